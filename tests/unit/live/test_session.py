"""Sessions: commands end where they said, layers give back what they took, logs give the same frames."""

import json
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from mien.core import LoadError, MienError
from mien.live import IDLE_PARTS, KINDS, Session, read_log, replay, standard_motions
from mien.live.idle import Idle
from mien.timeline import Track
from mien.vocab import vocabulary
from sessions import FACES, SAY, STILL, digest, ok, run, still
from support import face


@pytest.mark.parametrize("name", FACES)
def test_his_example_an_eye_shuts_in_five_loops_of_100_ms(name):
    session = Session(face(name), loop_s=0.1, idle=STILL)
    row = "eyelid.opening.left" if name == "head" else "eyelid.upper.left"
    ok(session, kind="move", values={"ELU": 1.0})
    run(session, 1)
    ok(session, kind="move", values={"ELU": 0.0}, over_ms=500)
    assert [frame.pose[row] for frame in run(session, 6)] == pytest.approx([0.8, 0.6, 0.4, 0.2, 0.0, 0.0])
    assert session.values[face(name).parameters.index[row]] == 0.0


@pytest.mark.parametrize("name", FACES)
def test_motor_codes_are_understood_and_read_back_on_every_face(name):
    session = still(name)
    values = {"ELU": 0.2, "BRL": 0.9, "BLM": 0.1, "MB": 0.4, "MLV": 0.8, "PLH": 10.0, "HH": -5.0}
    ok(session, kind="move", values=values, over_ms=200)
    run(session, 12)
    reply = ok(session, kind="state", names=list(values))
    assert reply["loop"] == 12
    assert reply["values"] == pytest.approx(values)


def test_a_code_that_shares_rows_with_another_lets_it_be():
    together, one_by_one = still(), still()
    ok(together, kind="move", values={"BRL": 0.9, "BRM": 0.1})
    ok(one_by_one, kind="move", values={"BRL": 0.9})
    run(one_by_one, 3)
    ok(one_by_one, kind="move", values={"BRM": 0.1})
    run(together, 4)
    run(one_by_one, 1)
    np.testing.assert_array_equal(together.values, one_by_one.values)


def test_a_direct_move_starts_from_what_is_seen():
    session = still()
    ok(session, kind="play", motion="surprise", hold=True)
    seen = run(session, 80)[-1].pose["jaw.rotation"]
    assert seen > 3.0
    ok(session, kind="move", values={"jaw.rotation": 0.0}, over_ms=1000)
    values = [frame.pose["jaw.rotation"] for frame in run(session, 60)]
    assert values[0] == pytest.approx(seen * 59 / 60)
    assert values[-1] == 0.0


def test_one_bad_value_in_a_batch_moves_nothing():
    session = still()
    before = session.values
    reply = session.handle({"kind": "move", "values": {"ELU": 0.1, "jaw.rotaton": 3}})
    assert "did you mean 'jaw.rotation'" in reply["message"]
    assert session.handle({"kind": "move", "values": {"jaw.rotation": 3, "BRL": 1.5}})["kind"] == "error"
    assert "out of range" in session.handle({"kind": "move", "values": {"jaw.rotation": 21}})["message"]
    np.testing.assert_array_equal(run(session, 3)[-1].pose.values, before)


def test_pupils_go_as_far_as_the_face_lets_them():
    assert "on 'head' it goes from" in still().handle({"kind": "move", "values": {"PLH": 80}})["message"]


@pytest.mark.parametrize("over_ms", [0, 500])
@pytest.mark.parametrize("name", FACES)
def test_reset_lets_go_of_everything(name, over_ms):
    session = still(name)
    rest = session.values
    ok(session, kind="move", values={"ELU": 0.2, "BRL": 0.9}, over_ms=2000)
    ok(session, kind="play", motion="yawn")
    ok(session, kind="look", at=[0.3, 0.1, 0.4])
    ok(session, **SAY)
    run(session, 40)
    ok(session, kind="reset", over_ms=over_ms)
    np.testing.assert_array_equal(run(session, 40)[-1].pose.values, rest)


