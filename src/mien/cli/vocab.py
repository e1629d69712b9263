"""``mien vocab``: other names for what a face can do, and what a face loses of them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Annotated

import typer

from . import options

if TYPE_CHECKING:
    from mien.vocab import Link
    from mien.vocab.loss import Loss

COMPARED_WITH = "head"
"""Who plays two vocabularies that are compared with one another."""


def vocab(
    name: Annotated[str | None, typer.Argument(metavar="NAME", help="A vocabulary, to see its names.")] = None,
    loss: Annotated[
        tuple[str, str] | None,
        typer.Option("--loss", metavar="FROM TO", help="What of FROM a face, or another vocabulary, cannot say."),
    ] = None,
    as_json: options.Json = False,
) -> None:
    """List the vocabularies, the names of one, or what is lost on the way.

    Loss on a face: a name is exact, near (approximated), missing, or something stands in for it; how far it moves the
    point that it moves most, in mm or the units of a drawing; and which other name does most nearly the same, 0 degrees
    apart where both do the same. Loss to another vocabulary: the nearest combination of its names, and how many degrees
    the two displacements are apart.

    \b
    mien vocab
    mien vocab facs
    mien vocab --loss arkit head
    mien vocab --loss facs toon:olav
    mien vocab --loss facs arkit --json
    """
    from mien.core import MienError

    if loss is not None and name is not None:
        raise MienError(f"vocab {name}: --loss takes both of its names itself — leave {name!r} out")
    if loss is not None:
        _show_loss(*loss, as_json)
    elif name is not None:
        _show_names(name, as_json)
    else:
        _show_vocabularies(as_json)


def _show_vocabularies(as_json: bool) -> None:
    from mien.vocab import families, vocabularies, vocabulary

    from .listing import print_json, print_table

    if as_json:
        listed = [
            {"name": name, "doc": doc, "names": len(vocabulary(name)), "faces": families(name)}
            for name, doc in vocabularies().items()
        ]
        print_json({"vocabularies": listed})
        return
    print_table(
        ("vocabulary", "names", "played by", "what it is"),
        [(name, str(len(vocabulary(name))), ", ".join(families(name)), doc) for name, doc in vocabularies().items()],
        numbers=(1,),
    )


def _show_names(name: str, as_json: bool) -> None:
    from mien.vocab import vocabulary

    from .listing import print_json, print_table

    table = vocabulary(name)
    aliases: dict[str, list[str]] = {}
    for alias, row in table.aliases.items():
        aliases.setdefault(row, []).append(alias)
    if as_json:
        rows = [
            {
                "name": row.name,
                "aliases": aliases.get(row.name, []),
                "low": row.low,
                "high": row.high,
                "default": row.default,
                "unit": row.unit,
                "group": row.group,
                "doc": row.doc,
                "source": row.source,
            }
            for row in table
        ]
        print_json({"vocabulary": name, "names": rows})
        return
    print_table(
        ("name", "also", "from", "to", "rest", "what is seen"),
        [
            (
                row.name,
                " ".join(aliases.get(row.name, [])),
                *(f"{x:g}" for x in (row.low, row.high, row.default)),
                row.doc,
            )
            for row in table
        ],
        numbers=(2, 3, 4),
    )


def _show_loss(name: str, to: str, as_json: bool) -> None:
    from mien import api
    from mien.core import Drawing
    from mien.vocab import vocabularies, vocabulary
    from mien.vocab.loss import loss_on, loss_to

    from .listing import print_json, print_table, show

    over = to in vocabularies()
    face = api.load_face(COMPARED_WITH if over else to)
    losses = loss_to(name, to, face) if over else loss_on(name, face)
    unit = "px" if isinstance(face.shape(face.neutral), Drawing) else "mm"
    if as_json:
        print_json({"from": name, "to": to, "names": [_described(loss, unit) for loss in losses]})
        return
    print_table(
        ("name", "fit", unit, "degrees", "nearest in " + to if over else "nearest other name"),
        [(loss.name, loss.fit, f"{loss.longest:.1f}", *_compared(loss, over)) for loss in losses],
        numbers=(2, 3),
    )
    lost = [loss for loss in losses if loss.fit in ("stand-in", "missing")]
    if lost and not over:
        show(["", f"What {to} cannot show of {name}, and what stands in for it:"])
        table = vocabulary(name)
        print_table(
            ("name", "cannot be shown", "instead"),
            [(loss.name, table[loss.name].doc, ", ".join(map(_done, loss.stand_ins)) or "nothing") for loss in lost],
        )


def _described(loss: Loss, unit: str) -> dict[str, object]:
    return {
        "name": loss.name,
        "fit": loss.fit,
        f"longest_{unit}": round(loss.longest, 2),
        "nearest": {name: round(share, 3) for name, share in loss.nearest.items()},
        "angle_deg": round(loss.angle_deg, 1),
        "stand_ins": [
            {"parameter": link.parameter, "gain": round(link.gain, 3), "blend": link.blend} for link in loss.stand_ins
        ],
    }


def _compared(loss: Loss, shares: bool) -> Sequence[str]:
    """Degrees, and names with their shares."""
    if not loss.nearest:
        return "", ""
    names = (f"{name} {share:.2f}" if shares else name for name, share in loss.nearest.items())
    return f"{loss.angle_deg:.1f}", " + ".join(names)


def _done(link: Link) -> str:
    return f"{link.parameter} {f'×{1.0 + link.gain:.2g}' if link.blend == 'multiply' else f'{link.gain:+.2g}'}"
