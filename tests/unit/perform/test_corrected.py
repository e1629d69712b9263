"""Timing corrected by hand: tiers and labels of other programs become the words and phones of a speech."""

from __future__ import annotations

import csv
from collections import Counter
from dataclasses import replace
from importlib import resources
from itertools import pairwise
from pathlib import Path

import pytest

from mien.core import Cue, MienError, Sound, UnknownNameError
from mien.formats import CueSheet, read_cue_file, write_cue_file
from mien.perform import correct, cues_for_speech
from mien.speech import PHONES, Speech
from mien.speech.mouth import articulate


def sheet(*labels: str, tier: str = "phones", step_s: float = 0.1) -> CueSheet:
    """Labels one after another; an empty one is a gap."""
    cues = tuple(Cue(n * step_s, (n + 1) * step_s, label) for n, label in enumerate(labels) if label)
    return CueSheet(len(labels) * step_s, {tier: cues})


def phones(*labels: str, tier: str = "phones") -> str:
    return " ".join(cue.symbol for cue in cues_for_speech(sheet(*labels, tier=tier))[1])


def said() -> Speech:
    words = (Cue(0.1, 0.5, "Oh"),)
    return Speech("Oh!", Sound.silence(0.6), words, (Cue(0.0, 0.1, "SIL"), Cue(0.1, 0.6, "OW1")), (), "somebody")


@pytest.mark.parametrize(
    ("labels", "wanted"),
    [
        (["HH", "AH0", "L", "OW1"], "HH AH0 L OW1"),
        (["hh", "ah", "l", "ow2", "PT"], "HH AH0 L OW2 P T"),
        (["h#", "ax", "pcl", "p", "axr", "en", "h#"], "SIL AH0 P P ER0 N SIL"),
        (["h", "ə", "ˈl", "əw"], "HH AH0 L OW1"),
        (["ˈhɛ", "ˌlo"], "HH EH1 L OW2"),
        (["tʃ", "t͡ʃ", "dʒ", "ʎ", "pʰ", "iː", "n̩", "mʲ", "ç", "ɑ̃"], "CH CH JH LY P IY0 N M HY AO0"),
        (["<p:>", '"h', "@", "l", "@U", "3:", "tS", "r\\", "{"], "SIL HH AH1 L OW0 ER0 CH R AE0"),
        (["V", "m", "N", "@:", "r", "d_b", "ai", "f@"], "AH0 M NG ER0 R D B AY0 F AH0"),
        (["", "sp", "M", "", "sil", "B", "spn"], "SIL M SIL B SIL"),
    ],
    ids=[
        "arpabet",
        "lower case",
        "timit",
        "ipa",
        "ipa with stress",
        "ipa with marks",
        "sampa",
        "two in a label",
        "pauses",
    ],
)
def test_labels_become_arpabet_with_stress(labels: list[str], wanted: str) -> None:
    assert phones(*labels) == wanted


@pytest.mark.parametrize("tier", ["phones", "Phones", "PHONE", "phonemes", "Phoneme", "MAU", "Ada - phones", "segment"])
def test_tiers_are_found_by_the_names_that_programs_give_them(tier: str) -> None:
    assert phones("M", tier=tier) == "M"


def test_words_are_found_beside_them_and_pauses_are_none() -> None:
    cues = (Cue(0.0, 0.1, "<p:>"), Cue(0.1, 0.3, "oh"))
    both = {"MAU": sheet("", "o", "o").tiers["phones"], "KAN-MAU": (Cue(0.1, 0.3, "oU"),), "ORT-MAU": cues}
    assert cues_for_speech(CueSheet(0.3, both))[0] == (Cue(0.1, 0.3, "oh"),)
    del both["ORT-MAU"]
    assert cues_for_speech(CueSheet(0.3, both))[0] == (Cue(0.1, 0.3, "oU"),)
    del both["KAN-MAU"]
    assert cues_for_speech(CueSheet(0.3, both))[0] == ()


def test_phones_have_no_holes_and_two_in_a_label_share_its_time() -> None:
    cues = (Cue(0.1, 0.2, "M"), Cue(0.3, 0.7, "aɪ"), Cue(0.7, 0.8, "ʦ"))
    assert cues_for_speech(CueSheet(1.0, {"phones": cues[:1]}))[1] == (
        Cue(0.0, 0.1, "SIL"),
        Cue(0.1, 0.2, "M"),
        Cue(0.2, 1.0, "SIL"),
    )
    found = cues_for_speech(CueSheet(1.0, {"phones": (Cue(0.1, 0.2, "m"), *cues[1:])}))[1]
    assert [(cue.symbol, round(cue.start_s, 9)) for cue in found] == [
        ("SIL", 0.0),
        ("M", 0.1),
        ("SIL", 0.2),
        ("AY0", 0.3),
        ("T", 0.7),
        ("S", 0.75),
        ("SIL", 0.8),
    ]
    assert all(one.end_s == two.start_s for one, two in pairwise(found))


