"""The shape of a head: each step does what its row says, where it says, and nothing elsewhere."""

import numpy as np
import pytest

from mien.core import Pose
from mien.faces.head.conformation import shape_steps, shares_of
from mien.faces.head.directions import directions
from mien.faces.head.measured import archive
from mien.faces.head.regions import region_rows, weigh_region
from mien.faces.head.table import conformation_rows, face_rows
from mien.faces.head.teeth import teeth_field
from planarity import bent_head
from support import face

HEAD = "head:parke1974"
BENT = bent_head(face(HEAD).unsubdivided)
STEPS = shape_steps(archive().floats("eye_centre"))


def shaped(changes: dict[str, float]) -> np.ndarray:
    """(V, 3) m of the bald head."""
    head = face(HEAD)
    return head.shape(Pose.neutral(head.parameters).replace(changes)).points


def skin_of(points: np.ndarray) -> np.ndarray:
    return points[: len(archive().mirror)]


def vertex(name: str) -> int:
    return archive().vertex[name]


@pytest.mark.parametrize("step", STEPS, ids=lambda step: step.parameter)
def test_a_step_moves_its_region_and_exactly_nothing_else(step):
    row = face(HEAD).parameters[step.parameter]
    rest = skin_of(shaped({}))
    taken = set(shares_of([step], archive().measured("cage").points, archive().floats("eye_centre")).rows.tolist())
    if step.kind == "blend":
        taken = set(np.flatnonzero(directions("cage")[step.region].any(axis=1)).tolist())
    for end in {row.low, row.high} - {step.rest}:
        moved = np.flatnonzero((skin_of(shaped({step.parameter: end})) != rest).any(axis=1))
        assert len(moved) >= 8 or step.kind == "field"
        assert set(moved.tolist()) <= taken
    assert len(taken) < len(rest)


def ends_mm(head, row):
    """How far each end of a row moves the point that it moves most, mm."""
    rest = head.shape(head.neutral).points
    for end in ("low", "high"):
        points = head.shape(head.neutral.replace({row["name"]: float(row[end])})).points
        yield end, 1000.0 * np.sqrt(((points - rest) ** 2).sum(axis=1).max())


@pytest.mark.parametrize("row", [*face_rows(), *conformation_rows()], ids=lambda row: row["name"])
def test_the_ends_of_a_row_move_the_head_as_far_as_the_table_says(row):
    for end, moved in ends_mm(BENT, row):
        assert moved == pytest.approx(float(row[f"{end}_mm"]), abs=0.06)
        assert moved >= (1.2 if "spread" in row else 0.5) or row[end] == row["default"]


@pytest.mark.parametrize("row", conformation_rows(), ids=lambda row: row["name"])
def test_plane_polygons_take_little_of_what_a_row_moves(row):
    """They blunt bumps of a few polygons: the angle of the jaw, the hollow of the cheek."""
    blunt = 0.13 if row["name"] in ("cheek.hollow", "jaw.angle", "jaw.width") else 0.055
    for end, moved in ends_mm(face(HEAD).unsubdivided, row):
        assert moved == pytest.approx(float(row[f"{end}_mm"]), rel=blunt, abs=0.06)


def test_the_chin_goes_fifty_of_parkes_units_forward():
    chin = vertex("k11_2")
    assert shaped({"chin.forward": 50})[chin, 2] - shaped({})[chin, 2] == pytest.approx(0.008, abs=1e-9)


def test_a_scale_of_the_chin_to_mouth_keeps_the_lips_and_lowers_the_neck_as_one():
    rest, long = shaped({}), shaped({"face.chin_to_mouth": 1.5})
    np.testing.assert_array_equal(long[vertex("m0_0")], rest[vertex("m0_0")])
    collar = face(HEAD).topology.part("collar")
    corners = face(HEAD).topology.corners
    starts = face(HEAD).topology.starts
    rows = np.unique(corners[starts[collar.first] : starts[collar.last]])
    lowered = (rest - long)[rows, 1]
    assert lowered.max() - lowered.min() < 0.0015
    assert 0.015 < lowered.mean() < 0.03


@pytest.mark.parametrize("name", ["eyelid.width", "eyelid.height"])
def test_scaled_lids_stay_on_their_spheres(name):
    lids, centre = archive().measured("cage").lids.index[:72], archive().floats("eye_centre")[0]
    for opening in (0.0, 0.75, 1.0):
        far = [
            np.sqrt(((shaped({name: factor, "eyelid.opening": opening})[lids] - centre) ** 2).sum(axis=1))
            for factor in (1.0, 0.5, 1.5)
        ]
        np.testing.assert_allclose(far[1], far[0], atol=1e-12)
        np.testing.assert_allclose(far[2], far[0], atol=1e-12)


@pytest.mark.parametrize("step", STEPS, ids=lambda step: step.parameter)
def test_the_lids_go_along_with_the_eye_as_one_piece(step):
    """A ball that stays where it is would be cut by lids that are bent or shifted."""
    if step.region in ("lids", "eye", "face"):
        return
    lids = archive().measured("cage").lids
    row = face(HEAD).parameters[step.parameter]
    for end in (row.low, row.high):
        moved = (skin_of(shaped({step.parameter: end})) - skin_of(shaped({})))[lids.index]
        for side in (1, -1):
            np.testing.assert_allclose(moved[lids.side == side], moved[lids.side == side][:1].repeat(72, 0), atol=1e-9)


