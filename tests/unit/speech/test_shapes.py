import itertools
from collections.abc import Sequence

import pytest
from mouth_cases import cues, poem

from mien.core import SILENCE, Cue, RangeError, UnknownNameError
from mien.speech import PHONES
from mien.speech.mouth_table import phone_table
from mien.speech.shapes import SHAPE_SETS, shapes_of
from mien.speech.shapes_passes import (
    LEAST_HELD_S,
    Piece,
    choose,
    drop_short,
    hold,
    join,
    lengthen,
    put_between,
    round_early,
    split,
)
from mien.speech.shapes_table import FORMER, NEXT, shape_table
from mien.vocab import vocabulary

RHUBARB = shape_table("rhubarb")
CLOSED = {"rhubarb": "A", "oculus": "PP", "sapi": "21", "preston-blair": "MBP"}
TUCKED = {"rhubarb": "G", "oculus": "FF", "sapi": "18", "preston-blair": "FV"}


def pieces(text: str) -> tuple[Piece, ...]:
    """Pieces of words like ``A!:30``: a shape, a mark where it is held, milliseconds."""
    return tuple(Piece(cue.start_s, cue.end_s, cue.symbol.rstrip("!"), cue.symbol.endswith("!")) for cue in cues(text))


def spell(shown: Sequence[Piece] | Sequence[Cue]) -> str:
    """Shapes and milliseconds, as ``pieces`` reads them."""
    words = []
    for each in shown:
        symbol = each.shape + "!" * each.held if isinstance(each, Piece) else each.symbol
        words.append(f"{symbol}:{round(1000 * (each.end_s - each.start_s))}")
    return " ".join(words)


@pytest.mark.parametrize("name", SHAPE_SETS)
def test_every_phone_has_a_shape_of_the_set(name: str) -> None:
    table = shape_table(name)
    known = {row.name for row in vocabulary(name).rows} | {NEXT, FORMER}
    assert set(table.phones) >= PHONES | {"SIL-relax", "SIL-hold"}
    assert set(table.phones) <= set(phone_table().index)
    shown = {row.shape for row in table.phones.values()} | {row.short for row in table.phones.values()}
    shown |= {row.before_round for row in table.phones.values()} | {way.shape for way in table.between.values()}
    shown |= {shape for pair in table.between for shape in pair}
    assert shown - {""} <= known
    assert known - {NEXT, FORMER} <= shown, "a shape that nothing shows"


def test_all_of_papas_lips() -> None:
    assert spell(shapes_of(cues("SIL:300 P:100 AA1:150 P:100 AH0:60 SIL:300"), "rhubarb")) == (
        "X:300 A:70 D:120 C:60 A:70 C:90 X:300"
    )


def test_time_goes_on_without_holes_and_no_shape_follows_itself() -> None:
    for name in SHAPE_SETS:
        shown = shapes_of(poem(), name)
        assert shown[0].start_s == 0.0
        assert shown[-1].end_s == poem()[-1].end_s
        for first, second in itertools.pairwise(shown):
            assert first.end_s == second.start_s
            assert first.symbol != second.symbol


@pytest.mark.parametrize("name", SHAPE_SETS)
def test_every_closure_and_tuck_of_the_poem_is_shown(name: str) -> None:
    shown = shapes_of(poem(), name)
    for cue in poem():
        wanted = {"P": CLOSED, "B": CLOSED, "M": CLOSED, "F": TUCKED, "V": TUCKED}.get(cue.symbol)
        if wanted:
            mine = [s for s in shown if s.symbol == wanted[name] and s.start_s < cue.end_s and cue.start_s < s.end_s]
            assert mine, cue
            assert mine[0].length_s >= LEAST_HELD_S - 1e-9


def test_nothing_said_shows_nothing_and_silence_rests() -> None:
    assert shapes_of([], "rhubarb") == ()
    assert shapes_of(cues("SIL:500"), "sapi") == (Cue(0.0, 0.5, "0"),)


def test_wrong_names_and_times_are_refused() -> None:
    with pytest.raises(UnknownNameError, match="preston-blair"):
        shapes_of(poem(), "preston blair")
    with pytest.raises(UnknownNameError, match="QQ"):
        shapes_of(cues("QQ:100"), "rhubarb")
    with pytest.raises(RangeError):
        shapes_of([Cue(1.0, 0.5, "T")], "rhubarb")


