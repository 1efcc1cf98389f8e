"""Variables of the vane mechanism's results beside those of every result: one line a variable."""

from __future__ import annotations

from typing import Final

from tribodyn.kernels.vsv.quantities import AIR, COLLAR, ENERGIES, MOTION, REACTIONS, WATCHED
from tribodyn.results.outputs import OUTPUTS, OUTPUTS_OF_CYCLE
from tribodyn.results.peaks import of_reversals_described
from tribodyn.results.variables import JUMP, SNAPSHOT, Variable, described

OF_CYCLE: Final[dict[str, Variable]] = {
    "wear_pressure_max": Variable("Pa", "largest contact pressure in the cycle, impacts included", JUMP),
    "wear_pressure_mean": Variable("Pa", "peak contact pressure, mean over the cycle", JUMP),
    "wear_roughness": Variable("m", "combined rms roughness in the cycle", JUMP),
    "wear_force_mean": Variable("N", "contact force, mean over the cycle", JUMP),
    "wear_angle_error_max": Variable("rad", "vane-angle error, largest in the cycle", JUMP),
    "wear_angle_error_rms": Variable("rad", "vane-angle error, rms over the cycle", JUMP),
    **OUTPUTS_OF_CYCLE,
}
"""Numbers of each cycle that a wear campaign keeps."""

VARIABLES: Final[dict[str, Variable]] = {
    **described(MOTION, COLLAR, REACTIONS, AIR, ENERGIES),
    **of_reversals_described(WATCHED),
    **OUTPUTS,
    "snapshot_theta_v": Variable("rad", "vane angle of the snapshot", SNAPSHOT),
    "snapshot_direction": Variable("1", "direction of vane rotation at the snapshot, +1 or -1", SNAPSHOT),
    "energy_gravity": Variable("J", "gravity energy of all bodies, from the start"),
    "energy_drive": Variable("J", "work of the drive"),
    "energy_loads": Variable("J", "work of the loads"),
    "energy_friction": Variable("J", "friction heat of the bushing"),
    "energy_collar_friction": Variable("J", "friction heat of the thrust collar"),
    "energy_collar_tilt": Variable("J", "work done against the thrust collar by tilting"),
    "energy_damping": Variable("J", "damping heat of the contact"),
    "energy_expansion": Variable("J", "work of temperatures on what the contact stores"),
    "radial_clearance": Variable("m", "radial clearance at the temperatures of the time"),
    "energy_residual": Variable("J", "error of the energy balance of the whole mechanism"),
    "energy_clearance_inertia": Variable("J", "clearance motion: work of inertia"),
    "energy_clearance_loads": Variable("J", "clearance motion: work of loads and reactions"),
    "energy_clearance_contact": Variable("J", "clearance motion: energy stored in the contact"),
    "energy_clearance_friction": Variable("J", "clearance motion: friction heat"),
    "energy_clearance_collar": Variable("J", "clearance motion: work done against the thrust collar"),
    "energy_clearance_damping": Variable("J", "clearance motion: damping heat"),
    "energy_clearance_residual": Variable("J", "error of the energy balance of the clearance motion"),
}
"""By name."""
