"""The benchmark of measured lips, on a made-up recording: "we move a Bee", drawn by hand as keys."""

from pathlib import Path

import numpy as np
import pytest

from mien.core import Cue, LoadError
from mien.formats.cue_files import read_cue_file, write_cue_file
from mien.formats.cue_sheet import CueSheet
from mien.perform import cues_for_speech

BENCHMARKS = Path(__file__).parents[3] / "benchmarks"
PHONES = "SIL:200 W:80 IY1:140 M:80 UW1:160 V:80 AH0:90 B:80 AA1:180 M:90 SIL:300"
KEYS = {  # s and mm, as somebody might have moved
    "aperture": "0:0 .2:2 .26:3 .35:6 .42:1 .44:0 .48:0 .52:3 .6:4 .67:2 .72:2 .8:7 .85:2 .87:0 .92:0 .95:6 1.02:15 "
    "1.08:8 1.11:0 1.2:0 1.5:0",
    "width": "0:50 .15:44 .24:38 .35:54 .45:47 .6:37 .7:44 .8:49 .9:48 1.02:46 1.2:49 1.5:50",
    "jaw": "0:0 .2:1 .35:2 .45:2 .6:2 .7:2 .8:5 .9:4 1.03:12 1.15:4 1.3:0 1.5:0",
}


@pytest.fixture
def lips(monkeypatch):
    monkeypatch.syspath_prepend(str(BENCHMARKS))
    import lips

    return lips


@pytest.fixture
def recording(tmp_path):
    """Files of measured lips and of phones."""
    times = np.arange(0.0, 1.48, 0.02)
    columns = []
    for keys in KEYS.values():
        pairs = np.array([[float(number) for number in key.split(":")] for key in keys.split()])
        columns.append(np.interp(times, *pairs.T))
    rows = ["time,aperture,width,jaw"]
    rows += [",".join(f"{value:.3f}" for value in row) for row in zip(times, *columns, strict=True)]
    rows[5] = "0.08,,50.0,0"
    (tmp_path / "lips.csv").write_text("\n".join(rows) + "\n", encoding="utf-8")
    cues, time = [], 0.0
    for word in PHONES.split():
        symbol, length = word.split(":")
        cues.append(Cue(time, time + int(length) / 1000.0, symbol))
        time = cues[-1].end_s
    write_cue_file(CueSheet(time, {"phones": tuple(cues)}), tmp_path / "lips.TextGrid")
    return tmp_path / "lips.csv", tmp_path / "lips.TextGrid"


def test_every_column_is_likened_for_us_and_for_others(lips, recording):
    times, measured = lips.read_measured(recording[0])
    phones = cues_for_speech(read_cue_file(recording[1]))[1]
    lines = lips.table(times, measured, phones, lips.shapes_of(phones, "rhubarb")).splitlines()
    likeness = {line.split(" | ")[0].removeprefix("| "): [float(cell.split()[0]) for cell in line.split(" | ")[1:]]
                for line in lines[2:]}  # fmt: skip
    assert list(likeness) == ["mien", "steps", "Gaussian of 40 ms", "Rhubarb's shapes"]
    assert min(likeness["mien"]) > 0.75
    assert sum(likeness["mien"]) > max(sum(likeness[name]) for name in ("steps", "Rhubarb's shapes"))


def test_an_empty_cell_is_not_measured(lips, recording):
    _, measured = lips.read_measured(recording[0])
    assert np.flatnonzero(np.isnan(measured["aperture"])).tolist() == [4]
    assert not np.isnan(measured["width"]).any()


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("time,aperture,jaw\n", "lips.csv:1: has no column width"),
        ("time,aperture,width,jaw\n0,1,2,3\n.1,much,2,3\n", "lips.csv:3: aperture: 'much' is not a number"),
        ("time,aperture,width,jaw\n0,1,2,3\n,1,2,3\n", "lips.csv:3: time: '' is not a number"),
        ("time,aperture,width,jaw\n0,1,2,3\n.1,inf,2,3\n", "lips.csv:3: aperture: inf is not finite"),
        ("time,aperture,width,jaw\n0,1,2,3\n.1,1,2,3\n.1,1,2,3\n", "times rise"),
    ],
)
def test_what_cannot_be_read_is_refused(lips, tmp_path, text, message):
    path = tmp_path / "lips.csv"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(LoadError, match=message.replace("(", r"\(")):
        lips.read_measured(path)


def test_a_correlation_by_hand(lips):
    times = np.arange(0.0, 4.0, 0.5)
    wave = np.array([0.0, 1.0, 0.0, -1.0, 0.0, 1.0, 0.0, -1.0])
    r, low, high = lips.correlate(times, 3.0 + 2.0 * wave, wave)
    assert r == pytest.approx(1.0)
    assert lips.correlate(times, -wave, wave)[0] == pytest.approx(-1.0)
    assert low <= r + 1e-9 >= high - 1e-9
    assert np.isnan(lips.correlate(times, np.ones(8), wave)[0])


def test_a_gaussian_keeps_a_constant_and_the_sum_of_a_pulse(lips):
    assert lips.smooth(np.full(9, 0.4), 2.0) == pytest.approx(np.full(9, 0.4))
    pulse = np.zeros(41)
    pulse[20] = 1.0
    smoothed = lips.smooth(pulse, 3.0)
    assert smoothed.sum() == pytest.approx(1.0, abs=1e-4)
    assert smoothed[23] / smoothed[20] == pytest.approx(np.exp(-0.5))
