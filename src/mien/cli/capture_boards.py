"""``mien capture boards``: corners of chessboards, found and kept."""

from __future__ import annotations

from . import options
from .capture_solve import Folder


def boards(folder: Folder, quiet: options.Quiet = False, as_json: options.Json = False) -> None:
    """Find the corners of boards in the photographs anew, and keep them in DIR/boards.csv.

    The boards stand in project.toml: [[board]] with kind = "chessboard" (or "charuco", with marker and dictionary),
    columns and rows (of squares), square (its side).

    \b
    mien capture boards anna
    mien capture boards anna --json
    """
    from mien.capture.project import find_boards, read_project
    from mien.core import MienError

    from .listing import print_json, print_table
    from .stages import Stages

    project = read_project(folder)
    if not project.boards:
        raise MienError(
            f"{folder}: there is no board in its project.toml — want [[board]] with kind, columns, rows, square"
        )
    stages = Stages(quiet)
    with stages.progress("boards") as report:
        found = find_boards(project, report)
    counts: dict[tuple[str, str], list[float]] = {}
    for each in found:
        counts.setdefault((each.photo, each.point.partition(":")[0]), []).append(each.sigma_px)
    if as_json:
        rows = [
            {"photo": photo, "board": board, "corners": len(sigmas), "sigma_px": sigmas[0]}
            for (photo, board), sigmas in counts.items()
        ]
        print_json({"boards": rows})
    elif not quiet:
        print_table(
            ("photograph", "corners", "sigma px", "board"),
            [(photo, str(len(sigmas)), f"{sigmas[0]:.2f}", board) for (photo, board), sigmas in counts.items()],
            numbers=(1, 2),
        )
        stages.say(f"{folder / 'boards.csv'}: {len(found)} corners")
