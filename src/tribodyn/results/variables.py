"""The variable table: name, unit, meaning and dimensions of everything a result may hold.

One line a variable, listed once. A mechanism that produces a new quantity adds its line here; the
builder, the NetCDF file and the documentation follow. All values are SI with angles in radians.
Signs are those of the theory manual: moments about X and Z are right-handed, about Y left-handed in the
joint; forces ``F_ab`` act on body ``b`` from body ``a``.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

TIME: Final = ("time",)
SNAPSHOT: Final = ("snapshot",)
JUMP: Final = ("jump",)
FRAME: Final = ("frame",)
STAGE: Final = ("stage_cycles",)
EVENTS: Final = frozenset((*TIME, *SNAPSHOT, *JUMP, *FRAME, *STAGE))
"""Dimensions along which a result may hold nothing: it ended before."""


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
    text
        Whether it holds texts rather than numbers.
    """

    units: str
    long_name: str
    dims: tuple[str, ...] = TIME
    text: bool = False


COORDINATES: Final[dict[str, Variable]] = {
    "law": Variable("1", "contact law, of runs side by side", ("law",), text=True),
    "time": Variable("s", "simulated time"),
    "snapshot": Variable("1", "number of the field snapshot", SNAPSHOT),
    "snapshot_time": Variable("s", "simulated time of the snapshot", SNAPSHOT),
    "snapshot_theta_v": Variable("rad", "vane angle of the snapshot", SNAPSHOT),
    "snapshot_direction": Variable("1", "direction of vane rotation at the snapshot, +1 or -1", SNAPSHOT),
    "frame": Variable("1", "number of the pressure frame, over the last cycle", FRAME),
    "frame_time": Variable("s", "simulated time of the pressure frame", FRAME),
    "jump": Variable("1", "number of the stop of a wear campaign", JUMP),
    "stage_cycles": Variable("1", "drive cycles at the worn profiles kept", STAGE),
    "theta": Variable("rad", "circumferential coordinate of the bushing", ("theta",)),
    "z": Variable("m", "axial coordinate of the bushing from its middle", ("z",)),
}

_ATTITUDE: Final[dict[str, Variable]] = {
    "e_x": Variable("m", "offset of the trunnion centre along X"),
    "e_y": Variable("m", "offset of the trunnion centre along Y"),
    "phi_x": Variable("rad", "tilt of the trunnion about X (right-handed)"),
    "phi_y": Variable("rad", "tilt of the trunnion about Y (left-handed)"),
    "e_x_dot": Variable("m s-1", "velocity of the trunnion centre along X"),
    "e_y_dot": Variable("m s-1", "velocity of the trunnion centre along Y"),
    "phi_x_dot": Variable("rad s-1", "tilt rate of the trunnion about X"),
    "phi_y_dot": Variable("rad s-1", "tilt rate of the trunnion about Y"),
}

_MOTION: Final[dict[str, Variable]] = {
    "theta_a": Variable("rad", "crank angle"),
    "theta_b": Variable("rad", "unison ring angle"),
    "theta_v": Variable("rad", "vane angle"),
    "theta_v_ideal": Variable("rad", "vane angle without clearance"),
    "omega_a": Variable("rad s-1", "crank speed"),
    "omega_v": Variable("rad s-1", "vane speed"),
    "omega_v_ideal": Variable("rad s-1", "vane speed without clearance"),
    "h_1": Variable("m", "axial travel of the unison ring"),
}

