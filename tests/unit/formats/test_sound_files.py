"""Sound of files of many kinds, and of broken ones."""

from __future__ import annotations

import gc
import struct
import wave
from fractions import Fraction
from pathlib import Path

import av
import numpy as np
import pytest

from mien.core import LoadError, Sound, sound_store
from mien.formats.sound_files import read_sound
from mien.formats.wav import write_wav

LENGTH_S = 2.0
BEGIN_S = 0.5
"""Where the tone begins; silence comes before it."""

KINDS = [
    ("a.wav", "pcm_s16le", 44100, "stereo"),
    ("a.wav", "pcm_f32le", 8000, "mono"),
    ("a.wav", "pcm_s24le", 96000, "stereo"),
    ("a.mp3", "libmp3lame", 44100, "stereo"),
    ("a.ogg", "libopus", 48000, "mono"),
    ("a.flac", "flac", 96000, "stereo"),
    ("a.m4a", "aac", 22050, "mono"),
]


def tone(rate_hz: int) -> np.ndarray:
    time = np.arange(round(LENGTH_S * rate_hz)) / rate_hz
    return np.rint(8000 * np.sin(2 * np.pi * 440 * time) * (time >= BEGIN_S)).astype(np.int16)


def write(path: Path, codec: str, rate_hz: int, layout: str, *, picture: bool = False) -> Path:
    """A file with a tone, by FFmpeg."""
    with av.open(str(path), "w") as container:
        stream = container.add_stream(codec, rate=rate_hz, layout=layout)
        if picture:
            film = container.add_stream("libx264", rate=Fraction(10), options={"preset": "ultrafast"})
            film.width = film.height = 16
            film.pix_fmt = "yuv420p"
            for _ in range(20):
                container.mux(film.encode(av.VideoFrame(16, 16, "yuv420p")))
            container.mux(film.encode(None))
        samples = np.repeat(tone(rate_hz), 2 if layout == "stereo" else 1)
        frame = av.AudioFrame.from_ndarray(samples[None], format="s16", layout=layout)
        frame.sample_rate = rate_hz
        container.mux(stream.encode(frame))
        container.mux(stream.encode(None))
    return path


def begin_s(sound: Sound) -> float:
    return float(np.flatnonzero(np.abs(sound.samples.astype(int)) > 2000)[0]) / sound.rate_hz


@pytest.mark.parametrize(("name", "codec", "rate_hz", "layout"), KINDS)
def test_sound_of_every_kind_is_read_at_its_time(name: str, codec: str, rate_hz: int, layout: str, tmp_path: Path):
    sound = read_sound(write(tmp_path / name, codec, rate_hz, layout))
    assert sound.rate_hz == min(rate_hz, 48000)
    assert sound.length_s == pytest.approx(LENGTH_S, abs=0.1)
    assert begin_s(sound) == pytest.approx(BEGIN_S, abs=0.05)
    assert 7500 < np.abs(sound.samples.astype(int)).max() < 9000


def test_the_sound_of_a_film_is_read(tmp_path: Path):
    sound = read_sound(write(tmp_path / "a.mp4", "aac", 48000, "mono", picture=True))
    assert begin_s(sound) == pytest.approx(BEGIN_S, abs=0.03)


def test_what_was_written_is_read_again(tmp_path: Path):
    sound = Sound(tone(24000), 24000)
    write_wav(sound, tmp_path / "a.wav")
    np.testing.assert_array_equal(read_sound(tmp_path / "a.wav").samples, sound.samples)


def test_channels_become_their_mean(tmp_path: Path):
    both = np.stack([np.full(8000, 4000), np.full(8000, 2000)], axis=1).astype("<i2")
    with wave.open(str(tmp_path / "a.wav"), "wb") as file:
        file.setparams((2, 2, 8000, 0, "NONE", ""))
        file.writeframes(both.tobytes())
    assert set(read_sound(tmp_path / "a.wav").samples.tolist()) == {3000}


