"""The four pictures of detail of Parke's paper of 1972: the face alone, and what makes a person of it."""

# mien: docs = picture, test = compare
import sys
from dataclasses import replace

import numpy as np
from plates import draw_plate, plate_scene

import mien
from mien.core import subdivide
from mien.faces.head.measured import archive
from mien.render import draw_mesh

POSE = {"mouth.expression": 0.25, "jaw.rotation": 2.5, "mouth.upper_lip": 6}
EYES = ("eye", "spot", "caruncle")
STEPS = (
    ("the face alone", ("skin",)),
    ("with eyes and nostrils", ("skin", *EYES)),
    ("with teeth, lashes, brows, inside of the mouth", ("skin", *EYES, "lash", "brow", "teeth", "gums", "tongue")),
    ("the complete head", ("skin", *EYES, "lash", "brow", "teeth", "gums", "tongue", "collar", "hair")),
)


def main(out: str = "figure_1972.jpg") -> None:
    head = mien.load_face("head:parke1972")
    mesh = head.shape(head.neutral.replace(POSE))

    def draw(number: int, scene: mien.Scene) -> mien.Picture:
        shown = take(mesh, STEPS[number][1])
        return mien.Picture(draw_mesh(subdivide(shown, scene.subdivide), scene))

    captions = [caption for caption, _ in STEPS]
    draw_plate(draw, plate_scene((400, 450), 5, 1.0, -0.03), 4, captions, grey=False).write(out)


def take(mesh: mien.Mesh, parts: tuple[str, ...]) -> mien.Mesh:
    """The mesh with these parts; of its skin the face only, until there is hair."""
    topology = mesh.topology
    skin, groups = topology.part("skin"), np.array(archive().group_names)[archive().groups]
    kept = np.concatenate(
        [np.full(part.last - part.first, part.name.split(".")[0] in parts) for part in topology.parts]
    )
    if "hair" not in parts:
        kept[skin.first : skin.last] &= face_polygons(mesh)[skin.first : skin.last]
    if "tongue" not in parts:
        kept[skin.first : skin.last] &= groups != "mouth"
    colors = mesh.colors.copy()
    if "eye" not in parts:
        nostrils = [topology.polygon(skin.first + number) for number in np.flatnonzero(groups == "nostril")]
        colors[np.unique(nostrils)] = 0.6 * colors[archive().vertex["k11_2"]]
    return replace(mesh, colors=colors).keeping(kept)


def face_polygons(mesh: mien.Mesh) -> np.ndarray:
    """(F,) whether a polygon lies where Parke's first face had one: in front of the ears, from hairline to chin."""
    corners, starts = mesh.topology.corners, mesh.topology.starts
    x, y, z = (np.add.reduceat(mesh.points[corners], starts[:-1]) / np.diff(starts)[:, None]).T
    return (z > 0.03) & (y < 0.086 - 4.4 * x * x) & (y > -0.125) & ((z > 0.05) | (y > -0.1))


if __name__ == "__main__":
    main(*sys.argv[1:])
