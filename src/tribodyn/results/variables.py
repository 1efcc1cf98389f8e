"""Types of variables of results, and variables that several mechanisms share, outputs among them.

One line a variable, listed once: here where mechanisms share it, beside the mechanism where it is its own.
The builder, the NetCDF file and the documentation follow. All values are SI with angles in radians.
Signs are those of the theory manual: moments about X and Z are right-handed, about Y left-handed in the
joint; forces ``F_ab`` act on body ``b`` from body ``a``.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any, Final, NamedTuple

import numpy as np

from tribodyn.core.quantities import TIME, Table
from tribodyn.kernels.joints.quantities import REPORTED, STATES

SNAPSHOT: Final = ("snapshot",)
JUMP: Final = ("jump",)
FRAME: Final = ("frame",)
REVERSAL: Final = ("reversal",)
STAGE: Final = ("stage_cycles",)
#: Dimensions along which a result may hold nothing: it ended before.
EVENTS: Final = frozenset((*TIME, *SNAPSHOT, *JUMP, *FRAME, *REVERSAL, *STAGE))


@dataclass(frozen=True)
class Variable:
    """Description of one variable for a reader."""

    units: str  #: SI unit as a UDUNITS string, ``"1"`` for a ratio.
    long_name: str  #: Plain words, used as axis label and in the documentation.
    dims: tuple[str, ...] = TIME  #: Dimensions of the array.
    #: Whether it holds names instead of numbers: what a dimension counts, such as bodies.
    named: bool = False
    #: The names that it then must hold, or the table of the case that gives them; empty where any will do.
    names: tuple[str, ...] | str = ()
    parts: str = ""  #: What key results call the parts that it names, where that is no table of the case.


COORDINATES: Final[dict[str, Variable]] = {
    "time": Variable("s", "simulated time"),
    "snapshot": Variable("1", "number of the field snapshot", SNAPSHOT),
    "snapshot_time": Variable("s", "simulated time of the snapshot", SNAPSHOT),
    "frame": Variable("1", "number of the pressure frame, over the last cycle", FRAME),
    "frame_time": Variable("s", "simulated time of the pressure frame", FRAME),
    "reversal": Variable("1", "number of the reversal; 0 is the start of the run", REVERSAL),
    "reversal_time": Variable("s", "simulated time of the reversal", REVERSAL),
    "jump": Variable("1", "number of the stop of a wear campaign", JUMP),
    "stage_cycles": Variable("1", "drive cycles at the worn profiles kept", STAGE),
    "theta": Variable("rad", "circumferential coordinate of the bushing", ("theta",)),
    "z": Variable("m", "axial coordinate of the bushing from its middle", ("z",)),
}


def described(*tables: Table) -> dict[str, Variable]:
    """Return the descriptions of quantities by the tables of the kernels that compute them."""
    return {q.name: Variable(q.unit, q.meaning, q.dimensions) for table in tables for q in table}


#: Motion of a shaft in its bushing, and what acts on it there.
BUSHING: Final[dict[str, Variable]] = {
    **described(STATES, REPORTED),
    "F_dx": Variable("N", "damping part of the contact force along X"),
    "F_dy": Variable("N", "damping part of the contact force along Y"),
}

#: Fields over the nodes of the bushing.
FIELDS: Final[dict[str, Variable]] = {
    "pressure": Variable("Pa", "contact pressure", ("snapshot", "theta", "z")),
    "pressure_cycle": Variable("Pa", "contact pressure over one drive cycle", ("frame", "theta", "z")),
    "wear_depth": Variable(
        "m", "wear depth of the bushing, after the campaign or, estimated, after this run", ("theta", "z")
    ),
    "partner_wear_depth": Variable("m", "part of wear_depth worn off the partner", ("theta", "z")),
}

#: Numbers of every wear campaign at its stops; a mechanism adds its own of each cycle.
CAMPAIGN: Final[dict[str, Variable]] = {
    "wear_cycles": Variable("1", "drive cycles of wear at the stop", JUMP),
    "wear_jump_cycles": Variable("1", "cycles that the cycle simulated there stands for", JUMP),
    "wear_depth_max": Variable("m", "wear depth at the deepest", JUMP),
    "wear_volume": Variable("m3", "volume worn off the bushing up to the stop", JUMP),
    "wear_rate": Variable("m", "wear depth of one cycle where it wears fastest", JUMP),
    "wear_load_change": Variable(
        "1", "change of the sliding load since the stop before, over its peak", JUMP
    ),
    "wear_energy_lost": Variable("J", "stored contact energy that the jump takes away", JUMP),
}

#: Worn profiles that are kept of a campaign.
STAGES: Final[dict[str, Variable]] = {
    "stage_depth": Variable("m", "wear depth of the bushing, selected", (*STAGE, "theta", "z"))
}

#: Every variable that mechanisms share, by name.
VARIABLES: Final[dict[str, Variable]] = {**COORDINATES, **BUSHING, **FIELDS, **CAMPAIGN, **STAGES}

#: Texts of a sweep on each of its points, with their meanings; all else it holds are numbers.
POINT_TEXTS: Final[dict[str, str]] = {
    "failure": "why there are no numbers; empty where there are",
    "warnings": "what the run says about its own trustworthiness",
    "doubtful": "why the numbers should not be used; empty where they can be",
    "points": "name of the folder of the point below points/",
}


#: Parts of the time from one reversal to the next, in the order of the kernels.
PARTS: Final = {
    "impact": "in the impacts after the reversal",
    "outside": "from these impacts to the next reversal",
}


def of_reversals_described(table: Table, part_of: tuple[str, ...] = ()) -> dict[str, Variable]:
    """Return the descriptions of the peaks of each reversal, and of each part of a mechanism, by name."""
    described = {}
    for quantity in table:
        for part, where in PARTS.items():
            meaning = f"largest {quantity.meaning} {where}"
            described[f"{quantity.name}_{part}"] = Variable(quantity.unit, meaning, (*REVERSAL, *part_of))
            described[f"{quantity.name}_{part}_time"] = Variable(
                "s", f"time of the {meaning}", (*REVERSAL, *part_of)
            )
    return described


_OUTPUT: Final = (*TIME, "output")
_INSTANT: Final = ("instant",)


class ErrorUnit(NamedTuple):
    """A unit of errors."""

    spelled: str  #: As names of key results have it.
    shown: str  #: As people write it.
    scale: float  #: How many of it are the SI unit.


#: By the SI unit of the output.
ERROR_UNITS: Final = {
    "m": ErrorUnit("um", "µm", 1e6),
    "rad": ErrorUnit("deg", "°", 180.0 / math.pi),
    "m/s": ErrorUnit("mm_per_s", "mm/s", 1e3),
    "rad/s": ErrorUnit("deg_per_s", "°/s", 180.0 / math.pi),
}

#: By name; an error in all directions is the length of a vector.
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
#: Numbers of each cycle that a wear campaign keeps.
OUTPUTS_OF_CYCLE: Final = {
    "wear_error_share": Variable(
        "1", "largest error of an output in the cycle over its limit; zero without limits", JUMP
    )
}

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
