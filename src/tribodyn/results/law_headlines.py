"""Headline numbers of runs with several contact laws side by side: one of each kind for each law."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Final

import numpy as np
import xarray as xr

from tribodyn.results.headline import Headline

_LAW: Final = "{law}"


def _one(name: str, scale: float = 1.0) -> Callable[[xr.Dataset], float]:
    """Return a reader of something a run has one of."""
    return lambda run: float(run[name].values) * scale


def _eccentricity(run: xr.Dataset) -> float:
    """Return the largest eccentricity [µm]."""
    e = np.hypot(run["e_x"].values, run["e_y"].values)
    finite = e[np.isfinite(e)]
    return float(finite.max()) * 1e6 if finite.size else math.nan


LAW_HEADLINES: Final[dict[str, Headline]] = {
    "settling_time_{law}_ms": Headline(
        "Settling time",
        "ms",
        "Settling",
        "Time after which the centre stays within 1 % of the clearance of its static equilibrium.",
        _one("settling_time", 1e3),
    ),
    "contact_start_{law}_ms": Headline(
        "Contact begins",
        "ms",
        "Settling",
        "When the first asperities meet: the gap falls below the onset separation.",
        _one("contact_start", 1e3),
    ),
    "rebounds_{law}": Headline(
        "Rebounds", "", "Settling", "How often the journal left contact again altogether.", _one("rebounds")
    ),
    "contact_force_max_{law}_N": Headline(
        "Contact force, largest",
        "N",
        "Impact",
        "Peak load on the bushing, at any step of the integration.",
        _one("contact_force_peak"),
    ),
    "film_force_max_{law}_N": Headline(
        "Film force, largest", "N", "Impact", "What the oil carries at most.", _one("film_force_peak")
    ),
    "peak_pressure_{law}_MPa": Headline(
        "Contact pressure, largest",
        "MPa",
        "Impact",
        "Compare it with the hardness of the bushing.",
        _one("pressure_peak", 1e-6),
    ),
    "eccentricity_max_{law}_um": Headline(
        "Eccentricity, largest",
        "µm",
        "Impact",
        "How far the centre moves off the axis; beyond the clearance the mean planes overlap.",
        _eccentricity,
    ),
    "friction_coefficient_{law}": Headline(
        "Friction coefficient at the end",
        "",
        "Impact",
        "Friction moment of contact and film over journal radius and load.",
        _one("friction_coefficient_end"),
    ),
    "energy_residual_{law}_percent": Headline(
        "Energy residual",
        "%",
        "Ledger",
        "What the energy ledger of this law's run misses.",
        _one("residual_fraction", 100.0),
    ),
}
"""Every such number; ``{law}`` in a name stands for the name of the law."""


def named(template: str, law: str) -> str:
    """Return the name of a headline number for one law."""
    return template.replace(_LAW, law)


def law_in(name: str, template: str) -> str | None:
    """Return the law that a name was made for from a template; nothing where it was not."""
    before, _, after = template.partition(_LAW)
    inside = len(name) > len(before) + len(after)
    if not (inside and name.startswith(before) and name.endswith(after)):
        return None
    return name[len(before) : len(name) - len(after)]
