"""A live face on sockets of this machine: ``python benchmarks/live.py [PART …] [--seconds 60] [--face head]``.

Loops: their rate and how late they begin. Paths: from a command to the picture that shows it, for each way in.
Commands: how many a second, in batches of a hundred, answered in order. Viewers: what twenty of them cost. Busy: the
first two while something else has all cores. Memory, only if it is named: ``--minutes 30``, with two viewers, commands
and clients that come and go. The face runs in a process of its own, as ``mien live`` starts it; viewers acknowledge
every picture.
"""

from __future__ import annotations

import argparse
import asyncio
import json
import os
import random
import socket
import struct
import subprocess
import sys
import time
import urllib.request
from collections.abc import Awaitable, Callable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from urllib.parse import parse_qs, urlsplit

import numpy as np
from websockets.asyncio.client import ClientConnection, connect

from mien.live.osc import encode_call
from mien.live.wire import FRAME, HEADER

STILL = "blinks=0,saccades=0,breathing=0,sway=0"
TRIALS = 150
BATCH = 100
VIEWERS = 20
AHEAD = 4
"""Batches on their way without an answer."""

ROW = "jaw.rotation"
TOON_ROW = "MB"
SLEEP = """
import sys, time
seconds, delays = float(sys.argv[1]), []
due = start = time.perf_counter()
while due < start + seconds:
    due += 1 / 60
    time.sleep(max(0.0, due - time.perf_counter()))
    delays.append(time.perf_counter() - due)
delays.sort()
print(*(round(1000 * delays[int(share * (len(delays) - 1))], 3) for share in (0.5, 0.95, 0.99)))
"""
"""What wakes sixty times a second and does nothing else: how late the machine itself is."""

SPIN = "import time\nend = time.monotonic() + {}\nwhile time.monotonic() < end: sum(range(1000))"


@dataclass(frozen=True)
class Server:
    """A face that runs.

    Attributes:
        process: its process.
        link: of the page.
        row: what commands move.
    """

    process: subprocess.Popen[str]
    link: str
    row: str

    @property
    def port(self) -> int:
        return urlsplit(self.link).port or 80

    @property
    def token(self) -> str:
        return parse_qs(urlsplit(self.link).query)["token"][0]

    @property
    def headers(self) -> dict[str, str]:
        return {"Authorization": f"Bearer {self.token}"}

    def about(self) -> dict:
        request = urllib.request.Request(f"http://127.0.0.1:{self.port}/about", headers=self.headers)
        with urllib.request.urlopen(request, timeout=10) as answer:
            return json.load(answer)

    def post(self, message: dict) -> None:
        url, data = f"http://127.0.0.1:{self.port}/messages", json.dumps(message).encode()
        with urllib.request.urlopen(urllib.request.Request(url, data, self.headers), timeout=10) as answer:
            answer.read()

    def socket(self) -> connect:
        address = f"ws://127.0.0.1:{self.port}/live"
        return connect(address, additional_headers=self.headers, compression=None, max_size=None)

    @property
    def cpu_s(self) -> float:
        """Processor time of the process so far, seconds."""
        fields = Path(f"/proc/{self.process.pid}/stat").read_text().rpartition(")")[2].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")

    @property
    def memory_mb(self) -> float:
        lines = Path(f"/proc/{self.process.pid}/status").read_text().splitlines()
        return next(int(line.split()[1]) for line in lines if line.startswith("VmRSS")) / 1024.0


@contextmanager
def serve(face: str, *, idle: str = "") -> Iterator[Server]:
    """A face in a process of its own."""
    command = [
        sys.executable,
        "-m",
        "mien",
        "live",
        "--face",
        face,
        "--port",
        "0",
        "--tcp-port",
        "0",
        "--osc-port",
        "0",
    ]
    process = subprocess.Popen([*command, "--no-voice", "--quiet", "--idle", idle], stdout=subprocess.PIPE, text=True)
    try:
        line = process.stdout.readline() if process.stdout else ""
        server = Server(process, line.strip(), TOON_ROW if face.startswith("toon") else ROW)
        wait_for_loops(server)
        yield server
    finally:
        process.terminate()
        process.wait(10)
        if process.stdout:
            process.stdout.close()


def wait_for_loops(server: Server) -> None:
    """Let what happens once be over."""
    deadline = time.monotonic() + 30
    while time.monotonic() < deadline:
        with suppress(OSError):
            if server.about()["loop"] > 120:
                return
        time.sleep(0.1)


def acknowledge(message: bytes) -> bytes | None:
    """The answer of a page to a picture."""
    kind, _, setup, loop, _ = HEADER.unpack_from(message)
    return struct.pack("<BBHI", 1, 0, setup, loop) if kind == FRAME else None


