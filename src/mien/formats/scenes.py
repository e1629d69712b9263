"""A scene as plain data, for JSON: every field under its own name, so that it comes back bit for bit."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from typing import Any

from mien.core import Light, LoadError, MienError, Scene, UnknownNameError


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
        LoadError: a field is unknown or has a value that no scene can have.
    """
    known = [field.name for field in dataclasses.fields(Scene)]
    for name in data:
        if name not in known:
            raise LoadError(place, f"scene: {UnknownNameError('field', name, known)}")
    fields = {name: _frozen(value) for name, value in data.items()}
    try:
        fields["lights"] = tuple(Light(**{k: _frozen(v) for k, v in light.items()}) for light in data.get("lights", ()))
        return Scene(**fields)
    except MienError as error:
        raise LoadError(place, f"scene: {error}") from error
    except (TypeError, ValueError, AttributeError) as error:
        raise LoadError(place, f"scene: a field has the wrong shape ({error})") from error


def _lights(scene: Scene) -> list[dict[str, Any]]:
    return [
        {field.name: _plain(getattr(light, field.name)) for field in dataclasses.fields(Light)}
        for light in scene.lights
    ]


def _plain(value: Any) -> Any:
    return [_plain(item) for item in value] if isinstance(value, tuple) else value


def _frozen(value: Any) -> Any:
    return tuple(_frozen(item) for item in value) if isinstance(value, list) else value
