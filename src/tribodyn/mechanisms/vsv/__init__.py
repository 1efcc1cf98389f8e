"""The variable stator vane mechanism with one clearance joint at the vane trunnion."""

from __future__ import annotations

from tribodyn.mechanisms.vsv.equilibrium import equilibrium
from tribodyn.mechanisms.vsv.parameters import AirLoads, Drive, Inertias, Lengths, Vsv
from tribodyn.mechanisms.vsv.problem import Carried, vsv_data, vsv_memory, vsv_problem
from tribodyn.mechanisms.vsv.reach import check_reach, ideal_vane_angle

__all__ = [
    "AirLoads",
    "Carried",
    "Drive",
    "Inertias",
    "Lengths",
    "Vsv",
    "check_reach",
    "equilibrium",
    "ideal_vane_angle",
    "vsv_data",
    "vsv_memory",
    "vsv_problem",
]