def test_long_sound_is_a_map_of_a_file_that_goes_with_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    path = write(tmp_path / "a.wav", "pcm_s16le", 16000, "mono")
    short = read_sound(path)
    monkeypatch.setattr(sound_store, "LONGEST_IN_MEMORY_S", 0.5)
    (tmp_path / "store").mkdir()
    long = read_sound(path, folder=tmp_path / "store")
    assert isinstance(long.samples, np.memmap)
    np.testing.assert_array_equal(long.samples, short.samples)
    gc.collect()
    assert list((tmp_path / "store").iterdir()) == []


def test_progress_is_told_in_seconds(tmp_path: Path):
    seen: list[tuple[int, int]] = []
    read_sound(write(tmp_path / "a.flac", "flac", 16000, "mono"), report=lambda *step: seen.append(step))
    assert seen[-1] == (2, 2)


@pytest.mark.parametrize("name", ["a.wav", "a.flac", "a.mp3"])
def test_a_file_that_is_cut_off_is_refused_with_the_place(name: str, tmp_path: Path):
    codec = {"a.wav": "pcm_s16le", "a.flac": "flac", "a.mp3": "libmp3lame"}[name]
    path = write(tmp_path / name, codec, 16000, "mono")
    path.write_bytes(path.read_bytes()[: path.stat().st_size // 2])
    with pytest.raises(LoadError, match=rf"{name}: ends after [01]\.\d+ s and says it lasts 2\.\d+ s — it is cut off"):
        read_sound(path)


@pytest.mark.parametrize("content", [b"RIFF", b"hello, this is text " * 20, bytes(5000)])
def test_what_is_no_sound_is_refused(content: bytes, tmp_path: Path):
    (tmp_path / "a.wav").write_bytes(content)
    with pytest.raises(LoadError, match=r"a\.wav: is no sound that can be read, or is cut off"):
        read_sound(tmp_path / "a.wav")


def test_an_empty_file_is_refused(tmp_path: Path):
    (tmp_path / "a.wav").write_bytes(b"")
    with pytest.raises(LoadError, match=r"a\.wav: is empty: 0 bytes"):
        read_sound(tmp_path / "a.wav")


def test_a_wav_file_without_samples_is_refused(tmp_path: Path):
    write_wav(Sound.silence(0.0), tmp_path / "a.wav")
    with pytest.raises(LoadError, match=r"a\.wav: "):
        read_sound(tmp_path / "a.wav")


def test_a_missing_file_is_refused(tmp_path: Path):
    with pytest.raises(LoadError, match=r"a\.wav: cannot be read \(No such file"):
        read_sound(tmp_path / "a.wav")


def test_a_folder_is_refused(tmp_path: Path):
    with pytest.raises(LoadError, match="cannot be read"):
        read_sound(tmp_path)


def test_a_film_without_sound_is_refused(tmp_path: Path):
    with av.open(str(tmp_path / "a.mp4"), "w") as container:
        film = container.add_stream("libx264", rate=Fraction(10))
        film.width = film.height = 16
        film.pix_fmt = "yuv420p"
        container.mux(film.encode(av.VideoFrame(16, 16, "yuv420p")))
        container.mux(film.encode(None))
    with pytest.raises(LoadError, match=r"a\.mp4: holds no sound"):
        read_sound(tmp_path / "a.mp4")


@pytest.mark.parametrize("bad", [np.nan, np.inf])
def test_samples_that_are_no_numbers_are_refused_with_their_time(bad: float, tmp_path: Path):
    samples = np.zeros(16000, "<f4")
    samples[12000] = bad
    header = struct.pack("<4sI4s4sIHHIIHH4sI", b"RIFF", 36 + 64000, b"WAVE", b"fmt ", 16, 3, 1, 16000, 64000, 4, 32,
                         b"data", 64000)  # fmt: skip
    (tmp_path / "a.wav").write_bytes(header + samples.tobytes())
    with pytest.raises(LoadError, match=r"a\.wav: has samples that are no numbers \(NaN or infinite\) at 0\.[67]\d s"):
        read_sound(tmp_path / "a.wav")


def test_too_few_samples_a_second_are_refused(tmp_path: Path):
    write_wav(Sound(np.ones(400, np.int16), 4000), tmp_path / "a.wav")
    with pytest.raises(LoadError, match="want 8000 samples a second or more, got 4000"):
        read_sound(tmp_path / "a.wav")
