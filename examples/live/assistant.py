"""A voice assistant: speaks while its answer is still being thought of, and falls silent when it is interrupted.

Start before: mien live. Then type a question; a line that comes while the face talks breaks it off.
"""

import sys
import time
from collections.abc import Iterator
from threading import Thread

import mien


def think(question: str) -> Iterator[str]:
    """An answer word by word, as a language model gives it: put yours here."""
    answer = f"You said: {question}. [think] Let me see. [nod] Yes."
    for word in answer.split(" "):
        time.sleep(0.05)
        yield word + " "


def main() -> None:
    with mien.Client() as face:

        def reply(question: str) -> None:
            said = face.say_stream(think(question), wait=True)
            print("broken off" if said.broken_off else "said", flush=True)

        talking: Thread | None = None
        for line in sys.stdin:
            if talking:
                face.interrupt()
                talking.join()
            talking = Thread(target=reply, args=(line.strip(),))
            talking.start()
        if talking:
            talking.join()


if __name__ == "__main__":
    main()
