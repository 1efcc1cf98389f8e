"""The journal as the rest of the program sees it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Final

import xarray as xr

from tribodyn.cases.load import BuiltIn
from tribodyn.mechanisms.base import MechanismDescriptor
from tribodyn.presets.journal.case import JournalCase
from tribodyn.presets.journal.rows import VARIABLES
from tribodyn.results.reading import entries
from tribodyn.results.summary import KeyResult


def _one(name: str, scale: float = 1.0) -> Callable[[xr.Dataset], float]:
    """Return a reader of something a run has one of."""
    return lambda run: float(entries(run, name)) * scale


KEY_RESULTS: Final[dict[str, KeyResult]] = {
    "settling_time_ms": KeyResult(
        "Settling time",
        "ms",
        "Settling",
        "Time after which the centre stays within 1 % of the clearance of its static equilibrium; a rebound "
        "that just gets there moves it by its length.",
        _one("settling_time", 1e3),
        digits=1,
    ),
    "contact_start_ms": KeyResult(
        "Contact begins",
        "ms",
        "Settling",
        "When the first asperities meet: the gap falls below the onset separation.",
        _one("contact_start", 1e3),
    ),
    "rebounds": KeyResult(
        "Rebounds",
        "",
        "Settling",
        "How often the journal left contact again altogether.",
        _one("rebounds"),
        count=True,
    ),
    "contact_force_max_N": KeyResult(
        "Contact force, peak",
        "N",
        "Impact",
        "Load on the bushing in the hardest impact, at any step of the integration.",
        _one("contact_force_peak"),
    ),
    "film_force_max_N": KeyResult(
        "Film force, peak", "N", "Impact", "What the oil carries at most.", _one("film_force_peak")
    ),
    "peak_pressure_MPa": KeyResult(
        "Contact pressure, peak",
        "MPa",
        "Impact",
        "The same for the pressure; compare it with the hardness of the bushing.",
        _one("pressure_peak", 1e-6),
    ),
    "eccentricity_max_um": KeyResult(
        "Eccentricity, peak",
        "µm",
        "Impact",
        "How far the centre moves off the axis; beyond the clearance the mean planes overlap.",
        _one("eccentricity_peak", 1e6),
    ),
    "friction_coefficient": KeyResult(
        "Friction coefficient at the end",
        "",
        "Impact",
        "Friction moment of contact and film over journal radius and load.",
        _one("friction_coefficient_end"),
    ),
    "flash_temperature_K": KeyResult(
        "Flash temperature",
        "K",
        "Impact",
        "How much warmer than the surfaces their asperities get, an estimate, where pressure times speed is "
        "largest.",
        lambda run: float(run.attrs["flash_temperature"]),
        digits=2,
    ),
    "energy_residual_percent": KeyResult(
        "Energy residual",
        "%",
        "Trust",
        "Error of the energy balance over its largest term; below 1 % is sound.",
        lambda run: float(run.attrs["energy_residual"]) * 100.0,
    ),
}
"""By name, in reading order."""

KEY_NUMBERS: Final = ("settling_time_ms", "contact_force_max_N", "film_force_max_N")
"""Most important key results."""


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
