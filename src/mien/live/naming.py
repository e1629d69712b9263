"""Which rows of a face's table a command means: its own names, or motor codes of ToonFace on any face."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from mien.core import Face, RangeError, UnknownNameError
from mien.vocab import load_remap, pose_from, vocabulary
from mien.vocab.posing import MOTORS
from mien.vocab.remap import HALVES


class Names:
    """The names that a face answers to.

    A code that is none of the face's own is played by several of its rows together (``mien.vocab``). Codes can share a
    row; so those that were given before count on until they are forgotten.
    """

    def __init__(self, face: Face) -> None:
        self.face = face
        self.table = face.parameters
        self.codes = vocabulary(MOTORS)
        self._given: dict[str, float] = {}
        links = load_remap(MOTORS, face.family).on(self.table).links
        self._rows: dict[str, tuple[int, ...]] = {
            code: tuple(
                dict.fromkeys(
                    self.table.index[link.parameter]
                    for link in links
                    if link.name in (code, code + HALVES[0], code + HALVES[1])
                )
            )
            for code in self.codes.names
        }
        self._same = {link.name: (self.table.index[link.parameter], link.gain) for link in links if link.blend == "set"}

    def targets(self, values: Mapping[str, float]) -> dict[int, float]:
        """Row number and value of every motor that values by name mean; a later name wins.

        Raises:
            UnknownNameError: a name is neither a parameter of the face nor a code.
            RangeError: a value is out of range.
        """
        found: dict[int, float] = {}
        given = {name: value for name, value in values.items() if name not in self.table}
        if given:
            codes = self._read(given)
            moved = pose_from(MOTORS, {**self._given, **codes}, self.face)
            self._given.update(codes)
            found = {row: float(moved.values[row]) for code in codes for row in self._rows[code]}
        own = {name: value for name, value in values.items() if name in self.table}
        for name, value in own.items():
            for row in self.table.resolve(name):
                found[self.table.index[row]] = self.table[row].check(value)
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

    def forget(self) -> None:
        """Let no code count any more."""
        self._given.clear()

    def _read(self, values: Mapping[str, float]) -> dict[str, float]:
        codes = {code: self.codes[code].check(value) for name, value in values.items() for code in self._resolve(name)}
        for code, value in codes.items():
            self._check_reach(code, value)
        return codes

    def _check_reach(self, code: str, value: float) -> None:
        """A code that a row plays alone goes as far as that row."""
        if code in self._same:
            row, gain = self._same[code]
            limits = self.table.rows[row]
            if not limits.low <= value * gain <= limits.high:
                low, high = sorted((limits.low / gain, limits.high / gain))
                raise RangeError(
                    f"{code}: {value:g} is out of range — on {self.face.name!r} it goes from {low:g} to {high:g}"
                )

    def _resolve(self, name: str) -> tuple[str, ...]:
        if name not in self.codes:
            known = [*self.table.names, *self.table.symmetric, *self.table.aliases, *self.codes.names]
            raise UnknownNameError("parameter", name, known)
        return self.codes.resolve(name)
