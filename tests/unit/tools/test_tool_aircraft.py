"""The letter H and the aircraft: what lies in the examples is what the tool writes, and both are closed."""

import importlib.util
from collections import Counter
from pathlib import Path

from mien.faces.keypose.files import read_keypose
from mien.faces.keypose.records import edges_of

ROOT = Path(__file__).parents[3]
FOLDER = ROOT / "examples/keypose/aircraft.keypose"


def load_tool():
    spec = importlib.util.spec_from_file_location("aircraft", ROOT / "tools/aircraft.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_the_example_is_what_the_tool_writes(tmp_path):
    load_tool().main(tmp_path / "aircraft.keypose")
    for path in FOLDER.iterdir():
        assert (tmp_path / "aircraft.keypose" / path.name).read_text() == path.read_text()


def test_the_surface_has_no_hole():
    keypose = read_keypose(FOLDER)
    middle = set(keypose.topology.midline)
    edges = Counter(edge for polygon in keypose.topology.polygons for edge in edges_of(polygon.points))
    assert {tuple(edge) for edge, count in edges.items() if count != 2 and not edge <= middle} == set()
