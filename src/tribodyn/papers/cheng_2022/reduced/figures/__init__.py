"""Figures of the vane mechanism, in the order in which one reads them."""

from typing import Final

from tribodyn.figures import chart, orbits, pressure, wear
from tribodyn.figures.figure_family import Family
from tribodyn.papers.cheng_2022.reduced.figures import mechanism
from tribodyn.papers.cheng_2022.reduced.sections import CHARTS
from tribodyn.views.bushing_sections import ORBIT
from tribodyn.views.wear import WEAR_HISTORY

FIGURES: Final[dict[str, Family]] = {
    family.name: family
    for family in (
        *map(chart.family, CHARTS),
        orbits.family(ORBIT),
        pressure.FAMILY,
        wear.FAMILY,
        mechanism.FAMILY,
        chart.family(WEAR_HISTORY),
    )
}
