import copy
import json

import numpy as np
import pytest

from mien.core import Cue, LoadError, Parameter, ParameterTable
from mien.timeline import Layer, Segment, Timeline, Track, from_json, json_text, to_json

TABLE = ParameterTable((Parameter("jaw.rotation", 0, 20, 0, "deg"), Parameter("mouth.width", 0.5, 1.5, 1)))
TIMELINE = Timeline(
    (
        Layer("idle", "replace", {}),
        Layer(
            "speech",
            "replace",
            {
                "jaw.rotation": Track.from_keys([0, 0.1, 1 / 3], [0, 0.1 + 0.2, 7], ["cosine", "ease-in"]),
                "mouth.width": Track.from_segments([Segment(0, 2, 1, 1.25, "ease-out"), Segment(0.5, 0.75, 0.5, 0.5)]),
            },
        ),
        Layer("direct", "weighted", {"jaw.rotation": Track.from_keys([0.5], [3])}, 0.25),
    ),
    2.5,
    fps=24.0,
    words=(Cue(0.1, 0.9, "grüß"),),
    phones=(Cue(0.1, 0.2, "ɡ"), Cue(0.2, 0.9, "ʁ")),
    title="A title",
    text='Grüß — "x"\nzwei',
    seed=7,
)


def stored_sample():
    """A file as version 1 wrote it; it must be readable for ever."""
    return {
        "format": "mien-timeline",
        "version": 1,
        "title": "Sample",
        "face": "head",
        "table": "0123456789ab",
        "sound": "sample.wav",
        "words": [[0.0, 0.5, "hi"]],
        "phones": [[0.0, 0.25, "h"], [0.25, 0.5, "ay"]],
        "scene": {"background": "#102030"},
        "fps": 24.0,
        "seed": 3,
        "length_s": 1.0,
        "layers": [
            {
                "name": "speech",
                "blend": "replace",
                "weight": 1.0,
                "tracks": {
                    "jaw.rotation": {"times": [0.0, 0.5, 1.0], "values": [0.0, 8.0, 0.0], "change": "cosine"},
                    "mouth.width": {"segments": [[0.0, 0.5, 1.0, 1.2, "linear"], [0.75, 1.0, 1.2, 1.0, "ease-in"]]},
                },
            },
            {"name": "direct", "blend": "add", "weight": 0.5, "tracks": {"head.turn": {"times": [0.0], "values": [4]}}},
        ],
    }


def test_round_trip_is_exact():
    text = "".join(json_text(TIMELINE, TABLE, face="head", sound="a.wav", scene={"size": [64, 64]}))
    stored = from_json(json.loads(text))
    assert stored.timeline == TIMELINE
    assert (stored.face, stored.sound, stored.scene) == ("head", "a.wav", {"size": [64, 64]})
    assert stored.fits(TABLE)
    times = np.linspace(0, 3, 501)
    assert stored.timeline.values(times, TABLE).tobytes() == TIMELINE.values(times, TABLE).tobytes()


def test_text_and_dict_are_the_same_form_and_a_track_is_a_line():
    text = "".join(json_text(TIMELINE, TABLE, sound="a.wav"))
    assert json.loads(text) == to_json(TIMELINE, TABLE, sound="a.wav")
    assert len([line for line in text.splitlines() if '"times"' in line or '"segments"' in line]) == 3
    assert json.loads("".join(json_text(Timeline((), 1.0)))) == to_json(Timeline((), 1.0))


def test_keys_are_written_compactly():
    track = to_json(TIMELINE)["layers"][1]["tracks"]["jaw.rotation"]
    assert track == {
        "times": [0.0, 0.1, 0.3333333333333333],
        "values": [0.0, 0.30000000000000004, 7.0],
        "change": ["cosine", "ease-in"],
    }
    assert to_json(TIMELINE)["layers"][2]["tracks"]["jaw.rotation"] == {"times": [0.5], "values": [3.0]}


def test_stored_sample_of_version_1_is_read():
    stored = from_json(stored_sample(), "sample.json")
    timeline = stored.timeline
    assert (stored.face, stored.fingerprint, stored.sound) == ("head", "0123456789ab", "sample.wav")
    assert stored.scene == {"background": "#102030"}
    assert not stored.fits(TABLE)
    assert (timeline.title, timeline.fps, timeline.seed, timeline.length_s) == ("Sample", 24.0, 3, 1.0)
    assert timeline.phones[1] == Cue(0.25, 0.5, "ay")
    assert timeline.layer("speech").tracks["jaw.rotation"].evaluate([0.25])[0] == pytest.approx(4)
    assert timeline.layer("speech").tracks["mouth.width"].evaluate([0.6])[0] == 1.2
    assert timeline.layer("direct").weight == 0.5


