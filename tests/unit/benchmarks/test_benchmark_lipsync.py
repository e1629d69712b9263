"""The benchmark of lip sync reads labels as people write them and counts what it says it counts."""

from pathlib import Path

import numpy as np
import pytest

from mien.core import Cue, Sound
from mien.formats.wav import write_wav
from mien.speech import PHONES

BENCHMARKS = Path(__file__).parents[3] / "benchmarks"


@pytest.fixture(autouse=True)
def path(monkeypatch):
    monkeypatch.syspath_prepend(str(BENCHMARKS))


def cues(text):
    """Cues of words like ``AA:120``: a symbol and its milliseconds; ``:100`` is one without a symbol."""
    out, time = [], 0
    for word in text.split():
        symbol, length = word.rsplit(":", 1)
        out.append(Cue(time / 1000.0, (time + int(length)) / 1000.0, symbol))
        time += int(length)
    return out


def segments(text):
    from labelled.labels import segments_of

    return segments_of(cues(text))[0]


def spell(found):
    return " ".join(f"{'+'.join(each.phones)}:{round(1000 * (each.end_s - each.start_s))}" for each in found)


def blocks_of(labels, phones, shapes):
    from labelled.measures import score

    return score(segments(labels), cues(phones) if phones else None, cues(shapes))


def test_closures_of_timit_are_one_phone_with_their_release():
    assert spell(segments("h#:100 dcl:30 d:20 ix:50 tcl:40 jh:50 pcl:40 s:60 kcl:30 q:20 h#:100")) == (
        "SIL:100 D:50 IH:50 T:40 JH:50 P:40 S:60 K:30 :20 SIL:100"
    )


def test_aspiration_of_emu_belongs_to_the_stop_before_it_and_two_phones_share_a_label():
    assert spell(segments("H#:100 k:40 H:20 A:90 dH:50 @::80 db:70 H:30 E:60")) == (
        "SIL:100 K:60 AE:90 D:50 ER:80 D+B:100 EH:60"
    )


def test_ipa_pauses_are_joined_and_unknown_labels_are_named():
    from labelled.labels import segments_of

    found, alphabet, strange = segments_of(cues(":50 :50 ˈtʃ:60 iː:90 ?!:40 ɔɪ:90"))
    assert (spell(found), alphabet, strange) == ("SIL:100 CH:60 IY:90 :40 OY:90", "ipa", {"?!"})


def test_every_phone_has_shapes_that_agree():
    from labelled.measures import allowed_shapes

    assert set(allowed_shapes()) >= PHONES | {"SIL-short"}
    assert all(row.shape in set("ABCDEFGHX") for row in allowed_shapes().values())


def test_boundaries_are_heard_less_labelled_beginnings():
    from labelled.measures import boundary_errors

    found = boundary_errors(segments("sil:300 t:100 aa:200 n:100 sil:300"), cues("SIL:310 T:80 AA1:200 N:110 SIL:300"))
    assert [error for _, _, error in found] == pytest.approx([0.010, -0.010, -0.010, 0.0])


def test_a_phone_that_is_not_heard_has_no_boundary_and_does_not_move_the_others():
    from labelled.measures import boundary_errors

    found = boundary_errors(segments("sil:300 s:100 t:50 dh:60 ah:90"), cues("SIL:300 S:150 DH:70 AH0:80"))
    assert [None if error is None else round(error, 3) for _, _, error in found] == [0.0, None, 0.0, 0.01]


def test_figures_of_a_clip_by_hand():
    from labelled.measures import figures

    # 10 frames of m: 8 shut. 20 of aa: 2 still shut, 8 half open, which is lenient, 10 wide open. 10 of f: 5 tucked.
    found = figures(blocks_of("m:100 aa:200 f:100", "M:80 AA1:240 F:80", "A:80 B:20 A:20 C:80 D:100 G:50 B:50"))
    values = {name: figure.value for name, figure in found.items()}
    assert values["strict %"] == pytest.approx(100 * (8 + 10 + 5) / 40)
    assert values["lenient %"] == pytest.approx(100 * (8 + 8 + 10 + 5) / 40)
    assert values["p b m shut %"] == values["f v tucked %"] == values["found %"] == 100.0
    assert values["false closures %"] == pytest.approx(100 * 2 / 30)
    assert values["boundary ms"] == pytest.approx(20.0)
    assert values["20 ms %"] == pytest.approx(100.0)


