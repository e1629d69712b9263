import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mien.core import LoadError, MienError, ParameterTable, UnknownNameError
from mien.core.parameters import Parameter, both_sides
from mien.timeline import Track
from mien.vocab import Remap, families, load_remap, parse_remap, vocabulary

TABLE = """channel,parameter,gain,blend,source
jaw,jaw.rotation,13,add,own
round,mouth.width,-0.25,add,own
spread,mouth.width,0.5,,own
blink,lid.left,-1,multiply,own
brow,lid.left,0.1,add,own
"""


@pytest.fixture
def remap() -> Remap:
    return parse_remap(TABLE, title="channels.toy", place="channels.toy.csv")


def test_offsets_are_sums_of_gain_times_value(remap: Remap) -> None:
    assert remap.apply({"jaw": 0.5, "round": 0.4, "spread": 0.2}) == {"jaw.rotation": 6.5, "mouth.width": 0.0}
    assert remap.apply({"round": 1.0}) == {"mouth.width": -0.25}
    assert remap.apply({}) == {}


def test_factors_are_one_plus_gain_times_value(remap: Remap) -> None:
    assert remap.scale({"blink": 0.75, "jaw": 1.0}) == {"lid.left": 0.25}
    assert remap.scale({"jaw": 1.0}) == {}


def test_unknown_name_is_refused_with_near_matches(remap: Remap) -> None:
    with pytest.raises(UnknownNameError, match="round"):
        remap.apply({"ruond": 1.0})
    with pytest.raises(UnknownNameError):
        remap.apply_tracks({"ruond": Track.from_keys([0.0], [1.0])})


def test_tracks_add_up_exactly_between_the_keys_of_both(remap: Remap) -> None:
    tracks = {
        "round": Track.from_keys([0.0, 1.0], [0.0, 1.0]),
        "spread": Track.from_keys([0.0, 0.5, 2.0], [1.0, 0.0, 1.0]),
    }
    summed = remap.apply_tracks(tracks)["mouth.width"]
    times = np.linspace(0.0, 2.5, 101)
    want = -0.25 * np.clip(times, 0.0, 1.0) + 0.5 * np.interp(times, [0.0, 0.5, 2.0], [1.0, 0.0, 1.0])
    np.testing.assert_allclose(summed.evaluate(times)[0], want, atol=1e-15)
    keys = summed.keys()
    assert keys is not None
    assert list(keys[0]) == [0.0, 0.5, 1.0, 2.0]


def test_single_track_keeps_its_change_function(remap: Remap) -> None:
    eased = Track.from_keys([0.0, 1.0], [0.0, 1.0], "cosine")
    played = remap.apply_tracks({"jaw": eased})["jaw.rotation"]
    np.testing.assert_allclose(played.evaluate([0.25])[0], 13.0 * (1.0 - np.cos(np.pi / 4.0)) / 2.0, rtol=1e-12)


def test_curves_that_are_not_straight_do_not_add_up(remap: Remap) -> None:
    eased = Track.from_keys([0.0, 1.0], [0.0, 1.0], "cosine")
    with pytest.raises(MienError, match=r"mouth\.width"):
        remap.apply_tracks({"round": eased, "spread": eased})


def test_scaling_tracks_rest_at_one(remap: Remap) -> None:
    factor = remap.scale_tracks({"blink": Track.from_keys([0.0, 1.0], [0.0, 1.0])})["lid.left"]
    assert list(factor.evaluate([0.0, 0.5, 1.0])[0]) == [1.0, 0.5, 0.0]


@settings(deadline=None, max_examples=30)
@given(st.dictionaries(st.sampled_from(["jaw", "round", "spread", "brow"]), st.floats(-1.0, 1.0)))
def test_tracks_at_a_moment_are_the_values_of_that_moment(values: dict[str, float]) -> None:
    remap = parse_remap(TABLE, title="channels.toy", place="channels.toy.csv")
    tracks = {name: Track.from_keys([0.0, 1.0], [value, value]) for name, value in values.items()}
    played = {name: float(track.evaluate([0.5])[0][0]) for name, track in remap.apply_tracks(tracks).items()}
    assert played == pytest.approx(remap.apply(values))


def test_reached_parameters(remap: Remap) -> None:
    assert remap.reached_by(["round", "jaw"]) == ("jaw.rotation", "mouth.width")


FACES = """name,parameter,gain,blend,fit,unless,source
open,mouth.bottom,0.5,share,exact,,own
close,mouth.bottom,-0.5,share,exact,,own
raise,mouth.top,1,share,near,,own
raise,brow,-0.4,share,stand-in,mouth.top,own
wave,hand,1,add,exact,,own
wave,brow,0.1,add,exact,,own
M+,brow,0.4,set,exact,,own
M-,brow,-0.2,set,near,,own
T,brow,-1,set,exact,,own
"""
BROW, BOTTOM, TOP = Parameter("brow", 0, 1, 0.5), Parameter("mouth.bottom", 0, 1, 0.2), Parameter("mouth.top", 0, 1)


