"""Standard motions: for every face, no two alike, ending at rest; files of one's own."""

import importlib.util
import json
from itertools import combinations

import numpy as np
import pytest

from mien.core import LoadError, UnknownNameError
from mien.live import IDLE_PARTS, Session, fit_motion, parse_motions, standard_motions
from support import FACE_NAMES, ROOT, face

STILL = dict.fromkeys(IDLE_PARTS, 0.0)
APART = 0.08
"""Least distance of two motions, as ``benchmarks/motions.py`` prints it."""


@pytest.fixture(scope="module")
def benchmark():
    spec = importlib.util.spec_from_file_location("benchmark_motions", ROOT / "benchmarks" / "motions.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_there_are_enough_of_them():
    asked = {"smile", "frown", "surprise", "wink_left", "wink_right", "nod", "shake", "think", "listen", "sleepy"}
    assert len(standard_motions()) >= 25
    assert asked | {"laugh", "doubt"} <= set(standard_motions())
    assert all(motion.doc.endswith(".") for motion in standard_motions().values())


@pytest.mark.parametrize("name", [name for name in FACE_NAMES if name == "head" or name.startswith("toon:")])
def test_every_motion_moves_every_face_and_ends_at_rest(name):
    table = face(name).parameters
    for motion in standard_motions().values():
        fitted = fit_motion(motion, face(name))
        assert len(fitted.rows), motion.name
        assert not fitted.offsets[-1].any()
        values = table.defaults[fitted.rows] + fitted.offsets
        assert (values >= table.lows[fitted.rows] - 1e-9).all()
        assert (values <= table.highs[fitted.rows] + 1e-9).all()


@pytest.mark.parametrize("name", ["head", "toon:olav", "toon:gus"])
def test_no_two_motions_are_alike(name, benchmark):
    found = benchmark.tracks(face(name))
    for track in found.values():
        assert not track[-1].any()
    near = {
        (one, other): apart
        for one, other in combinations(found, 2)
        if (apart := benchmark.distance(found[one], found[other])) < APART
    }
    assert near == {}


def test_a_wink_in_the_mirror_is_the_other_wink(benchmark):
    table = face("head").parameters
    found = benchmark.tracks(face("head"))
    mirrored = found["wink_left"][:, table.mirror_index] * table.mirror_sign
    np.testing.assert_allclose(mirrored, found["wink_right"], atol=1e-12)


def test_a_wink_shuts_one_eye_and_leaves_the_other():
    session = Session(face("toon:olav"), idle=STILL)
    session.handle({"kind": "play", "motion": "wink_left"})
    poses = [session.step().pose for _ in range(20)]
    assert min(pose["eyelid.upper.left"] for pose in poses) == 0.0
    assert min(pose["eyelid.upper.right"] for pose in poses) > 0.5


@pytest.mark.parametrize(("loop_s", "speed", "loops"), [(1 / 60, 1, 66), (0.1, 1, 11), (1 / 60, 2, 33), (0.5, 10, 1)])
def test_motions_last_as_long_as_they_say_at_any_loop_length(loop_s, speed, loops):
    session = Session(face("head"), loop_s=loop_s, idle=STILL)
    reply = session.handle({"kind": "play", "motion": "nod", "speed": speed})
    assert reply["loops"] == loops
    rest = face("head").parameters.defaults
    frames = [session.step().pose.values for _ in range(loops)]
    np.testing.assert_array_equal(frames[-1], rest)
    assert loops < 5 or not np.array_equal(frames[loops // 2], rest)


def test_half_the_strength_is_half_the_way():
    whole, half = (Session(face("head"), idle=STILL) for _ in range(2))
    whole.handle({"kind": "play", "motion": "nod"})
    half.handle({"kind": "play", "motion": "nod", "strength": 0.5})
    for _ in range(60):
        assert half.step().pose["head.nod"] == pytest.approx(0.5 * whole.step().pose["head.nod"])


def own(**changes):
    motion = {"name": "peek", "doc": "", "keys": [{"at_ms": 100, "values": {"AU5": 1}}, {"at_ms": 200, "values": {}}]}
    return json.dumps({"format": "mien-motions", "version": 1, "motions": [{**motion, **changes}]})


def test_motions_of_ones_own_are_played_and_logged():
    (motion,) = parse_motions(own(), "own.json").values()
    log = []
    session = Session(face("head"), idle=STILL, motions=[motion], log=log.append)
    assert session.handle({"kind": "play", "motion": "peek"})["loops"] == 12
    assert json.loads(log[0])["motions"] == [motion.to_json()]
    assert max(session.step().pose["eyelid.opening.left"] for _ in range(12)) > 0.8


def test_expressions_can_be_named_in_motions():
    text = own(keys=[{"at_ms": 100, "values": {"happy": 0.5}}, {"at_ms": 300, "values": {}}])
    fitted = fit_motion(parse_motions(text, "own.json")["peek"], face("head"))
    happy = face("head").neutral.replace(face("head").presets["happy"].values)
    rest = face("head").parameters.defaults[fitted.rows]
    np.testing.assert_allclose(fitted.offsets[0], 0.5 * (happy.values[fitted.rows] - rest))


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("[", "own.json: is no JSON"),
        ("[]", "want 'format'"),
        (own(keys=[]), "peek: keys: want 2 to 64"),
        (own(keys=[{"at_ms": 1, "values": {"AU5": 2}}] * 2), "peek: key 0: AU5: 2 is out of range"),
        (own(keys=[{"at_ms": 1, "values": {}}] * 2), "key 1 does not come after"),
        (own(keys=[{"at_ms": 0, "values": {}}, {"at_ms": 1, "values": {}}]), "key 0 is at 0 ms"),
        (own(keys=[{"at_ms": 1, "values": {}}, {"at_ms": 2, "values": {"AU5": 1}}]), "ends at rest"),
        (own(keys=[{"at_ms": 1, "values": {}, "chnage": ""}, {"at_ms": 2, "values": {}}]), "did you mean 'change'"),
        (own(keys=[{"at_ms": 1, "values": {}, "change": []}, {"at_ms": 2, "values": {}}]), "change"),
        (own(nmae="x"), "did you mean 'name'"),
        (own(name=""), "name: want 1 to"),
    ],
)
def test_bad_files_of_motions_are_refused(text, words):
    with pytest.raises(LoadError, match=words):
        parse_motions(text, "own.json")


def test_an_unknown_name_is_found_when_a_face_is_to_play_it():
    text = own(keys=[{"at_ms": 1, "values": {"hapy": 1}}, {"at_ms": 2, "values": {}}])
    with pytest.raises(UnknownNameError, match="did you mean 'happy'"):
        fit_motion(parse_motions(text, "own.json")["peek"], face("head"))
