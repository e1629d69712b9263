"""The measured directions are what their tool makes, without a look at the people kept for testing."""

import importlib.util
from importlib.resources import files
from pathlib import Path

import numpy as np
import pytest

from mien.faces.head.arrays import parse_arrays

ROOT = Path(__file__).parents[2]
REFERENCE = ROOT.parent / "shared/reference"
FOR_TESTING = "ict_identities_dev"

pytestmark = pytest.mark.skipif(not REFERENCE.is_dir(), reason="the reference heads are not here")


@pytest.fixture(scope="module")
def tool():
    pytest.importorskip("scipy")
    spec = importlib.util.spec_from_file_location("measure_head", ROOT / "tools/measure_head.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_file_is_what_the_tool_makes(tool, monkeypatch):
    """No other file than those of the reference is read, and not that of the people kept for testing."""
    read, load = set(), np.load

    def watched(path, *args, **kwargs):
        read.add(Path(path).stem)
        assert FOR_TESTING not in str(path)
        return load(path, *args, **kwargs)

    monkeypatch.setattr(np, "load", watched)
    made = tool.measure(REFERENCE)
    assert read >= {"ict_identities_more", "mh_identities", "mh_expressions"}

    shipped = parse_arrays(files("mien.faces.head").joinpath("data/conformation.arrays").read_bytes())
    assert list(made) == list(shipped), "run python tools/measure_head.py ../shared/reference"
    for name, array in shipped.items():
        assert made[name].dtype == array.dtype
        if array.dtype.kind == "f":
            # Half floats: what the last bit of a matrix product decides differs by one step of theirs at most.
            np.testing.assert_allclose(made[name].astype(float), array.astype(float), rtol=2e-3, atol=1e-7)
        else:
            np.testing.assert_array_equal(made[name], array)


def test_tool_needs_no_people_kept_for_testing(tool, tmp_path):
    for path in REFERENCE.glob("*.npz"):
        if path.stem != FOR_TESTING:
            (tmp_path / path.name).symlink_to(path.resolve())
    assert len(tool.measure(tmp_path)["names"]) >= 16
