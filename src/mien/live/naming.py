"""Which rows of a face's table a command means: its own names, or motor codes of ToonFace on any face."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from mien.core import Face, Pose, RangeError, UnknownNameError
from mien.vocab import load_remap, pose_from, vocabulary
from mien.vocab.posing import MOTORS
from mien.vocab.remap import whole


class Names:
    """The names that a face answers to.

    A code that is none of the face's own is played by several of its rows together (``mien.vocab``). Codes can share a
    row; so those that were given before count on until they are forgotten.
    """

    def __init__(self, face: Face, rest: Pose | None = None) -> None:
        self.face, self.rest = face, rest or face.neutral
        self.table = face.parameters
        self.codes = vocabulary(MOTORS)
        self._given: dict[str, float] = {}
        links = load_remap(MOTORS, face.family).on(self.table).links
        played = {code: [link for link in links if whole(link.name) == code] for code in self.codes.names}
        self._rows = {
            code: tuple(dict.fromkeys(self.table.index[link.parameter] for link in some))
            for code, some in played.items()
        }
        self._same = {
            code: (self._rows[code][0], some[0].gain)
            for code, some in played.items()
            if len(some) == 1 and some[0].name == code
        }

    def targets(self, values: Mapping[str, float]) -> dict[int, float]:
        """Row number and value of every motor that values by name mean; the face's own names win over codes.

        Raises:
            UnknownNameError: a name is neither a parameter of the face nor a code.
            RangeError: a value is out of range.
        """
        found: dict[int, float] = {}
        given = {name: value for name, value in values.items() if name not in self.table}
        codes = {code: self.codes[code].check(value) for name, value in given.items() for code in self._resolve(name)}
        shared = {code: value for code, value in codes.items() if code not in self._same}
        for code in (code for code in codes if code not in shared):
            number, gain = self._same[code]
            found[number] = self._check_reach(code, codes[code], number, gain)
        if shared:
            moved = pose_from(MOTORS, {**self._given, **shared}, self.face, self.rest)
            found |= {row: float(moved.values[row]) for code in shared for row in self._rows[code]}
        own = {name: value for name, value in values.items() if name in self.table}
        for name, value in own.items():
            for row in self.table.resolve(name):
                found[self.table.index[row]] = self.table[row].check(value)
        self._given |= shared
        return found

    def read(self, values: Mapping[int, float], names: Iterable[str]) -> dict[str, float]:
        """Values by the names that were asked for; a symmetric name tells both of its sides.

        A code that several rows play has the value that it was given last, and before that its rest.

        Raises:
            UnknownNameError: there is no such name.
        """
        found: dict[str, float] = {}
        for name in names:
            if name in self.table:
                rows = self.table.resolve(name)
                keys = (name,) if len(rows) == 1 else rows
                found |= {key: values[self.table.index[row]] for key, row in zip(keys, rows, strict=True)}
                continue
            for code in self._resolve(name):
                row, gain = self._same.get(code, (0, 0.0))
                found[code] = values[row] / gain if gain else self._given.get(code, self.codes[code].default)
        return found

    def release(self, names: Iterable[str]) -> tuple[int, ...]:
        """The rows that names mean; codes among them count no more.

        Raises:
            UnknownNameError: there is no such name.
        """
        rows: dict[int, None] = {}
        codes: list[str] = []
        for name in names:
            if name in self.table:
                rows |= dict.fromkeys(self.table.index[row] for row in self.table.resolve(name))
            else:
                codes += self._resolve(name)
        for code in codes:
            rows |= dict.fromkeys(self._rows[code])
            self._given.pop(code, None)
        return tuple(rows)

    def forget(self, rows: Iterable[int]) -> None:
        """Let no code count any more that moves one of some rows."""
        gone = set(rows)
        self._given = {code: value for code, value in self._given.items() if gone.isdisjoint(self._rows[code])}

    def _check_reach(self, code: str, value: float, row: int, gain: float) -> float:
        """What the row that plays a code alone is set to; the code goes as far as that row."""
        limits, moved = self.table.rows[row], value * gain
        if not limits.low <= moved <= limits.high:
            low, high = sorted((limits.low / gain, limits.high / gain))
            name = self.face.name
            raise RangeError(f"{code}: {value:g} is out of range — on {name!r} it goes from {low:g} to {high:g}")
        return moved

    def _resolve(self, name: str) -> tuple[str, ...]:
        if name not in self.codes:
            known = [*self.table.names, *self.table.symmetric, *self.table.aliases, *self.codes.names]
            raise UnknownNameError("parameter", name, known)
        return self.codes.resolve(name)