async def watch(server: Server, seen: Callable[[bytes], object]) -> None:
    """A viewer that draws at once, until cancelled."""
    async with server.socket() as viewer:
        await viewer.send(json.dumps({"kind": "subscribe", "frames": True}))
        async for message in viewer:
            if isinstance(message, bytes) and (answer := acknowledge(message)):
                await viewer.send(answer)
                seen(message)


def measure_loops(server: Server, seconds: float) -> None:
    """Rate and delays of loops, while nobody disturbs them; and what the machine does to a program that only sleeps."""
    command = [sys.executable, "-c", SLEEP, str(seconds)]
    before, start = server.about()["loop"], time.perf_counter()
    p50, p95, p99 = subprocess.run(command, capture_output=True, text=True, check=True).stdout.split()
    about, lasted = server.about(), time.perf_counter() - start
    rate = (about["loop"] - before) / lasted
    delays = about["loops"]["delay_ms"]
    print(f"  {lasted:.1f} s: {rate:.4f} loops a second, error {100 * (rate / about['rate_hz'] - 1):+.3f} %")
    print(f"  a loop begins late by p50 {delays['p50']}, p95 {delays['p95']}, p99 {delays['p99']} ms")
    print(f"  beside it, a program that only sleeps wakes late by p50 {p50}, p95 {p95}, p99 {p99} ms")
    print(f"  late by a loop or more: {about['loops']['late']}, dropped {about['loops']['dropped']}")


async def measure_paths(server: Server, trials: int) -> None:
    """From a command to the picture that shows it, by every way in."""
    ports = server.about()["ports"]
    news: asyncio.Queue[tuple[float, bytes]] = asyncio.Queue()
    last = b""

    def seen(message: bytes) -> None:
        nonlocal last
        if message[HEADER.size :] != last:
            last = message[HEADER.size :]
            news.put_nowait((time.perf_counter(), last))

    viewing = asyncio.create_task(watch(server, seen))
    await news.get()
    udp = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    reader, writer = await asyncio.open_connection("127.0.0.1", ports["tcp"])
    async with server.socket() as sender:

        async def by_websocket(value: float) -> None:
            await sender.send(json.dumps({"kind": "move", "values": {server.row: value}}))

        async def by_tcp(value: float) -> None:
            writer.write(f"{server.row} {value}\n".encode())
            await writer.drain()

        async def by_osc(value: float) -> None:
            udp.sendto(encode_call(f"/mien/move/{server.row.replace('.', '/')}", value), ("127.0.0.1", ports["osc"]))

        async def by_http(value: float) -> None:
            await asyncio.to_thread(server.post, {"kind": "move", "values": {server.row: value}})

        ways: dict[str, Callable[[float], Awaitable[None]]] = {
            "WebSocket": by_websocket, "TCP": by_tcp, "OSC": by_osc, "HTTP": by_http,
        }  # fmt: skip
        for name, send in ways.items():
            print(f"  {name:10s}" + summary([await one_trial(send, news, number) for number in range(trials)]))
    viewing.cancel()
    await asyncio.gather(viewing, return_exceptions=True)
    writer.close()
    udp.close()
    await reader.read()


async def one_trial(send: Callable[[float], Awaitable[None]], news: asyncio.Queue, number: int) -> float:
    """Milliseconds from a command, at a moment drawn by chance, to its picture."""
    await asyncio.sleep(0.03 + random.random() / 60)
    while not news.empty():
        news.get_nowait()
    start = time.perf_counter()
    sending = asyncio.ensure_future(send(0.2 + 0.001 * (number % 500)))
    came, _ = await asyncio.wait_for(news.get(), 10)
    await sending
    return 1000 * (came - start)


def summary(values: list[float]) -> str:
    """Percentiles, in ms."""
    p50, p95, p99 = np.percentile(values, [50, 95, 99])
    return f"p50 {p50:.1f}, p95 {p95:.1f}, p99 {p99:.1f} ms ({len(values)} commands)"


async def measure_commands(server: Server, seconds: float) -> None:
    """Motor commands a second on one WebSocket, in batches of a hundred, all answered in order."""
    async with server.socket() as sender:
        number = answered = 0
        start = time.perf_counter()

        async def send() -> None:
            nonlocal number
            batch = [
                {"kind": "move", "values": {server.row: 0.2 + 1e-5 * k}, "over_ms": 100, "id": str(number + k)}
                for k in range(BATCH)
            ]
            number += BATCH
            await sender.send(json.dumps(batch))

        for _ in range(AHEAD):
            await send()
        while answered < number:
            replies = json.loads(await sender.recv())
            wanted = [str(answered + k) for k in range(BATCH)]
            if [reply["id"] for reply in replies] != wanted or any(reply["kind"] != "ok" for reply in replies):
                raise SystemExit(f"answers out of order, or refused: {replies[0]}")
            answered += BATCH
            if time.perf_counter() - start < seconds:
                await send()
        lasted = time.perf_counter() - start
        print(f"  {answered / lasted:,.0f} a second ({answered:,} in {lasted:.1f} s), all answered in order")


