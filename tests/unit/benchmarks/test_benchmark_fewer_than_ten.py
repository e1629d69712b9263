"""The experiment on Parke's few parameters finds what it is given, and sees shut and tucked lips."""

from pathlib import Path

import numpy as np
import pytest

from mien.core import Cue

pytest.importorskip("scipy")
BENCHMARKS = Path(__file__).parents[3] / "benchmarks"
PHONES = "SIL:200 M:80 AA1:150 V:80 IY1:120 B:80 UW1:150 SIL:300"


@pytest.fixture
def ten(monkeypatch):
    monkeypatch.syspath_prepend(str(BENCHMARKS))
    import fewer_than_ten

    return fewer_than_ten


def phones():
    out, time = [], 0.0
    for word in PHONES.split():
        symbol, length = word.split(":")
        out.append(Cue(time, time + int(length) / 1000.0, symbol))
        time = out[-1].end_s
    return tuple(out)


def test_a_pose_of_the_same_parameters_is_found_again(ten):
    stage = ten.Stage()
    names = ("jaw.rotation", "mouth.width", "mouth.offset")
    wanted = {"jaw.rotation": 4.0, "mouth.width": 0.8, "mouth.offset": 6.0}
    points = stage.look([stage.head.neutral.replace(wanted).values]).points
    (found,) = stage.fit(points, names)
    table = stage.head.parameters
    for name, value in wanted.items():
        assert found[table.index[name]] == pytest.approx(value, rel=0.15)


def test_the_table_tells_what_a_few_parameters_can(ten):
    lines = ten.table(phones()).splitlines()[2:]
    cells = {line.split(" | ")[0].removeprefix("| "): line.removesuffix(" |").split(" | ")[1:] for line in lines}
    assert cells["all that speech moves: 13"][:5] == ["0.0 mm", "r 1.00", "r 1.00", "100 %", "100 %"]
    his = cells["figure 5.1: 4"]
    assert float(his[0].removesuffix(" mm")) > 1.0
    assert float(his[1].removeprefix("r ")) > 0.9
    without_jaw = cells["without `jaw.rotation`"][1].removeprefix("r ")
    assert without_jaw == "still" or float(without_jaw) < 0.5
    assert np.all([len(row) == 6 for row in cells.values()])
