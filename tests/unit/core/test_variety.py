"""People drawn by chance, and mixtures of people."""

import numpy as np
import pytest

from mien.core import MienError, Parameter, ParameterTable, Pose, RangeError, mix_people, random_person
from mien.core.chance import around, stream
from support import face


def test_the_same_seed_gives_the_same_person_and_another_seed_another():
    head = face("head")
    first, again, other = (random_person(head, seed) for seed in (7, 7, 8))
    np.testing.assert_array_equal(first.values, again.values)
    assert len({*first.changed()} & {*other.changed()}) > 50
    assert np.abs(first.values - other.values).max() > 0.1


def test_chance_changes_the_shape_and_the_colours_and_moves_nothing():
    head = face("head")
    changed = random_person(head, 3).changed()
    assert all(head.parameters[name].spread or name.split(".")[1] == "color" for name in changed)
    assert not any(name.startswith(("jaw.rotation", "mouth.", "eyelid.opening", "target.")) for name in changed)


def test_nobody_is_grey_by_chance():
    for seed in range(60):
        person = random_person(face("head"), seed)
        assert person["skin.color.red"] > person["skin.color.green"] > person["skin.color.blue"]


def test_people_spread_as_their_rows_say():
    head = face("head")
    rows = [row for row in head.parameters if row.spread]
    people = [random_person(head, seed) for seed in range(300)]
    drawn = np.array([[person[row.name] for row in rows] for person in people])
    wide = (drawn.std(axis=0) / [row.spread for row in rows], drawn.mean(axis=0) - [row.default for row in rows])
    assert np.all(np.abs(wide[0] - 0.98) < 0.2)
    assert np.all(np.abs(wide[1]) < 0.25 * np.array([row.spread for row in rows]))


def test_who_is_drawn_does_not_depend_on_who_is_asked():
    ada, tom = (random_person(face(name), 5) for name in ("head:ada", "head:tom"))
    np.testing.assert_array_equal(ada.values, tom.values)


def test_both_sides_of_a_face_are_nearly_alike():
    head = face("head")
    people = [random_person(head, seed) for seed in range(80)]
    apart = [person["jaw.width.left"] - person["jaw.width.right"] for person in people]
    spread = head.parameters["jaw.width.left"].spread
    assert 0.0 < np.std(apart) < 0.2 * spread


def test_a_draw_by_hand():
    table = ParameterTable((Parameter("nose.length", 0.0, 10.0, 5.0, spread=2.0), Parameter("jaw.rotation", 0, 20)))
    toy = Toy("toy", table)
    want = 5.0 + 2.0 * around(stream(11, "nose.length"), 0.0, 3.0)
    assert random_person(toy, 11).changed() == {"nose.length": pytest.approx(want)}


def test_a_mixture_is_so_far_on_the_way_to_the_other_person():
    head, other = face("head"), face("head:imani")
    pose = head.neutral.replace({"jaw.rotation": 5.0})
    mixed = mix_people(pose, head, [(other, 0.25)])
    assert mixed["jaw.rotation"] == 5.0
    name = "skin.color.red"
    assert mixed[name] == pytest.approx(0.75 * head.neutral[name] + 0.25 * other.neutral[name])
    np.testing.assert_allclose(mix_people(head.neutral, head, [(other, 1.0)]).values, other.neutral.values, atol=1e-12)


@pytest.mark.parametrize("shares", [[-0.1], [0.6, 0.5], [1.1]])
def test_shares_that_make_no_person_are_refused(shares):
    head = face("head")
    with pytest.raises(RangeError, match=r"head:ada=.*no more than 1"):
        mix_people(head.neutral, head, [(face("head:ada"), share) for share in shares])


def test_faces_of_other_kinds_do_not_mix():
    toy = Toy("toy", ParameterTable((Parameter("jaw.rotation", 0, 20),)))
    with pytest.raises(MienError, match="head and toy cannot be mixed"):
        mix_people(face("head").neutral, face("head"), [(toy, 0.5)])


class Toy:
    """A face with a table and nothing else."""

    family = "toy"

    def __init__(self, name: str, parameters: ParameterTable):
        self.name, self.parameters, self.presets = name, parameters, {}

    @property
    def neutral(self) -> Pose:
        return Pose.neutral(self.parameters)
