"""Files of DLTdv, Argus and easyWand: clicks, points and cameras.

``…xypts.csv`` has columns ``pt1_cam1_X, pt1_cam1_Y, …`` (Argus: ``nose_cam_1_x``) and a row for each frame, NaN where
nothing was clicked. The middle of the first pixel is 1, 1. It is at the upper left in DLTdv8, at the lower left in
older versions and in Argus. ``…xyzpts.csv`` has ``pt1_X, pt1_Y, pt1_Z``. ``…dltCoefs.csv`` has a column for each camera
and in it the 11 coefficients of the direct linear transformation, which are the 11 unknowns of Parke 1974, Appendix C.

Source: Hedrick 2008, "Software techniques for two- and three-dimensional kinematic measurements of biological and
biomimetic systems", and the programs that read and write his files.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from mien.core import LoadError, MienError
from mien.core.mesh import Points
from mien.formats.cue_text import read_text

from .project_points import check_inside
from .project_tables import Faults, Row, format_table, round_float, split_table
from .records import Camera, Observation, Photograph, Solution

ORIGINS = ("upper-left", "lower-left")
"""Corners that a file may count pixels from; that of DLTdv8 first."""

FIRST_PX = 0.5
"""What is to be added to our pixels, which count from the corner of the first one, for its middle to be 1."""

_COLUMN = re.compile(r"(?P<point>.+?)_cam_?(?P<camera>\d+)_(?P<axis>[xy])", re.IGNORECASE)

NAMES_SUFFIX = "_pointnames.csv"
"""End of a file beside the clicks that tells what their points are called: columns ``point`` and ``name``."""


@dataclass(frozen=True)
class Views:
    """Which photograph each camera took at each moment.

    Attributes:
        moments: in the order of rows of a file.
        cameras: how many there are.
        photographs: by (number of the moment, number of the camera), both from 0.
    """

    moments: tuple[str, ...]
    cameras: int
    photographs: Mapping[tuple[int, int], Photograph]


def views(photographs: Sequence[Photograph]) -> Views:
    """Cameras and moments of a project, in the order in which they are first told of.

    Where one camera took several photographs of a moment, the first of each moment is camera 1, the next camera 2.
    """
    moments = tuple(dict.fromkeys(each.moment for each in photographs))
    names = tuple(dict.fromkeys(each.camera for each in photographs))
    apart = len({(each.moment, each.camera) for each in photographs}) == len(photographs)
    found: dict[tuple[int, int], Photograph] = {}
    for each in photographs:
        row = moments.index(each.moment)
        number = names.index(each.camera) if apart else sum(key[0] == row for key in found)
        found[row, number] = each
    return Views(moments, 1 + max(camera for _, camera in found), found)


def read_clicks(
    path: Path,
    photographs: Sequence[Photograph],
    *,
    origin: str = ORIGINS[0],
    frames: Sequence[int] = (),
    names: Sequence[str] = (),
) -> tuple[Observation, ...]:
    """Clicks in a file of DLTdv or Argus.

    Args:
        path: of the file.
        photographs: of the project; ``views`` tells which cameras and moments they are.
        origin: a name of ``ORIGINS``.
        frames: rows, from 1, that hold the moments of the project; 1, 2, … unless told.
        names: what the points are called, in the order of the columns; by the file beside it unless told.

    Raises:
        LoadError: all that is wrong with the file.
    """
    known, rows = views(photographs), split_table(path, read_text(path))
    line, header = next(iter(rows))
    columns = _columns(path, line, header, known)
    called = _called(path, list(dict.fromkeys(point for point, _, _ in columns)), names)
    wanted = dict(zip(frames or range(1, len(known.moments) + 1), range(len(known.moments)), strict=False))
    faults, found, count = Faults(path), list[Observation](), 0
    for count, (line, cells) in enumerate(rows, start=1):
        if len(cells) != len(columns):
            faults.add(line, f"want {len(columns)} cells, got {len(cells)}")
            continue
        for (point, camera), (x, y) in _pairs(faults, line, columns, cells).items():
            photo = known.photographs.get((wanted.get(count, -1), camera))
            if count not in wanted:
                if not frames:
                    faults.add(line, _too_many(count, known))
                continue
            if photo is None:
                moment = known.moments[wanted[count]]
                faults.add(line, f"{point}: the project has no photograph of camera {camera + 1} at moment {moment!r}")
                continue
            height = photo.size_px[1]
            seen = Observation(photo.name, called[point], *from_pixels(x, y, height, origin))
            try:
                check_inside(seen, photo)
            except MienError as error:
                faults.add(line, f"{error} Or does the file count from the {_other(origin)}?")
            found.append(seen)
    late = [frame for frame in frames if frame > count]
    if late:
        raise LoadError(path, f"has {count} rows, and row {late[0]} is wanted")
    faults.check()
    return tuple(found)


def from_pixels(x: float, y: float, height: int, origin: str) -> tuple[float, float]:
    """(u, v) of a place that DLTdv tells of."""
    return x - FIRST_PX, (y - FIRST_PX if origin == ORIGINS[0] else height + FIRST_PX - y)


def to_pixels(u: float, v: float, height: int, origin: str) -> tuple[float, float]:
    """The place as DLTdv tells it."""
    return u + FIRST_PX, (v + FIRST_PX if origin == ORIGINS[0] else height + FIRST_PX - v)


def _other(origin: str) -> str:
    return f"{ORIGINS[1 - ORIGINS.index(origin)].replace('-', ' ')}, --origin {ORIGINS[1 - ORIGINS.index(origin)]}?"[
        :-1
    ]


def _too_many(row: int, known: Views) -> str:
    told = ", ".join(known.moments)
    return (
        f"row {row} has clicks, and the project has {len(known.moments)} moments ({told}) — tell which rows they are: "
        "--frames 1,120"
    )


def _columns(path: Path, line: int, header: Sequence[str], known: Views) -> list[tuple[str, int, int]]:
    """(point, camera from 0, 0 of x or 1 of y) of each column."""
    columns = []
    for number, name in enumerate(header, start=1):
        parts = _COLUMN.fullmatch(name)
        if parts is None:
            raise LoadError(
                path, f"column {number}: want a name as pt1_cam1_X, got {name!r}", line=line,
                hint="of DLTdv8 files, want those saved as CSV, not the sparse ones",
            )  # fmt: skip
        camera = int(parts["camera"]) - 1
        if not 0 <= camera < known.cameras:
            raise LoadError(path, f"column {number}: {name!r} is of camera {camera + 1}, and the project has "
                            f"{known.cameras}", line=line)  # fmt: skip
        columns.append((parts["point"], camera, "xy".index(parts["axis"].lower())))
    for point, camera, axis in columns:
        if columns.count((point, camera, axis)) > 1 or (point, camera, 1 - axis) not in columns:
            raise LoadError(path, f"want one X and one Y of {point} in camera {camera + 1}", line=line)
    return columns


def _pairs(
    faults: Faults, line: int, columns: Sequence[tuple[str, int, int]], cells: Sequence[str]
) -> dict[tuple[str, int], tuple[float, float]]:
    """What a row has clicked: (x, y) by point and camera."""
    values: dict[tuple[str, int], list[float | None]] = {}
    for (point, camera, axis), cell in zip(columns, cells, strict=True):
        try:
            row = Row(line, {"": "" if cell.lower() == "nan" else cell})
            values.setdefault((point, camera), [None, None])[axis] = row.number("") if row.cells[""] else None
        except MienError:
            faults.add(line, f"{point} in camera {camera + 1}: want a number or NaN, got {cell!r}")
    pairs = {}
    for (point, camera), (x, y) in values.items():
        if x is not None and y is not None:
            pairs[point, camera] = x, y
        elif x is not None or y is not None:
            faults.add(line, f"{point} in camera {camera + 1} has one of X and Y only")
    return pairs


def _called(path: Path, points: Sequence[str], names: Sequence[str]) -> Mapping[str, str]:
    """Names of the project by those of the file."""
    if names:
        if len(names) != len(points) or len(set(names)) != len(names):
            raise LoadError(path, f"has {len(points)} points, and {len(set(names))} different names are told for them")
        return dict(zip(points, names, strict=True))
    beside = names_file(path)
    if not beside.is_file():
        return {point: point for point in points}
    rows = list(split_table(beside, read_text(beside)))
    table = {
        f"pt{cells[0]}" if cells[0].isdecimal() else cells[0]: cells[1]
        for _, cells in rows[1:]
        if len(cells) == 2 and cells[1]
    }
    missing = [point for point in points if point not in table]
    if missing:
        raise LoadError(
            beside, f"does not name {missing[0]!r} of {path.name}",
            hint=f"want columns point, name and a line such as {missing[0]},nose",
        )  # fmt: skip
    return {point: table[point] for point in points}


def names_file(path: Path) -> Path:
    """The file beside clicks that names their points."""
    return path.with_name(re.sub(r"[-_]?xyz?pts$", "", path.stem, flags=re.IGNORECASE) + NAMES_SUFFIX)


def format_clicks(
    observations: Sequence[Observation], photographs: Sequence[Photograph], *, origin: str = ORIGINS[0]
) -> str:
    """Clicks as a file of DLTdv; its points are ``pt1``, ``pt2``, … in the order of ``point_names``."""
    known = views(photographs)
    seen = {(each.photo, each.point): each for each in observations}
    names = point_names(observations)
    columns = [
        f"pt{number}_cam{camera + 1}_{axis}"
        for number in range(1, len(names) + 1)
        for camera in range(known.cameras)
        for axis in "XY"
    ]
    rows = []
    for row in range(len(known.moments)):
        cells: list[str | float] = []
        for name in names:
            for camera in range(known.cameras):
                photo = known.photographs.get((row, camera))
                found = seen.get((photo.name, name)) if photo else None
                if photo is None or found is None:
                    cells += ["NaN", "NaN"]
                else:
                    cells += [round_float(x) for x in to_pixels(found.u, found.v, photo.size_px[1], origin)]
        rows.append(cells)
    return format_table(columns, rows)


def point_names(observations: Sequence[Observation]) -> list[str]:
    """Names of points in the order in which they are first seen."""
    return list(dict.fromkeys(each.point for each in observations))


def format_names(names: Sequence[str]) -> str:
    """What ``pt1``, ``pt2``, … are called."""
    return format_table(("point", "name"), [(f"pt{number}", name) for number, name in enumerate(names, start=1)])


def format_places(solution: Solution, names: Sequence[str], metres: float) -> str:
    """Points as a file of DLTdv, a row for each moment of the survey, in a unit of so many metres."""
    columns = [f"pt{number}_{axis}" for number in range(1, len(names) + 1) for axis in "XYZ"]
    rows: list[list[str | float]] = []
    for moment in views(solution.survey.photographs).moments:
        cells: list[str | float] = []
        for name in names:
            point = solution.points.get((moment, name))
            cells += ["NaN"] * 3 if point is None else [round_float(x / metres) for x in point.place]
        rows.append(cells)
    return format_table(columns, rows)


def coefficients(camera: Camera, height: int, metres: float, origin: str = ORIGINS[0]) -> Points:
    """The 11 coefficients (11,) of a camera without distortion, for lengths in a unit of so many metres.

    A place is seen at (L1 x + L2 y + L3 z + L4) / (L9 x + L10 y + L11 z + 1), and with L5 to L8 above the same.

    Raises:
        MienError: the origin of the world lies beside the camera, where no such coefficients exist.
    """
    lens = camera.lens
    u, v = to_pixels(*lens.principal_px, height, origin)
    down = lens.focal_px * (lens.aspect if origin == ORIGINS[0] else -lens.aspect)
    inner = np.array([[lens.focal_px, 0.0, u], [0.0, down, v], [0.0, 0.0, 1.0]])
    outer = np.column_stack([camera.rotation * metres, -camera.rotation @ camera.place])
    matrix = inner @ outer
    if abs(matrix[2, 3]) < 1e-9 * float(np.linalg.norm(camera.place)):
        raise MienError(
            "the origin of the references lies beside a camera, in the plane of its lens, where the 11 coefficients do "
            "not exist — move the origin into the middle of the references"
        )
    return np.asarray((matrix / matrix[2, 3]).ravel()[:11])


def format_coefficients(solution: Solution, metres: float, origin: str = ORIGINS[0]) -> str:
    """Cameras as a file of DLTdv, by the photographs of the first moment.

    Raises:
        MienError: one of them has no camera in the solution, or no such coefficients.
    """
    known = views(solution.survey.photographs)
    columns = []
    for number in range(known.cameras):
        photo = known.photographs.get((0, number))
        camera = solution.cameras.get(photo.name) if photo else None
        if photo is None or camera is None:
            raise MienError(f"camera {number + 1} has no photograph of {known.moments[0]!r} that was solved")
        columns.append(coefficients(camera, photo.size_px[1], metres, origin))
    return "".join(",".join(repr(round_float(x, 15)) for x in row) + "\n" for row in np.transpose(columns))
