"""How soon a live face speaks: ``python benchmarks/first_sound.py [--rounds 3] [--voice NAME]``.

From the moment at which a ``say`` is handed over to that at which the first of its sound is there, with the movement
that goes with it; the process that makes both is warm, and nothing else is being said. Then the same for texts that
come word by word, from the word that completes the first sentence, and for what is still to be made after an
interruption. Every text is said ``--rounds`` times; the worst of what else a machine does is in the numbers.
"""

from __future__ import annotations

import argparse
import asyncio
import os
import time
from fractions import Fraction
from statistics import median

import numpy as np

from mien.live import check_message
from mien.live.serving.speaker import Failure, Part, Speaker

RATE = Fraction(60)
TEXTS = (
    "Yes.",
    "Hello there.",
    "Good morning, Anna.",
    "I am not quite sure.",
    "What can I do for you today?",
    "It is a quarter past nine.",
    "That will be 24 euros and 90 cents.",
    "Please take a seat; she will be with you soon.",
    "The train to Reykjavik leaves from platform three.",
    "I have looked it up, and there are two that might suit you.",
    "Dr. Smith is on the second floor, the third door on the left.",
    "If you would like to know more about it, just ask me whenever you like.",
    "Turn left at the church and follow the river until you see an old bridge made of stone.",
    "First we measure the flour, then we warm the milk, and only then do we add the eggs, one at a time.",
    "Nobody knew who had left the window open that night, although everybody had an idea of their own about it.",
    "The weather will be fine in the morning, with some clouds coming in from the west, and rain is expected by the "
    "evening.",
    "Parke made the first three-dimensional face on a computer in 1972, and two years later he gave it parameters, so "
    "that anybody could make it speak.",
    "She opened the letter, read it twice, folded it with great care, put it back into its envelope, and went out into "
    "the garden without a single word.",
    "There are three reasons for this: it is cheap, it is quick, and nobody has ever complained about it, at least not "
    "in writing, and not to anybody who would have told us, which comes to the same.",
    "When the last of the guests had gone and the lights in the hall were out we sat down on the stairs and talked "
    "until the sun came up about everything that we had meant to say all evening and had not found the time for.",
)
"""From 4 to 210 characters; the last one without a comma, so that it is made in one piece."""


class Stage:
    """A speaker whose listener only waits."""

    def __init__(self, voice: str | None) -> None:
        self.news: asyncio.Queue[Part | Failure] = asyncio.Queue()
        self.speaker = Speaker(voice, RATE, 1, self.news.put_nowait)

    def say(self, text: str, *, more: bool = False) -> None:
        """Hand a text over while nothing is being said."""
        self.speaker.tick(0.0)
        self.speaker.say(check_message({"kind": "say", "text": text, "more": more}))

    async def hear(self) -> Part:
        part = await self.news.get()
        if isinstance(part, Failure):
            raise SystemExit(part.message)
        return part

    async def hear_all(self) -> list[Part]:
        parts = [await self.hear()]
        while parts[-1].message["more"]:
            self.speaker.tick(0.0)  # as if all of it were over
            parts.append(await self.hear())
        return parts


async def first_ms(stage: Stage, text: str) -> tuple[float, float]:
    """Milliseconds until the first sound of a text, and how long that sound lasts, seconds."""
    start = time.perf_counter()
    stage.say(text)
    part = await stage.hear()
    took = time.perf_counter() - start
    if part.message["more"]:
        await stage.hear_all()
    return 1000.0 * took, float(part.utterance.loops / RATE)


async def streamed_ms(stage: Stage, text: str) -> float:
    """Milliseconds until the first sound, from the word that shows that the first sentence is over."""
    for word in text.split():
        stage.say(word + " ", more=True)
        await asyncio.sleep(0)
    start = time.perf_counter()
    stage.say("Well", more=True)
    await stage.hear()
    took = time.perf_counter() - start
    stage.say(".")
    await stage.hear_all()
    return 1000.0 * took


async def interrupted_ms(stage: Stage, text: str) -> float:
    """Milliseconds until the first sound of a short text that comes in the midst of a long one's making."""
    stage.say(text)
    await asyncio.sleep(0.02)
    stage.speaker.cancel()
    took, _ = await first_ms(stage, TEXTS[1])
    return took


def tell(what: str, found: list[float]) -> None:
    print(f"{what:44} {median(found):6.0f} {np.percentile(found, 95):6.0f} {max(found):6.0f}")


async def measure(rounds: int, voice: str | None) -> None:
    stage = Stage(voice)
    start = time.perf_counter()
    await stage.speaker.start()
    print(f"start of the process, warm: {time.perf_counter() - start:.1f} s; load {os.getloadavg()[0]:.1f}")
    try:
        print(f"{'ms until the first sound':44} {'p50':>6} {'p95':>6} {'worst':>6}")
        found: list[float] = []
        for text in TEXTS:
            one, lengths = zip(*[await first_ms(stage, text) for _ in range(rounds)], strict=True)
            tell(f"  {len(text)} characters, first sound {lengths[0]:.1f} s", [*one])
            found += one
        tell(f"{len(TEXTS)} texts, {rounds} times each", found)
        words = [text for text in TEXTS if len(text) > 20 and "," not in text and "." not in text[:-1]]
        tell("word by word", [await streamed_ms(stage, text) for text in words[:8] for _ in range(rounds)])
        tell("after an interruption", [await interrupted_ms(stage, TEXTS[-1]) for _ in range(4 * rounds)])
    finally:
        await stage.speaker.close()


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--voice")
    arguments = parser.parse_args()
    asyncio.run(measure(arguments.rounds, arguments.voice))


if __name__ == "__main__":
    main()
