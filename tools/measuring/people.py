"""How people differ: their displacements without size and pose, and what goes along with one measure of them."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from mien.core import MienError, UnknownNameError

from .reference import Reference, Source, similarity

STABLE = (
    *("glabella", "nasion", "subnasale", "opisthocranion"),
    *(
        f"{name}_{side}"
        for name in ("endocanthion", "exocanthion", "tragion", "zygion", "frontotemporale", "gonion", "eurion")
        for side in "LR"
    ),
)
"""Landmarks by which size and pose are taken from a person."""

ADULT = 18
WEIGHT_OF_MODELS = 0.5
"""What an adult drawn by MakeHuman's artists counts beside a person from scans; children count nothing."""

TERM = re.compile(r"([+-]?)\s*(\d*\.?\d*)\s*([a-z][\w-]*?)(?:\.([xyz]))?\s*(?=[+-]\s|$)")
LABELS = ("sex", "old", "ethnicity_0", "ethnicity_1", "weight")
"""Labels whose effects are told apart by multiple regression; the third share of ethnicity follows from two."""
OLD_FROM, OLD_AT = 45.0, 70.0
"""Age up to which, on these models, hardly anything sags, and that of the oldest: ``old`` goes from 0 to 1 between."""


@dataclass(frozen=True, eq=False)
class People:
    """People of one source that are used, without size and pose.

    Attributes:
        fields: (N, S, 3) m, on our skin.
        moves: landmark -> (N, 3) m.
        labels: label -> (N,), none for scans.
        weight: what each counts.
    """

    fields: np.ndarray
    moves: dict[str, np.ndarray]
    labels: dict[str, np.ndarray]
    weight: float

    def measured(self, measure: str) -> np.ndarray:
        """(N,) a sum such as ``0.5 metopion.z - glabella.z`` in mm, or of labels such as ``weight``; centred.

        Raises:
            UnknownNameError: there is no such landmark or label.
            MienError: the sum cannot be read.
        """
        total = np.zeros(len(self.fields))
        for sign, factor, name, axis in _terms(measure):
            known = self.moves if axis else self.labels
            if name not in known:
                raise UnknownNameError("landmark" if axis else "label", name, known)
            value = 1000.0 * self.moves[name][:, "xyz".index(axis)] if axis else self.labels[name]
            total += (-1.0 if sign == "-" else 1.0) * float(factor or 1.0) * value
        return total - total.mean()

    def told_apart(self, measure: str, others: Sequence[str]) -> tuple[np.ndarray, np.ndarray]:
        """Values (N,) of a measure and the fields (N, S, 3), less what other measures explain.

        Source: Frisch and Waugh 1933 (the slope on what remains is that of the multiple regression).
        """
        design = np.column_stack([np.ones(len(self.fields)), *(self.measured(other) for other in others)])
        own, _ = np.linalg.qr(design)
        values, flat = self.measured(measure), self.fields.reshape(len(self.fields), -1)
        return values - own @ (own.T @ values), (flat - own @ (own.T @ flat)).reshape(self.fields.shape)


@dataclass(frozen=True, eq=False)
class Population:
    """All people of a reference folder."""

    reference: Reference

    @cached_property
    def scans(self) -> People:
        """Those drawn from a model of scans."""
        return _people(self.reference.scans, 1.0)

    @cached_property
    def models(self) -> People:
        """The adults of MakeHuman."""
        return _people(self.reference.models, WEIGHT_OF_MODELS)

    def direction(self, landmarks: str, apart: Sequence[str], label: str) -> np.ndarray:
        """The field (S, 3) m that goes along with one standard deviation of a measure.

        The slope is pooled within the two sources, so that how their neutral heads differ does not matter.

        Args:
            landmarks: a sum of landmarks' coordinates; empty where only labels tell.
            apart: other such sums, whose effects are taken off.
            label: a sum of labels of MakeHuman's people; empty where landmarks tell of all.
        """
        parts = []
        if landmarks:
            parts.append((*self.scans.told_apart(landmarks, apart), self.scans.weight))
        if label:
            others = [name for name in LABELS if name not in label.split()]
            parts.append((*self.models.told_apart(label, [*others, *apart]), self.models.weight))
        else:
            parts.append((*self.models.told_apart(landmarks, apart), self.models.weight))
        if landmarks and label:
            # A label and a sum of landmarks share no unit; deviations are what they share.
            parts = [(values / values.std(), fields, weight) for values, fields, weight in parts]
        along = sum(weight * np.tensordot(values, fields, 1) for values, fields, weight in parts)
        square = sum(weight * (values @ values) for values, _, weight in parts)
        deviation = np.sqrt(square / sum(weight * len(values) for values, _, weight in parts))
        return along / square * deviation


def align(source: Source, people: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Displacements of our skin (N, S, 3) m and of the landmarks (N, L, 3) m, without size and pose.

    Args:
        source: the head that they belong to.
        people: (N, V, 3) m, how each differs from it, in its own frame.
    """
    vertices = np.array(list(source.landmarks.values()))
    stable = [source.landmarks[name] for name in STABLE]
    skin = source.onto_skin @ source.points
    fields, moves = [], []
    for person in source.points + people @ source.turn.T:
        turn, shift = similarity(person[stable], source.points[stable])
        person = person @ turn.T + shift
        fields.append(source.onto_skin @ person - skin)
        moves.append((person - source.points)[vertices])
    return np.stack(fields), np.stack(moves)


def _people(source: Source, weight: float) -> People:
    used = [number for number, label in enumerate(source.labels) if label.get("age", ADULT) >= ADULT]
    fields, moves = align(source, source.people[used])
    by_name = dict(zip(source.landmarks, moves.swapaxes(0, 1), strict=True))
    return People(fields, by_name, _labels([source.labels[number] for number in used]), weight)


def _labels(labels: list[dict[str, Any]]) -> dict[str, np.ndarray]:
    if not labels[0]:
        return {}
    modifiers = sorted({name for label in labels for name in label["modifiers"]})
    ethnicity = np.array([label["ethnicity"] for label in labels])
    return {
        **{name: np.array([float(label[name]) for label in labels]) for name in ("sex", "age", "weight")},
        "old": np.clip([(label["age"] - OLD_FROM) / (OLD_AT - OLD_FROM) for label in labels], 0.0, 1.0),
        **{f"ethnicity_{number}": ethnicity[:, number] for number in (0, 1)},
        **{name: np.array([label["modifiers"].get(name, 0.0) for label in labels]) for name in modifiers},
    }


def _terms(measure: str) -> list[tuple[str, str, str, str]]:
    if not measure or TERM.sub("", measure).strip():
        raise MienError(f"measure {measure!r} cannot be read — want a sum such as '0.5 metopion.z - glabella.z'")
    return TERM.findall(measure)
