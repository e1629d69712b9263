"""A robot's face: its eyes follow an object, as the camera of the robot would tell where it is.

Start before: mien live --osc-port 39539
"""

import math
import socket
import struct
import sys
import time

import mien


def osc(address: str, *values: float) -> bytes:
    """An OSC message of numbers: address and types, padded with zeros to fours, then big-endian floats."""
    texts = (text.encode() for text in (address, "," + "f" * len(values)))
    return b"".join(text + bytes(4 - len(text) % 4) for text in texts) + struct.pack(f">{len(values)}f", *values)


def main(steps: int = 200, every_s: float = 0.05) -> None:
    with mien.Client() as face, socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as eyes:
        port = face.about()["ports"]["osc"]
        for step in range(steps):
            # Metres from the middle of the face: x to its own left, y up, z forward.
            x, y, z = 0.4 * math.sin(step * every_s), 0.1, 0.7
            eyes.sendto(osc("/mien/look", x, y, z), ("127.0.0.1", port))
            time.sleep(every_s)
            pupil = face.state("PLH")["PLH"]  # degrees; positive is to the left as one sees the picture
            print(f"object {math.degrees(math.atan2(x, z)):6.1f} deg, pupil {pupil:6.1f} deg")
        face.look("viewer")


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
