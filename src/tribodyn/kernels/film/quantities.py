"""Observed quantities of the oil film of a joint."""

from typing import Final

from tribodyn.core.quantities import Quantity, of_table

FILM: Final = (
    Quantity("film_force", "N", "force of the oil film on the shaft, axes of the joint", size=3),
    Quantity(
        "film_moment",
        "N m",
        "moment of the oil film on the shaft, axes of the joint; about the axis that of its friction",
        size=3,
    ),
    Quantity("film_pressure_max", "Pa", "largest pressure in the oil film"),
    Quantity("film_thickness_min", "m", "smallest gap of the oil film, negative where mean surfaces overlap"),
    Quantity("film_leakage", "m3 s-1", "volume of oil that leaves both ends per second"),
)
"""The report of an instant."""

FILM_PEAKS: Final = (
    Quantity("film_force_peak", "N", "largest film force at any accepted step", ()),
    Quantity("film_force_peak_time", "s", "when the film force was largest", ()),
    Quantity("film_pressure_peak", "Pa", "largest film pressure at any accepted step", ()),
    Quantity("film_pressure_peak_time", "s", "when the film pressure was largest", ()),
    Quantity("film_thickness_least", "m", "smallest gap of the oil film at any accepted step", ()),
)
"""Over all accepted steps; output times would miss them."""

Report = of_table(FILM)
Peaks = of_table(FILM_PEAKS)
