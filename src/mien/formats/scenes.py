"""A scene as plain data, for JSON: every field under its own name, so that it comes back bit for bit."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Mapping
from typing import Any

from mien.core import Light, LoadError, MienError, Scene
from mien.timeline.json_reader import Node


def scene_to_data(scene: Scene) -> dict[str, Any]:
    """Every field of the scene, vectors as lists."""
    return {
        field.name: _plain(getattr(scene, field.name)) if field.name != "lights" else _lights(scene)
        for field in dataclasses.fields(Scene)
    }


def scene_from_data(data: Mapping[str, Any], place: str) -> Scene:
    """The scene that ``scene_to_data`` described; a field that is missing has its default.

    Args:
        data: fields by name.
        place: the file, for messages.

    Raises:
        LoadError: a field is unknown or has a value that no scene can have; names the field.
    """
    members = Node(dict(data), place, "scene").members((), tuple(FIELDS))
    fields = {name: FIELDS[name](node) for name, node in members.items()}
    try:
        return Scene(**fields)
    except MienError as error:
        raise LoadError(place, f"scene: {error}") from error


def _vector(node: Node) -> tuple[float, ...]:
    return tuple(item.number() for item in node.items(3))


def _size(node: Node) -> tuple[int, ...]:
    return tuple(item.integer() for item in node.items(2))


def _background(node: Node) -> tuple[tuple[float, ...], ...] | None:
    return (
        None
        if node.value is None
        else tuple(tuple(part.number() for part in color.items(4)) for color in node.items(2))
    )


def _ambient(node: Node) -> tuple[tuple[float, ...], ...]:
    return tuple(_vector(color) for color in node.items(2))


def _target(node: Node) -> tuple[float, ...] | None:
    return None if node.value is None else _vector(node)


def _read_lights(node: Node) -> tuple[Light, ...]:
    return tuple(
        Light(
            **{name: LIGHT_FIELDS[name](each) for name, each in light.members(("position", "color"), ("wrap",)).items()}
        )
        for light in node.items()
    )


LIGHT_FIELDS: Mapping[str, Callable[[Node], Any]] = {"position": _vector, "color": _vector, "wrap": Node.number}

FIELDS: Mapping[str, Callable[[Node], Any]] = {
    "position": _vector,
    "at": _vector,
    "fov_deg": Node.number,
    "size_px": _size,
    "background": _background,
    "lights": _read_lights,
    "ambient": _ambient,
    "cosine_power": Node.integer,
    "gloss": Node.number,
    "shading": Node.text,
    "subdivide": Node.integer,
    "target": _target,
}
"""How each field of a scene is read."""


def _lights(scene: Scene) -> list[dict[str, Any]]:
    return [
        {field.name: _plain(getattr(light, field.name)) for field in dataclasses.fields(Light)}
        for light in scene.lights
    ]


def _plain(value: Any) -> Any:
    return [_plain(item) for item in value] if isinstance(value, tuple) else value