@pytest.fixture
def on_all() -> Remap:
    return parse_remap(FACES, title="names.toy", place="names.toy.csv").on(ParameterTable((BROW, BOTTOM, TOP)))


@pytest.fixture
def on_few() -> Remap:
    return parse_remap(FACES, title="names.toy", place="names.toy.csv").on(ParameterTable((BROW, BOTTOM)))


def test_a_share_is_of_the_way_that_a_face_has(on_all: Remap) -> None:
    assert on_all.apply({"open": 1.0}) == {"mouth.bottom": pytest.approx(0.4)}
    assert on_all.apply({"close": 0.5}) == {"mouth.bottom": pytest.approx(-0.05)}
    with pytest.raises(MienError, match=r"names\.toy: counts in shares"):
        parse_remap(FACES, title="names.toy", place="names.toy.csv").apply({"open": 1.0})


def test_links_to_what_a_face_has_not_are_left_out(on_all: Remap, on_few: Remap) -> None:
    assert on_all.apply({"wave": 1.0}) == on_few.apply({"wave": 1.0}) == {"brow": 0.1}
    assert on_few.to_names == ("mouth.bottom", "brow")


def test_something_else_is_played_unless_a_face_has_the_parameter(on_all: Remap, on_few: Remap) -> None:
    assert on_all.apply({"raise": 1.0}) == {"mouth.top": 1.0}
    assert on_few.apply({"raise": 1.0}) == {"brow": -0.2}


def test_a_name_fits_as_its_worst_link_and_what_is_left_without_the_first_stands_in(
    on_all: Remap, on_few: Remap
) -> None:
    assert on_all.fits == {
        "open": "exact",
        "close": "exact",
        "raise": "near",
        "wave": "stand-in",
        "M": "near",
        "T": "exact",
    }
    assert on_few.fits["raise"] == "stand-in"


def test_places_are_gain_times_value_and_halves_move_from_rest(on_all: Remap) -> None:
    assert on_all.places({"T": 0.25, "M+": 1.0}) == {"brow": -0.25}
    assert on_all.moves({"T": 0.25, "M+": 0.5, "M-": 0.0}) == {"brow": [(0.4, 0.5), (-0.2, 0.0)]}


def test_check_names_the_missing_parameter(remap: Remap) -> None:
    known = ParameterTable(tuple(Parameter(name, 0, 1) for name in ("jaw", "round", "spread", "blink", "brow")))
    played = ParameterTable((Parameter("jaw.rotation", 0, 20), *both_sides(Parameter("lid", 0, 1))))
    with pytest.raises(UnknownNameError, match=r"mouth\.width"):
        remap.check(known, played)
    remap.check(known, ParameterTable((*played.rows, Parameter("mouth.width", 0, 2))))


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ("jaw,x,many,add,own", "many"),
        ("jaw,x,1,divide,own", "divide"),
        ("jaw,x,nan,add,own", "nan"),
        ("jaw,x", "fields"),
    ],
)
def test_wrong_line_is_named(line: str, message: str) -> None:
    with pytest.raises(LoadError, match=rf"toy\.csv:2.*{message}"):
        parse_remap(f"channel,parameter,gain,blend,source\n{line}\n", title="toy", place="toy.csv")


def test_wrong_header_is_named() -> None:
    with pytest.raises(LoadError, match=r"toy\.csv:1"):
        parse_remap("channel,gain\njaw,1\n", title="toy", place="toy.csv")


def test_family_without_a_table_is_refused() -> None:
    with pytest.raises(MienError, match=r"'channels' cannot play .* 'marionette' — there is a table for head"):
        load_remap("channels", "marionette")
    with pytest.raises(UnknownNameError, match="unknown vocabulary"):
        load_remap("klingon", "head")


@pytest.mark.parametrize("family", families("channels"))
def test_every_row_of_a_table_has_a_source_and_a_known_channel(family: str) -> None:
    remap = load_remap("channels", family)
    assert all(link.source for link in remap.links)
    assert set(remap.from_names) <= set(vocabulary("channels").names)


def test_head_table_plays_every_channel_and_every_parameter_exists() -> None:
    from mien.faces.head.table import head_table

    remap = load_remap("channels", "head")
    remap.check(vocabulary("channels"), head_table())
    assert set(remap.from_names) == set(vocabulary("channels").names)


def test_head_table_is_the_same_left_and_right() -> None:
    remap = load_remap("channels", "head")
    for name in remap.from_names:
        if not name.startswith("blink"):
            offsets = remap.apply({name: 1.0})
            for parameter, value in offsets.items():
                if parameter.endswith(".left"):
                    assert offsets[parameter.removesuffix(".left") + ".right"] == value


def test_shut_lips_are_parted_by_nothing_that_speech_plays_on_the_head() -> None:
    factors = load_remap("channels", "head").scale({"closure": 1.0})
    assert factors["mouth.upper_lip"] == factors["mouth.lower_depress.left"] == 0.0
    assert load_remap("channels", "head").scale({"blink.left": 1.0}) == {"eyelid.opening.left": 0.0}


def test_channels_rest_at_zero() -> None:
    assert not np.any(vocabulary("channels").defaults)
