"""Units in which errors of outputs are shown."""

from __future__ import annotations

import math
from typing import Final, NamedTuple


class ErrorUnit(NamedTuple):
    """A unit of errors.

    Attributes
    ----------
    spelled
        As names of key results have it.
    shown
        As people write it.
    scale
        How many of it are the SI unit.
    """

    spelled: str
    shown: str
    scale: float


ERROR_UNITS: Final = {
    "m": ErrorUnit("um", "µm", 1e6),
    "rad": ErrorUnit("deg", "°", 180.0 / math.pi),
    "m/s": ErrorUnit("mm_per_s", "mm/s", 1e3),
}
"""By the SI unit of the output."""
