"""Subtitles: every word once, broken where a reader would, shown for as long as he needs; files that players read."""

from __future__ import annotations

import re
from itertools import pairwise
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from small_face import opening_jaw

from mien.core import Cue, MienError
from mien.formats import write_performance
from mien.formats.subtitle_files import format_srt, format_vtt
from mien.formats.subtitles import GUIDE, Subtitle, make_subtitles
from mien.timeline import Timeline


def say(text: str, *, word_s: float = 0.3, pause_s: float = 0.5) -> Timeline:
    """A timeline in which somebody says a text at an even pace, with pauses after sentences."""
    words, time = [], 0.2
    for spot in text.split():
        if spoken := spot.strip(".,;:!?…\"'”“()—"):
            words.append(Cue(time, time + word_s, spoken))
            time += word_s
        time += pause_s if spot[-1] in ".!?…" else 0.0
    return Timeline((), time + 0.5, words=tuple(words), text=text)


def lines(text: str, **pace: float) -> list[tuple[str, ...]]:
    return [subtitle.lines for subtitle in make_subtitles(say(text, **pace))]


def test_a_short_sentence_is_one_line_from_its_first_word_until_it_is_read() -> None:
    (subtitle,) = make_subtitles(say("Hello there, my baby."))
    assert subtitle.lines == ("Hello there, my baby.",)
    assert subtitle.start_s == 0.2
    assert subtitle.end_s == pytest.approx(0.2 + 21 / GUIDE.characters_per_s)


def test_sentences_are_kept_apart_and_a_title_does_not_end_one() -> None:
    assert lines("Is it so, Dr. Smith? Yes, it is so.", pause_s=1.0) == [
        ("Is it so, Dr. Smith?",),
        ("Yes, it is so.",),
    ]


def test_a_long_sentence_is_broken_after_punctuation_and_before_phrases() -> None:
    text = (
        "The north wind and the sun were disputing which was the stronger, when a traveler came along "
        "wrapped in a warm cloak."
    )
    assert lines(text) == [
        ("The north wind and the sun were disputing", "which was the stronger,"),
        ("when a traveler came", "along wrapped in a warm cloak."),
    ]


def test_an_article_is_not_left_behind() -> None:
    text = "Everybody in this old town remembers the extraordinary gentleman"
    for parts in lines(text):
        assert not any(line.split()[-1] in ("the", "this", "in") for line in parts)


def test_short_sentences_said_at_once_share_a_subtitle_that_can_be_read() -> None:
    assert lines("No. Yes! Oh.", word_s=0.2, pause_s=0.05) == [("No. Yes! Oh.",)]


@pytest.mark.parametrize(
    ("text", "words", "shown"),
    [
        ("A well-known man — he.", ["A", "well", "known", "man", "he"], "A well-known man — he."),
        ("Look 😀 here и там now!", ["Look", "here", "now"], "Look here now!"),
        ("“Well,” he said", ["Well", "he", "said"], "“Well,” he said"),
        ("banana a", ["a"], "a"),
        ("", ["no", "text"], "no text"),
        ("nothing of it", ["else", "said"], "else said"),
        ("it is\n  here\t\x07now", ["it", "is", "here", "now"], "it is here now"),
        ("a b c", ["a b", "c"], "a b c"),
    ],
)
def test_words_stand_with_their_marks_and_what_was_not_said_is_left_out(text: str, words: list, shown: str) -> None:
    cues = tuple(Cue(k * 0.4, k * 0.4 + 0.4, word) for k, word in enumerate(words))
    (subtitle,) = make_subtitles(Timeline((), 5.0, words=cues, text=text))
    assert " ".join(subtitle.lines) == shown


def test_a_word_longer_than_a_line_is_cut() -> None:
    parts = make_subtitles(Timeline((), 9.0, words=(Cue(0.0, 8.0, "x" * 100),)))
    assert "".join(line for part in parts for line in part.lines) == "x" * 100
    assert max(len(line) for part in parts for line in part.lines) == 42