def change(way, value):
    data = stored_sample()
    target = data
    for step in way[:-1]:
        target = target[step]
    if value is ...:
        del target[way[-1]]
    else:
        target[way[-1]] = value
    return data


JAW = ("layers", 0, "tracks", "jaw.rotation")


@pytest.mark.parametrize(
    ("data", "message"),
    [
        ([], "x.json: document: want an object, got []"),
        ({}, 'x.json: document: is not a timeline: want "format": "mien-timeline"'),
        (change(("format",), "gltf"), "is not a timeline"),
        (change(("version",), ...), "'version' is missing"),
        (change(("version",), "1"), 'version: want a whole number, got "1"'),
        (change(("version",), True), "version: want a whole number, got true"),
        (change(("version",), 2), "version: want version 1, got 2 — a newer mien wrote it"),
        (change(("version",), 0), "version: want version 1, got 0 — there never was"),
        (change(("lenght_s",), 1), "unknown key 'lenght_s' — did you mean 'length_s'"),
        (change(("length_s",), ...), "'length_s' is missing"),
        (change(("length_s",), -1), "length of -1.0 s"),
        (change(("length_s",), 1e300), "length of 1e+300 s"),
        (change(("length_s",), float("nan")), "length_s: want a finite number"),
        (change(("fps",), 0), "a rate of 0"),
        (change(("seed",), 1.5), "seed: want a whole number, got 1.5"),
        (change(("words", 0), [0, 1]), "words[0]: want a list of 3, got one of 2"),
        (change(("words", 0, 2), 4), "words[0][2]: want a text, got 4"),
        (change(("words", 0, 1), -4), "words[0]: ends at -4.0 s, before it starts at 0.0 s"),
        (change(("layers",), {}), "layers: want a list, got {}"),
        (change(("layers", 1, "name"), "speech"), "two layers 'speech'"),
        (
            change(("layers", 0, "blend"), "ad"),
            "layers[0]: unknown blend rule of layer 'speech' 'ad' — did you mean 'add'",
        ),
        (change(("layers", 1, "weight"), 2), "layers[1]: layer 'direct': weight 2.0 is not in 0..1"),
        (change(("layers", 1, "weights"), 2), "layers[1]: unknown key 'weights' — did you mean 'weight'"),
        (change((*JAW, "times", 1), "x"), 'layers[0].tracks["jaw.rotation"].times[1]: want a number, got "x"'),
        (change((*JAW, "times", 1), True), 'layers[0].tracks["jaw.rotation"].times[1]: want a number, got true'),
        (change((*JAW, "values", 2), float("nan")), "].values[2]: want a finite number, got NaN"),
        (change((*JAW, "values", 2), 10**400), "].values[2]: want a finite number, got 1000"),
        (change((*JAW, "values", 2), 1e300), "track 'jaw.rotation': value 1e+300 at 1.0 s"),
        (
            change((*JAW, "values"), [1]),
            "].tracks[\"jaw.rotation\"]: track 'jaw.rotation': want as many times as values",
        ),
        (change((*JAW, "times", 2), 0.1), "key 2 at 0.1 s comes before key 1 at 0.5 s"),
        (change((*JAW, "change"), "cos"), "unknown change function 'cos'"),
        (change((*JAW, "change"), ["cosine"]), "want 2 change functions, got 1"),
        (change((*JAW, "times"), ...), "'times' is missing"),
        (change((*JAW, "segments"), []), "unknown key 'times'"),
        (
            change(("layers", 0, "tracks", "mouth.width", "segments", 0, 1), None),
            "segments[0][1]: want a number, got null",
        ),
        (change(("layers", 0, "tracks", "mouth.width", "segments"), []), "has no key"),
        (change(("scene",), []), "scene: want an object"),
    ],
)
def test_what_is_wrong_is_refused_with_its_place(data, message):
    with pytest.raises(LoadError) as caught:
        from_json(copy.deepcopy(data), "x.json")
    assert str(caught.value).startswith("x.json: ")
    assert str(caught.value).count("x.json") == 1
    assert message in str(caught.value)


def test_an_hour_of_dense_tracks_is_written_and_read_in_good_time():
    times = np.arange(200_000) * 0.01
    track = Track.from_keys(times, times % 20)
    timeline = Timeline((Layer("speech", "replace", {"jaw.rotation": track}),), 2000.0)
    assert from_json(json.loads("".join(json_text(timeline)))).timeline == timeline
