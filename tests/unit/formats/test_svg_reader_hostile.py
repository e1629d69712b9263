"""Drawings that would fetch, execute or grow: refused or left out with a word and the place."""

import gzip
import re
import socket
import time
from contextlib import suppress

import pytest

from mien.core import LoadError
from mien.formats.svg_reader import read_svg

HEAD = '<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" viewBox="0 0 9 9"'
SQUARE = '<rect width="5" height="5"/>'


@pytest.fixture(autouse=True)
def no_network(monkeypatch):
    def refuse(*arguments):
        raise AssertionError("a drawing opened a connection")

    monkeypatch.setattr(socket, "socket", refuse)


def write(tmp_path, content):
    path = tmp_path / "bad.svg"
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    return path


LAUGHS = '<!ENTITY l0 "lol">' + "".join(f'<!ENTITY l{n} "{f"&l{n - 1};" * 10}">\n' for n in range(1, 10))


@pytest.mark.parametrize(
    ("content", "wanted"),
    [
        (f'<?xml version="1.0"?>\n<!DOCTYPE svg [{LAUGHS}]>{HEAD}>&l9;</svg>', r"bad\.svg:2: the DOCTYPE"),
        (f'<!DOCTYPE svg [<!ENTITY f SYSTEM "file:///etc/passwd">]>{HEAD}>&f;</svg>', "the DOCTYPE holds declarations"),
        (f"{HEAD}><rect></svg>", r"bad\.svg:1: is no well-formed XML"),
        (f"{HEAD}>&nbsp;</svg>", "is no well-formed XML: undefined entity"),
        ("<html><svg/></html>", "is XML but no SVG"),
        ("", "is empty"),
        (gzip.compress(HEAD.encode(), mtime=0), "is compressed"),
        (b"\xff\xfe\x00\x00", "is no well-formed XML"),
        ('<?xml version="1.0" encoding="klingon"?><svg/>', "cannot be read|unknown encoding"),
        (f"{HEAD}>{'<g>' * 150}{'</g>' * 150}</svg>", "lie more than 100 deep"),
        (f"{HEAD}>{SQUARE * 30_000}</svg>", "has more than 20,000 elements"),
        (f'{HEAD}><g id="a"><use href="#a"/></g></svg>', r"<use> of '#a' leads back to itself"),
        (f'{HEAD}><rect width="1e999" height="5"/></svg>', "too large a number"),
        (f'{HEAD}><rect width="five" height="5"/></svg>', "width of <rect>: 'five' is no length"),
        (f'{HEAD}><rect transform="spin(5)" width="1" height="5"/></svg>', "cannot be understood"),
        (f'{HEAD}><text>face</text></svg>', "shows no shape.*<text> is left out"),
        (f"{HEAD} width='0'/>".replace("0 0 9 9", "0 0 0 9"), "the canvas is empty"),
    ],
)  # fmt: skip
def test_what_cannot_be_used_is_refused_with_a_word(tmp_path, content, wanted):
    with pytest.raises(LoadError, match=wanted):
        read_svg(write(tmp_path, content))


@pytest.mark.parametrize(
    ("inside", "wanted"),
    [
        ("<script>steal()</script>", "<script> is left out: nothing in a drawing is executed"),
        ('<rect onclick="steal()" width="1" height="1"/>', "onclick=… of <rect> is left out"),
        ('<image href="http://x.example/a.png" width="5" height="5"/>', "<image> is left out"),
        ('<use xlink:href="http://x.example/a.svg#b"/>', "nothing outside the file is fetched"),
        ('<use href="file:///etc/passwd#b"/>', "nothing outside the file is fetched"),
        ("<style>@import url(http://x.example/a.css);</style>", "@import of a style sheet is left out"),
        (
            '<rect width="1" height="1" fill="url(http://x.example/a.svg#g)"/>',
            r"url\(http://x.example/a.svg#g\) is left out",
        ),
        ('<rect width="1" height="1" style="behavior: url(evil.htc)"/>', r"url\(evil.htc\) is left out"),
        ('<animate attributeName="d"/>', "<animate> is left out: a face moves by its motors"),
        ("<foreignObject><b/></foreignObject>", "<foreignObject> is left out"),
        ("<style>g &gt; path { fill: red }</style>", "want a tag, .class or #id"),
    ],
)
def test_what_is_left_out_is_told(tmp_path, inside, wanted):
    drawing = read_svg(write(tmp_path, f"{HEAD}>{SQUARE}\n{inside}</svg>"))
    (remark,) = [text for text in drawing.remarks if "unknown" not in text and "the paint" not in text]
    assert "bad.svg:2: " in remark

    assert re.search(wanted, remark)


