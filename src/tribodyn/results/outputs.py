"""Variables of the outputs of a mechanism in results, and the units in which their errors are shown."""

import math
from collections.abc import Mapping
from dataclasses import replace
from typing import Any, Final, NamedTuple

import numpy as np

from tribodyn.core.quantities import TIME
from tribodyn.results.variables import JUMP, Variable

_OUTPUT: Final = (*TIME, "output")
_INSTANT: Final = ("instant",)


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
    "rad/s": ErrorUnit("deg_per_s", "°/s", 180.0 / math.pi),
}
"""By the SI unit of the output."""

OUTPUTS: Final[dict[str, Variable]] = {
    "output": Variable("", "name of the output", ("output",), named=True, names="outputs"),
    "output_unit": Variable("", "unit of the output", ("output",), named=True),
    "output_value": Variable("1", "value of the output, in its unit", _OUTPUT),
    "output_ideal": Variable("1", "value with ideal joints and the same drives, in its unit", _OUTPUT),
    "output_error": Variable("1", "difference from the ideal motion, in the unit of the output", _OUTPUT),
    "output_error_limit": Variable(
        "1", "error at which the mechanism is worn out, in the unit of the output", ("output",)
    ),
    "output_life": Variable(
        "1", "drive cycles until the error reaches its limit, a linear estimate of one run", ("output",)
    ),
    "instant": Variable("", "where an error is read", _INSTANT, named=True, parts="instants"),
    "instant_output": Variable("", "name of the output whose error is read", _INSTANT, named=True),
    "error_at": Variable("1", "mean error at the instant, in the unit of the output", _INSTANT),
    "error_at_forward": Variable(
        "1", "the same while the drive runs forward, where it runs in both directions", _INSTANT
    ),
    "error_at_backward": Variable("1", "the same while the drive runs backward", _INSTANT),
}
"""By name; an error in all directions is the length of a vector."""
OUTPUTS_OF_CYCLE: Final = {
    "wear_error_share": Variable(
        "1", "largest error of an output in the cycle over its limit; zero without limits", JUMP
    )
}
"""Numbers of each cycle that a wear campaign keeps."""

_IN_THEIR_UNIT: Final = (
    "output_value",
    "output_ideal",
    "output_error",
    "output_error_limit",
    "error_at",
    "error_at_forward",
    "error_at_backward",
)


def in_output_unit(known: Mapping[str, Variable], units: Any) -> dict[str, Variable]:
    """Return descriptions of variables, those in units of outputs with the unit that all outputs share."""
    shared = sorted({str(unit) for unit in np.asarray(units).ravel()})
    if len(shared) != 1:
        return {**known}
    return {**known, **{n: replace(known[n], units=shared[0]) for n in _IN_THEIR_UNIT if n in known}}
