"""Figures of the vane mechanism, in the order in which one reads them."""

from typing import Final

from tribodyn.figures import chart, contact_force, energy, pressure, trajectory, wear
from tribodyn.figures.figure_family import Family
from tribodyn.papers.cheng_2022.reduced.checks import BALANCES
from tribodyn.papers.cheng_2022.reduced.figures import mechanism, vane_error
from tribodyn.papers.cheng_2022.reduced.sections.motion import MOTION, WARMING
from tribodyn.views.bushing_sections import TILT

FIGURES: Final[dict[str, Family]] = {
    family.name: family
    for family in (
        chart.family(MOTION),
        chart.family(WARMING),
        vane_error.FAMILY,
        contact_force.FAMILY,
        trajectory.FAMILY,
        chart.family(TILT),
        pressure.FAMILY,
        wear.FAMILY,
        energy.family(BALANCES),
        mechanism.FAMILY,
        wear.HISTORY,
    )
}
