"""Pack the measured head into the file that ships: metres, float32, one file that is read at once.

    python tools/pack_head.py FOLDER

FOLDER holds head2.npz and head2_expressions.npz (the trial's measurements of ICT-FaceKit Light). Mouth parts
(teeth, gums, tongue, cavity) are modelled here, see tools/model_mouth.py.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parent))
import mend_head
import mend_lids
import mend_planes
import model_mouth

from mien.faces.head.arrays import format_arrays

CM = 0.01
OUT = Path(__file__).parents[1] / "src/mien/faces/head/data"
KEEP_MORPHS = {  # the lids and the gaze have mechanisms of their own, the jaw too (its residual is in the head file)
    "eyeBlink", "eyeLookDown", "eyeLookIn", "eyeLookOut", "eyeLookUp", "jawOpen",
}  # fmt: skip


def symmetric(points: np.ndarray, mirror: np.ndarray) -> np.ndarray:
    """Points averaged with their mirror images."""
    return 0.5 * (points + points[mirror] * np.array([-1.0, 1.0, 1.0]))


def nearest_mirror(points: np.ndarray) -> np.ndarray:
    """Number of the point nearest to each point's mirror image."""
    flipped = points * np.array([-1.0, 1.0, 1.0])
    return np.array([int(((points - p) ** 2).sum(axis=1).argmin()) for p in flipped])


def twin_name(name: str) -> str:
    """The expression of the other side."""
    for a, b in (("_L", "_R"), ("_R", "_L"), ("Left", "Right"), ("Right", "Left")):
        if name.endswith(a):
            return name.removesuffix(a) + b
    return name


def symmetric_pair(deltas: np.ndarray, names: list[str], name: str, mirror: np.ndarray) -> np.ndarray:
    """(V, 3) of an expression, averaged with the mirror image of its twin."""
    own, other = (deltas[names.index(each)].astype(np.float64) for each in (name, twin_name(name)))
    return 0.5 * (own + other[mirror] * np.array([-1.0, 1.0, 1.0]))


def main(folder: Path) -> None:
    head, morphs = dict(np.load(folder / "head2.npz")), np.load(folder / "head2_expressions.npz")
    mend_head.mend(head, dict(morphs))
    mirror = head["mirror_full"]
    for name in ("control", "control_onsurface", "jaw_residual_control", "jaw_residual_onsurface"):
        head[name] = symmetric(head[name].astype(np.float64), mirror)
    for name in ("jaw_share_control", "jaw_share_onsurface", "ambient", "region_weight_vertex"):
        head[name] = 0.5 * (head[name].astype(np.float64) + head[name].astype(np.float64)[mirror])
    for name in ("brow", "lash"):
        head[f"{name}_R_I"], head[f"{name}_R_W"] = mirror[head[f"{name}_L_I"]], head[f"{name}_L_W"]
        if name == "lash":
            head["lash_R_tip"] = head["lash_L_tip"]
    head["collar_v"] = symmetric(head["collar_v"].astype(np.float64), nearest_mirror(head["collar_v"]))
    out: dict[str, np.ndarray] = {}
    points = np.float32
    out["cage"] = (head["control"] * CM).astype(points)
    out["surface"] = (head["control_onsurface"] * CM).astype(points)
    for name in ("quads", "groups", "group_names", "half_names", "region_names"):
        out[name] = head[name].astype(np.int16) if name == "quads" else head[name]
    out["mirror"] = head["mirror_full"].astype(np.int16)
    out["region_weights"] = head["region_weight_vertex"]
    out["ambient"] = head["ambient"]
    out["jaw_axis"] = (head["jaw_axis_yz"] * CM).astype(points)
    out["jaw_open_angle"] = head["jaw_open_angle_rad"]
    for kind, name in (("control", "cage"), ("onsurface", "surface")):
        out[f"jaw_share_{name}"] = head[f"jaw_share_{kind}"]
        residual = head[f"jaw_residual_{kind}"] * CM
        residual[np.abs(residual) < 2e-6] = 0.0
        out[f"jaw_residual_{name}"] = residual.astype(np.float16)
        for key in ("az", "el", "r", "el_closed", "r_closed"):
            scale = CM if key.startswith("r") else 1.0
            out[f"lid_{name}_{key}"] = (head[f"lid_{kind}_{key}"] * scale).astype(points)
    for key in ("index", "ring", "station", "side", "upper"):
        out[f"lid_{key}"] = head[f"lid_{key}"]
    out["eye_centre"] = (head["eye_centre"] * CM).astype(points)
    out["eye_radius"] = np.float32(head["eye_radius"] * CM)
    for part in ("brow", "lash"):
        for side, name in (("L", "left"), ("R", "right")):
            out[f"{part}_{name}_index"] = head[f"{part}_{side}_I"].astype(np.int16)
            out[f"{part}_{name}_weight"] = head[f"{part}_{side}_W"]
    for side, name in (("L", "left"), ("R", "right")):
        tip = head[f"lash_{side}_tip"].copy()
        tip[:, 0] *= CM
        out[f"lash_{name}_tip"] = tip
    out["lash_quads"] = head["lash_L_q"].astype(np.int16)
    out["lash_lower"] = head["lash_L_lower"]
    out["brow_quads"] = head["brow_q"].astype(np.int16)
    out["brow_offset"] = (head["brow_offset"] * CM).astype(points)
    out["brow_along"], out["brow_across"] = head["brow_u"], head["brow_row"]
    for key, value in model_mouth.build(head).items():
        out[key] = value
    out["collar_points"] = (head["collar_v"] * CM).astype(points)
    out["collar_quads"] = head["collar_q"].astype(np.int16)
    out["collar_band"] = head["collar_kind"] == 0
    names = [str(n) for n in morphs["names"]]
    keep = [i for i, n in enumerate(names) if n.rsplit("_", 1)[0] not in KEEP_MORPHS]
    out["morph_names"] = np.array([names[i] for i in keep])
    for kind, name in (("control", "cage"), ("onsurface", "surface")):
        deltas = morphs[kind][keep].astype(np.float64) * CM
        kept = [names[i] for i in keep]
        done = np.zeros_like(deltas)
        for number, own in enumerate(kept):
            done[number] = symmetric_pair(deltas, kept, own, mirror)
        done[np.abs(done) < 2e-6] = 0.0
        out[f"morph_{name}"] = done.astype(np.float16)
    out["surface_flatter"] = mend_planes.flatten(out).astype(np.float16)
    out["plane_quads"] = mend_planes.left_half(out).astype(np.int16)
    mend_lids.shut(out)
    for kind, name in (("control", "cage"), ("onsurface", "surface")):
        blinks = [symmetric_pair(morphs[kind], names, f"eyeBlink_{side}", mirror) * CM for side in "LR"]
        slides = [mend_lids.slide(out, name, blink, side) for blink, side in zip(blinks, (1, -1), strict=True)]
        out[f"morph_{name}"] = np.concatenate([out[f"morph_{name}"], np.array(slides, dtype=np.float16)])
    out["morph_names"] = np.array([*out["morph_names"], "lidSlide_L", "lidSlide_R"])
    OUT.mkdir(parents=True, exist_ok=True)
    path = OUT / "head.arrays"
    path.write_bytes(format_arrays({name: np.asarray(array) for name, array in out.items()}))
    print(f"{path}: {path.stat().st_size / 1e3:.0f} kB")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