def test_a_doctype_without_declarations_is_not_fetched(tmp_path):
    doctype = '<!DOCTYPE svg PUBLIC "-//W3C//DTD SVG 1.1//EN" "http://www.w3.org/Graphics/SVG/1.1/DTD/svg11.dtd">'
    assert len(read_svg(write(tmp_path, f"{doctype}{HEAD}>{SQUARE}</svg>")).shapes) == 1


@pytest.mark.parametrize(
    "inside",
    [
        f'<path d="M0 0{"".join(f"L{number} {number % 7}" for number in range(100_001))}"/>',
        f'<polygon points="{"1,2 " * 100_001}"/>',
        "".join(f'<path d="M0 0{"h1v1" * 25_001}"/>' for _ in range(3)),
        '<defs><path id="p" d="M0 0' + "h1v1" * 500 + '"/></defs>' + '<use href="#p"/>' * 200,
        '<clipPath id="c"><path d="M0 0' + "h1v1" * 4_000 + f'"/></clipPath><g clip-path="url(#c)">{SQUARE * 50}</g>',
        '<defs><g id="g0"/>'
        + "".join(f'<g id="g{n}">{f"""<use href="#g{n - 1}"/>""" * 10}</g>' for n in range(1, 12))
        + '</defs><use href="#g11"/>',
    ],
    ids=["path", "polygon", "paths", "uses", "clips", "use of use"],
)
def test_a_hundred_thousand_points_are_refused_in_two_seconds(tmp_path, inside):
    path = write(tmp_path, f"{HEAD}>{inside}</svg>")
    start = time.process_time()
    with pytest.raises(LoadError, match=r"has more than 100,000 points|makes more than 20,000 elements"):
        read_svg(path)
    assert time.process_time() - start < 2.0


@pytest.mark.parametrize(
    "inside",
    [
        "<style>" + "@a{" * 30_000 + "</style>",
        "<style>" + "/*" * 50_000 + "</style>",
        "<style>" + "a" * 200_000 + "</style>",
        f'<rect width="1{" " * 100_000}x" height="1"/>',
        f'<rect fill="url(#{" " * 100_000}x" width="1" height="1"/>',
        f'<rect transform="scale(1){" " * 100_000}x" width="1" height="1"/>',
        f'<path d="{"1" * 200_000}"/>',
    ],
)
def test_nothing_takes_long_to_understand(tmp_path, inside):
    path = write(tmp_path, f"{HEAD}>{SQUARE}{inside}</svg>")
    start = time.process_time()
    with suppress(LoadError):
        read_svg(path)
    assert time.process_time() - start < 1.0


def test_a_file_that_is_too_large_is_not_parsed(tmp_path):
    path = write(tmp_path, f"{HEAD}>{SQUARE}</svg>")
    with path.open("ab") as file:
        file.truncate(17 << 20)
    with pytest.raises(LoadError, match="is larger than 16 MB"):
        read_svg(path)


def test_a_missing_file_is_named(tmp_path):
    with pytest.raises(LoadError, match=r"gone\.svg: cannot be read"):
        read_svg(tmp_path / "gone.svg")
