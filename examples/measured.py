"""Two people measured on photographs: each picture is a phase, or lies between some, as Parke's first faces did."""

# mien: docs = picture, test = compare
import mien

SHOWN = {
    "keypose:vera": ({}, {"phase.smile": 1.0}, {"phase.aei": 0.8}, {"phase.smile": 0.6, "phase.blink": 1.0}),
    "keypose:hugo": ({}, {"phase.surprised": 1.0}, {"phase.pucker": 1.0}, {"phase.smile": 0.9, "phase.open": 0.35}),
}
CAPTIONS = ("", "smile", "a, e, i", "smile and blink", "", "surprised", "pucker", "smile, mouth open")


def main(out: str = "measured.jpg") -> None:
    scene = mien.Scene(size_px=(320, 320)).seen("three-quarter")
    pictures = [mien.draw(face, values, scene) for face, poses in SHOWN.items() for values in poses]
    captions = [caption or face for caption, face in zip(CAPTIONS, [f for f in SHOWN for _ in range(4)], strict=True)]
    mien.contact_sheet(pictures, 4, captions).write(out)


if __name__ == "__main__":
    main()
