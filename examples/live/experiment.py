"""An experiment: which expression came in which loop, exactly; the log gives the same frames again.

Start before: mien live --rate 100 --idle blinks=0,saccades=0,breathing=0,sway=0 --log trial.log
And afterwards: mien replay trial.log -o trial.csv
"""

import random
import sys
import time

import mien

MOTIONS = ("smile", "frown", "surprise", "disgust")


def main(trials: int = 8, pause_s: float = 3.0) -> None:
    order = random.Random(1996).choices(MOTIONS, k=trials)
    with mien.Client() as face:
        rate_hz = face.about()["rate_hz"]
        print("trial,motion,loop,time_s")
        for trial, motion in enumerate(order, start=1):
            # What comes in one list acts from the same loop on.
            _, state = face.send([{"kind": "play", "motion": motion}, {"kind": "state"}])
            print(f"{trial},{motion},{state['loop']},{state['loop'] / rate_hz:.3f}")
            time.sleep(pause_s)


if __name__ == "__main__":
    main(*(kind(text) for kind, text in zip((int, float), sys.argv[1:], strict=False)))
