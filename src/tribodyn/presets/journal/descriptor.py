"""The journal as the rest of the program sees it."""

from __future__ import annotations

from typing import Final

from tribodyn.cases.load import BuiltIn
from tribodyn.mechanisms.base import MechanismDescriptor
from tribodyn.presets.journal.case import JournalCase
from tribodyn.presets.journal.key_results import KEY_NUMBERS, KEY_RESULTS
from tribodyn.presets.journal.variables import VARIABLES

MECHANISM: Final = MechanismDescriptor(
    folder="tribodyn.presets.journal",
    case=JournalCase,
    built_in={
        "journal-dry": BuiltIn(
            JournalCase, "journal under a constant load falling into its dry bushing, with damping"
        ),
        "journal-oil": BuiltIn(JournalCase, "the same in oil", {"film.lubricated": True}),
    },
    variables=VARIABLES,
    key_results=KEY_RESULTS,
    key_numbers=KEY_NUMBERS,
    controls=(
        "joint.clearance",
        "joint.friction_coefficient",
        "surfaces.bushing.roughness",
        "asperities.density",
        "loads.force_x",
        "loads.force_y",
        "journal.mass",
        "contact.law",
    ),
    bearings="tribodyn.mechanisms.bushing:bearings",
)
