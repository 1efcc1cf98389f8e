"""The built-in case ``vsv-engine``: the mechanism of the paper as it might stand in a hot engine.

Lengths, masses, surfaces at room temperature and drive are the paper's. What an engine adds is here, each
number with where it comes from.
"""

from __future__ import annotations

from typing import Final

from tribodyn.cases.load import BuiltIn
from tribodyn.papers.cheng_2022.reduced.case import VsvCase

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
