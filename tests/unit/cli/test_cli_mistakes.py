"""Every mistake of the user's: status 2, a few lines on standard error, nothing written, nothing long begun."""

from __future__ import annotations

from pathlib import Path

import pytest

from mien.cli import main

SPEC = "jaw.rotation 0 3 0 8 cosine\n"

MISTAKES = {
    "empty text": (["say", "", "-o", "a.mp4"], "is empty"),
    "text of blanks": (["say", " \n ", "-o", "a.mp4"], "is empty"),
    "text file missing": (["say", "@none.txt", "-o", "a.mp4"], "none.txt: cannot be read"),
    "unknown face": (["say", "Hello", "--face", "haed", "-o", "a.mp4"], "did you mean 'head'"),
    "unknown face to render": (["render", "haed", "-o", "a.png"], "did you mean 'head'"),
    "face file missing": (["render", "x.face.json", "-o", "a.png"], "no such file"),
    "unknown voice": (["say", "Hello", "--voice", "hibaro", "-o", "a.mp4"], "unknown voice 'hibaro'"),
    "unknown emotion": (["say", "Hello", "--emotion", "smyle", "-o", "a.mp4"], "did you mean 'smile'"),
    "unknown style": (["say", "Hello", "--style", "blink=off", "-o", "a.mp4"], "did you mean 'blinks'"),
    "style out of range": (["say", "Hello", "--style", "head=3", "-o", "a.mp4"], "from 0 (off) to 2"),
    "unknown preset": (["render", "head", "--preset", "smyle", "-o", "a.png"], "did you mean 'smile'"),
    "unknown parameter": (["render", "head", "--set", "jaw.rotaton=8", "-o", "a.png"], "did you mean 'jaw.rotation'"),
    "value out of range": (["render", "head", "--set", "jaw.rotation=80", "-o", "a.png"], "from 0 to 20 deg"),
    "value NaN": (["render", "head", "--set", "jaw.rotation=nan", "-o", "a.png"], "not a finite number"),
    "value infinite": (["say", "Hello", "--set", "jaw.rotation=inf", "-o", "a.mp4"], "not a finite number"),
    "value no number": (["render", "head", "--set", "jaw.rotation=x", "-o", "a.png"], "'x' is not a number"),
    "unknown suffix": (["say", "Hello", "-o", "a.mp5"], "did you mean '.mp4'"),
    "unknown picture": (["render", "head", "-o", "a.tiff"], "suffix of 'a.tiff'"),
    "no suffix for a picture": (["render", "head", "-o", "a"], "end it in one of .png, .jpg, .jpeg"),
    "endless name": (["say", "Hello", "-o", "a" * 300 + ".mp4"], "give a shorter one"),
    "endless name of a picture": (["render", "head", "-o", "a" * 300 + ".png"], "give a shorter one"),
    "endless name of a face": (["render", "a" * 300 + ".face.json", "-o", "a.png"], "give a shorter one"),
    "endless name of a timeline": (["play", "a" * 300 + ".json", "--commands"], "cannot be read"),
    "standard output": (["say", "Hello", "-o", "-"], "nothing is written to standard output"),
    "one picture for many frames": (["say", "Hello", "-o", "a.png"], "a_%04d.png"),
    "folder missing": (["say", "Hello", "-o", "nowhere/a.mp4"], "mkdir -p nowhere"),
    "folder with a blank missing": (["say", "Hello", "-o", "no where/a.mp4"], "mkdir -p 'no where'"),
    "folder missing for a picture": (["render", "head", "-o", "nowhere/a.png"], "mkdir -p nowhere"),
    "file in its place": (["say", "Hello", "-o", "list.spec/a.mp4"], "is a file, not a folder"),
    "folder closed": (["render", "head", "-o", "/proc/a.png"], "cannot be written to"),
    "text file without a name": (["say", "@", "-o", "a.mp4"], "mien: @: cannot be read"),
    "folder of other things": (["say", "Hello", "-o", "."], "holds other things"),
    "rate too low": (["say", "Hello", "--fps", "0", "-o", "a.mp4"], "from 1 to 240"),
    "rate too high": (["say", "Hello", "--fps", "241", "-o", "a.mp4"], "from 1 to 240"),
    "rate NaN": (["play", "list.spec", "--fps", "nan", "-o", "a.mp4"], "from 1 to 240"),
    "rate no number": (["say", "Hello", "--fps", "fast", "-o", "a.mp4"], "--fps"),
    "rate of a broken fraction": (["say", "Hello", "--fps", "30000/", "-o", "a.mp4"], "as in --fps 29.97 or"),
    "rate by nothing": (["say", "Hello", "--fps", "24/0", "-o", "a.mp4"], "as in --fps 29.97 or"),
    "rate below nothing": (["play", "list.spec", "--fps", "-24/1", "-o", "a.mp4"], "from 1 to 240"),
    "rate too high for a GIF": (["say", "Hello", "--fps", "60", "-o", "a.gif"], "at most 50"),
    "huge film": (["say", "Hello", "--size", "16384", "-o", "a.mp4"], "try --size 5970x5970"),
    "wide WebP": (["say", "Hello", "--size", "16384x64", "-o", "a.webp"], "try --size 16383x63"),
    "no size": (["say", "Hello", "--size", "0", "-o", "a.mp4"], "1 to 16384"),
    "transparent film": (["say", "Hello", "--background", "transparent", "-o", "a.mp4"], "write .webm, .mov"),
    "subtitles of no kind": (["say", "Hello", "--subtitles", "brun", "-o", "a.mp4"], "did you mean 'burn'"),
    "subtitles of another suffix": (
        ["say", "Hello", "--subtitles", "a.txt", "-o", "a.mp4"],
        "did you mean '.vtt' or '.srt'",
    ),
    "subtitles nowhere": (["say", "Hello", "--subtitles", "no/a.srt", "-o", "a.mp4"], "mkdir -p no"),
    "subtitles of subtitles": (["say", "Hello", "--subtitles", "a.srt", "-o", "a.srt"], "asked for twice"),
    "subtitles in a sound": (["say", "Hello", "--subtitles", "burn", "-o", "a.wav"], "no pictures"),
    "subtitles in a stamp": (["say", "Hello", "--subtitles", "burn", "--size", "64", "-o", "a.mp4"], "--size 187x126"),
    "subtitles of nothing": (["play", "list.spec", "--commands", "--subtitles", "a.srt"], "name one with -o"),
    "subtitles of a nod": (["play", "list.spec", "--subtitles", "a.srt", "-o", "a.csv"], "no word is said"),
    "subtitles of a silent list": (["play", "list.spec", "-o", "a.vtt"], "no word is said"),
    "variable frames": (["say", "Hello", "--variable", "-o", "frames"], "only the pictures of a film"),
    "no such size": (["render", "head", "--size", "big", "-o", "a.png"], "--size 1024"),
    "size too large": (["render", "head", "--size", "20000", "-o", "a.png"], "1 to 16384"),
    "unknown view": (["render", "head", "--view", "frnt", "-o", "a.png"], "did you mean 'front'"),
    "unknown shading": (["render", "head", "--shading", "smoth", "-o", "a.png"], "did you mean 'smooth'"),
    "colour too strong": (["render", "head", "--background", "rgb(300,0,0)", "-o", "a.png"], "from 0 to 255"),
    "unknown colour": (["render", "head", "--background", "whit", "-o", "a.png"], "did you mean 'white'"),
    "no threads": (["render", "head", "--threads", "0", "-o", "a.png"], "1 to 256"),
    "timeline missing": (["play", "none.spec", "-o", "a.mp4"], "none.spec: cannot be read"),
    "timeline of no kind": (["play", "a.txt", "-o", "a.mp4"], "suffix of 'a.txt'"),
    "bad specification": (["play", "bad.spec", "-o", "a.mp4"], "bad.spec:2: "),
    "specification for another face": (["play", "beak.spec", "--commands"], "beak.spec:1: unknown parameter 'beak"),
    "nothing to do": (["play", "list.spec"], "give -o FILE"),
    "sound of a silent list": (["play", "list.spec", "-o", "a.wav"], "there is no sound"),
    "unknown plot": (["play", "list.spec", "--plot", "a.gif"], "suffix of 'a.gif'"),
    "unknown command": (["sya", "Hello"], "Did you mean 'say'"),
    "unknown option": (["say", "Hello", "--fast", "-o", "a.mp4"], "--fast"),
    "no output": (["say", "Hello"], "--out"),
    "no command": ([], "Usage"),
}


