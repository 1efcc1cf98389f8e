"""What results of the vane mechanism hold beside what every result has: one line a variable."""

from __future__ import annotations

from typing import Final

from tribodyn.results.variables import JUMP, SNAPSHOT, Variable

OF_CYCLE: Final[dict[str, Variable]] = {
    "wear_pressure_max": Variable("Pa", "largest contact pressure in the cycle, impacts included", JUMP),
    "wear_pressure_mean": Variable("Pa", "peak contact pressure, mean over the cycle", JUMP),
    "wear_force_mean": Variable("N", "contact force, mean over the cycle", JUMP),
    "wear_angle_error_max": Variable("rad", "vane-angle error, largest in the cycle", JUMP),
    "wear_angle_error_rms": Variable("rad", "vane-angle error, rms over the cycle", JUMP),
}
"""What a wear campaign writes down about each cycle."""

VARIABLES: Final[dict[str, Variable]] = {
    "snapshot_theta_v": Variable("rad", "vane angle of the snapshot", SNAPSHOT),
    "snapshot_direction": Variable("1", "direction of vane rotation at the snapshot, +1 or -1", SNAPSHOT),
    "theta_a": Variable("rad", "crank angle"),
    "theta_b": Variable("rad", "unison ring angle"),
    "theta_v": Variable("rad", "vane angle"),
    "theta_v_ideal": Variable("rad", "vane angle without clearance"),
    "omega_a": Variable("rad s-1", "crank speed"),
    "omega_v": Variable("rad s-1", "vane speed"),
    "omega_v_ideal": Variable("rad s-1", "vane speed without clearance"),
    "h_1": Variable("m", "axial travel of the unison ring"),
    "F_cz": Variable("N", "force of the thrust collar on the trunnion along Z"),
    "M_tcx": Variable("N m", "moment of the thrust collar about X"),
    "M_tcy": Variable("N m", "moment of the thrust collar about Y (left-handed)"),
    "M_tf": Variable("N m", "friction moment of the thrust collar about Z"),
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
"""By name."""
