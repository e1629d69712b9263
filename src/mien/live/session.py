"""A live face: messages go in, a pose comes out at every loop. The one thing in mien that changes; it has no clock."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import Any

import numpy as np

from mien.core import Face, MienError, Pose, Sound, UnknownNameError
from mien.speech import Speech
from mien.timeline import exact_rate
from mien.vocab import vocabulary

from .fields import read_number
from .idle import Idle
from .logs import LOOP_S, Header, command_line, end_line
from .looking import Looks
from .messages import IDLE_PARTS, KINDS, Message, check_message, refusal
from .mixing import CHANNELS, Mixer, Moment
from .motions import FaceMotion, Motion, fit_motion, standard_motions
from .naming import Names
from .saying import Turn, Utterance, make_utterance
from .slices import Floats, Motors, Way, count_slices
from .sounds import sound_line

SILENT_S = 0.1
"""The mouth is shut so soon after an interruption."""

BORROW_S = 0.12
GIVE_BACK_S = 0.25
"""Speech takes the mouth in this time, and gives it back in this."""

MOST_SAID = 1_000
MOST_SAID_S = 600.0
"""Texts that can wait for being said, and how long they may be together."""

STATE_ROLES = ("motion", "gaze", "contact")
"""Rows that ``state`` tells, if none are named."""

Say = Callable[[str], Speech]


@dataclass(frozen=True, eq=False)
class Frame:
    """What a loop has made.

    Attributes:
        loop: its number, from 0.
        pose: the face.
        events: what happened: speech that starts, words, speech that ends.
    """

    loop: int
    pose: Pose
    events: tuple[Mapping[str, Any], ...] = ()


class Session:
    """One face, live.

    Messages that come between two loops act from the next one on, in order; the same messages at the same loops give
    the same frames, bit by bit. A motion takes the place of those that move the same regions of the face, and joins
    the others: one nods with a smile.

    Args:
        face: of a family that the tables ``channels`` and ``toonface`` exist for.
        loop_s: length of a loop, seconds: the duration of a slice.
        seed: of all that chance decides.
        pose: what the face is like at rest; None is neutral.
        idle: how much of each of ``IDLE_PARTS``; 1 where nothing is said.
        motions: besides the standard ones, and in their place where names are the same.
        voice: says texts that come without phones.
        log: hears every line of the log (``mien.live.logs``), without line ends.

    Raises:
        MienError: the face cannot be played, or not with these motions.
    """

    def __init__(
        self,
        face: Face,
        loop_s: float = 1 / 60,
        seed: int = 0,
        *,
        pose: Pose | None = None,
        idle: Mapping[str, float] = MappingProxyType({}),
        motions: Iterable[Motion] = (),
        voice: Say | None = None,
        log: Callable[[str], object] | None = None,
    ) -> None:
        read_number("loop_s", loop_s, *LOOP_S, "s")
        for part in idle:
            if part not in IDLE_PARTS:
                raise UnknownNameError("part of idle life", part, IDLE_PARTS)
        self.face, self.seed, self.rate = face, seed, exact_rate(1.0 / loop_s)
        self.loop_s = float(1 / self.rate)
        self.loop = 0
        self._voice, self._log = voice, log
        own = tuple(motions)
        self.motions: Mapping[str, Motion] = {**standard_motions(), **{motion.name: motion for motion in own}}
        self._fitted: dict[str, FaceMotion] = {motion.name: fit_motion(motion, face) for motion in own}
        self.rest = face.neutral if pose is None else pose
        self._mixer, self._names = Mixer(face, self.rest), Names(face, self.rest)
        size, channels = len(face.parameters), vocabulary(CHANNELS)
        self._looks = Looks(self.loop_s)
        self._idle = Idle(seed, self.rate, idle)
        self._gaze, self._speech = Motors(channels.defaults), Motors(channels.defaults)
        self._expression, self._direct = Motors(np.zeros(size)), Motors(self.rest.values)
        self._held, self._borrowed = Motors(np.zeros(size)), Motors([0.0])
        self._playing: dict[str, frozenset[int]] = {}
        self._said: deque[Turn] = deque()
        self._happened: list[Mapping[str, Any]] = []
        self._said_loops = self._utterances = 0
        self._speaking = self._saying = False
        self._told: tuple[tuple[int, int, float], ...] = ()
        self._telling = Motors([0.0])
        self.values: Floats = self._mix(np.zeros(len(channels)))
        """(P,) as of the last loop; nobody changes them."""
        if log is not None:
            usual = dict(zip(IDLE_PARTS, self._idle.usual, strict=True))
            log(Header(face.name, face.parameters.fingerprint, seed, loop_s, usual, own, self.rest.changed()).line())

    @property
    def unsaid_s(self) -> float:
        """How long it will take to say all that waits for being said."""
        return (sum(turn.utterance.loops for turn in self._said) - self._said_loops) * self.loop_s

    def handle(self, value: object, utterance: Utterance | None = None) -> dict[str, Any]:
        """The answer to a message, any JSON value or one that has been checked; a bad one changes nothing.

        Args:
            value: the message.
            utterance: what ``make_utterance`` made of it for this session, where that was done beforehand; of a
                ``say`` with phones.
        """
        sound: Sound | None = None
        try:
            message = value if isinstance(value, Message) else check_message(value)
            if KINDS[message.kind].connection:
                raise MienError(f"{message.kind}: is for a server, and this is a session without connections")
            if message.kind == "say":
                message, sound = self._spoken(message)
                reply = self._say(message, utterance)
            else:
                reply = _ACTS[message.kind](self, message)
        except MienError as error:
            return refusal(error, value.to_json() if isinstance(value, Message) else value)
        if self._log is not None and message.kind != "state":
            self._log(command_line(self.loop, message))
        if sound is not None:
            self.keep_sound(reply["speech"], sound)
        return {"kind": "ok", **reply} | ({} if message.id is None else {"id": message.id})

    def step(self) -> Frame:
        """The next loop: one slice of every motor that has any."""
        events = self._speak()
        for motors in (
            self._gaze,
            self._speech,
            self._expression,
            self._direct,
            self._held,
            self._borrowed,
            self._telling,
        ):
            motors.step()
        self.values = self._mix(self._idle.step(self._told, float(self._telling.values[0])))
        frame = Frame(self.loop, Pose(self.face.parameters, self.values), events)
        self.loop += 1
        self._said_loops += bool(self._said)
        return frame

    def keep_sound(self, speech: int, sound: Sound) -> None:
        """Write the sound of an utterance, by its number, into the log: a replay is heard."""
        if self._log is not None:
            self._log(sound_line(speech, sound))

    def close(self) -> None:
        """Write the end of the log, which tells how many loops there were."""
        if self._log is not None:
            self._log(end_line(self.loop))
            self._log = None

    def _mix(self, idle: Floats) -> Floats:
        speech = self._mouth(self._said_loops) if self._said else self._speech.values
        borrowed = float(self._borrowed.values[0])
        return self._mixer.mix(
            Moment(
                idle,
                self._gaze.values,
                self._expression.values,
                speech,
                self._direct.values,
                self._held.values,
                borrowed,
            )
        )

    def _mouth(self, loop: int) -> Floats:
        """(C,) what is said at a loop of the utterance, and what somebody moves besides; none passes its end."""
        table = vocabulary(CHANNELS)
        return np.clip(self._speech.values + self._said[0].utterance.channels[:, loop], table.lows, table.highs)

    def _speak(self) -> tuple[Mapping[str, Any], ...]:
        """Go on to the next utterance where one is over, and lend or give back the mouth; what happens."""
        self._forget_said()
        speaking = bool(self._said) or bool(self._speech.values.any()) or self._speech.moving
        if speaking != self._speaking:
            self._speaking = speaking
            self._borrowed.move(0, Way(float(speaking), self._slices(BORROW_S if speaking else GIVE_BACK_S), "cosine"))
        saying = bool(self._said)
        if saying != self._saying:
            self._saying = saying
            self._telling.move(0, Way(float(saying), self._slices(BORROW_S if saying else GIVE_BACK_S), "cosine"))
        if saying:
            # What broke off stays while idle life takes over.
            life = self._said[0].utterance.life
            self._told = tuple((part, channel, float(values[self._said_loops])) for part, channel, values in life)
        events = [*self._happened]
        self._happened.clear()
        if self._said:
            turn = self._said[0]
            # Through the front door, so that the log has them and a replay needs no marks.
            replies = [self.handle(message) for message in turn.utterance.acts.get(self._said_loops, ())]
            events += (turn.failed(reply["message"]) for reply in replies if reply["kind"] == "error")
            events += turn.events(self._said_loops)
        return tuple(events)

    def _forget_said(self) -> None:
        """Let go of an utterance that is over."""
        if self._said and self._said_loops == self._said[0].utterance.loops:
            self._said.popleft()
            self._said_loops = 0

    def _slices(self, over_s: float) -> int:
        return count_slices(over_s, self.loop_s)

    def _move(self, message: Message) -> dict[str, Any]:
        slices, change = self._slices(message["over_ms"] / 1000.0), message["change"]
        layer: str = message["layer"]
        if layer in ("gaze", "speech"):
            motors = self._gaze if layer == "gaze" else self._speech
            targets = _channel_targets(message["values"])
            if layer == "gaze":
                self._looks.leave()
        else:
            motors = self._direct if layer == "direct" else self._expression
            targets = self._names.targets(message["values"])
        for row, value in targets.items():
            if layer == "direct" and self._held.values[row] < 1.0:
                self._direct.put(row, float(self.values[row]))
            if layer == "direct":
                self._held.put(row, 1.0)
            rest = float(self.rest.values[row]) if layer == "expression" else 0.0
            motors.move(row, Way(value - rest, slices, change))
        return {}

    def _play(self, message: Message) -> dict[str, Any]:
        name: str = message["motion"]
        if name not in self.motions:
            raise UnknownNameError("motion", name, self.motions)
        fitted = self._fitted.get(name)
        if fitted is None:
            fitted = self._fitted[name] = fit_motion(self.motions[name], self.face)
        ways = fitted.ways(self.loop_s, message["strength"], message["speed"], hold=message["hold"])
        rows = frozenset(row for row, _ in ways)
        first = ways[0][1][0].slices if ways else 1
        for other in [other for other, moved in self._playing.items() if self._regions(moved) & self._regions(rows)]:
            # Half of a smile under half of a frown is neither.
            self._rest(self._expression, self._playing.pop(other) - rows, first)
        for row, path in ways:
            self._expression.move(row, *path)
        self._playing[name] = rows
        return {"loops": max((sum(way.slices for way in path) for _, path in ways), default=0)}

    def _regions(self, rows: Iterable[int]) -> set[str]:
        """Groups of the table that rows are in."""
        return {self.face.parameters.rows[row].group for row in rows}

    def _spoken(self, message: Message) -> tuple[Message, Sound | None]:
        """The message with its phones, and its sound, so that the log does not need the voice again."""
        if message["phones"] is not None:
            return message, None
        if self._voice is None:
            raise MienError("say: this session has no voice — give phones, or a session with a voice")
        speech = self._voice(message["text"])
        cues = {
            name: tuple((cue.start_s, cue.end_s, cue.symbol) for cue in given)
            for name, given in (("phones", speech.phones), ("words", speech.words))
        }
        return replace(message, fields=MappingProxyType({**message.fields, **cues})), speech.sound

    def _say(self, message: Message, utterance: Utterance | None) -> dict[str, Any]:
        if len(self._said) == MOST_SAID:
            raise MienError(f"say: {MOST_SAID} texts are waiting — wait for speech.ended, or interrupt")
        if utterance is None:
            utterance = make_utterance(
                message["text"], message["phones"], message["words"] or (), rate=self.rate, seed=self.seed
            )
        if self.unsaid_s + utterance.loops * self.loop_s > MOST_SAID_S:
            raise MienError(f"say: more than {MOST_SAID_S:g} s are waiting — wait for speech.ended, or interrupt")
        turn = Turn(utterance, self._utterances, message["more"], message.id)
        self._utterances += 1
        self._said.append(turn)
        return {"loops": utterance.loops, "speech": turn.number}

    def _look(self, message: Message) -> dict[str, Any]:
        for channel, path in self._looks.look(message["at"], message["head"], self._gaze.values):
            self._gaze.move(channel, *path)
        return {}

    def _target(self, message: Message) -> dict[str, Any]:
        for channel, path in self._looks.place(message["name"], message["at"], self._gaze.values):
            self._gaze.move(channel, *path)
        return {}

    def _stop(self, message: Message) -> dict[str, Any]:
        slices = self._slices(message["over_ms"] / 1000.0)
        if message["names"] is not None:
            if message["layer"] != "direct":
                raise MienError("stop: 'names' are for the layer 'direct'")
            self._let_go(self._names.release(message["names"]), slices)
            return {}
        for layer in ("gaze", "expression", "speech", "direct") if message["layer"] is None else (message["layer"],):
            _STOPS[layer](self, slices)
        return {}

    def _reset(self, message: Message) -> dict[str, Any]:
        slices = self._slices(message["over_ms"] / 1000.0)
        for layer in ("gaze", "expression", "speech", "direct"):
            _STOPS[layer](self, slices)
        self._idle.restore(slices)
        return {}

    def _interrupt(self, message: Message) -> dict[str, Any]:
        slices = max(1, int(SILENT_S / self.loop_s + 1e-6))
        mouth = np.flatnonzero(self._mixer.mouth).tolist()
        self._stop_speech(slices)
        self._rest(self._expression, mouth, slices)
        self._names.forget(mouth)
        self._let_go(mouth, slices)
        return {}

    def _state(self, message: Message) -> dict[str, Any]:
        table = self.face.parameters
        names = message["names"] or [row.name for row in table if row.role in STATE_ROLES]
        values = self._names.read(dict(enumerate(self.values.tolist())), names)
        return {"kind": "state", "loop": self.loop, "values": values}

    def _switch(self, message: Message) -> dict[str, Any]:
        self._idle.switch({part: amount for part, amount in message.fields.items() if amount is not None})
        return {}

    def _stop_gaze(self, slices: int) -> None:
        self._looks.leave()
        self._rest(self._gaze, range(len(self._gaze.values)), slices)

    def _stop_expression(self, slices: int) -> None:
        self._playing.clear()
        self._rest(self._expression, range(len(self._expression.values)), slices)

    def _stop_speech(self, slices: int) -> None:
        """What is being said breaks off: the mouth goes to rest from where it is."""
        self._forget_said()
        if self._said_loops:
            self._speech.values[:] = self._mouth(self._said_loops - 1)
        self._happened += (turn.ended(broken_off=True) for turn in self._said)
        self._said.clear()
        self._said_loops = 0
        self._rest(self._speech, range(len(self._speech.values)), slices)

    def _stop_direct(self, slices: int) -> None:
        self._names.forget(range(len(self._held.values)))
        self._direct.halt()
        self._rest(self._held, range(len(self._held.values)), slices)

    def _let_go(self, rows: Iterable[int], slices: int) -> None:
        """Hold rows no longer in the layer ``direct``; they stay where they are while the others take over."""
        for row in rows:
            self._direct.move(row)
        self._rest(self._held, rows, slices)

    def _rest(self, motors: Motors, rows: Iterable[int], slices: int) -> None:
        """Let motors go back to 0; those that are there already have nothing pending any more."""
        for row in rows:
            motors.move(row, *([Way(0.0, slices, "cosine")] if motors.values[row] else []))


_ACTS: Mapping[str, Callable[[Session, Message], dict[str, Any]]] = MappingProxyType(
    {
        "move": Session._move,
        "play": Session._play,
        "look": Session._look,
        "target": Session._target,
        "stop": Session._stop,
        "interrupt": Session._interrupt,
        "reset": Session._reset,
        "state": Session._state,
        "idle": Session._switch,
    }
)

_STOPS: Mapping[str, Callable[[Session, int], None]] = MappingProxyType(
    {
        "gaze": Session._stop_gaze,
        "expression": Session._stop_expression,
        "speech": Session._stop_speech,
        "direct": Session._stop_direct,
        "idle": lambda session, slices: session._idle.fade(slices),
    }
)


def _channel_targets(values: Mapping[str, float]) -> dict[int, float]:
    """Channel number and value by the names of channels.

    Raises:
        UnknownNameError: there is no such channel.
        RangeError: a value is out of its range.
    """
    table = vocabulary(CHANNELS)
    for name in values:
        if name not in table:
            raise UnknownNameError("channel", name, [*table.names, *table.symmetric])
    return {table.index[row]: table[row].check(value) for name, value in values.items() for row in table.resolve(name)}
