"""Units of the dissertation in metres and radians."""

import math

PARKE_UNIT_M = 0.00016
"""One of Parke's units: an eyeball of his nominal size 75 then has the anatomical radius of 12 mm."""

DEG = math.pi / 180.0
MM = 0.001
