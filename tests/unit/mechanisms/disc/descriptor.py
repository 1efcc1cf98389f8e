"""The disc as the rest of the program sees it."""

from falling_disc.case import DiscCase
from falling_disc.variables import VARIABLES

from tribodyn.cases.load import BuiltIn
from tribodyn.mechanisms.mechanism_protocol import MechanismDescriptor
from tribodyn.results.reading import column, peak
from tribodyn.results.summary import KeyResult

MECHANISM = MechanismDescriptor(
    folder="falling_disc",
    case=DiscCase,
    built_in={"disc": BuiltIn(DiscCase, "a disc that falls on an elastic floor")},
    variables=VARIABLES,
    key_results={
        "floor_force_max_N": KeyResult(
            "Force of the floor, largest",
            "N",
            "Load",
            "What the floor bears.",
            lambda d: peak(column(d, "floor_force")),
        )
    },
    key_numbers=("floor_force_max_N",),
)