def test_lips_that_never_meet_are_counted_as_missed():
    from labelled.measures import figures

    found = figures(blocks_of("b:50 iy:100 v:60 sil:400", "", "B:210 X:400"))
    assert found["p b m shut %"].value == found["f v tucked %"].value == 0.0
    assert np.isnan(found["boundary ms"].value)


def test_diphthongs_and_bursts_change_shape_in_time():
    from labelled.measures import figures

    assert figures(blocks_of("ay:100", "", "D:60 B:40"))["strict %"].value == 100.0
    assert figures(blocks_of("ay:100", "", "B:40 D:60"))["strict %"].value == pytest.approx(20.0)
    assert figures(blocks_of("p:100", "", "A:60 D:40"))["lenient %"].value == 100.0


def test_intervals_hold_the_value_and_shrink_with_more_seconds():
    from labelled.measures import figures

    some = figures(blocks_of("aa:300 iy:300 " * 5, "", "D:200 B:400 " * 5))["strict %"]
    more = figures(blocks_of("aa:300 iy:300 " * 50, "", "D:200 B:400 " * 50))["strict %"]
    assert some.low <= some.value <= some.high
    assert more.high - more.low < some.high - some.low


def test_labels_are_read_in_the_layouts_of_timit_esps_and_htk(tmp_path):
    from labelled.clips import read_labels

    sound = Sound.silence(1.0, 16000)
    wanted = [Cue(0.0, 0.25, "h#"), Cue(0.25, 1.0, "aa")]
    (tmp_path / "a.phn").write_text("0 4000 h#\n4000 16000 aa\n")
    (tmp_path / "b.lab").write_text("signal b\nnfields 1\n#\n  0.25 125 h#\n  1.0 125 aa\n")
    (tmp_path / "c.lab").write_text("0 2500000 h#\n2500000 10000000 aa\n")
    for name in ("a.phn", "b.lab", "c.lab"):
        assert read_labels(tmp_path / name, sound) == wanted


def test_a_folder_is_read_with_its_tier_of_phones_and_its_transcript(tmp_path, capsys):
    from labelled.clips import read_folder

    write_wav(Sound.silence(1.0, 16000), tmp_path / "hi.wav")
    write_wav(Sound.silence(1.0, 16000), tmp_path / "unlabelled.wav")
    tiers = [("words", [(0.25, 1.0, "ah")]), ("ann - phones", [(0.25, 0.75, "AA1")])]
    lines = ['File type = "ooTextFile"', 'Object class = "TextGrid"', "0", "1", "<exists>", str(len(tiers))]
    for name, intervals in tiers:
        lines += ['"IntervalTier"', f'"{name}"', "0", "1", str(len(intervals))]
        lines += [f'{start} {end} "{text}"' for start, end, text in intervals]
    (tmp_path / "hi.TextGrid").write_text("\n".join(lines))
    (tmp_path / "hi.txt").write_text("0 16000 Ah.\n")
    (clip,) = read_folder(tmp_path)
    assert (clip.name, clip.text, spell(clip.segments)) == ("hi", "Ah.", "SIL:250 AA:500 SIL:250")
    assert "arpabet" in capsys.readouterr().out


def test_noise_is_as_loud_as_asked_for_beneath_the_speech():
    from labelled.clips import Clip, with_noise

    tone = np.rint(8000 * np.sin(np.arange(32000) / 5)).astype(np.int16)
    tone[:16000] = 0
    clip = Clip("tone", Sound(tone, 16000), tuple(segments("sil:1000 aa:1000")), "ah")
    noisy = with_noise(clip, 10.0, np.random.default_rng(1))
    noise = noisy.sound.samples.astype(float) - tone
    assert 10 * np.log10((tone[16000:].astype(float) ** 2).mean() / (noise**2).mean()) == pytest.approx(10.0, abs=0.1)


def test_the_synthesised_script_is_the_same_each_time_and_as_long_as_asked(tmp_path):
    from labelled.synthesis import CLIPS_A_MINUTE, write_script

    for name in ("a", "b"):
        write_script(tmp_path / name, 2.0)
    assert (tmp_path / "a").read_bytes() == (tmp_path / "b").read_bytes()
    rows = [line.split("\t") for line in (tmp_path / "a").read_text().splitlines()]
    assert len(rows) == 2 * CLIPS_A_MINUTE
    assert {len(row) for row in rows} == {5}
