"""One face five ways: wireframe, flat polygons, Gouraud's shading, light on every pixel; and subdivided skin."""

# mien: docs = picture, test = compare
import sys

import mien

WAYS = (
    ("wireframe", 0, "wire"),
    ("polygons", 0, "polygon"),
    ("Gouraud", 0, "smooth"),
    ("every pixel", 0, "smooth+"),
    ("subdivided", 2, "smooth"),
)


def main(out: str = "shading.jpg") -> None:
    pictures = [
        mien.draw(
            "head:ben",
            {"mouth.expression": 0.5},
            mien.Scene(size_px=(300, 360), subdivide=subdivide, shading=shading).seen("three-quarter"),
        )
        for _, subdivide, shading in WAYS
    ]
    mien.contact_sheet(pictures, 5, [name for name, *_ in WAYS]).write(out)


if __name__ == "__main__":
    main(*sys.argv[1:])