def test_a_larger_eyeball_takes_its_lids_along():
    rest, large = (eye_radii(shaped({"eye.size.left": size})) for size in (75, 100))
    assert large[0] / rest[0] == pytest.approx(100 / 75)
    assert large[1] == rest[1]


def eye_radii(points: np.ndarray) -> list[float]:
    head = face(HEAD)
    out = []
    for side in ("left", "right"):
        part = head.topology.part(f"eye.{side}")
        rows = np.unique(head.topology.corners[head.topology.starts[part.first] : head.topology.starts[part.last]])
        ball = points[rows]
        # The sphere through the points, by least squares: |p|^2 = 2 c.p + (r^2 - c^2).
        system = np.concatenate([2.0 * ball, np.ones((len(ball), 1))], axis=1)
        solved = np.linalg.lstsq(system, (ball * ball).sum(axis=1), rcond=None)[0]
        out.append(float(np.sqrt(solved[3] + (solved[:3] ** 2).sum())))
    return out


def test_irises_stay_round_when_the_head_is_scaled():
    head = face(HEAD)
    straight = {"target.x": 0.0315, "target.y": 0.004, "target.z": 100.0}
    for width, height in ((0.6, 1.0), (1.0, 1.4), (1.3, 0.7)):
        points = shaped({"head.scale.width": width, "head.scale.height": height, **straight})
        pupil = head.topology.polygon(head.topology.part("eye.left").first)
        size = points[pupil].max(axis=0) - points[pupil].min(axis=0)
        assert size[0] / size[1] == pytest.approx(1.0, abs=0.03)


def test_ears_that_stick_out_go_outwards_on_both_sides():
    rest, out = shaped({}), shaped({"ear.angle": 30})
    edge = np.argmax(skin_of(rest)[:, 0])
    other = archive().mirror[edge]
    assert out[edge, 0] > rest[edge, 0] + 0.004
    assert out[other, 0] < rest[other, 0] - 0.004


def test_one_side_alone_moves():
    rest, wide = shaped({}), shaped({"jaw.width.left": 1.3})
    right = skin_of(rest)[:, 0] < 0.0
    np.testing.assert_array_equal(skin_of(wide)[right], skin_of(rest)[right])
    assert np.abs(skin_of(wide) - skin_of(rest)).max() > 0.004


def test_the_neck_turns_about_its_pivot_when_the_face_is_long():
    """The collar must not slide over a neck that turns elsewhere."""
    long = {"face.chin_to_eye": 1.4}
    rest, turned = shaped(long), shaped({**long, "head.turn": 40})
    low = skin_of(archive().measured("cage").points)[:, 1] < -0.168
    np.testing.assert_allclose(skin_of(turned)[low], skin_of(rest)[low], atol=2e-3)


def test_every_region_is_used_and_every_row_has_one():
    used = {row["region"] for row in conformation_rows() if row["region"] and row["kind"] != "field"} | {"rigid lids"}
    assert used == set(region_rows())


def test_a_span_stretches_what_lies_between_and_takes_the_rest_along():
    """From 4 down to -122 mm; the weight times the distance is the integral of two smooth steps."""
    y = np.array([0.01, 0.004, -0.05, -0.2, -0.3])
    share = weigh_region("below the eyes", np.stack([0 * y, y, 0 * y], axis=1))
    assert share[0] == share[1] == 0.0
    way = share * (0.004 - y)
    assert way[2] == pytest.approx(0.050 - 0.0085, abs=1e-9)
    assert way[3] == way[4] == pytest.approx(0.113 - 0.0085, abs=1e-9)


def test_longer_teeth_grow_from_the_gums_and_wider_ones_about_their_middles():
    teeth = archive().floats("teeth_points")
    crowns = teeth.reshape(-1, 33, 3)
    edges = teeth_field(teeth, "length").reshape(crowns.shape)[:, 24:32].mean(axis=1)
    np.testing.assert_allclose(edges, crowns[:, 24:32].mean(axis=1) - crowns[:, :8].mean(axis=1), atol=1e-6)
    width = teeth_field(teeth, "width").reshape(crowns.shape)
    assert np.abs(width.mean(axis=1)).max() < 0.0015


def test_thicker_brows_keep_their_middle_line():
    head = face(HEAD)
    part = head.topology.part("brow.left")
    rows = np.unique(head.topology.corners[head.topology.starts[part.first] : head.topology.starts[part.last]])
    rest, thick = (shaped({"eyebrow.thickness": factor})[rows].reshape(-1, 4, 3) for factor in (1.0, 2.0))
    np.testing.assert_allclose((thick[:, 0] + thick[:, 3]) / 2, (rest[:, 0] + rest[:, 3]) / 2, atol=1e-12)
    np.testing.assert_allclose(thick[:, 3] - thick[:, 0], 2 * (rest[:, 3] - rest[:, 0]), atol=1e-12)


def test_arched_brows_peak_beyond_their_middle():
    head = face(HEAD)
    part = head.topology.part("brow.right")
    rows = np.unique(head.topology.corners[head.topology.starts[part.first] : head.topology.starts[part.last]])
    lift = (shaped({"eyebrow.shape": 1.0}) - shaped({}))[rows].reshape(-1, 4, 3)[:, 1, 1]
    assert 8 <= np.argmax(lift) <= 9
    assert lift[0] < 0.0 < lift[-5]
