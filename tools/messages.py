"""Build docs/messages.md and docs/messages.schema.json: what a live face understands, from the table of messages.

python tools/messages.py
"""

from __future__ import annotations

import json
from pathlib import Path

from mien.live import json_schema, standard_motions
from mien.live.lines import FORMS
from mien.live.messages import markdown
from mien.live.osc import PREFIX, WANTED

DOCS = Path(__file__).parents[1] / "docs"
HEADER = """# Messages to a live face

Made by `python tools/messages.py` from the table in `src/mien/live/messages.py`; a test compares them.

A message is a JSON object with a `kind`; up to 100 of them can be sent as a list. Every message is answered, with
`{"kind": "ok"}`, with the state that it asked for, or with `{"kind": "error", "message": "…"}`, which says what was
wrong, what was wanted and what came; a message that is refused changes nothing. Left and right are the face's own,
but for directions of `look`: a face that looks `left` looks to the left as one sees the picture.
JSON Schema: [messages.schema.json](messages.schema.json).

## Kinds
"""
FORMS_HEADER = """
## As lines and as OSC

One message a line; the first word is its kind, in whatever case. A line that begins with another word is a move, one
that begins with `{` is JSON.

| line | OSC address, arguments |
|---|---|
"""
EXAMPLES = {
    "move": "`MOVE ELU 0.2 500`, `ELU 0.2 500`",
    "play": "`PLAY smile`, `PLAY smile 0.8`",
    "say": "`SAY Hello there`",
    "look": "`LOOK 0.1 0 0.5`, `LOOK left`, `LOOK cup`",
    "target": "`TARGET cup 0.1 0 0.5`",
    "stop": "`STOP`, `STOP speech`",
    "interrupt": "`INTERRUPT`",
    "reset": "`RESET`",
    "state": "`STATE`, `STATE ELU MB`",
    "idle": "`IDLE blinks 0`",
    "subscribe": "`SUBSCRIBE events`",
}
EVENTS = """
## Events

Who has subscribed to events hears what happens, with the number of the `loop` and, where the message had one, its
`id`. A text is said sentence by sentence; `speech` counts the sentences of a session from 0.

| event | besides `kind`, `event`, `loop`, `speech` and `id` |
|---|---|
| `speech.started` | `text`: the sentence |
| `speech.word` | `word` and its `number` in the sentence |
| `speech.ended` | `more`: whether more of the same text follows; `broken_off`: whether it was interrupted |
| `speech.failed` | `message`: why something cannot be said, or be done with it; `more`: whether the text goes on |

A `say` with `more` hands over a part of a text, as large or small as it comes, blanks included. Parts with the same
`id` are joined, and a sentence is said once what follows shows that it is complete, or when no part has come for a
second; `"more": false` ends the text, and that part may be empty. `[smile]`, `[smile 0.6]` in a text plays the motion
with the word behind it, `[neutral]` ends motions, `[look left]` is a look of a moment, `<break time="500ms"/>` a
silence; `*word*` and `<emphasis>` do nothing yet. None of them is spoken. An `interrupt`, a `reset` and a `stop` of
the speech also drop what is not made yet, parts that wait for more included; a text of which nothing had begun has a
`speech.ended` without a number then. A sentence that the voice cannot say (a lone emoji) is passed over in a text that
has others.
"""
MOTIONS_HEADER = """
## Standard motions

For every face, with pictures in [motions.md](motions.md); a file of one's own has the form of
`src/mien/live/data/motions.json`.

| motion | what is seen | seconds |
|---|---|---|
"""


def page() -> str:
    """The text of the page."""
    places = {kind: f"`{PREFIX}/{kind}" + ("/NAME/PARTS`" if kind == "move" else "`") for kind in FORMS}
    forms = "".join(
        f"| {EXAMPLES[kind]} | {places[kind] + ': ' + WANTED[kind] if kind in WANTED else ''} |\n" for kind in EXAMPLES
    )
    motions = "".join(
        f"| `{motion.name}` | {motion.doc} | {motion.length_s:.1f} |\n" for motion in standard_motions().values()
    )
    return HEADER + markdown() + EVENTS + FORMS_HEADER + forms + MOTIONS_HEADER + motions


def schema() -> str:
    """The text of the schema."""
    return json.dumps(json_schema(), indent=1) + "\n"


if __name__ == "__main__":
    (DOCS / "messages.md").write_text(page(), encoding="utf-8")
    (DOCS / "messages.schema.json").write_text(schema(), encoding="utf-8")