def test_a_layer_that_is_stopped_fades_and_the_others_stay():
    session = still()
    ok(session, kind="move", values={"jaw.rotation": 10.0})
    ok(session, kind="look", at="left")
    run(session, 60)
    ok(session, kind="stop", layer="direct", over_ms=200)
    values = [frame.pose["jaw.rotation"] for frame in run(session, 12)]
    assert values == sorted(values, reverse=True)
    assert 0.0 < values[5] < 10.0
    assert values[-1] == 0.0
    assert session.step().pose["eye.turn.left"] == -17.0


def test_nodding_keeps_a_smile_and_frowning_takes_its_place():
    session = still()
    rest = session.values
    ok(session, kind="play", motion="smile", hold=True)
    smile = run(session, 130)[-1].pose
    ok(session, kind="play", motion="nod")
    np.testing.assert_array_equal(run(session, 80)[-1].pose.values, smile.values)
    ok(session, kind="play", motion="frown")
    np.testing.assert_array_equal(run(session, 200)[-1].pose.values, rest)


def test_eyes_lead_and_the_head_follows_while_the_aim_stays():
    session = still()
    ok(session, kind="look", at=[0.25, 0.0, 0.5])
    eyes, heads = zip(*((f.pose["eye.turn.left"], f.pose["head.turn"]) for f in run(session, 60)), strict=True)
    aim = np.degrees(np.arctan2(0.25, 0.5))
    assert heads[3] == 0.0
    assert eyes[4] == pytest.approx(aim)
    np.testing.assert_allclose(np.add(eyes, heads)[4:], aim, atol=1e-6)
    assert heads[-1] == pytest.approx(0.26 * aim)
    ok(session, kind="look", at="viewer")
    assert run(session, 60)[-1].pose["head.turn"] == 0.0


def test_channels_are_moved_in_the_layers_that_they_belong_to():
    session = still()
    ok(session, kind="move", values={"jaw": 0.5}, layer="speech", over_ms=100)
    assert run(session, 20)[-1].pose["jaw.rotation"] == pytest.approx(6.5)
    assert (
        "did you mean 'jaw'" in session.handle({"kind": "move", "values": {"jaww": 0.5}, "layer": "speech"})["message"]
    )
    ok(session, kind="stop", layer="speech")
    assert run(session, 40)[-1].pose["jaw.rotation"] == 0.0


@settings(max_examples=40, deadline=None)
@given(
    cues=st.lists(
        st.tuples(st.floats(0, 2), st.floats(0, 2), st.sampled_from(["AA1", "P", "SIL", "S", "QQ", "1"])), max_size=6
    ),
    words=st.lists(st.tuples(st.floats(0, 9), st.floats(0, 9), st.text(max_size=5)), max_size=4),
)
def test_any_phones_are_said_or_refused(cues, words):
    session = still("toon:gus")
    ordered = [
        [float(number + min(a, b) / 2), number + max(a, b) / 2, name] for number, (a, b, name) in enumerate(cues)
    ]
    reply = session.handle({"kind": "say", "text": "", "phones": ordered, "words": [list(word) for word in words]})
    assert reply["kind"] in ("ok", "error")
    assert np.isfinite(run(session, 9)[-1].pose.values).all()


@pytest.mark.parametrize("loop_s", [0.0, -1.0, float("nan"), 1e-6, 100.0])
def test_loops_have_sensible_lengths(loop_s):
    with pytest.raises(MienError, match="loop_s"):
        Session(face("head"), loop_s=loop_s)


ANYTHING = st.one_of(
    st.none(),
    st.booleans(),
    st.floats(),
    st.integers(),
    st.sampled_from(
        ["smile", "direct", "speech", "linear", "left", "", "\ud800", [], {}, [0, 0, 1e-300], [1e3, 0, -1e3]]
    ),
    st.dictionaries(
        st.sampled_from(["ELU", "BRL", "jaw.rotation", "jaw", "eyelid.opening", "palette", "viewer.z"]),
        st.one_of(st.floats(-30, 30), st.floats()),
        max_size=3,
    ),
)
FIELDS = sorted({field.name for kind in KINDS.values() for field in kind.fields} | {"id"})


