"""The built-in case ``vsv-engine``: the mechanism of the paper as it might stand in a hot engine.

Lengths, masses, surfaces at room temperature and drive are the paper's. What an engine adds is here, each
number with where it comes from.
"""

from __future__ import annotations

from typing import Final

from tribodyn.cases.load import BuiltIn
from tribodyn.mechanisms.vsv.case import VsvCase

_DATA_SHEET: Final = "DuPont, Vespel S line design handbook: SP-21"
_STEEL: Final = "assumed: martensitic stainless steel"
_SCALED: Final = (
    "the paper's at 23 degC, at 260 degC by the modulus of Vespel SP-21 there (2.55 of 3.79 GPa, DuPont), "
    "beyond by a straight line; assumed"
)
_GAS: Final = "assumed: the size of the paper's M_air, here by the angle of the vane"

_VALUES: Final = {
    "title": ("Variable stator vane mechanism in an engine: 300 °C, elastic liner, gas loads", ""),
    "joint.clearance": ("52 um", "assumed: leaves some 20 um, the paper's clearance, at 300 degC"),
    "joint.liner.thickness": ("1.5 mm", "assumed"),
    "joint.form.chamfer_length": ("0.5 mm", "assumed"),
    "joint.form.chamfer_depth": ("20 um", "assumed"),
    "surfaces.trunnion.thermal_expansion": ("11e-6 1/K", _STEEL),
    "surfaces.bushing.thermal_expansion": ("49e-6 1/K", f"{_DATA_SHEET}, 23 to 300 degC"),
    "temperature.trunnion": ("300 degC", "assumed"),
    "temperature.bushing": ("300 degC", "assumed"),
    "temperature.casing": ("300 degC", "assumed"),
    "temperature.fit": ("bonded", "assumed"),
    "temperature.casing_expansion": ("11e-6 1/K", _STEEL),
    "temperature.properties.temperatures": ("23, 260, 300 degC", _DATA_SHEET),
    "temperature.properties.young_modulus": ("7.17, 4.82, 4.43 GPa", _SCALED),
    "temperature.properties.hardness": ("492, 331, 304 MPa", _SCALED),
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
    "solver.grid.z": (24, "assumed: chamfers have points of their own"),
}

ENGINE: Final = BuiltIn(
    VsvCase,
    "the same in an engine at 300 degC: elastic liner, chamfers, gas loads from tables, 52 um at assembly",
    {path: value for path, (value, _) in _VALUES.items()},
    {path: origin for path, (_, origin) in _VALUES.items()},
)
