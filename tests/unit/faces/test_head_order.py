"""The order in which the parameters act, as data, is the order in which they act."""

import sys
from itertools import pairwise

import pytest

from mien.compiling import Kernel
from mien.core import Pose
from mien.faces.head import posing
from mien.faces.head.order import MECHANISMS, acts, nodes
from mien.faces.head.table import conformation_rows, face_rows
from support import face, in_python

HEAD = face("head:parke1974")
HOW = {"blend": "interpolation", "scale": "scaling", "lids": "scaling", "field": "scaling", "brow": "scaling"}
HOW |= {"move": "translation", "turn": "rotation", "head": "scaling"}


def act_of(row):
    """Number and act of a row of a table, whose sides belong together."""
    name = row["name"] + (".left" if row["sides"] else "")
    return next((number, act) for number, act in enumerate(acts()) if act.takes(name))


def test_every_parameter_is_in_exactly_one_row():
    found = {name: [act.function for act in acts() if act.takes(name)] for name in HEAD.parameters.names}
    assert {name: rows for name, rows in found.items() if len(rows) != 1} == {}


@pytest.mark.parametrize("act", acts(), ids=lambda act: " ".join(act.titles))
def test_every_row_names_parameters_that_are_there_and_a_known_mechanism(act):
    assert act.mechanism in MECHANISMS
    for pattern in act.parameters:
        assert any(type(act)(act.function, act.node, act.mechanism, (pattern,)).takes(n) for n in HEAD.parameters.names)


def test_the_steps_of_the_shape_follow_one_another_as_their_rows_do():
    places = [place for place, act in map(act_of, conformation_rows()) if act.function == "shape_points"]
    assert len(places) > 25
    assert all(one <= next_one for one, next_one in pairwise(places))


@pytest.mark.parametrize("row", conformation_rows(), ids=lambda row: row["name"])
def test_the_mechanism_of_a_row_of_the_shape_is_the_one_that_is_told(row):
    _, act = act_of(row)
    assert act.mechanism == HOW[row["kind"]]
    assert (act.function == "add_moves") == (row["kind"] == "blend")


def test_measured_expressions_are_interpolations():
    for row in face_rows():
        if row["morph"]:
            _, act = act_of(row)
            assert (act.function, act.mechanism) == ("add_moves", "interpolation"), row["name"]


def test_the_functions_run_in_the_order_of_the_table(monkeypatch):
    for name, value in vars(posing).items():
        if isinstance(value, Kernel) and value.signature:
            monkeypatch.setattr(posing, name, in_python(value))
    # A colour that nobody asked for before, so that it is worked out now; and everything moves.
    pose = Pose(HEAD.parameters, 0.37 * HEAD.parameters.lows + 0.63 * HEAD.parameters.highs)
    told, run = list(dict.fromkeys(act.function for act in acts())), []

    def listen(frame, event, _):
        # The centres of the eyes are shaped beforehand, so that the eyes are aimed from where they will be.
        if event == "call" and frame.f_code.co_name in told and frame.f_back.f_code.co_name != "shape_held":
            run.append(frame.f_code.co_name)

    before = sys.getprofile()
    sys.setprofile(listen)
    try:
        HEAD.shape(pose)
    finally:
        sys.setprofile(before)
    assert list(dict.fromkeys(run)) == told


def test_each_part_follows_what_it_is_part_of():
    parts = nodes()
    assert parts[0] == ("head",)
    assert len(set(parts)) == len(parts)
    for number, node in enumerate(parts[1:], start=1):
        assert node[:-1] in parts[:number]
        # Nothing that is not of the same whole stands between them.
        assert all(part[: len(node) - 1] == node[:-1] for part in parts[parts.index(node[:-1]) : number])


def test_an_interpolation_has_an_asterisk_and_no_side():
    titles = [title for act in acts() for title in act.titles]
    assert "eyelid.opening*" in titles
    assert "jaw.rotation" in titles
    assert not any(title.endswith((".left", ".right", ".")) for title in titles)
