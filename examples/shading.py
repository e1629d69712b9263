"""One face four ways: wireframe, flat polygons and Gouraud's shading of the measured surface, and subdivided skin."""

# mien: docs = picture, test = compare
import sys

import mien

WAYS = (
    ("wireframe", 0, "wire"),
    ("polygons", 0, "polygon"),
    ("Gouraud", 0, "smooth"),
    ("subdivided", 2, "smooth"),
)


def main(out: str = "shading.jpg") -> None:
    pictures = [
        mien.draw(
            "head:ben",
            {"mouth.expression": 0.5},
            mien.Scene(size_px=(340, 400), subdivide=subdivide, shading=shading).seen("three-quarter"),
        )
        for _, subdivide, shading in WAYS
    ]
    mien.contact_sheet(pictures, 4, [name for name, *_ in WAYS]).write(out)


if __name__ == "__main__":
    main(*sys.argv[1:])