@pytest.mark.parametrize(
    ("labels", "message"),
    [
        (["HH", "", "AEE"], r"tier 'phones', interval 3 \(0\.200 s\), read as arpabet: 'AEE' — did you mean 'AE'"),
        (["h", "ɛ", "ʘ"], r"interval 3 \(0\.200 s\), read as ipa: 'ʘ'"),
        (["B1", "AE1"], "interval 1 .*'B1' — did you mean 'B'"),
        (["AE3"], "'AE3'"),
        (["AE12"], "'AE12'"),
    ],
)
def test_a_label_that_is_no_phone_is_named_with_its_place(labels: list[str], message: str) -> None:
    with pytest.raises(UnknownNameError, match=message):
        phones(*labels)


@pytest.mark.parametrize(
    ("tiers", "message"),
    [
        ({"words": (Cue(0.0, 1.0, "a"),)}, "no tier of phones, only 'words' — name one of them 'phones'"),
        ({"phones": ()}, "tier 'phones' is empty"),
        (
            {"a - phones": (Cue(0.0, 1.0, "M"),), "b - phones": (Cue(0.0, 1.0, "M"),)},
            "2 tiers may be the phones: 'a - phones', 'b - phones' — keep one",
        ),
    ],
)
def test_tiers_that_are_missing_or_too_many_are_refused(tiers: dict[str, tuple[Cue, ...]], message: str) -> None:
    with pytest.raises(MienError, match=message):
        cues_for_speech(CueSheet(1.0, tiers))


def test_what_is_corrected_wins_over_ours() -> None:
    corrected = CueSheet(0.61, {"words": (Cue(0.2, 0.5, "Ah"),), "phones": (Cue(0.2, 0.61, "AA1"),)})
    speech = correct(before := said(), corrected)
    assert speech.words == (Cue(0.2, 0.5, "Ah"),)
    assert speech.phones == (Cue(0.0, 0.2, "SIL"), Cue(0.2, 0.6, "AA1"))
    assert (speech.text, speech.voice) == ("Oh!", "somebody")
    assert speech.sound is before.sound
    assert correct(said(), sheet("M")).words == said().words


def test_a_closure_moved_by_hand_moves_the_mouth(tmp_path: Path) -> None:
    cues = (Cue(0.0, 0.2, "AA1"), Cue(0.2, 0.3, "M"), Cue(0.3, 0.6, "AA0"))
    speech = replace(said(), phones=cues)
    path = tmp_path / "a.TextGrid"
    write_cue_file(CueSheet(0.6, {"words": speech.words, "phones": speech.phones}), path)
    path.write_text(path.read_text().replace("= 0.2 ", "= 0.4 ").replace("= 0.3 ", "= 0.5 "))
    moved = correct(speech, read_cue_file(path))

    def closed_s(speech: Speech) -> float:
        times, values = articulate(speech.phones)["closure"].given()
        return float(times[values == values.max()].mean())

    assert closed_s(moved) - closed_s(speech) == pytest.approx(0.2, abs=0.02)


def test_timing_of_another_recording_is_refused() -> None:
    with pytest.raises(MienError, match=r"tier 'phones' ends at 0\.800 s, but the sound at 0\.600 s"):
        correct(said(), sheet(*"MMMMMMMM"))
    assert correct(said(), sheet("M", *["sil"] * 9)).phones[-1] == Cue(0.1, 0.6, "SIL")


def test_ours_written_and_read_back_is_the_same(tmp_path: Path) -> None:
    speech = said()
    write_cue_file(CueSheet(0.6, {"words": speech.words, "phones": speech.phones}), tmp_path / "a.TextGrid")
    again = correct(speech, read_cue_file(tmp_path / "a.TextGrid"))
    assert (again.words, again.phones) == (speech.words, speech.phones)


def test_the_table_of_labels_has_each_once_and_known_phones() -> None:
    text = resources.files("mien.perform").joinpath("data/phone_labels.csv").read_text(encoding="utf-8")
    rows = list(csv.DictReader(line for line in text.splitlines() if not line.startswith("# ")))
    assert not [key for key, count in Counter((row["alphabet"], row["label"]) for row in rows).items() if count > 1]
    assert {phone for row in rows for phone in row["arpabet"].split()} <= PHONES
    assert all(row["arpabet"].split() for row in rows)
