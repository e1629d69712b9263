"""The main job with the real head and the real voice: a sentence in, a talking head out."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path

import av
import numpy as np
import pytest
from PIL import Image

from mien.cli import main

SMALL = ["--size", "96", "--subdivide", "0", "--threads", "1"]


def say(*arguments: str) -> None:
    assert main(["say", *arguments, *SMALL, "--quiet"]) == 0


def streams(path: Path) -> tuple[np.ndarray, np.ndarray, list[float]]:
    """Frames (N, H, W, 3), samples (M,) and the lengths of both streams, s."""
    with av.open(str(path)) as film:
        assert [stream.type for stream in film.streams] == ["video", "audio"]
        lengths = [float(stream.duration * stream.time_base) for stream in film.streams]
        frames = np.stack([frame.to_ndarray(format="rgb24") for frame in film.decode(video=0)])
    with av.open(str(path)) as film:
        samples = np.concatenate([frame.to_ndarray()[0] for frame in film.decode(audio=0)])
    return frames, samples, lengths


@pytest.fixture(scope="module")
def hello(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("say") / "hello.mp4"
    say("Hello there, my baby.", "-o", str(path))
    return path


def test_the_film_has_picture_and_sound_of_one_length(hello: Path) -> None:
    frames, samples, (picture_s, sound_s) = streams(hello)
    assert 1.0 < picture_s < 4.0
    assert abs(picture_s - sound_s) < 1.5 / 24
    assert len(frames) == round(picture_s * 24)
    assert len(samples) / 24000 == pytest.approx(sound_s, abs=0.05)


def test_it_is_heard(hello: Path) -> None:
    _, samples, _ = streams(hello)
    loudness = 20 * np.log10(np.sqrt(np.mean(samples**2)))
    assert -40 < loudness < -10
    assert np.abs(samples).max() <= 1.0


def test_the_mouth_moves_and_the_background_does_not(hello: Path) -> None:
    frames = streams(hello)[0].astype(int)
    steps = np.abs(np.diff(frames, axis=0)).max(axis=3)
    assert (steps.max(axis=(1, 2)) > 8).mean() > 0.5
    lower, corner = steps[:, 48:80, 24:72], steps[:, :12, :12]
    assert lower.max() > 40
    assert corner.max() <= 4


def test_it_says_that_it_is_synthetic(hello: Path) -> None:
    with av.open(str(hello)) as film:
        assert film.metadata["title"] == "Hello there, my baby."
        assert film.metadata["face"] == "head"
        assert "Synthetic" in film.metadata["description"]


def test_a_stored_timeline_gives_the_same_frames_bit_for_bit(tmp_path: Path) -> None:
    settings = ["--fps", "30", "--seed", "7", "--emotion", "smile", "--set", "head.turn=5", "--view", "front"]
    say("Go.", *settings, "-o", str(tmp_path / "a.json"))
    say("Go.", *settings, "-o", str(tmp_path / "said"))
    assert main(["play", str(tmp_path / "a.json"), "-o", str(tmp_path / "played"), "-q"]) == 0
    said, played = (sorted((tmp_path / name).glob("*.png")) for name in ("said", "played"))
    assert [path.name for path in said] == [path.name for path in played]
    assert len(said) > 10
    for mine, theirs in zip(said, played, strict=True):
        with Image.open(mine) as one, Image.open(theirs) as other:
            np.testing.assert_array_equal(np.asarray(one), np.asarray(other))
    assert (tmp_path / "said" / "sound.wav").read_bytes() == (tmp_path / "a.wav").read_bytes()


def test_another_seed_moves_otherwise(tmp_path: Path) -> None:
    for seed in ("1", "2", "1"):
        say("Hello there, my baby.", "--seed", seed, "-o", str(tmp_path / f"{seed}.csv"))
    one, two = ((tmp_path / f"{seed}.csv").read_text() for seed in ("1", "2"))
    assert one != two


def test_a_puppet_is_the_same_said_or_played_again(tmp_path: Path) -> None:
    options = ["--subdivide", "0", "-q", "-o"]
    for name in ("said", "played"):
        (tmp_path / name).mkdir()
    saying = ["say", "Go.", "--seed", "5", "--preset", "sleepy"]
    assert main([*saying, *options, str(tmp_path / "said" / "a.glb")]) == 0
    assert main([*saying, *options, str(tmp_path / "a.json")]) == 0
    assert main(["play", str(tmp_path / "a.json"), *options, str(tmp_path / "played" / "a.glb")]) == 0
    for name in ("a.glb", "a.wav"):
        assert (tmp_path / "said" / name).read_bytes() == (tmp_path / "played" / name).read_bytes()


@pytest.mark.parametrize("fps", ["1", "240"])
def test_the_slowest_and_the_fastest_rate(tmp_path: Path, fps: str) -> None:
    assert main(["say", "Go.", "--fps", fps, "-o", str(tmp_path / "a.mp4"), "--size", "16", "--subdivide", "0"]) == 0
    frames, _, (picture_s, sound_s) = streams(tmp_path / "a.mp4")
    assert len(frames) == round(picture_s * float(fps))
    assert 0 <= picture_s - sound_s + 0.001 < 1 / float(fps) + 0.01


def test_what_cannot_be_spoken_is_said(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    assert main(["say", "Hello 😀 привет", "-o", str(tmp_path / "a.wav")]) == 0
    err = capfd.readouterr().err
    assert "not spoken" in err
    assert "😀" in err
    assert str(tmp_path / "a.wav") in err


def test_nothing_but_what_cannot_be_spoken_is_a_mistake(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    assert main(["say", "😀", "-o", str(tmp_path / "a.wav")]) == 2
    assert "cannot say 😀" in capfd.readouterr().err
    assert list(tmp_path.iterdir()) == []


def test_quiet_is_quiet(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    say("Go.", "-o", str(tmp_path / "a.json"))
    assert capfd.readouterr() == ("", "")


@pytest.mark.parametrize("name", ["a.wav", "a.srt", "a.vtt"])
def test_what_is_heard_alone_moves_no_face(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str) -> None:
    monkeypatch.setattr("mien.api.perform", lambda *arguments, **more: pytest.fail("performed"))
    assert (
        main(["say", "Hello there, my baby.", "-o", str(tmp_path / name), "--subtitles", str(tmp_path / "b.srt")]) == 0
    )
    assert (tmp_path / "b.srt").read_text().endswith("\nHello there, my baby.\n\n")
    assert sorted(item.name for item in tmp_path.iterdir()) == sorted([name, "b.srt"])


def test_subtitles_come_in_the_picture_and_survive_in_a_timeline(tmp_path: Path) -> None:
    size = ["--size", "190x130", "--subdivide", "0", "--fps", "5"]
    assert main(["say", "Hi, you!", "--subtitles", str(tmp_path / "a.vtt"), "-o", str(tmp_path / "a.json"), "-q"]) == 0
    for name, more in (("plain", []), ("burned", ["--subtitles", "burn"])):
        assert main(["play", str(tmp_path / "a.json"), *size, *more, "-o", str(tmp_path / name), "-q"]) == 0
    assert main(["play", str(tmp_path / "a.json"), "-o", str(tmp_path / "b.vtt"), "-q"]) == 0
    assert (tmp_path / "a.vtt").read_bytes() == (tmp_path / "b.vtt").read_bytes()
    with (
        Image.open(tmp_path / "plain" / "frame_0002.png") as one,
        Image.open(tmp_path / "burned" / "frame_0002.png") as two,
    ):
        plain, burned = np.asarray(one), np.asarray(two)
    rows = np.flatnonzero((plain != burned).any(axis=(1, 2)))
    assert 0.75 * 130 < rows.min() < rows.max() < 0.96 * 130


@pytest.mark.parametrize("fps", ["23.976", "24000/1001"])
def test_a_rate_of_television_is_exact(tmp_path: Path, fps: str) -> None:
    out = tmp_path / "a.mp4"
    assert main(["say", "Go.", "--fps", fps, "-o", str(out), "--size", "17x15", "--subdivide", "0", "-q"]) == 0
    with av.open(str(out)) as film:
        assert film.streams.video[0].average_rate == Fraction(24000, 1001)
        times = [frame.pts * frame.time_base for frame in film.decode(video=0)]
    assert times == [Fraction(1001 * frame, 24000) for frame in range(len(times))]


def test_a_still_film_of_variable_rate_is_one_picture_for_all_its_time(tmp_path: Path) -> None:
    (tmp_path / "a.spec").write_text("fps 30\nlength 90\njaw.rotation 30 30 0 8 linear\n")
    out = tmp_path / "a.mp4"
    size = ["--size", "32", "--subdivide", "0", "-q"]
    assert main(["play", str(tmp_path / "a.spec"), "--variable", *size, "-o", str(out)]) == 0
    with av.open(str(out)) as film:
        packets = [(p.pts * p.time_base, p.duration * p.time_base) for p in film.demux(video=0) if p.pts is not None]
    assert packets == [(0, 1), (1, 2)]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("Go. [smiel] Now.", "mien: unknown mark in line 1, column 5: 'smiel' — did you mean 'smile'"),
        ("Go <break tiem='1s'/>.", "mien: unknown attribute of <break> in line 1, column 4: 'tiem'"),
        ("Go [smile", "mien: line 1, column 4: '[' begins a mark"),
    ],
)
def test_a_mistake_in_a_mark_is_told_before_anything_is_said(
    tmp_path: Path, capfd: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, text: str, message: str
) -> None:
    monkeypatch.setattr("mien.api.speak", lambda *arguments, **more: pytest.fail("spoke"))
    assert main(["say", text, "-o", str(tmp_path / "a.mp4")]) == 2
    assert capfd.readouterr().err.startswith(message)
    assert list(tmp_path.iterdir()) == []


def test_subtitles_and_titles_show_no_marks(tmp_path: Path) -> None:
    text = "Hello [smile] *there*, <break time='300ms'/> my [look left] baby."
    assert main(["say", text, "-o", str(tmp_path / "a.srt"), "-q"]) == 0
    assert (tmp_path / "a.srt").read_text().endswith("\nHello there, my baby.\n\n")
    say(text, "-o", str(tmp_path / "a.mp4"), "--size", "16", "--fps", "2")
    with av.open(str(tmp_path / "a.mp4")) as film:
        assert film.metadata["title"] == "Hello there, my baby."


def test_a_film_without_sound_says_so(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    size = ["--size", "16", "--subdivide", "0", "--fps", "2"]
    assert main(["say", "Go.", *size, "-o", str(tmp_path / "a.gif")]) == 0
    assert "without sound" in capfd.readouterr().err


def test_the_seed_is_told_in_the_film(tmp_path: Path) -> None:
    size = ["--size", "16", "--subdivide", "0", "--fps", "2", "-q"]
    for name in ("a.mp4", "a.webm"):
        assert main(["say", "Go.", *size, "--seed", "41", "-o", str(tmp_path / name)]) == 0
        with av.open(str(tmp_path / name)) as film:
            assert {key.lower(): value for key, value in film.metadata.items()}["seed"] == "41"