@settings(max_examples=150, deadline=None)
@given(kind=st.sampled_from(sorted(KINDS)), fields=st.dictionaries(st.sampled_from(FIELDS), ANYTHING, max_size=4))
@example(kind="move", fields={"values": {"ELU": 5e-324}, "over_ms": 600_000})
@example(kind="look", fields={"at": [1e-300, 1e-300, -1e-300]})
@example(kind="play", fields={"motion": "nod", "speed": 0.1, "strength": 0})
def test_whatever_is_sent_is_answered_and_the_face_goes_on(kind, fields):
    session = Session(face("head"))
    for message in ({**fields, "kind": kind}, {"kind": "reset"}):
        reply = session.handle(message)
        assert reply["kind"] in ("ok", "error", "state")
        json.dumps(reply, allow_nan=False).encode("ascii")
        pose = session.step().pose
        assert np.isfinite(pose.values).all()
        assert pose.clamped() == pose


COMMANDS = st.one_of(
    st.builds(
        lambda name, value, over, change: {"kind": "move", "values": {name: value}, "over_ms": over, "change": change},
        st.sampled_from(["ELU", "ERU", "BRL", "BRM", "MLV", "MB", "HH", "HV"]),
        st.floats(0, 1),
        st.integers(0, 400),
        st.sampled_from(["linear", "cosine", "ease-in", "ease-out"]),
    ),
    st.builds(
        lambda motion, strength, hold: {"kind": "play", "motion": motion, "strength": strength, "hold": hold},
        st.sampled_from(sorted(standard_motions())),
        st.floats(0, 1),
        st.booleans(),
    ),
    st.builds(lambda *at: {"kind": "look", "at": list(at)}, *[st.floats(-2, 2).filter(bool)] * 3),
    st.builds(lambda *at: {"kind": "target", "name": "cup", "at": list(at)}, *[st.floats(-2, 2).filter(bool)] * 3),
    st.just({"kind": "look", "at": "cup"}),
    st.builds(
        lambda layer: {"kind": "stop", "layer": layer}, st.sampled_from(["gaze", "expression", "speech", "direct"])
    ),
    st.sampled_from([SAY, {"kind": "interrupt"}, {"kind": "reset"}, {"kind": "idle", "blinks": 0.5, "sway": 0}]),
    st.builds(lambda jaw: {"kind": "move", "values": {"jaw": jaw}, "layer": "speech"}, st.floats(0, 1)),
)


@pytest.mark.parametrize("name", FACES)
@settings(max_examples=12, deadline=None)
@given(commands=st.lists(st.tuples(st.integers(0, 30), COMMANDS), max_size=8), seed=st.integers(0, 2**64 - 1))
def test_values_stay_in_range_and_the_same_log_gives_the_same_frames(name, commands, seed):
    log, frames = [], []
    table = face(name).parameters
    session = Session(face(name), seed=seed, log=log.append)
    ok(session, kind="target", name="cup", at=[0.3, 0, 1])
    for loops, command in commands:
        assert session.handle(command)["kind"] == "ok"
        frames += run(session, loops)
    frames += run(session, 5)
    session.close()
    values = np.array([frame.pose.values for frame in frames])
    assert np.isfinite(values).all()
    assert (values >= table.lows).all()
    assert (values <= table.highs).all()
    again = list(replay(read_log(log), face(name)))
    assert len(again) == len(frames)
    assert digest(again) == digest(frames)


@pytest.mark.parametrize("name", FACES)
@settings(max_examples=12, deadline=None)
@given(data=st.data())
def test_every_move_ends_where_it_said(name, data):
    table = face(name).parameters
    rows = [row for row in table if row.role in ("motion", "gaze", "contact")]
    session = Session(face(name), seed=data.draw(st.integers(0, 9)))
    told = {}
    for row in data.draw(st.lists(st.sampled_from(rows), min_size=1, max_size=8)):
        value = data.draw(st.floats(row.low, row.high))
        ok(session, kind="move", values={row.name: value}, over_ms=data.draw(st.integers(0, 300)))
        told[row.name] = value
        run(session, data.draw(st.integers(0, 9)))
    pose = run(session, 19)[-1].pose
    assert {row: pose[row] for row in told} == told


