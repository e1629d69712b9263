"""How the elements of an SVG file are painted: attributes, style attributes, rules of style sheets, inheritance.

Source: Cascading Style Sheets 2.2, W3C, sections 4.1 and 6.4; SVG 1.1, chapter 6.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import islice

from .svg_reader_xml import Element, Remarks

INHERITED = {
    "color": "black",
    "fill": "black",
    "fill-opacity": "1",
    "fill-rule": "nonzero",
    "stroke": "none",
    "stroke-opacity": "1",
    "stroke-width": "1",
    "stroke-linecap": "butt",
    "stroke-dasharray": "none",
    "visibility": "visible",
}
"""Properties that what is inside takes over, with what they are at first."""

OWN = {
    "opacity": "1",
    "display": "inline",
    "clip-path": "none",
    "mask": "none",
    "filter": "none",
    "stop-color": "black",
    "stop-opacity": "1",
}
"""Properties of one element."""

INITIAL: Mapping[str, str] = {**INHERITED, **OWN}

MOST_RULES = 500
LONGEST_VALUE = 500

AT_RULE = re.compile(r"@([\w-]+)[^@{};]*(;|\{(?:[^@{}]|\{[^@{}]*\})*\})")
SELECTOR = re.compile(r"(\*|[\w-]+)?((?:[.#][\w-]+)*)")
ELSEWHERE = re.compile(r"url\(\s*['\"]?(?!#)\s*([^)'\"]*)", re.IGNORECASE)


@dataclass(frozen=True)
class Rule:
    """What a style sheet says of some elements.

    Attributes:
        tag: of the elements; empty for all.
        id: of the element; empty for any.
        classes: that they have.
        declarations: property and value.
    """

    tag: str
    id: str
    classes: frozenset[str]
    declarations: Mapping[str, str]

    @property
    def weight(self) -> tuple[int, int, int]:
        """The heavier rule wins: ids before classes before tags."""
        return (bool(self.id), len(self.classes), bool(self.tag))

    def meets(self, element: Element) -> bool:
        """Whether the element is one of those it speaks of."""
        attributes = element.attributes
        return (
            self.tag in ("", element.name)
            and self.id in ("", attributes.get("id", ""))
            and self.classes <= set(attributes.get("class", "").split())
        )


def read_rules(root: Element, remarks: Remarks) -> list[Rule]:
    """The rules of all style sheets in a file, the weightier later."""
    sheets = [element for element in root if element.name == "style"]
    found = (rule for sheet in sheets for rule in _parse_sheet("".join(sheet.texts), sheet.line, remarks))
    rules = list(islice(found, MOST_RULES + 1))
    if len(rules) > MOST_RULES:
        remarks.add(sheets[-1].line, f"of the rules of style sheets, those after the first {MOST_RULES} are left out")
    return sorted(rules[:MOST_RULES], key=lambda rule: rule.weight)


def cascade(element: Element, around: Mapping[str, str], rules: list[Rule], remarks: Remarks) -> dict[str, str]:
    """The values of all properties of an element in another whose values are ``around``."""
    given = {name: value for name, value in element.attributes.items() if name in INITIAL}
    for rule in rules:
        if rule.meets(element):
            given |= rule.declarations
    given |= _parse_declarations(element.attributes.get("style", ""), element.line, remarks)
    style = {name: around[name] if name in INHERITED else initial for name, initial in INITIAL.items()}
    for name, value in given.items():
        value = value[:LONGEST_VALUE].strip()
        _note_elsewhere(value, element.line, remarks)
        if value == "inherit":
            style[name] = around[name]
        elif value in ("initial", "unset", "revert"):
            style[name] = INITIAL[name]
        elif value:
            style[name] = value
    if style["color"].lower() == "currentcolor":
        style["color"] = around["color"]
    return style


def _parse_sheet(text: str, line: int, remarks: Remarks) -> Iterator[Rule]:
    text = _strip_comments(text)
    for match in AT_RULE.finditer(text):
        if match[1] != "charset":
            remarks.add(line, f"@{match[1]} of a style sheet is left out: nothing is fetched, and it is no simple rule")
    text = AT_RULE.sub("", text)
    for block in text.split("}")[:-1]:
        selectors, _, inside = block.partition("{")
        declarations = _parse_declarations(inside, line, remarks)
        for selector in selectors.split(","):
            simple = SELECTOR.fullmatch(selector.strip())
            if simple is None or not selector.strip():
                remarks.add(line, f"the rule for {selector.strip()!r} is left out: want a tag, .class or #id")
            elif declarations:
                names = re.findall(r"[.#][\w-]+", simple[2])
                ids = [name[1:] for name in names if name[0] == "#"]
                classes = frozenset(name[1:] for name in names if name[0] == ".")
                tag = "" if simple[1] in (None, "*") else simple[1]
                yield Rule(tag, ids[0] if ids else "", classes, declarations)


def _strip_comments(text: str) -> str:
    kept = []
    for piece in text.replace("<!--", "").replace("-->", "").split("*/"):
        kept.append(piece.partition("/*")[0])
    return "".join(kept)


def _parse_declarations(text: str, line: int, remarks: Remarks) -> dict[str, str]:
    found = {}
    for declaration in text.split(";"):
        name, colon, value = declaration.partition(":")
        name = name.strip().lower()
        if colon and name in INITIAL:
            found[name] = value.replace("!important", "").strip()
        elif colon:
            _note_elsewhere(value, line, remarks)
    return found


def _note_elsewhere(value: str, line: int, remarks: Remarks) -> None:
    if "(" in value and (match := ELSEWHERE.search(value)):
        remarks.add(line, f"url({match[1][:40].strip()}) is left out: nothing outside the file is fetched")
