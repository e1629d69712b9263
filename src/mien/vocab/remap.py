"""A remap: what each value under one set of names does to values under another."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property, lru_cache
from typing import TypeVar

import numpy as np

from mien.core import MienError, ParameterTable, UnknownNameError
from mien.timeline import Track

BLENDS = ("add", "multiply", "share", "set")
FITS = ("exact", "near", "stand-in")

HALVES = ("+", "-")
"""What stands behind a name for the part of its value that is above its rest, and for the part below."""

Value = TypeVar("Value", float, Track)


@dataclass(frozen=True)
class Link:
    """What a value v of a name does to one parameter.

    Attributes:
        name: of the vocabulary; with ``+`` or ``-`` behind it v is the share of the way from its rest to its high or
            low end.
        parameter: of a family of faces, or a name of another vocabulary.
        gain: how much.
        blend: ``add`` adds ``gain * v``; ``share`` adds ``gain * v`` of the way from the parameter's default to the end
            of its range; ``multiply`` multiplies by ``1 + gain * v`` (a blink shuts an eye however wide an expression
            has opened it); ``set`` makes what lies beneath count no more: the parameter is ``gain * v``, and for a
            half of a name ``gain * v`` from its default.
        fit: ``exact``, ``near``, or ``stand-in`` for something that the family cannot show.
        source: where this comes from.
        unless: a parameter; faces that have it do without this link.
    """

    name: str
    parameter: str
    gain: float
    blend: str = BLENDS[0]
    fit: str = FITS[0]
    source: str = ""
    unless: str = ""


@dataclass(frozen=True, eq=False)
class Remap:
    """A sparse matrix of links from the names of a vocabulary to the parameters of a family of faces.

    Attributes:
        title: ``vocabulary.family``, for messages.
        links: in the order of the table.
        at_best: fits that names cannot be better than, since a face has not all parameters.
    """

    title: str
    links: tuple[Link, ...]
    at_best: Mapping[str, str] = field(default_factory=dict)

    @cached_property
    def from_names(self) -> tuple[str, ...]:
        """Names that are given; halves of names each for itself."""
        return tuple(dict.fromkeys(link.name for link in self.links))

    @cached_property
    def to_names(self) -> tuple[str, ...]:
        """Parameters that are played."""
        return tuple(dict.fromkeys(link.parameter for link in self.links))

    @cached_property
    def index(self) -> Mapping[str, int]:
        """Column of each name that is given."""
        return {name: column for column, name in enumerate(self.from_names)}

    @cached_property
    def fits(self) -> Mapping[str, str]:
        """How well each name of the vocabulary is played: as its worst link is.

        The first link of a name is what it is about: what is left of a name that has lost it stands in for it. One
        that has lost another link is played nearly.
        """
        fits: dict[str, str] = {}
        for link in self.links:
            name = whole(link.name)
            fits[name] = worst(fits.get(name, FITS[0]), self.at_best.get(name, FITS[0]), link.fit)
        return fits

    def on(self, table: ParameterTable) -> Remap:
        """The remap for one face of the family: shares become amounts, links to what this face has not are left out.

        Args:
            table: the face's.
        """
        return _on(self, table)

    def apply(self, values: Mapping[str, float]) -> dict[str, float]:
        """What the values add to parameters, for those parameters that they reach.

        Raises:
            UnknownNameError: a name is not in the vocabulary.
        """
        return {
            parameter: sum(gain * value for gain, value in parts) for parameter, parts in self.pushes(values).items()
        }

    def scale(self, values: Mapping[str, float]) -> dict[str, float]:
        """What parameters are to be multiplied by, for those that the values reach: the factors of all names.

        Raises:
            UnknownNameError: a name is not in the vocabulary.
        """
        return {
            parameter: math.prod(1.0 + gain * value for gain, value in parts)
            for parameter, parts in self._parts("multiply", values).items()
        }

    def pushes(self, values: Mapping[str, float]) -> dict[str, list[tuple[float, float]]]:
        """(gain, value) of each name that adds to a parameter, for those parameters that the values reach.

        Raises:
            UnknownNameError: a name is not in the vocabulary.
        """
        return self._parts("add", values)

    def places(self, values: Mapping[str, float]) -> dict[str, float]:
        """What parameters are set to by names as a whole.

        Raises:
            UnknownNameError: a name is not in the vocabulary.
        """
        wholes = {name: value for name, value in values.items() if name == whole(name)}
        return {name: gain * value for name, parts in self._parts("set", wholes).items() for gain, value in parts}

    def moves(self, values: Mapping[str, float]) -> dict[str, list[tuple[float, float]]]:
        """(gain, value) of each half of a name that moves a parameter from its default, whatever lies beneath.

        Raises:
            UnknownNameError: a name is not in the vocabulary.
        """
        return self._parts("set", {name: value for name, value in values.items() if name != whole(name)})

    def apply_tracks(self, tracks: Mapping[str, Track]) -> dict[str, Track]:
        """Tracks of what is added to each parameter that the given tracks reach.

        Exact: sums of straight lines have a key wherever one of them has; a track that reaches a parameter alone
        keeps its change functions. Before its first key a track counts with the value of that key.

        Raises:
            UnknownNameError: a name is not in the vocabulary.
            MienError: tracks to be added are not made of keys and straight lines.
        """
        return self._apply_tracks("add", tracks, 0.0)

    def scale_tracks(self, tracks: Mapping[str, Track]) -> dict[str, Track]:
        """Tracks of what parameters are multiplied by; otherwise as ``apply_tracks``.

        Where several names multiply one parameter their gains are added up, since a product of straight lines is none.
        """
        return self._apply_tracks("multiply", tracks, 1.0)

    def reached_by(self, names: Iterable[str]) -> tuple[str, ...]:
        """Parameters that some of the names add to, in order."""
        return tuple(self._parts("add", dict.fromkeys(names, 1.0)))

    def check(self, known_from: ParameterTable, known_to: ParameterTable) -> None:
        """Nothing, when both sets of names exist.

        Raises:
            UnknownNameError: a name on either side is in no table.
        """
        given = (whole(name) for name in self.from_names)
        unless = (link.unless for link in self.links if link.unless)
        for names, table in ((given, known_from), (self.to_names, known_to), (unless, known_to)):
            for name in names:
                if name not in table:
                    raise UnknownNameError(f"name in the table {self.title!r}:", name, table.names)

    @cached_property
    def _matrices(self) -> Mapping[str, Mapping[str, Mapping[str, float]]]:
        """blend -> parameter -> name -> gain; names in the order of ``from_names``."""
        matrices: dict[str, dict[str, dict[str, float]]] = {blend: {} for blend in BLENDS}
        for link in sorted(self.links, key=lambda link: self.index[link.name]):
            row = matrices[link.blend].setdefault(link.parameter, {})
            row[link.name] = row.get(link.name, 0.0) + link.gain
        return matrices

    def _parts(self, blend: str, values: Mapping[str, Value]) -> dict[str, list[tuple[float, Value]]]:
        for name in values:
            if name not in self.index:
                raise UnknownNameError(f"name in the vocabulary of {self.title!r}:", name, self.from_names)
        if self._matrices["share"]:
            raise MienError(
                f"{self.title}: counts in shares of ranges, which every face has its own of — use on(table)"
            )
        rows = self._matrices[blend]
        parts = (
            (name, [(gain, values[given]) for given, gain in rows[name].items() if given in values])
            for name in self.to_names
            if name in rows
        )
        return {name: part for name, part in parts if part}

    def _apply_tracks(self, blend: str, tracks: Mapping[str, Track], rest: float) -> dict[str, Track]:
        return {name: weigh(parts, rest, name=name) for name, parts in self._parts(blend, tracks).items()}


def whole(name: str) -> str:
    """The name that a half belongs to, or the name itself."""
    return name[:-1] if name.endswith(HALVES) else name


def worst(*fits: str) -> str:
    """The worst of some fits."""
    return max(fits, key=FITS.index)


@lru_cache(maxsize=64)
def _on(remap: Remap, table: ParameterTable) -> Remap:
    known = [link for link in remap.links if not (link.unless and link.unless in table)]
    first = {whole(link.name): link for link in reversed(remap.links)}
    at_best: dict[str, str] = {}
    for link in known:
        if link.parameter not in table:
            name = whole(link.name)
            at_best[name] = worst(at_best.get(name, FITS[1]), FITS[-1] if link is first[name] else FITS[1])
    links = tuple(_counted(link, table) for link in known if link.parameter in table)
    return Remap(remap.title, links, at_best)


def _counted(link: Link, table: ParameterTable) -> Link:
    """The link with an amount instead of a share."""
    if link.blend != "share":
        return link
    row = table[link.parameter]
    return replace(
        link, blend="add", gain=link.gain * (row.high - row.default if link.gain > 0.0 else row.default - row.low)
    )


def weigh(parts: list[tuple[float, Track]], rest: float = 0.0, *, name: str = "") -> Track:
    """The track ``rest`` + the sum of gain times track over the parts.

    Raises:
        MienError: there are several and one is not made of keys and straight lines.
    """
    if len(parts) == 1:
        gain, track = parts[0]
        first, last = rest + gain * track.first, rest + gain * track.last
        return Track(track.start_s, track.end_s, first, last, track.change, name)
    keys = [_straight_keys(track, name) for _, track in parts]
    times = np.unique(np.concatenate([when for when, _ in keys]))
    total = np.full(len(times), rest)
    for (gain, track), (when, values) in zip(parts, keys, strict=True):
        total += gain * np.where(times < when[0], values[0], track.evaluate(times)[0])
    return Track.from_keys(times, total, name=name)


def _straight_keys(track: Track, name: str) -> tuple[np.ndarray, np.ndarray]:
    keys = track.keys()
    if keys is None or np.any(track.change) or np.any(np.diff(keys[0]) <= 0.0):
        raise MienError(f"tracks that add up in {name!r} must be keys and straight lines without jumps")
    return keys