@pytest.fixture(autouse=True)
def _here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "list.spec").write_text(SPEC)
    (tmp_path / "bad.spec").write_text(SPEC + "jaw.rotation 0 3 0\n")
    (tmp_path / "beak.spec").write_text("beak.rotation 0 3 0 8 cosine\n")


@pytest.fixture(autouse=True)
def _no_long_work(monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(*arguments: object, **more: object) -> None:
        raise AssertionError("long work began before the mistake was found")

    monkeypatch.setattr("mien.speech.speak", fail)
    monkeypatch.setattr("mien.api.warmup", fail)


@pytest.mark.parametrize("case", MISTAKES)
def test_a_mistake_is_told_and_nothing_written(case: str, capfd: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    arguments, message = MISTAKES[case]
    before = sorted(item.name for item in tmp_path.iterdir())
    assert main(arguments) == 2
    out, err = capfd.readouterr()
    text = err if arguments else out + err
    assert message in text
    assert "Traceback" not in text
    assert len(err.splitlines()) <= (4 if arguments else 40)
    assert sorted(item.name for item in tmp_path.iterdir()) == before


def test_an_existing_file_survives_a_mistake(tmp_path: Path) -> None:
    (tmp_path / "a.png").write_text("old")
    assert main(["render", "head", "--set", "jaw.rotation=80", "-o", "a.png"]) == 2
    assert (tmp_path / "a.png").read_text() == "old"


def test_a_fault_of_ours_says_where_to_report_it(
    monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    def fail() -> None:
        raise ZeroDivisionError("oh")

    monkeypatch.setattr("mien.api.face_names", fail)
    assert main(["faces"]) == 1
    err = capfd.readouterr().err
    assert "ZeroDivisionError: oh" in err
    assert "report" in err
    assert "Traceback" not in err
    monkeypatch.setenv("MIEN_DEBUG", "1")
    assert main(["faces"]) == 1
    assert "Traceback" in capfd.readouterr().err


def test_full_temporary_storage_is_the_users_to_mend(
    monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    def fail() -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("mien.api.face_names", fail)
    assert main(["faces"]) == 2
    assert "disk is full" in capfd.readouterr().err


def test_too_little_memory_is_no_fault(monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]) -> None:
    def fail() -> None:
        raise MemoryError

    monkeypatch.setattr("mien.api.face_names", fail)
    assert main(["faces"]) == 2
    assert "a smaller --size needs less" in capfd.readouterr().err
