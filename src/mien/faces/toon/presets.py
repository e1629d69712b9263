"""What a drawn face can do by name: expressions, poses and moves of its hand, palettes."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from functools import cache
from importlib import resources

from mien.core import Preset

from .lines import resting_share
from .motors import motors
from .records import Character
from .table import OWN, linear_color


def make_presets(character: Character) -> Iterator[Preset]:
    """All presets of a character."""
    yield from _expressions(character)
    yield from _gestures(character)
    yield from _palettes(character)


@cache
def _family_expressions() -> tuple[tuple[str, str, str, Mapping[str, float]], ...]:
    """Name, meaning, source and activations by code of the expressions that every drawn face has."""
    text = resources.files(__package__).joinpath("data", "expressions.json").read_text(encoding="utf-8")
    return tuple((each["name"], each["doc"], each["source"], each["activations"]) for each in json.loads(text))


def _expressions(character: Character) -> list[Preset]:
    found = {}
    for name, doc, source, activations in _family_expressions():
        values = {
            motors()[code].parameter: share_at(code, character, amount)
            for code, amount in activations.items()
            if code in character.motors
        }
        found[name] = Preset(name, "expression", values, doc, source)
    for name, own in character.expressions.items():
        values = {motors()[code].parameter: value for code, value in own.items()}
        doc = found[name].doc if name in found else f"{name.capitalize()}, as {character.name} was drawn."
        found[name] = Preset(name, "expression", values, doc, OWN)
    return list(found.values())


def _gestures(character: Character) -> list[Preset]:
    """What its hand does: poses, and moves, which a picture shows at their first key."""
    presets = []
    for each in character.gestures:
        keys = tuple(
            (time_s, {motors()[code].parameter: value for code, value in values.items()})
            for time_s, values in each.keys
        )
        kind, moves = ("move", keys) if len(keys) > 1 else ("hand", ())
        presets.append(Preset(each.name, kind, keys[0][1], each.doc, each.source, moves))
    return presets


def _palettes(character: Character) -> list[Preset]:
    """The character's palettes; ``own`` is the one it is drawn in."""
    variants = {"own": character.palette, **character.palettes} if character.palettes else {}
    presets = []
    for name, variant in variants.items():
        colors = {**character.palette, **variant}
        values = {
            f"palette.{entry}.{channel}": value
            for entry, code in colors.items()
            for channel, value in zip(("red", "green", "blue"), linear_color(code), strict=True)
        }
        presets.append(Preset(name, "palette", values, f"All colours of {character.name} in {name}.", OWN))
    return presets


def share_at(code: str, character: Character, amount: float) -> float:
    """P_ctrl or degrees of a motor at an activation, -1..1."""
    limits = character.motors[code]
    if motors()[code].unit == "deg":
        return amount * (limits.high_deg if amount > 0.0 else -limits.low_deg)
    if motors()[code].unit == "signed":
        return amount
    rest = resting_share(code, limits)
    return rest + amount * ((1.0 - rest) if amount > 0.0 else rest)
