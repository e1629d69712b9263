"""What commands hear in a recording, with progress and with what a person should know about it."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from .stages import Stages

if TYPE_CHECKING:
    from mien.speech import Heard, Speech

UNSURE = 0.5
"""Words less sure than this are named."""

MOST_NAMED = 10


def hear_file(audio: Path, text: str | None, language: str | None, cues: Path | None, stages: Stages) -> Heard:
    """The words and phones of a recording: those of a file of cues where there is one, else those that are heard.

    Args:
        audio: a sound file or a film.
        text: what is said in it; None where nobody knows.
        language: in which it is said; English where None.
        cues: times that were corrected by hand.
        stages: told what is going on.
    """
    from mien.formats.sound_files import read_sound
    from mien.speech import Heard, Speech, hear

    with stages.progress("reading") as report:
        sound = read_sound(audio, report=report)
    if cues is not None:
        speech = take_cues(Speech(text or "", sound, (), (), (), ""), cues)
        return Heard(speech, (1.0,) * len(speech.words), ())
    with stages.progress("listening") as report:
        heard = hear(sound, text, language=language or "en", report=lambda done, total, doing: report(done, total))
    for notice in heard.notices:
        stages.say(f"{audio}: {notice}")
    if text is None:
        stages.say(f"heard: {heard.speech.text}")
    unsure = [
        f"{word.symbol!r} at {word.start_s:.1f} s"
        for word, sure in zip(heard.speech.words, heard.sure, strict=True)
        if sure < UNSURE
    ]
    if unsure:
        more = f" and {len(unsure) - MOST_NAMED} more" if len(unsure) > MOST_NAMED else ""
        stages.say(f"{audio}: not sure of {', '.join(unsure[:MOST_NAMED])}{more}")
    return heard


def take_cues(speech: Speech, cues: Path) -> Speech:
    """The speech with the words and phones of a file of cues in place of its own.

    Raises:
        LoadError: the file, or what its tiers say, cannot be used.
    """
    from mien.core import LoadError, MienError
    from mien.formats.cue_files import read_cue_file
    from mien.perform import correct

    sheet = read_cue_file(cues)
    try:
        return correct(speech, sheet)
    except MienError as error:
        raise LoadError(cues, str(error).removeprefix("cues: ")) from None
