"""Live sessions for tests: still ones, loops of them, and something to say."""

import hashlib

from mien.live import IDLE_PARTS, Session
from support import face

STILL = dict.fromkeys(IDLE_PARTS, 0.0)
FACES = ("head", "toon:olav", "toon:gus")
PHONES = [[0.0, 0.1, "HH"], [0.1, 0.25, "AH0"], [0.25, 0.35, "L"], [0.35, 0.7, "OW1"], [0.7, 0.9, "SIL"]]
SAY = {"kind": "say", "text": "Hello", "phones": PHONES, "words": [[0.0, 0.7, "Hello"]], "id": "7"}
WIDE = {"head": "jaw.rotation", "toon:olav": "mouth.bottom", "toon:gus": "mouth.bottom"}


def still(name="head", **more):
    return Session(face(name), idle=STILL, **more)


def run(session, loops):
    return [session.step() for _ in range(loops)]


def ok(session, **message):
    reply = session.handle(message)
    assert reply["kind"] in ("ok", "state"), reply
    return reply


def digest(frames):
    found = hashlib.sha256()
    for frame in frames:
        found.update(frame.pose.values.tobytes())
    return found.hexdigest()
