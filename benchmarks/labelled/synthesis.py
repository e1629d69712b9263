"""Minutes of speech whose phone times are known: sentences said by the voices of espeak-ng."""

from __future__ import annotations

import subprocess
from pathlib import Path

import numpy as np

SEED = 1974
VOICES = ("en-us", "en-us+f3", "en-us+m3", "en-us+f2", "en-us+m7")
WORDS_A_MINUTE = (130, 185)
PITCH = (35, 65)
SENTENCES_A_CLIP = 4
CLIPS_A_MINUTE = 3


def write_script(path: Path, minutes: float) -> None:
    """A line of name, voice, speed, pitch and sentences for each clip; the same ones each time."""
    sentences = (Path(__file__).parent / "sentences.txt").read_text(encoding="utf-8").splitlines()
    random = np.random.default_rng(SEED)
    order: list[str] = []
    lines = []
    for number in range(max(1, round(minutes * CLIPS_A_MINUTE))):
        if len(order) < SENTENCES_A_CLIP:
            order = [sentences[k] for k in random.permutation(len(sentences))]
        text, order = " ".join(order[:SENTENCES_A_CLIP]), order[SENTENCES_A_CLIP:]
        speed, pitch = random.integers(*WORDS_A_MINUTE), random.integers(*PITCH)
        lines.append(f"{number:03d}\t{VOICES[number % len(VOICES)]}\t{speed}\t{pitch}\t{text}\n")
    path.write_text("".join(lines), encoding="utf-8")


def synthesise(folder: Path, minutes: float, python: Path) -> None:
    """Sounds, labels and transcripts in a folder; the interpreter is that of the peers' environment."""
    write_script(folder / "script.tsv", minutes)
    worker = Path(__file__).parents[1] / "peers" / "with_espeak.py"
    subprocess.run([python, worker, folder / "script.tsv", folder], check=True)
