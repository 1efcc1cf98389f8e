"""The journal as the rest of the program sees it."""

from typing import Final

from tribodyn.cases.load import BuiltIn
from tribodyn.mechanisms.mechanism_protocol import MechanismDescriptor
from tribodyn.presets.journal.case import JournalCase
from tribodyn.presets.journal.results import KEY_RESULTS, VARIABLES

MECHANISM: Final = MechanismDescriptor(
    folder="tribodyn.presets.journal",
    views="tribodyn.mechanism",
    case=JournalCase,
    built_in={
        "journal-dry": BuiltIn(
            JournalCase, "journal under a constant load falling into its dry bushing, with damping"
        ),
        "journal-oil": BuiltIn(JournalCase, "the same in oil", {"film.lubricated": True}),
    },
    variables=VARIABLES,
    key_results=KEY_RESULTS,
    key_numbers=("settling_time_ms", "contact_force_max_N", "film_force_max_N"),
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