def test_the_same_seed_lives_the_same_life_and_another_another():
    frames = [digest(run(Session(face("toon:olav"), seed=seed), 200)) for seed in (1, 1, 2)]
    assert frames[0] == frames[1] != frames[2]


def test_each_part_of_idle_life_can_be_switched():
    table = face("head").parameters
    seen = {}
    for part in IDLE_PARTS:
        values = np.array([f.pose.values for f in run(Session(face("head"), idle={**STILL, part: 1.0}, seed=4), 900)])
        seen[part] = {table.names[row] for row in np.flatnonzero(np.ptp(values, axis=0))}
    assert "eyelid.opening.left" in seen["blinks"]
    assert seen["saccades"] == {"eye.turn.left", "eye.turn.right", "eye.nod.left", "eye.nod.right"}
    assert seen["breathing"] == {"head.nod"}
    assert seen["sway"] == {"head.turn", "head.nod", "head.tilt"}
    session = Session(face("head"), seed=4)
    ok(session, kind="idle", **STILL)
    run(session, 60)
    assert len({frame.pose for frame in run(session, 600)}) == 1


def test_no_loop_makes_more_than_one_piece_of_what_comes_next(monkeypatch):
    made, plain = [], Track.evaluate
    monkeypatch.setattr(Track, "evaluate", lambda *given: made.append(0) or plain(*given))
    idle, counts = Idle(1, Fraction(60), {}), []
    pieces = len(made)
    for _ in range(4000):
        made.clear()
        idle.step()
        counts.append(len(made))
    assert max(counts) == 1
    assert sum(counts) == 3 * pieces


def test_a_stretch_of_few_long_loops_is_whole():
    slow, fast = Idle(1, Fraction(1, 10), {}), Idle(1, Fraction(1), {})
    every = [fast.step() for _ in range(60)]
    np.testing.assert_allclose([slow.step() for _ in range(6)], every[::10], atol=1e-12)


def test_an_hour_blinks_at_the_published_rate_and_keeps_no_more_than_a_stretch():
    """Source of the rate: ``mien.gaze.blinks``, 17 a minute."""
    idle, shut, before, sizes = Idle(1, Fraction(25), {}), 0, 0.0, set()
    row = vocabulary("channels").index["blink.left"]
    for loop in range(90_000):
        now = idle.step()[row]
        shut += now > 0.5 >= before
        before = now
        if loop % 9000 == 8999:
            sizes.add(sum(track.size for _, _, track in (*idle._stretch, *idle._next)))
    assert len(sizes) == 1
    assert 14 * 60 < shut < 20 * 60


@pytest.mark.parametrize(
    ("lines", "words"),
    [
        ([], "is empty"),
        (["{}"], "mien-live"),
        (["nonsense"], "log:1: is no JSON"),
        (['{"format": "mien-live", "version": 2}'], "version"),
    ],
)
def test_what_is_no_log_is_refused(lines, words):
    with pytest.raises(LoadError, match=words):
        read_log(lines)


def test_wrong_lines_of_a_log_are_named():
    log = []
    session = still(log=log.append)
    ok(session, kind="play", motion="nod")
    session.close()
    with pytest.raises(LoadError, match="log:2: unknown kind of message 'plya'"):
        read_log([log[0], log[1].replace("play", "plya")])
    with pytest.raises(LoadError, match="log:4: comes after the end"):
        read_log([*log, log[1]])
    assert read_log(log[:2]).loops == 1
    with pytest.raises(MienError, match="another version"):
        list(replay(read_log(log), face("toon:gus")))


@pytest.mark.parametrize("kind", sorted(name for name, kind in KINDS.items() if kind.connection))
def test_what_is_about_a_connection_is_refused_by_a_session_alone(kind):
    fields = {"subscribe": {"events": True}, "speech.pcm": {"rate_hz": 16000, "data": "AAAA"}, "report": {}}[kind]
    assert "without connections" in still().handle({"kind": kind, **fields})["message"]
