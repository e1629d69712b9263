"""A replayed log tells the words that were said, when they were said, and keeps no more than what moved."""

import pytest

from mien.live import Session, perform_log, read_log
from mien.timeline.rates import time_of
from sessions import PHONES, SAY, STILL, ok, run
from support import face


def played(*acts, loops=300):
    """The performance of a still session in which messages come before loops."""
    lines, session = [], None
    session = Session(face("head"), idle=STILL, log=lines.append)
    for loop in range(loops):
        for when, message in acts:
            if when == loop:
                ok(session, **message)
        run(session, 1)
    session.close()
    return perform_log(read_log(lines), face("head")).timeline


def test_words_and_phones_stand_where_they_were_heard():
    timeline = played((30, SAY), (40, {**SAY, "text": "World.", "words": [[0.1, 0.7, "World"]]}))
    first, second = timeline.words
    assert timeline.text == "Hello World."
    assert (first.symbol, first.start_s, first.end_s) == ("Hello", 0.5, pytest.approx(1.2))
    assert (second.symbol, second.start_s) == ("World", pytest.approx(second.end_s - 0.6))
    assert second.start_s > 0.5 + PHONES[-1][1]
    assert [phone.symbol for phone in timeline.phones] == 2 * [symbol for _, _, symbol in PHONES]


def test_what_was_interrupted_ends_there_and_what_never_began_was_not_said():
    timeline = played((0, SAY), (1, {**SAY, "text": "never"}), (18, {"kind": "interrupt"}))
    assert timeline.text == "Hello"
    assert [phone.symbol for phone in timeline.phones] == ["HH", "AH0", "L"]
    assert timeline.phones[-1].end_s == pytest.approx(0.3)
    assert [(word.symbol, word.end_s) for word in timeline.words] == [("Hello", pytest.approx(0.3))]


def test_a_row_that_begins_to_move_late_was_at_rest_before():
    timeline = played((60, {"kind": "move", "values": {"jaw.rotation": 8}}), loops=90)
    (track,) = timeline.layers[0].tracks.values()
    times, values = track.given()[:2]
    assert list(values) == [0.0] * 60 + [8.0] * 30
    assert times[60] == time_of(60.0, 60)


def test_a_text_whose_phones_nobody_speaks_still_has_no_words():
    assert played((3, {**SAY, "words": []})).words == ()
