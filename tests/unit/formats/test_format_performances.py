"""One performance in every format, and back."""

from __future__ import annotations

import json
import re
from dataclasses import fields, replace
from pathlib import Path

import av
import numpy as np
import pytest
from PIL import Image
from small_face import SmallFace, SmallRenderer, opening_jaw

from mien.core import Light, LoadError, MienError, RangeError, Scene, UnknownNameError
from mien.formats import check_performance, write_performance
from mien.formats.performances import draw_frames
from mien.formats.scenes import FIELDS, LIGHT_FIELDS, scene_from_data, scene_to_data
from mien.formats.timeline_files import read_timeline
from mien.formats.wav import read_wav


@pytest.fixture(autouse=True)
def painted(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("mien.render.Renderer", SmallRenderer)


def load(address: str) -> SmallFace:
    return SmallFace(name=address)


def test_a_film_has_the_frames_and_the_sound(tmp_path: Path) -> None:
    done = []
    write_performance(opening_jaw(), tmp_path / "a.mp4", fps=12, report=lambda *numbers: done.append(numbers))
    with av.open(str(tmp_path / "a.mp4")) as film:
        reds = [frame.to_ndarray(format="rgb24")[:, :, 0].mean() for frame in film.decode(video=0)]
        assert [stream.type for stream in film.streams] == ["video", "audio"]
        assert film.metadata["title"] == "Ah"
    np.testing.assert_allclose(reds, 255 * np.arange(12) / 12, atol=5)
    assert done == [(number, 12) for number in range(1, 13)]


@pytest.mark.parametrize("name", ["frames", "f_%03d.png"])
def test_frames_as_pictures(tmp_path: Path, name: str) -> None:
    write_performance(opening_jaw(), tmp_path / name, fps=5)
    folder = tmp_path / name if name == "frames" else tmp_path
    reds = []
    for path in sorted(folder.glob("*.png")):
        with Image.open(path) as image:
            reds.append(image.getpixel((0, 0))[0])
            assert image.size == (32, 16)
    assert reds == [0, 51, 102, 153, 204]
    assert (folder / "sound.wav").exists() == (name == "frames")


def test_the_sound_alone(tmp_path: Path) -> None:
    performance = opening_jaw()
    write_performance(performance, tmp_path / "a.wav")
    np.testing.assert_array_equal(read_wav(tmp_path / "a.wav").samples, performance.sound.samples)
    with pytest.raises(MienError, match="there is no sound"):
        write_performance(opening_jaw(sound=False), tmp_path / "b.wav")


def test_json_plays_again_bit_for_bit(tmp_path: Path) -> None:
    performance = opening_jaw(0.7)
    scene = Scene(size_px=(20, 10)).turned(11.3, 4.7)
    write_performance(performance, tmp_path / "a.json", fps=23.976, scene=scene)
    stored = read_timeline(tmp_path / "a.json", load)
    assert stored.scene == scene
    assert stored.face.name == "small"
    assert stored.same_table
    assert (stored.timeline.fps, stored.timeline.seed, stored.timeline.title) == (24000 / 1001, 3, "Ah")
    np.testing.assert_array_equal(stored.sound.samples, performance.sound.samples)
    for mine, theirs in zip(
        draw_frames(performance.timeline, performance.face, scene, 23.976),
        draw_frames(stored.timeline, stored.face, stored.scene, stored.timeline.fps),
        strict=True,
    ):
        np.testing.assert_array_equal(mine, theirs)


def test_json_names_the_sound_beside_it(tmp_path: Path) -> None:
    write_performance(opening_jaw(), tmp_path / "a.json")
    assert json.loads((tmp_path / "a.json").read_text())["sound"] == "a.wav"
    (tmp_path / "a.wav").unlink()
    with pytest.raises(LoadError, match=r"a\.json: sound 'a\.wav': .*a\.wav: cannot be read"):
        read_timeline(tmp_path / "a.json", load)


def test_a_sound_outside_the_folder_is_not_fetched(tmp_path: Path) -> None:
    write_performance(opening_jaw(), tmp_path / "a.json")
    text = (tmp_path / "a.json").read_text().replace('"a.wav"', '"../a.wav"')
    (tmp_path / "a.json").write_text(text)
    with pytest.raises(LoadError, match="without folders"):
        read_timeline(tmp_path / "a.json", load)


def test_without_sound_there_is_no_wav_beside_it(tmp_path: Path) -> None:
    write_performance(opening_jaw(sound=False), tmp_path / "a.json")
    assert [item.name for item in tmp_path.iterdir()] == ["a.json"]
    assert read_timeline(tmp_path / "a.json", load).sound is None


def test_csv_gives_the_values_at_the_frames_back(tmp_path: Path) -> None:
    performance = opening_jaw()
    write_performance(performance, tmp_path / "a.csv", fps=10)
    stored = read_timeline(tmp_path / "a.csv", load)
    times = performance.timeline.frame_times(10)
    table = performance.face.parameters
    np.testing.assert_array_equal(stored.timeline.values(times, table), performance.timeline.values(times, table))


@pytest.mark.parametrize("name", ["a.json", "a.csv", "a.spec", "a.mp4"])
def test_a_file_that_is_no_timeline_is_refused_by_name(tmp_path: Path, name: str) -> None:
    for content in (b"hello", b"\xff\xfe\x00", b"", b"{}", b"[" * 100_000):
        (tmp_path / name).write_bytes(content)
        with pytest.raises(MienError, match=re.escape(name)):
            read_timeline(tmp_path / name, load)


def test_a_specification_list_complains_at_its_own_line(tmp_path: Path) -> None:
    (tmp_path / "a.spec").write_text("# a comment\njaw.rotation 0 10 0 99 cosine\n")
    with pytest.raises(LoadError, match=r"a.spec:2: jaw.rotation: 99 is out of range"):
        read_timeline(tmp_path / "a.spec", load)


def test_a_timeline_of_another_face_is_refused_by_name(tmp_path: Path) -> None:
    write_performance(opening_jaw(), tmp_path / "a.json")
    text = (tmp_path / "a.json").read_text().replace('"jaw.rotation"', '"beak.rotation"')
    (tmp_path / "a.json").write_text(text)
    with pytest.raises(LoadError, match=r"unknown parameter 'beak.rotation' — did you mean 'jaw.rotation'"):
        read_timeline(tmp_path / "a.json", load)


def test_a_face_that_changed_is_noticed(tmp_path: Path) -> None:
    write_performance(opening_jaw(), tmp_path / "a.json")
    text = (tmp_path / "a.json").read_text()
    (tmp_path / "a.json").write_text(re.sub(r'"table": "\w+"', '"table": "000000000000"', text))
    assert not read_timeline(tmp_path / "a.json", load).same_table


def test_every_field_of_a_scene_comes_back() -> None:
    scene = replace(Scene.parke(0.2, 3), target=(0.1, 0.2, 1 / 3), fov_deg=12.5, shading="wire", subdivide=1)
    for each in (scene, Scene()):
        assert scene_from_data(json.loads(json.dumps(scene_to_data(each))), "x") == each


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"fov": 3}, "did you mean 'fov_deg'"),
        ({"shading": "smoth"}, "did you mean 'smooth'"),
        ({"size_px": 3}, "size_px: want a list"),
        ({"size_px": [64, 64, 64]}, "size_px: want a list of 2"),
        ({"size_px": [64.5, 64]}, "whole number, got 64.5"),
        ({"at": ["a", 0, 0]}, r"at\[0\]: want a number"),
        ({"at": [0, 0]}, "at: want a list of 3"),
        ({"background": [1, 2, 3]}, "background: want a list of 2"),
        ({"background": [[0, 0, 0], [1, 1, 1]]}, r"background\[0\]: want a list of 4"),
        ({"lights": [{"position": [0, 0, 1]}]}, r"lights\[0\]: 'color' is missing"),
        ({"lights": [{"position": [0, 0, 1], "color": 5}]}, r"lights\[0\].color: want a list"),
        ({"lights": 4}, "lights: want a list"),
        ({"subdivide": 1.0}, "subdivide: want a whole number"),
        ({"fov_deg": "20"}, "fov_deg: want a number"),
        ({"fov_deg": 900}, "out of range"),
    ],
)
def test_a_scene_that_cannot_be_is_refused_with_its_place(change: dict, message: str) -> None:
    with pytest.raises(LoadError, match=f"x.json: scene.*{message}"):
        scene_from_data({**scene_to_data(Scene()), **change}, "x.json")


