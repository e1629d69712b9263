"""The shortest program: a sentence in, a film out."""

# mien: docs = text, test = run
import sys

import mien


def main(out: str = "hello.mp4") -> None:
    mien.say("Hello there.", scene=mien.Scene(size_px=(160, 160)).seen("three-quarter")).write(out)


if __name__ == "__main__":
    main(*sys.argv[1:])