async def view_together(server: Server, count: int, seconds: float) -> list[int]:
    """How many pictures each of some viewers has drawn."""
    drawn = [0] * count

    def counter(number: int) -> Callable[[bytes], None]:
        def count_one(message: bytes) -> None:
            drawn[number] += 1

        return count_one

    tasks = [asyncio.create_task(watch(server, counter(number))) for number in range(count)]
    await asyncio.sleep(2.0)
    before, cpu, start = list(drawn), server.cpu_s, time.perf_counter()
    await asyncio.sleep(seconds)
    lasted, used = time.perf_counter() - start, server.cpu_s - cpu
    rates = sorted((after - first) / lasted for after, first in zip(drawn, before, strict=True))
    print(
        f"  {count:2d} viewers: {100 * used / lasted:.0f} % of a core; pictures a second {rates[0]:.1f} to "
        f"{rates[-1]:.1f}, {100 * used / lasted / max(count, 1):.1f} % a viewer"
    )
    for task in tasks:
        task.cancel()
    await asyncio.gather(*tasks, return_exceptions=True)
    return drawn


async def measure_memory(server: Server, minutes: float) -> None:
    """Memory while viewers watch, commands come, and clients come and go."""
    tasks = [asyncio.create_task(watch(server, len)) for _ in range(2)]
    start = time.perf_counter()
    readings: list[tuple[float, float]] = []
    while (now := time.perf_counter() - start) < 60.0 * minutes:
        await come_and_go(server)
        readings.append((now / 60.0, server.memory_mb))
        if len(readings) % 60 == 1:
            print(f"  {readings[-1][0]:5.1f} min {readings[-1][1]:7.1f} MB", flush=True)
        await asyncio.sleep(1.0)
    late = np.array(readings[len(readings) // 3 :])
    slope = np.polyfit(late[:, 0], late[:, 1], 1)[0] if len(late) > 2 else 0.0
    print(f"  in the last two thirds it grows by {1000 * slope:+.0f} kB a minute")
    for task in tasks:
        task.cancel()
    await asyncio.gather(*tasks, return_exceptions=True)


async def come_and_go(server: Server) -> None:
    client: ClientConnection
    async with server.socket() as client:
        await client.send(json.dumps([{"kind": "play", "motion": "smile"}, {"kind": "state"}]))
        await client.recv()


@contextmanager
def busy_cores(seconds: float) -> Iterator[None]:
    """Something else has all cores."""
    spinning = [subprocess.Popen([sys.executable, "-c", SPIN.format(seconds)]) for _ in range(os.cpu_count() or 1)]
    try:
        yield
    finally:
        for process in spinning:
            process.kill()
            process.wait()


def loops(options: argparse.Namespace) -> None:
    print(f"loops of {options.face}, alive, nobody connected")
    with serve(options.face) as server:
        measure_loops(server, options.seconds)


def paths(options: argparse.Namespace) -> None:
    print("from a command to its picture in a viewer")
    with serve(options.face, idle=STILL) as server:
        asyncio.run(measure_paths(server, TRIALS))


def commands(options: argparse.Namespace) -> None:
    print("motor commands")
    with serve(options.face, idle=STILL) as server:
        asyncio.run(measure_commands(server, min(10.0, options.seconds)))


def viewers(options: argparse.Namespace) -> None:
    print("viewers")
    with serve(options.face) as server:
        for count in (1, VIEWERS):
            asyncio.run(view_together(server, count, options.seconds / 2))


def busy(options: argparse.Namespace) -> None:
    print("with all cores busy")
    with serve(options.face) as server, busy_cores(3 * options.seconds):
        time.sleep(1.0)
        measure_loops(server, options.seconds / 3)
    with serve(options.face, idle=STILL) as server, busy_cores(6 * options.seconds):
        asyncio.run(measure_paths(server, TRIALS // 3))


def memory(options: argparse.Namespace) -> None:
    print(f"memory, {options.minutes:g} minutes")
    with serve(options.face) as server:
        asyncio.run(measure_memory(server, options.minutes))


PARTS = {part.__name__: part for part in (loops, paths, commands, viewers, busy, memory)}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument(
        "parts",
        nargs="*",
        choices=[[], *PARTS],
        metavar="PART",
        help=f"of {', '.join(PARTS)}; all but memory unless said",
    )
    parser.add_argument("--seconds", type=float, default=60.0, help="of loops, and half of it for viewers")
    parser.add_argument("--minutes", type=float, default=30.0, help="of watching memory")
    parser.add_argument("--face", default="head")
    options = parser.parse_args()
    for name in options.parts or [name for name in PARTS if name != "memory"]:
        PARTS[name](options)


if __name__ == "__main__":
    main()
