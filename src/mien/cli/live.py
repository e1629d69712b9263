"""``mien live``: a face that moves while one looks at it, in a browser, driven from sockets."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import AsyncExitStack, suppress
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from . import options
from .main import Interrupted, signals
from .stages import Stages
from .streams import tell

if TYPE_CHECKING:
    from mien.live.motions import Motion
    from mien.live.serving.animator import Animator
    from mien.live.serving.server import Doors, Opened
    from mien.live.serving.speaker import Speaker
    from mien.live.serving.vmc_sender import VmcSender


def live(
    face: options.Face = "head",
    host: Annotated[
        str, typer.Option("--host", metavar="H", help="Address to listen on; all but this machine's own is a risk.")
    ] = "127.0.0.1",
    port: Annotated[
        int, typer.Option("--port", metavar="N", min=0, max=65535, help="Of page, WebSocket and HTTP; 0 is any free.")
    ] = 8765,
    tcp_port: Annotated[
        int | None, typer.Option("--tcp-port", metavar="N", min=0, max=65535, help="Text lines here; no token.")
    ] = None,
    osc_port: Annotated[
        int | None,
        typer.Option("--osc-port", metavar="N", min=0, max=65535, help="OSC and VMC over UDP here; no token."),
    ] = None,
    token: Annotated[
        str | None, typer.Option("--token", metavar="T", help="What clients must know; drawn by chance unless said.")
    ] = None,
    allow: Annotated[
        list[str] | None,
        typer.Option(
            "--allow",
            metavar="NAME|ORIGIN",
            help="Another name of this server (kiosk.lan), or where pages that connect come from "
            "(http://localhost:3000); may be repeated.",
        ),
    ] = None,
    rate: Annotated[
        float, typer.Option("--rate", metavar="HZ", min=1.0, max=240.0, help="Loops a second; ToonFace had 10.")
    ] = 60.0,
    idle: Annotated[
        str,
        typer.Option(
            "--idle", metavar="PART=N,…", help="What it does by itself, 0 to 1: blinks, saccades, breathing, sway."
        ),
    ] = "",
    motions: Annotated[
        list[Path] | None,
        typer.Option("--motions", metavar="FILE", help="Motions of your own, JSON; may be repeated."),
    ] = None,
    log: Annotated[
        Path | None, typer.Option("--log", metavar="FILE", help="Write every message with its loop ('mien replay').")
    ] = None,
    seed: Annotated[int, typer.Option("--seed", metavar="N", help="Of blinks and small movements.")] = 0,
    values: options.Sets = None,
    preset: options.Presets = None,
    units: options.Units = None,
    mix: options.Mix = None,
    person: options.Random = None,
    caricature: options.Caricature = 1.0,
    voice: Annotated[
        str | None, typer.Option("--voice", metavar="NAME", help="Who speaks: a name from 'mien voices'.")
    ] = None,
    mute: Annotated[
        bool, typer.Option("--no-voice", help="Say nothing but messages that bring their own phones; starts faster.")
    ] = False,
    vmc_to: Annotated[
        str | None,
        typer.Option("--vmc-to", metavar="HOST:PORT", help="Send the face by VMC, as in 127.0.0.1:39539."),
    ] = None,
    vmc_names: Annotated[
        str,
        typer.Option("--vmc-names", metavar="SET", help="Its names: vrm0, vrm1, arkit, perfect-sync."),
    ] = "vrm0",
    view: options.View = None,
    position: options.From = None,
    at: options.At = None,
    fov: options.Fov = None,
    background: options.Background = None,
    quiet: options.Quiet = False,
) -> None:
    """Serve a face, live, until Ctrl-C; open the link that it prints.

    \b
    mien live
    mien live --face toon:olav --tcp-port 7000
    mien live --face head:ada --osc-port 39539 --log talk.log
    mien live --rate 10 --idle blinks=0,saccades=0 --background transparent
    """
    import asyncio
    from contextlib import ExitStack

    from mien import api
    from mien.live import Session
    from mien.live.frames import FrameEncoder
    from mien.live.serving.animator import Animator
    from mien.live.serving.server import Doors
    from mien.live.serving.speaker import Speaker

    from . import settings
    from .session_log import session_log

    stages = Stages(quiet)
    subject = api.load_face(face)
    scene = settings.make_scene(
        api.default_scene(subject),
        size=None,
        view=view,
        position=position,
        at=at,
        fov=fov,
        shading=None,
        subdivide=None,
        background=background,
        light=None,
        diffuse=None,
        cosine_power=None,
    )
    own = {} if token is None else {"token": _check_token(token)}
    doors = Doors(host, port, allow=tuple(allow or ()), tcp_port=tcp_port, udp_port=osc_port, **own)
    with ExitStack() as stack:
        lines = None if log is None else stack.enter_context(session_log(log, tell))
        session = Session(
            subject,
            1.0 / rate,
            seed,
            pose=settings.make_pose(subject, values, preset, units, mix, person, caricature),
            idle=_parts(idle),
            motions=_read_motions(motions or ()),
            log=None if lines is None else lines.write,
        )
        stack.callback(session.close)
        animator = Animator(session, FrameEncoder(subject, scene, session.rate))
        if lines is not None:
            animator.on_frame(lambda frame: lines.flush())
        if vmc_to is not None:
            stack.callback(_send_vmc(animator, vmc_to, vmc_names).close)
        speaker = None
        if not mute:
            speaker = Speaker(voice, session.rate, seed, animator.deliver, motions=session.motions)
        asyncio.run(_serve_until_signalled(animator, doors, speaker, stages))
    if not session.loop:
        raise Interrupted
    late = animator.report.late
    stages.say(f"mien: the face has stopped after {session.loop} loops, of which {late} were late")


async def _serve_until_signalled(animator: Animator, doors: Doors, speaker: Speaker | None, stages: Stages) -> None:
    """Serve until somebody wants it to end, be it while the voice wakes; to want it twice does not hurry the end."""
    import asyncio

    enough = asyncio.Event()
    for number in signals():
        asyncio.get_running_loop().add_signal_handler(number, enough.set)
    serving = asyncio.create_task(_serve(animator, doors, speaker, stages))
    waiting = asyncio.create_task(enough.wait())
    await asyncio.wait((serving, waiting), return_when=asyncio.FIRST_COMPLETED)
    for task in (serving, waiting):
        task.cancel()
    with suppress(asyncio.CancelledError):
        await serving


async def _serve(animator: Animator, doors: Doors, speaker: Speaker | None, stages: Stages) -> None:
    """Open the doors and keep them open as long as all goes well."""
    from datetime import UTC, datetime
    from importlib.metadata import version

    from mien.live.serving.runtime import Running, announce
    from mien.live.serving.server import open_server

    async with AsyncExitStack() as stack:
        if speaker is not None:
            with stages.stage("waking the voice"):
                await speaker.start()
            stack.push_async_callback(speaker.close)
            animator.speaker = speaker
        opened = await stack.enter_async_context(open_server(animator, doors))
        start = datetime.now(UTC).isoformat(timespec="seconds")
        face = animator.session.face.name
        stack.enter_context(announce(Running(opened.link, opened.ports, face, version("mien"), start)))
        _tell(animator, doors, opened, stages)
        await opened.wait()


def _send_vmc(animator: Animator, target: str, names: str) -> VmcSender:
    from mien.core import MienError
    from mien.live.serving.vmc_sender import VmcSender

    host, _, port = target.rpartition(":")
    if not host or not port.isdigit() or not 0 < int(port) < 65536:
        raise MienError(f"--vmc-to {target}: want HOST:PORT, as in 127.0.0.1:39539")
    try:
        return VmcSender(animator, host.strip("[]"), int(port), names)
    except (OSError, UnicodeError) as error:
        raise MienError(f"--vmc-to {target}: there is no such host ({error})") from None


def _tell(animator: Animator, doors: Doors, opened: Opened, stages: Stages) -> None:
    from socket import gethostname

    from mien.live.serving.server import EVERYWHERE

    session = animator.session
    typer.echo(opened.link)
    stages.say(
        f"mien: {session.face.name} is live, {float(session.rate):g} loops a second; open the link; Ctrl-C ends it"
    )
    for name, port in opened.ports.items():
        if name != "page":
            stages.say(
                f"mien: {name.upper()} on {doors.host}:{port}, without a token: whoever reaches it can move the face"
            )
    if not doors.is_loopback:
        stages.say(
            f"mien: {doors.host} is open to others: whoever has the link can move the face, let it speak and see it. "
            "Nothing is encrypted: use it in networks that you trust, or behind a proxy with HTTPS"
        )
    if doors.host in EVERYWHERE:
        elsewhere = doors.link(opened.ports["page"], gethostname())
        stages.say(f"mien: from elsewhere {elsewhere} (or with an address of this machine in the place of its name)")


def _check_token(token: str) -> str:
    from mien.core import MienError

    if not (len(token) >= 8 and token.isascii() and all(letter.isalnum() or letter in "-_" for letter in token)):
        raise MienError("--token: want at least 8 letters, digits, - or _")
    return token


def _parts(text: str) -> dict[str, float]:
    """Amounts of idle life, from a text such as ``blinks=0,sway=0.5``."""
    from mien.core import MienError

    from . import settings

    found = {}
    for part in filter(None, (part.strip() for part in text.split(","))):
        name, equals, amount = part.partition("=")
        if not equals:
            raise MienError(f"--idle {part}: want PART=N, as in --idle blinks=0,sway=0.5")
        found[name] = settings.parse_number(amount, f"--idle {name}")
    return found


def _read_motions(paths: Sequence[Path]) -> list[Motion]:
    from mien.formats.cue_text import read_text
    from mien.live import parse_motions

    return [motion for path in paths for motion in parse_motions(read_text(path), str(path)).values()]
