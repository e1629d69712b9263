"""WAV files, streamed and mapped."""

from __future__ import annotations

import wave
from pathlib import Path

import numpy as np
import pytest

from mien.core import LoadError, Sound
from mien.formats.wav import BLOCK, read_wav, write_wav


@pytest.mark.parametrize("count", [0, 1, BLOCK - 1, BLOCK, 2 * BLOCK + 3])
def test_every_sample_comes_back(tmp_path: Path, count: int) -> None:
    samples = np.random.default_rng(count).integers(-32768, 32768, count, dtype=np.int16)
    write_wav(Sound(samples, 22050), tmp_path / "a.wav")
    back = read_wav(tmp_path / "a.wav")
    assert back.rate_hz == 22050
    np.testing.assert_array_equal(back.samples, samples)


def test_other_programs_read_it(tmp_path: Path) -> None:
    write_wav(Sound(np.array([1, -2, 3], dtype=np.int16), 24000), tmp_path / "a.wav")
    with wave.open(str(tmp_path / "a.wav")) as file:
        assert (file.getnchannels(), file.getsampwidth(), file.getframerate(), file.getnframes()) == (1, 2, 24000, 3)


def test_the_sound_is_a_map_of_the_file_not_a_copy(tmp_path: Path) -> None:
    write_wav(Sound.silence(1.0), tmp_path / "a.wav")
    assert isinstance(read_wav(tmp_path / "a.wav").samples, np.memmap)


def test_a_block_between_header_and_samples_is_skipped(tmp_path: Path) -> None:
    write_wav(Sound(np.array([7, 8], dtype=np.int16), 24000), tmp_path / "a.wav")
    data = (tmp_path / "a.wav").read_bytes()
    (tmp_path / "b.wav").write_bytes(data[:36] + b"LIST\x03\x00\x00\x00abc\0" + data[36:])
    assert read_wav(tmp_path / "b.wav").samples.tolist() == [7, 8]


def test_what_is_no_mono_wav_is_refused(tmp_path: Path) -> None:
    write_wav(Sound.silence(0.1), tmp_path / "a.wav")
    data = (tmp_path / "a.wav").read_bytes()
    cases = {
        b"": "is no WAV file",
        b"hello there, this is text": "is no WAV file",
        data[:20]: "header",
        data[:36]: "without sound",
        data[:22] + b"\x02" + data[23:]: "2 channels",
    }
    for content, message in cases.items():
        (tmp_path / "b.wav").write_bytes(content)
        with pytest.raises(LoadError, match=message):
            read_wav(tmp_path / "b.wav")
    with pytest.raises(LoadError, match="cannot be read"):
        read_wav(tmp_path / "none.wav")
