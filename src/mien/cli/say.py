"""``mien say``: a sentence in, a talking head out."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from . import options
from .stages import Stages

if TYPE_CHECKING:
    from mien.speech import Speech


def say(
    out: options.Film,
    text: Annotated[
        str | None,
        typer.Argument(metavar="TEXT|@FILE|-", help="What to say, a file to read from, or - for standard input."),
    ] = None,
    face: options.Face = "head",
    voice: Annotated[
        str | None, typer.Option("--voice", metavar="NAME", help="Who speaks: a name from 'mien voices'.")
    ] = None,
    audio: Annotated[
        Path | None,
        typer.Option("--audio", metavar="FILE", help="A recording to speak with: WAV, MP3, OGG, FLAC, M4A, a film."),
    ] = None,
    transcript: options.Transcript = None,
    language: options.Language = None,
    cues: options.Cues = None,
    script: Annotated[
        Path | None,
        typer.Option(
            "--script",
            metavar="FILE",
            help="Several speakers: a table speaker,line (and face,voice,emotion) in CSV. OUT with %s in its name is "
            "a film of each; else one film cuts to whoever speaks.",
        ),
    ] = None,
    style: Annotated[
        str,
        typer.Option(
            "--style",
            metavar="NAME=AMOUNT,…|@FILE",
            help="How lively, 0 (off) over 1 to 2: blinks, head, brows, gaze, strength, jaw, lips, tongue; passes of "
            "the mouth: targets, stress, diphthongs, brief, pauses, anticipation, lag, dominance, rounding, closures; "
            "or a name: mumbling, enunciating, ventriloquist, drawling, pursed, still; or a style file.",
        ),
    ] = "",
    emotion: Annotated[
        str | None,
        typer.Option(
            "--emotion", metavar="NAME[=N]", help="An expression that shows through: a preset, or 0..1 of it."
        ),
    ] = None,
    seed: Annotated[int, typer.Option("--seed", metavar="N", help="Of blinks, small movements and brows.")] = 0,
    values: options.Sets = None,
    preset: options.Presets = None,
    units: options.Units = None,
    mix: options.Mix = None,
    person: options.Random = None,
    caricature: options.Caricature = 1.0,
    exaggerate: options.Exaggerate = 1.0,
    size: options.Size = None,
    fps: options.Fps = None,
    view: options.View = None,
    position: options.From = None,
    at: options.At = None,
    fov: options.Fov = None,
    shading: options.Shading = None,
    subdivide: options.Subdivide = None,
    background: options.Background = None,
    light: options.Light = None,
    diffuse: options.Diffuse = None,
    cosine_power: options.CosinePower = None,
    threads: options.Threads = None,
    subtitles: options.Subtitles = None,
    variable: options.Variable = False,
    quiet: options.Quiet = False,
) -> None:
    """Let a face say something, as a film with its voice.

    \b
    mien say "How happy is the little stone" -o stone.mp4
    mien say @poem.txt --face head:ada --view front --fps 30 -o poem.mp4
    mien say "Good night." --preset sleepy --style blinks=2,head=0.5 -o night.mp4
    mien say "Good morning." --style mumbling -o morning.mp4
    mien say @news.txt --fps 29.97 --subtitles burn -o news.webm
    mien say "Schöne Grüße aus München." --language de -o gruesse.mp4
    mien say "What a surprise!" --emotion surprised --exaggerate 1.6 -o surprise.mp4
    mien say "Over there." --background transparent -o overlay.mov --subtitles overlay.srt
    mien say "[wave] Hello!" --face toon:olav -o olav.webm
    mien say "Hello there." -o hello.glb
    mien say --audio line.wav --text "Call me at noon." -o line.mp4
    mien say --audio line.wav --cues corrected.TextGrid -o line.mp4
    mien say "I am [smile 0.6] so *happy* <break time='400ms'/> to see you. [look left] Who is that?" -o who.mp4
    mien say --script talk.csv -o talk.mp4
    mien say --script talk.csv -o talk_%s.mp4
    echo Hello | mien say - --emotion smile=0.6 -o hello.json
    """
    from mien import api
    from mien.core.exaggeration import check_amount
    from mien.formats import DEFAULT_FPS, check_performance
    from mien.formats.performances import HEARD, usual_scene
    from mien.perform import check_emotion, check_marks, listen, load_style, parse_marks
    from mien.perform import exaggerate as exaggerate_performance

    from . import settings
    from .writing import write

    rate = DEFAULT_FPS if fps is None else settings.parse_rate(fps)
    subject = api.load_face(face)
    scene = settings.make_scene(
        usual_scene(out, api.default_scene(subject)),
        size=size,
        view=view,
        position=position,
        at=at,
        fov=fov,
        shading=shading,
        subdivide=subdivide,
        background=background,
        light=light,
        diffuse=diffuse,
        cosine_power=cosine_power,
    )
    settings.check_threads(threads)
    check_amount(exaggerate)
    manner = load_style(style)
    mood, amount = settings.parse_emotion(emotion)
    stages = Stages(quiet)
    if script is not None:
        check_alone(script, text, audio, transcript, cues)
        voice = check_source(str(script), voice, None, None, language)
        from .script import Job, say_script

        begun = "" if mood is None else f"{mood} {amount:g}"
        job = Job(
            out,
            scene,
            rate,
            threads,
            subtitles,
            variable,
            face,
            voice,
            begun,
            seed,
            manner,
            lambda face: settings.make_pose(face, values, preset, units, mix, person, caricature),
            exaggerate,
        )
        say_script(script, job, stages)
        return
    # Everything that can be wrong is looked at before the first long step.
    kind = check_performance(out, fps=rate, scene=scene, subtitles=subtitles, variable=variable)
    if kind == "glb":
        from mien.formats.glb_targets import check_face

        check_face(subject)
    pose = settings.make_pose(subject, values, preset, units, mix, person, caricature)
    voice = check_source(text, voice, audio, transcript, language)
    written = text if audio is None else transcript
    written = None if written is None else settings.read_text(written)
    if written is not None:
        check_marks(parse_marks(written), subject)
    if mood is not None:
        check_emotion(subject, mood, amount)
    speech = find_speech(written, voice, audio, language, cues, stages)
    if kind in HEARD:
        performance = listen(speech, subject)
    else:
        with stages.stage("moving the face"):
            performance = api.perform(
                speech,
                subject,
                seed=seed,
                style=manner,
                emotion=mood,
                emotion_amount=amount,
                pose=pose,
                scene=scene,
            )
            performance = exaggerate_performance(performance, exaggerate)
    write(performance, out, kind, stages, fps=rate, threads=threads, subtitles=subtitles, variable=variable)


def check_alone(script: Path, text: str | None, audio: Path | None, transcript: str | None, cues: Path | None) -> None:
    """Nothing, when nothing but a script says what is said.

    Raises:
        MienError: something else does, too.
    """
    from mien.core import MienError

    others = {"TEXT": text, "--audio": audio, "--text": transcript, "--cues": cues}
    found = next((f"{name} {other}" for name, other in others.items() if other is not None), None)
    if found is not None:
        raise MienError(f"{found}: the script {script} says what is said — leave one of them out")


def check_source(
    text: str | None, voice: str | None, audio: Path | None, transcript: str | None, language: str | None
) -> str | None:
    """The name of the voice that speaks; None for the usual one, or a recording.

    Raises:
        MienError: neither or both do, or an option belongs to the other.
        UnknownNameError: there is no such voice, or nobody speaks the language.
    """
    from mien import api
    from mien.core import MienError
    from mien.speech import find_speaker

    if audio is None:
        if text is None:
            raise MienError('nothing to say — give a text, as in mien say "Hello there." -o hello.mp4, or --audio FILE')
        if transcript is not None:
            raise MienError("--text says what a recording says — add --audio FILE, or leave --text out")
        if language is not None and voice is not None:
            raise MienError(f"--voice {voice} has a language of its own — leave --language {language} out")
        if language is not None:
            return find_speaker(language).name
        api.find_voice(voice)
        return voice
    elif text is not None:
        raise MienError(f"{text!r}: the recording {audio} speaks already — what it says goes after --text")
    elif voice is not None:
        raise MienError(f"--voice {voice}: the recording {audio} has its own — leave one of them out")
    return None


def find_speech(
    script: str | None,
    voice: str | None,
    audio: Path | None,
    language: str | None,
    cues: Path | None,
    stages: Stages,
) -> Speech:
    """What the face says: a text by a voice, or a recording; with the times of a file of cues where there is one."""
    from mien import api
    from mien.perform import parse_marks

    from .hearing import hear_file, take_cues

    if audio is not None:
        text = None if script is None else parse_marks(script).text
        return replace(hear_file(audio, text, language, cues, stages).speech, script=script or "")
    with stages.progress("speaking") as report:
        speech = api.speak(script or "", voice, report=lambda done, total, doing: report(done, total))
    if speech.skipped:
        stages.say(f"not spoken, because the voice {speech.voice!r} cannot: {' '.join(speech.skipped)}")
    return speech if cues is None else take_cues(speech, cues)
