"""The variable stator vane mechanism as the rest of the program sees it."""

from __future__ import annotations

from typing import Final

from tribodyn.cases.load import BuiltIn
from tribodyn.mechanisms.base import MechanismDescriptor
from tribodyn.mechanisms.output_numbers import BY_INSTANT, BY_OUTPUT
from tribodyn.papers.cheng_2022.reduced.case import VsvCase
from tribodyn.papers.cheng_2022.reduced.engine import ENGINE
from tribodyn.papers.cheng_2022.reduced.key_results import KEY_NUMBERS, KEY_RESULTS
from tribodyn.papers.cheng_2022.reduced.variables import OF_CYCLE, VARIABLES

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