_JOINT: Final[dict[str, Variable]] = {
    "F_cx": Variable("N", "normal contact force on the trunnion along X"),
    "F_cy": Variable("N", "normal contact force on the trunnion along Y"),
    "F_kx": Variable("N", "rigid (asperity stiffness) part of the contact force along X"),
    "F_ky": Variable("N", "rigid (asperity stiffness) part of the contact force along Y"),
    "F_dx": Variable("N", "damping part of the contact force along X"),
    "F_dy": Variable("N", "damping part of the contact force along Y"),
    "F_fx": Variable("N", "friction force on the trunnion along X"),
    "F_fy": Variable("N", "friction force on the trunnion along Y"),
    "F_cz": Variable("N", "force of the thrust collar on the trunnion along Z"),
    "M_jcx": Variable("N m", "moment of the contact pressure about X"),
    "M_jcy": Variable("N m", "moment of the contact pressure about Y (left-handed)"),
    "M_fx": Variable("N m", "moment of the bushing friction about X"),
    "M_fy": Variable("N m", "moment of the bushing friction about Y (left-handed)"),
    "M_tcx": Variable("N m", "moment of the thrust collar about X"),
    "M_tcy": Variable("N m", "moment of the thrust collar about Y (left-handed)"),
    "M_jf": Variable("N m", "friction moment of the bushing about Z"),
    "M_tf": Variable("N m", "friction moment of the thrust collar about Z"),
    "p_max": Variable("Pa", "peak contact pressure in the bushing, edges included"),
    "separation_min": Variable("m", "smallest gap in the bushing, negative where mean surfaces overlap"),
    "tensile_clip_share": Variable(
        "1", "share of the contact force held back by the clip of tensile pressure"
    ),
    "M_kx": Variable("N m", "moment of the rigid part of the contact pressure about X"),
    "M_ky": Variable("N m", "moment of the rigid part of the contact pressure about Y (left-handed)"),
    "damping_power": Variable("W", "power of the damping pressure, turned into heat"),
    "friction_power": Variable("W", "power of the bushing friction, turned into heat"),
    "contact_fraction": Variable("1", "share of the bushing surface in contact"),
}

_FILM: Final[dict[str, Variable]] = {
    "F_ox": Variable("N", "force of the oil film on the journal along X"),
    "F_oy": Variable("N", "force of the oil film on the journal along Y"),
    "M_ox": Variable("N m", "moment of the oil film about X"),
    "M_oy": Variable("N m", "moment of the oil film about Y (left-handed)"),
    "M_of": Variable("N m", "friction moment of the oil film about Z"),
    "energy_film": Variable("J", "heat of the oil film"),
}

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

_REACTIONS: Final[dict[str, Variable]] = {
    "F_ax": Variable("N", "force of the casing on the crank pivot along X"),
    "F_ay": Variable("N", "force of the casing on the crank pivot along Y"),
    "F_az": Variable("N", "force of the casing on the crank pivot along Z"),
    "M_ax": Variable("N m", "moment of the casing on the crank pivot about X"),
    "M_az": Variable("N m", "moment of the casing on the crank pivot about Z"),
    "M_d": Variable("N m", "drive moment on the crank"),
    "F_21x": Variable("N", "force of the drag link on the crank along X"),
    "F_21y": Variable("N", "force of the drag link on the crank along Y"),
    "F_21z": Variable("N", "force of the drag link on the crank along Z"),
    "F_32x": Variable("N", "force of the unison ring on the drag link along X"),
    "F_32y": Variable("N", "force of the unison ring on the drag link along Y"),
    "F_32z": Variable("N", "force of the unison ring on the drag link along Z"),
    "F_43x": Variable("N", "force of the lever arm on the unison ring along X"),
    "F_43y": Variable("N", "force of the lever arm on the unison ring along Y"),
    "F_43z": Variable("N", "force of the lever arm on the unison ring along Z"),
    "F_bx": Variable("N", "force of the casing on the unison ring along X"),
    "F_bz": Variable("N", "force of the casing on the unison ring along Z"),
    "M_bx": Variable("N m", "moment of the casing on the unison ring about X"),
    "M_bz": Variable("N m", "moment of the casing on the unison ring about Z"),
    "F_airx": Variable("N", "aerodynamic force on the vane along X"),
    "F_airy": Variable("N", "aerodynamic force on the vane along Y"),
    "M_air": Variable("N m", "aerodynamic moment on the vane about Z"),
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
    "wear_volume": Variable("m3", "volume worn off the bushing up to the stop", JUMP),
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
    "stage_depth": Variable("m", "wear depth of the bushing, selected", (*STAGE, "theta", "z")),
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
    **_ATTITUDE,
    **_MOTION,
    **_JOINT,
    **_FILM,
    **_JOURNAL,
    **_REACTIONS,
    **_ENERGY,
    **_FIELDS,
    **_CAMPAIGN,
}
"""Every variable a result may hold, by name."""

POINT_TEXTS: Final[dict[str, str]] = {
    "failure": "why there are no numbers; empty where there are",
    "warnings": "what the run says about its own trustworthiness",
    "points": "name of the folder of the point below points/",
}
"""What a sweep says of each of its points in words, with its meaning; all else it holds are numbers."""