def test_every_field_of_a_scene_can_be_read() -> None:
    assert set(FIELDS) == {field.name for field in fields(Scene)}
    assert set(LIGHT_FIELDS) == {field.name for field in fields(Light)}


def test_an_unknown_face_in_a_file_is_refused_with_the_file(tmp_path: Path) -> None:
    write_performance(opening_jaw(), tmp_path / "a.json")

    def load_none(address: str) -> SmallFace:
        raise UnknownNameError("face", address, ["head"])

    with pytest.raises(LoadError, match=r"a\.json: face: unknown face .*--face"):
        read_timeline(tmp_path / "a.json", load_none)
    with pytest.raises(UnknownNameError):
        read_timeline(tmp_path / "a.json", load_none, "nobody")


@pytest.mark.parametrize(
    ("name", "settings", "error", "message"),
    [
        ("a.mp5", {}, UnknownNameError, "did you mean '.mp4'"),
        ("a.ogv", {}, UnknownNameError, "suffix of 'a.ogv'"),
        ("a.mp4", {"subtitles": "brun"}, UnknownNameError, "did you mean 'burn'"),
        ("a.mp4", {"subtitles": "a.txt"}, UnknownNameError, "suffix of 'a.txt'"),
        ("a.mp4", {"subtitles": "nowhere/a.srt"}, MienError, "does not exist"),
        ("a.wav", {"subtitles": "burn"}, MienError, "no pictures to draw subtitles into"),
        ("a.mp4", {"subtitles": "burn", "scene": Scene(size_px=(64, 64))}, RangeError, "could not be read"),
        ("frames", {"variable": True}, MienError, "only the pictures of a film"),
        ("a.gif", {"fps": 60}, RangeError, "at most 50"),
        ("a" * 300 + ".mp4", {}, MienError, "give a shorter one"),
        ("nowhere/a.mp4", {}, MienError, "does not exist"),
        ("a.png", {}, MienError, "a_%04d.png"),
        ("a.mp4", {"fps": 241}, RangeError, "from 1 to 240"),
        ("a.mp4", {"fps": float("nan")}, RangeError, "from 1 to 240"),
        ("a.mp4", {"fps": 0}, RangeError, "from 1 to 240"),
        ("frames", {"fps": 0.1}, RangeError, "from 1 to 240"),
        ("a.mp4", {"scene": Scene(size_px=(16384, 16384))}, RangeError, "try --size 5970x5970, or write PNG"),
        ("a.webp", {"scene": Scene(size_px=(16384, 1000))}, RangeError, "try --size 16383x999"),
        ("a.mp4", {"scene": Scene(background=((0, 0, 0, 0), (0, 0, 0, 0)))}, RangeError, "write .webm, .mov"),
    ],
)
def test_what_cannot_be_written_is_refused_before_work_begins(
    tmp_path: Path, name: str, settings: dict, error: type[Exception], message: str
) -> None:
    with pytest.raises(error, match=message):
        check_performance(tmp_path / name, **settings)
    with pytest.raises(error, match=message):
        write_performance(opening_jaw(), tmp_path / name, **settings)
    assert list(tmp_path.iterdir()) == []
