"""Timelines as JSON: versioned, exact to the last bit, one line a track.

Floats are written as Python's ``repr``, the shortest text that reads back as the same number.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from mien.core import Cue, LoadError, MienError, ParameterTable

from .change import CHANGE_NAMES
from .json_reader import Node
from .layers import Layer
from .timeline import Timeline
from .track import Segment, Track

FORMAT = "mien-timeline"
VERSION = 1
"""Version that is written. It is the first; a later one brings the step from each earlier one with it."""

_TOP_OPTIONAL = ("title", "face", "table", "fps", "seed", "sound", "words", "phones", "scene", "text")


@dataclass(frozen=True)
class StoredTimeline:
    """A timeline as it stands in a file, with what it says about face, sound and scene.

    Attributes:
        timeline: the timeline.
        face: address of the face that it was made for, or "".
        fingerprint: of that face's table, or "".
        sound: name of the sound file that goes with it, or "".
        scene: settings of the picture; what they mean is up to the reader.
    """

    timeline: Timeline
    face: str = ""
    fingerprint: str = ""
    sound: str = ""
    scene: Mapping[str, Any] = field(default_factory=dict)

    def fits(self, table: ParameterTable) -> bool:
        """Whether it was made for exactly this table, or does not say for which."""
        return self.fingerprint in ("", table.fingerprint)


def to_json(
    timeline: Timeline,
    table: ParameterTable | None = None,
    *,
    face: str = "",
    sound: str = "",
    scene: Mapping[str, Any] | None = None,
) -> dict[str, Any]:
    """The JSON form, made of dicts, lists, texts and numbers only; what is empty is left out."""
    form = _head(StoredTimeline(timeline, face, table.fingerprint if table else "", sound, scene or {}))
    form["layers"] = [
        {**_layer_head(layer), "tracks": {name: _track_form(track) for name, track in layer.tracks.items()}}
        for layer in timeline.layers
    ]
    return form


def json_text(
    timeline: Timeline,
    table: ParameterTable | None = None,
    *,
    face: str = "",
    sound: str = "",
    scene: Mapping[str, Any] | None = None,
) -> Iterator[str]:
    """The text of the JSON form in pieces, one line a track, so that hours of speech need the memory of one track."""
    head = _head(StoredTimeline(timeline, face, table.fingerprint if table else "", sound, scene or {}))
    yield "{\n"
    for key, value in head.items():
        yield f"  {_dump(key)}: {_dump(value)},\n"
    yield '  "layers": ['
    for number, layer in enumerate(timeline.layers):
        yield ("," if number else "") + "\n    {"
        for key, value in _layer_head(layer).items():
            yield f"{_dump(key)}: {_dump(value)}, "
        yield '"tracks": {'
        for row, (name, track) in enumerate(layer.tracks.items()):
            yield ("," if row else "") + f"\n      {_dump(name)}: {_dump(_track_form(track))}"
        yield "\n    }}" if layer.tracks else "}}"
    yield "\n  ]\n}\n" if timeline.layers else "]\n}\n"


def from_json(data: object, source: str = "timeline") -> StoredTimeline:
    """The timeline of a JSON form and what is said beside it.

    Raises:
        LoadError: it is no timeline, of another version, or something in it is missing, unknown or of the wrong kind;
            the message names the place, such as ``layers[2].tracks["jaw.rotation"].times[4]``.
    """
    top = Node(data, source)
    kinds = dict(top.entries())
    if "format" not in kinds or kinds["format"].value != FORMAT:
        raise top.error(f'is not a timeline: want "format": "{FORMAT}"', "was it written by something else?")
    if "version" not in kinds:
        raise top.error("'version' is missing")
    version = kinds["version"].integer()
    if version != VERSION:
        hint = "a newer mien wrote it: update this one" if version > VERSION else "there never was such a version"
        raise kinds["version"].error(f"want version {VERSION}, got {version}", hint)
    members = top.members(("format", "version", "length_s", "layers"), _TOP_OPTIONAL)

    def text(key: str) -> str:
        return members[key].text() if key in members else ""

    layers = tuple(_read_layer(node) for node in members["layers"].items())
    try:
        timeline = Timeline(
            layers,
            members["length_s"].number(),
            fps=members["fps"].number() if "fps" in members else None,
            words=_read_cues(members["words"]) if "words" in members else (),
            phones=_read_cues(members["phones"]) if "phones" in members else (),
            title=text("title"),
            text=text("text"),
            seed=members["seed"].integer() if "seed" in members else None,
        )
    except LoadError:  # knows its place already
        raise
    except MienError as error:
        raise _placed(top, error) from None
    scene = dict(members["scene"].entries()) if "scene" in members else {}
    plain_scene = {key: node.value for key, node in scene.items()}
    return StoredTimeline(timeline, text("face"), text("table"), text("sound"), plain_scene)


def _head(stored: StoredTimeline) -> dict[str, Any]:
    timeline = stored.timeline
    form: dict[str, Any] = {"format": FORMAT, "version": VERSION}
    optional = {
        "title": timeline.title,
        "text": timeline.text,
        "face": stored.face,
        "table": stored.fingerprint,
        "sound": stored.sound,
        "words": [[cue.start_s, cue.end_s, cue.symbol] for cue in timeline.words],
        "phones": [[cue.start_s, cue.end_s, cue.symbol] for cue in timeline.phones],
        "scene": dict(stored.scene),
    }
    form |= {key: value for key, value in optional.items() if value}
    if timeline.fps is not None:
        form["fps"] = timeline.fps
    if timeline.seed is not None:
        form["seed"] = timeline.seed
    return {**form, "length_s": timeline.length_s}


def _layer_head(layer: Layer) -> dict[str, Any]:
    return {"name": layer.name, "blend": layer.blend, "weight": layer.weight}


def _track_form(track: Track) -> dict[str, Any]:
    """``times``, ``values`` and ``change`` of a way through keys; else ``segments``, one list each."""
    keys = track.keys()
    if keys is None:
        return {"segments": [[s.start_s, s.end_s, s.first, s.last, s.change] for s in track.segments()]}
    times, values = keys
    form: dict[str, Any] = {"times": times.tolist(), "values": values.tolist()}
    if len(times) > 1:
        codes = track.change
        names = [CHANGE_NAMES[code] for code in codes] if np.any(codes != codes[0]) else CHANGE_NAMES[codes[0]]
        form["change"] = names
    return form


def _read_layer(node: Node) -> Layer:
    members = node.members(("name", "blend", "tracks"), ("weight",))
    tracks = {name: _read_track(name, track) for name, track in members["tracks"].entries()}
    weight = members["weight"].number() if "weight" in members else 1.0
    try:
        return Layer(members["name"].text(), members["blend"].text(), tracks, weight)
    except MienError as error:
        raise _placed(node, error) from None


def _read_track(name: str, node: Node) -> Track:
    if "segments" in dict(node.entries()):
        segments = [_read_segment(item) for item in node.members(("segments",))["segments"].items()]
        try:
            return Track.from_segments(segments, name=name)
        except MienError as error:
            raise _placed(node, error) from None
    members = node.members(("times", "values"), ("change",))
    change: str | list[str] = "linear"
    if "change" in members:
        form = members["change"]
        change = [item.text() for item in form.items()] if isinstance(form.value, list) else form.text()
    times, values = members["times"].numbers(), members["values"].numbers()
    try:
        return Track.from_keys(times, values, change, name=name)
    except MienError as error:
        raise _placed(node, error) from None


def _read_segment(node: Node) -> Segment:
    start, end, first, last, change = node.items(5)
    return Segment(start.number(), end.number(), first.number(), last.number(), change.text())


def _read_cues(node: Node) -> tuple[Cue, ...]:
    cues = []
    for item in node.items():
        start, end, symbol = item.items(3)
        cues.append(Cue(start.number(), end.number(), symbol.text()))
        if end.number() < start.number():
            raise item.error(f"ends at {end.number()} s, before it starts at {start.number()} s")
    return tuple(cues)


def _placed(node: Node, error: MienError) -> MienError:
    return node.error(str(error))


def _dump(value: object) -> str:
    return json.dumps(value, ensure_ascii=False, allow_nan=False)
