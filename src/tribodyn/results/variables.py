"""The variable table: name, unit, meaning and dimensions of everything a result may hold.

One line a variable, listed once: observed quantities in the tables of their mechanism, all others here. The
builder, the NetCDF file and the documentation follow. All values are SI with angles in radians.
Signs are those of the theory manual: moments about X and Z are right-handed, about Y left-handed in the
joint; forces ``F_ab`` act on body ``b`` from body ``a``.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

from tribodyn.core.quantities import TIME, Table
from tribodyn.kernels.joints import quantities as joint
from tribodyn.kernels.journal import quantities as journal
from tribodyn.kernels.vsv import quantities as vsv

SNAPSHOT: Final = ("snapshot",)
JUMP: Final = ("jump",)
FRAME: Final = ("frame",)


@dataclass(frozen=True)
class Variable:
    """What a reader needs to know about one variable.

    Attributes
    ----------
    units
        SI unit as a UDUNITS string, ``"1"`` for a ratio.
    long_name
        Plain words, used as axis label and in the documentation.
    dims
        Dimensions of the array.
    """

    units: str
    long_name: str
    dims: tuple[str, ...] = TIME


COORDINATES: Final[dict[str, Variable]] = {
    "law": Variable("1", "contact law, of runs side by side", ("law",)),
    "time": Variable("s", "simulated time"),
    "snapshot": Variable("1", "number of the field snapshot", SNAPSHOT),
    "snapshot_time": Variable("s", "simulated time of the snapshot", SNAPSHOT),
    "snapshot_theta_v": Variable("rad", "vane angle of the snapshot", SNAPSHOT),
    "snapshot_direction": Variable("1", "direction of vane rotation at the snapshot, +1 or -1", SNAPSHOT),
    "frame": Variable("1", "number of the pressure frame, over the last cycle", FRAME),
    "frame_time": Variable("s", "simulated time of the pressure frame", FRAME),
    "jump": Variable("1", "number of the stop of a wear campaign", JUMP),
    "stage_cycles": Variable("1", "drive cycles at the worn profiles kept", ("stage_cycles",)),
    "theta": Variable("rad", "circumferential coordinate of the bushing", ("theta",)),
    "z": Variable("m", "axial coordinate of the bushing from its middle", ("z",)),
}


def _of(table: Table) -> dict[str, Variable]:
    """Return the variables that hold the quantities of a table."""
    return {entry.name: Variable(entry.unit, entry.meaning, entry.dimensions) for entry in table}


_OBSERVED: Final[dict[str, Variable]] = _of(
    (*joint.STATES, *vsv.MOTION, *joint.REPORTED, *vsv.COLLAR, *journal.FILM, *vsv.REACTIONS, *vsv.AIR)
)

_DERIVED: Final[dict[str, Variable]] = {
    "F_dx": Variable("N", "damping part of the contact force along X"),
    "F_dy": Variable("N", "damping part of the contact force along Y"),
    "energy_film": Variable("J", "heat of the oil film"),
}
"""What is worked out from observed quantities."""

_JOURNAL: Final[dict[str, Variable]] = {
    "settling_time": Variable(
        "s", "time after which the centre stays within 1 % of the clearance of its static equilibrium", ()
    ),
    "contact_start": Variable("s", "first output time at which any point is in contact", ()),
    "rebounds": Variable("1", "how often the journal left contact again", ()),
    "contact_force_peak": Variable("N", "largest contact force at any accepted step", ()),
    "contact_force_peak_time": Variable("s", "when the contact force was largest", ()),
    "film_force_peak": Variable("N", "largest film force at any accepted step", ()),
    "pressure_peak": Variable("Pa", "largest contact pressure at any accepted step", ()),
    "separation_least": Variable("m", "smallest gap at any accepted step", ()),
    "e_x_balance": Variable("m", "e_x of the static equilibrium", ()),
    "e_y_balance": Variable("m", "e_y of the static equilibrium", ()),
    "friction_coefficient_end": Variable("1", "friction moment over radius and load, at the end", ()),
    "residual_fraction": Variable("1", "largest energy residual over the largest energy", ()),
}

_ENERGY: Final[dict[str, Variable]] = {
    "energy_kinetic": Variable("J", "kinetic energy of all bodies"),
    "energy_gravity": Variable("J", "gravity energy of all bodies, from the start"),
    "energy_contact": Variable("J", "energy stored in the contact"),
    "energy_drive": Variable("J", "work of the drive"),
    "energy_loads": Variable("J", "work of the loads"),
    "energy_friction": Variable("J", "friction heat of the bushing"),
    "energy_collar_friction": Variable("J", "friction heat of the thrust collar"),
    "energy_collar_tilt": Variable("J", "work done against the thrust collar by tilting"),
    "energy_damping": Variable("J", "damping heat of the contact"),
    "energy_residual": Variable("J", "what the whole-mechanism ledger misses"),
    "energy_clearance_inertia": Variable("J", "clearance motion: work of inertia"),
    "energy_clearance_loads": Variable("J", "clearance motion: work of loads and reactions"),
    "energy_clearance_contact": Variable("J", "clearance motion: energy stored in the contact"),
    "energy_clearance_friction": Variable("J", "clearance motion: friction heat"),
    "energy_clearance_collar": Variable("J", "clearance motion: work done against the thrust collar"),
    "energy_clearance_damping": Variable("J", "clearance motion: damping heat"),
    "energy_clearance_residual": Variable("J", "what the clearance ledger misses"),
}

_CAMPAIGN: Final[dict[str, Variable]] = {
    "wear_cycles": Variable("1", "drive cycles of wear at the stop", JUMP),
    "wear_jump_cycles": Variable("1", "cycles that the cycle simulated there stands for", JUMP),
    "wear_depth_max": Variable("m", "wear depth at the deepest", JUMP),
    "worn_volume": Variable("m3", "volume worn off the bushing", JUMP),
    "wear_rate": Variable("m", "wear depth of one cycle where it wears fastest", JUMP),
    "wear_load_change": Variable(
        "1", "change of the sliding load since the stop before, over its peak", JUMP
    ),
    "wear_pressure_max": Variable("Pa", "largest contact pressure in the cycle, impacts included", JUMP),
    "wear_pressure_mean": Variable("Pa", "peak contact pressure, mean over the cycle", JUMP),
    "wear_force_mean": Variable("N", "contact force, mean over the cycle", JUMP),
    "wear_angle_error_max": Variable("rad", "vane-angle error, largest in the cycle", JUMP),
    "wear_angle_error_rms": Variable("rad", "vane-angle error, rms over the cycle", JUMP),
    "wear_energy_lost": Variable("J", "stored contact energy that the jump takes away", JUMP),
    "stage_depth": Variable("m", "wear depth of the bushing, selected", ("stage_cycles", "theta", "z")),
}

_FIELDS: Final[dict[str, Variable]] = {
    "pressure": Variable("Pa", "contact pressure", ("snapshot", "theta", "z")),
    "pressure_cycle": Variable("Pa", "contact pressure over one drive cycle", ("frame", "theta", "z")),
    "wear_depth": Variable(
        "m", "wear depth of the bushing, after the campaign or, estimated, after this run", ("theta", "z")
    ),
}

VARIABLES: Final[dict[str, Variable]] = {
    **COORDINATES,
    **_OBSERVED,
    **_DERIVED,
    **_JOURNAL,
    **_ENERGY,
    **_FIELDS,
    **_CAMPAIGN,
}
"""Every variable a result may hold, by name."""