def test_a_pause_clears_the_screen_and_a_flicker_is_closed() -> None:
    words = (Cue(0.0, 1.0, "one."), Cue(1.4, 2.4, "two."), Cue(9.0, 10.0, "three."))
    one, two, three = make_subtitles(Timeline((), 10.2, words=words))
    assert one.end_s == pytest.approx(1.4 - GUIDE.gap_s)
    assert two.end_s == pytest.approx(2.4)
    assert three.end_s == pytest.approx(10.0)


def test_nothing_said_is_nothing_shown() -> None:
    assert make_subtitles(Timeline((), 3.0, words=(Cue(0, 1, " "),), text="hm")) == ()


@settings(deadline=None, max_examples=60)
@given(
    st.lists(
        st.tuples(st.text("abcdefgh", min_size=1, max_size=60), st.sampled_from(["", ",", ".", "!"]), st.floats(0, 1)),
        min_size=1,
        max_size=40,
    )
)
def test_every_word_is_shown_once_in_lines_that_fit_and_times_that_rise(said: list) -> None:
    cues, time = [], 0.0
    for word, _, length in said:
        cues.append(Cue(time, time + length, word))
        time += length + 0.02
    text = " ".join(word + mark for word, mark, _ in said)
    subtitles = make_subtitles(Timeline((), time, words=tuple(cues), text=text))
    shown = "".join(line for subtitle in subtitles for line in subtitle.lines)
    assert shown.replace(" ", "") == text.replace(" ", "")
    for subtitle in subtitles:
        assert 1 <= len(subtitle.lines) <= 2
        assert all(0 < len(line) <= GUIDE.line_length for line in subtitle.lines)
        assert subtitle.end_s > subtitle.start_s
    assert all(two.start_s >= one.end_s for one, two in pairwise(subtitles))


SAMPLE = (Subtitle(0.2, 1.0344, ("A & B", "<i>no</i>")), Subtitle(3661.5, 3662.9999, ("x --> y",)))


def test_subrip() -> None:
    assert "".join(format_srt(SAMPLE)) == (
        "1\n00:00:00,200 --> 00:00:01,034\nA & B\n<i>no</i>\n\n2\n01:01:01,500 --> 01:01:03,000\nx -> y\n\n"
    )


def test_webvtt() -> None:
    assert "".join(format_vtt(SAMPLE, {"Title": "a\n\nb --> c"})) == (
        "WEBVTT\n\nNOTE\nTitle: a b --&gt; c\n\n00:00:00.200 --> 00:00:01.034\nA &amp; B\n&lt;i&gt;no&lt;/i&gt;\n\n"
        "01:01:01.500 --> 01:01:03.000\nx --&gt; y\n\n"
    )


def test_a_player_reads_both(tmp_path: Path) -> None:
    import av

    for name in ("a.srt", "a.vtt"):
        write_performance(opening_jaw(words=("Ah", "me")), tmp_path / name)
        with av.open(str(tmp_path / name)) as file:
            times = [float(packet.pts * packet.time_base) for packet in file.demux() if packet.pts is not None]
        assert times == [0.0], name
    assert re.search(r"Seed: 3\n.*synthetic", (tmp_path / "a.vtt").read_text(), re.IGNORECASE)


def test_a_timeline_without_words_has_none(tmp_path: Path) -> None:
    for name, more in (("a.srt", {}), ("a.csv", {"subtitles": tmp_path / "b.srt"}), ("a", {"subtitles": "burn"})):
        with pytest.raises(MienError, match="no word is said"):
            write_performance(opening_jaw(size_px=(200, 200)), tmp_path / name, **more)
    assert list(tmp_path.iterdir()) == []


def test_the_file_beside_appears_with_what_it_belongs_to_or_not_at_all(tmp_path: Path) -> None:
    (tmp_path / "a.srt").write_text("old")
    silent = opening_jaw(sound=False, words=("Ah",))
    with pytest.raises(MienError, match="no sound"):
        write_performance(silent, tmp_path / "a.wav", subtitles=tmp_path / "a.srt")
    assert (tmp_path / "a.srt").read_text() == "old"
    write_performance(silent, tmp_path / "a.csv", subtitles=tmp_path / "a.srt")
    assert (tmp_path / "a.srt").read_text().startswith("1\n00:00:00,000 --> ")
    with pytest.raises(MienError, match="asked for twice"):
        write_performance(silent, tmp_path / "a.srt", subtitles=tmp_path / "a.srt")
