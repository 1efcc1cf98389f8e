"""The variable stator vane mechanism as the rest of the program sees it."""

from typing import Final

from tribodyn.cases.load import BuiltIn
from tribodyn.kernels.vsv.quantities import AIR, COLLAR, ENERGIES, MOTION, REACTIONS, WATCHED
from tribodyn.mechanisms.mechanism_protocol import MechanismDescriptor
from tribodyn.mechanisms.output_numbers import BY_INSTANT, BY_OUTPUT
from tribodyn.papers.cheng_2022.reduced.case import VsvCase
from tribodyn.papers.cheng_2022.reduced.key_results import KEY_NUMBERS, KEY_RESULTS
from tribodyn.results.variables import (
    JUMP,
    OUTPUTS,
    OUTPUTS_OF_CYCLE,
    SNAPSHOT,
    Variable,
    described,
    of_reversals_described,
)

#: Numbers of each cycle that a wear campaign keeps.
OF_CYCLE: Final[dict[str, Variable]] = {
    "wear_pressure_max": Variable("Pa", "largest contact pressure in the cycle, impacts included", JUMP),
    "wear_pressure_mean": Variable("Pa", "peak contact pressure, mean over the cycle", JUMP),
    "wear_roughness": Variable("m", "combined rms roughness in the cycle", JUMP),
    "wear_force_mean": Variable("N", "contact force, mean over the cycle", JUMP),
    "wear_angle_error_max": Variable("rad", "vane-angle error, largest in the cycle", JUMP),
    "wear_angle_error_rms": Variable("rad", "vane-angle error, rms over the cycle", JUMP),
    **OUTPUTS_OF_CYCLE,
}

#: By name.
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


_POLYIMIDE: Final = "makeitfrom.com, 40% Graphite Thermoset PI (ASTM D6456 Type II Class 2), to 260 degC"
_STEEL: Final = "assumed: martensitic stainless steel"
_SOFTENED: Final = "the paper's when cold, three fifths of it at 300 degC; assumed"
_GAS: Final = "assumed: the size of the paper's M_air, here by the angle of the vane"

_VALUES: Final = {
    "title": ("Variable stator vane mechanism in an engine: 300 °C, elastic liner, gas loads", ""),
    "joint.clearance": ("43 um", "assumed: leaves some 20 um, the paper's clearance, at 300 degC"),
    "joint.liner.thickness": ("1.5 mm", "assumed"),
    "joint.form.chamfer_length": ("0.5 mm", "assumed"),
    "joint.form.chamfer_depth": ("20 um", "assumed"),
    "surfaces.trunnion.thermal_expansion": ("11e-6 1/K", _STEEL),
    "surfaces.bushing.thermal_expansion": ("38e-6 1/K", _POLYIMIDE),
    "temperature.trunnion": ("300 degC", "assumed"),
    "temperature.bushing": ("300 degC", "assumed"),
    "temperature.casing": ("300 degC", "assumed"),
    "temperature.fit": ("bonded", "assumed"),
    "temperature.casing_expansion": ("11e-6 1/K", _STEEL),
    "temperature.properties.temperatures": ("20, 300 degC", "assumed"),
    "temperature.properties.young_modulus": ("7.17, 4.30 GPa", _SOFTENED),
    "temperature.properties.hardness": ("492, 295 MPa", _SOFTENED),
    "loads.air_force_x": ("0 N", "in loads.more"),
    "loads.air_force_y": ("0 N", "in loads.more"),
    "loads.air_moment": ("0 N m", "in loads.more"),
    "loads.more.gas.moment.angles": ("50, 70, 90, 110, 130 deg", "assumed"),
    "loads.more.gas.moment.values": ("-0.84, -0.42, 0, 0.42, 0.84 N m", _GAS),
    "loads.more.gas.force_x.angles": ("50, 70, 90, 110, 130 deg", "assumed"),
    "loads.more.gas.force_x.values": ("-0.4, -0.3, 0, 0.3, 0.4 N", "assumed: the size of the paper's F_airx"),
    "loads.more.gas.force_y.value": ("1.2 N", "paper, Table 3"),
    "loads.more.gas.span.positions": ("10, 70, 150 mm", "assumed: from the bushing's end to the tip"),
    "loads.more.gas.span.values": ("8, 9, 7 N/m", "assumed"),
    "wear.specific_wear_rate": ("1.1e-15 m^2/N", "the paper's; at 300 degC it is not known"),
    "solver.grid.z": (24, "assumed: chamfers have points of their own"),
}

ENGINE: Final = BuiltIn(
    VsvCase,
    "the same in an engine at 300 degC: elastic liner, chamfers, gas loads from tables, 43 um at assembly",
    {path: value for path, (value, _) in _VALUES.items()},
    {path: origin for path, (_, origin) in _VALUES.items()},
)


MECHANISM: Final = MechanismDescriptor(
    folder="tribodyn.papers.cheng_2022.reduced",
    case=VsvCase,
    built_in={
        "vsv": BuiltIn(
            VsvCase,
            "variable stator vane mechanism, dry rough trunnion joint, 20 um clearance, two drive cycles",
        ),
        "vsv-engine": ENGINE,
    },
    variables=VARIABLES | OF_CYCLE,
    key_results=KEY_RESULTS,
    key_numbers=KEY_NUMBERS,
    of_cycle=OF_CYCLE,
    by_part={"outputs": BY_OUTPUT, "instants": BY_INSTANT},
    controls=(
        "joint.clearance",
        "joint.friction_coefficient",
        "surfaces.bushing.roughness",
        "asperities.density",
        "loads.air_moment",
        "loads.air_force_y",
        "drive.speed_amplitude",
        "contact.law",
    ),
    bearings="tribodyn.mechanisms.bushing:bearings",
)