def test_diphthongs_are_split_sixty_to_forty_where_the_set_has_two_shapes() -> None:
    assert spell(split(cues("OY1:100"), RHUBARB)) == "OY1:60 OY1+:40"
    assert spell(split(cues("OY1:100"), shape_table("sapi"))) == "OY1:100"


def test_quick_vowels_open_less() -> None:
    assert choose(cues("AH1:190 AH1:210"), RHUBARB) == ("C", "D")


def test_breath_takes_the_next_shape_and_a_very_short_pause_the_former() -> None:
    assert choose(cues("HH:60 UW1:100 SIL-hold:50 HH:40"), RHUBARB) == ("F", "F", "F", RHUBARB.row(SILENCE).shape)


def test_free_lips_are_round_before_a_round_vowel_but_not_for_long() -> None:
    near, far = cues("S:60 T:60 UW1:100"), cues("S:120 T:60 UW1:100")
    assert round_early(near, choose(near, RHUBARB), RHUBARB) == ("F", "F", "F")
    assert round_early(far, choose(far, RHUBARB), RHUBARB) == ("B", "F", "F")


def test_labials_and_open_vowels_are_not_rounded() -> None:
    phones = cues("AA1:80 P:60 W:60 IY1:80")
    assert round_early(phones, choose(phones, RHUBARB), RHUBARB) == ("D", "A", "F", "B")


def test_lips_part_at_the_burst_but_stay_shut_before_a_pause() -> None:
    assert spell(hold(cues("P:100 AA1:100"), ["A", "D"])) == "A!:70 D:130"
    assert spell(hold(cues("P:100 SIL:100"), ["A", "X"])) == "A!:100 X:100"


def test_m_and_f_have_no_burst() -> None:
    assert spell(hold(cues("M:100 AA1:100 F:80 IY1:50"), list("ADGB"))) == "A!:100 D:100 G!:80 B:50"


def test_two_closures_in_a_row_are_one() -> None:
    assert spell(hold(cues("M:100 P:100 AA1:50"), ["A", "A", "D"])) == "A!:170 D:80"


def test_short_closures_take_time_from_both_sides() -> None:
    assert spell(lengthen(pieces("D:100 A!:35 C:100"))) == "D:87 A!:55 C:93"


def test_short_closures_at_the_ends_and_beside_held_ones_take_it_from_the_other_side() -> None:
    assert spell(lengthen(pieces("A!:35 C:100"))) == "A!:55 C:80"
    assert spell(lengthen(pieces("C:100 A!:35"))) == "C:80 A!:55"
    assert spell(lengthen(pieces("G!:60 A!:35 C:100"))) == "G!:60 A!:55 C:80"


def test_what_is_too_short_to_be_reached_is_shared_by_its_neighbours() -> None:
    assert spell(drop_short(pieces("C:100 B:30 D:100"))) == "C:115 D:115"
    assert spell(drop_short(pieces("C:100 B:30 C:100"))) == "C:230"
    assert spell(drop_short(pieces("A!:60 B:30 D:100"))) == "A!:60 D:130"
    assert spell(drop_short(pieces("B:30 D:100 H:20"))) == "D:150"


def test_lips_part_between_two_closures_however_quickly() -> None:
    assert spell(drop_short(pieces("A!:60 C:20 A!:60"))) == "A!:60 C:20 A!:60"


def test_the_jaw_closes_through_half_open_but_pops_open() -> None:
    assert spell(put_between(pieces("D:150 A!:60 D:150"), RHUBARB)) == "D:100 C:50 A!:60 D:150"


def test_round_openings_are_on_the_way_to_a_pucker_and_back() -> None:
    assert spell(put_between(pieces("C:90 F:120 C:90"), RHUBARB)) == "C:90 E:40 F:40 E:40 C:90"


def test_short_shapes_give_no_time_for_what_is_between() -> None:
    assert spell(put_between(pieces("D:60 B:100"), RHUBARB)) == "D:60 B:100"


def test_join_drops_what_is_empty() -> None:
    assert spell(join(pieces("A:50 B:0 A:50"))) == "A:100"
