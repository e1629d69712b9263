"""Colours of SVG files; a gradient is the mean of its colours.

Source: CSS Color Module Level 4, W3C, sections 5 to 7; SVG 1.1, chapter 13.
"""

from __future__ import annotations

import colorsys
import re
from collections.abc import Callable, Mapping
from itertools import pairwise

from .svg_reader_style import INITIAL, Rule, cascade
from .svg_reader_xml import Element, Remarks

Paint = tuple[float, float, float, float]
"""sRGB and alpha, 0..1."""

FUNCTION = re.compile(r"(rgba?|hsla?)\(([^()]*)\)", re.IGNORECASE)
REFERENCE = re.compile(r"url\(\s*['\"]?#([^)'\"]+?)['\"]?\s*\)\s*(.*)", re.IGNORECASE | re.DOTALL)

LONGEST_CHAIN = 20
"""Of gradients that take their colours from one another."""

GRADIENTS = ("linearGradient", "radialGradient")


def parse_color(text: str, current: str = "black") -> Paint | None:
    """A colour; None for ``none`` and ``transparent``.

    Raises:
        ValueError: it is no colour.
    """
    from PIL import ImageColor

    text = text.strip().lower()
    if text == "currentcolor":
        text = current.strip().lower()
    if text in ("none", "transparent"):
        return None
    if match := FUNCTION.fullmatch(text):
        return _from_function(match[1], match[2])
    red, green, blue, *alpha = ImageColor.getrgb(text)
    return (red / 255.0, green / 255.0, blue / 255.0, alpha[0] / 255.0 if alpha else 1.0)


def parse_share(text: str) -> float:
    """A number or a percentage, held in 0..1.

    Raises:
        ValueError: it is neither.
    """
    text = text.strip()
    share = float(text[:-1]) / 100.0 if text.endswith("%") else float(text)
    return min(max(share, 0.0), 1.0)


class Paints:
    """Finds the colours of paints, gradients among them."""

    def __init__(self, by_id: Mapping[str, Element], rules: list[Rule], remarks: Remarks) -> None:
        self._by_id, self._rules, self._remarks = by_id, rules, remarks
        self._means: dict[str, Paint | None] = {}

    def find(self, text: str, style: Mapping[str, str], line: int) -> Paint | None:
        """The colour of ``fill`` or ``stroke``; None where nothing is painted."""
        match = REFERENCE.fullmatch(text.strip())
        if match is None:
            return self._parse(text, style["color"], line)
        target = self._by_id.get(match[1])
        if target is not None and target.name in GRADIENTS:
            if match[1] not in self._means:
                self._means[match[1]] = self._mean(target)
                self._remarks.add(target.line, f"<{target.name}> {match[1]!r} becomes the mean of its colours")
            return self._means[match[1]]
        if target is not None and target.name == "solidColor":
            return self._parse(target.attributes.get("solid-color", "black"), "black", line)
        self._remarks.add(line, f"the paint {match[1]!r} is left out: it is no gradient of this file")
        return self._parse(match[2], style["color"], line) if match[2] else None

    def _parse(self, text: str, current: str, line: int) -> Paint | None:
        try:
            return parse_color(text, current)
        except ValueError:
            self._remarks.add(line, f"the colour {text[:40]!r} is unknown, black instead")
            return (0.0, 0.0, 0.0, 1.0)

    def _mean(self, gradient: Element) -> Paint | None:
        """The mean along a gradient, from its first colour at 0 to its last at 1; None without colours."""
        stops = self._stops(gradient)
        if not stops:
            return None
        stops = [(0.0, stops[0][1]), *stops, (1.0, stops[-1][1])]
        sums = [0.0] * 4
        for (start, first), (end, second) in pairwise(stops):
            for channel in range(4):
                sums[channel] += max(0.0, end - start) * (first[channel] + second[channel]) / 2.0
        red, green, blue, alpha = (round(value, 6) for value in sums)
        return (red, green, blue, alpha)

    def _stops(self, gradient: Element) -> list[tuple[float, Paint]]:
        """Offsets that never fall, with their colours; those of another gradient where it refers to one."""
        for _ in range(LONGEST_CHAIN):
            found: list[tuple[float, Paint]] = []
            for stop in (child for child in gradient.children if child.name == "stop"):
                style = cascade(stop, INITIAL, self._rules, self._remarks)
                color = self._parse(style["stop-color"], style["color"], stop.line) or (0.0, 0.0, 0.0, 0.0)
                alpha = self._number(parse_share, style["stop-opacity"], stop.line, 1.0)
                offset = self._number(parse_share, stop.attributes.get("offset", "0"), stop.line, 0.0)
                found.append((max([offset, *(place for place, _ in found[-1:])]), (*color[:3], color[3] * alpha)))
            if found:
                return found
            gradient = self._by_id.get(gradient.attributes.get("href", "").removeprefix("#"), gradient)
        return []

    def _number(self, parse: Callable[[str], float], text: str, line: int, otherwise: float) -> float:
        try:
            return parse(text)
        except ValueError:
            self._remarks.add(line, f"{text[:40]!r} is no number, {otherwise:g} instead")
            return otherwise


def _from_function(name: str, inside: str) -> Paint:
    words = inside.replace(",", " ").replace("/", " ").split()
    if len(words) not in (3, 4):
        raise ValueError(f"{name}({inside}) wants three numbers or four")
    alpha = parse_share(words[3]) if len(words) == 4 else 1.0
    if name.startswith("rgb"):
        red, green, blue = (
            parse_share(word) if word.endswith("%") else min(max(float(word) / 255.0, 0.0), 1.0) for word in words[:3]
        )
    else:
        turn = float(words[0].removesuffix("deg")) / 360.0
        saturation, lightness = (parse_share(word if word.endswith("%") else word + "%") for word in words[1:3])
        red, green, blue = colorsys.hls_to_rgb(turn % 1.0, lightness, saturation)
    return (red, green, blue, alpha)
