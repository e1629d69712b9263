"""``mien capture``: photographs to cameras and points."""

from __future__ import annotations

import typer

from . import capture_boards, capture_exchange, capture_keypose, capture_new, capture_report, capture_solve

app = typer.Typer(no_args_is_help=True, rich_markup_mode=None)
"""The commands about photographs."""

app.command("new")(capture_new.new)
app.command("boards")(capture_boards.boards)
app.command("solve")(capture_solve.solve)
app.command("keypose")(capture_keypose.keypose)
app.command("report")(capture_report.report)
app.command("import")(capture_exchange.import_points)
app.command("export")(capture_exchange.export_points)


@app.callback()
def capture() -> None:
    """Photographs of a face to points in space: begin a project, solve it, look at how good it is.

    \b
    mien capture new anna photos/*.jpg      a folder with project.toml, points.csv and references.csv
    mien capture solve anna                 cameras and points, into anna/solution
    mien capture solve anna --json
    mien capture report anna                how exact they are, as a page
    mien capture keypose anna -o anna.keypose
    """
