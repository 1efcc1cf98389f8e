"""Figures of a mechanism, in the order in which one reads them."""

from typing import Final

from tribodyn.figures import chart, energy, wear
from tribodyn.figures.figure_family import Animation, Family
from tribodyn.mechanism.figures import animation as film
from tribodyn.mechanism.figures import joints, mechanism
from tribodyn.mechanism.results.readings import BALANCES
from tribodyn.mechanism.sections.charts import CHARTS

FIGURES: Final[dict[str, Family]] = {
    family.name: family
    for family in (
        mechanism.FAMILY,
        mechanism.MODE_SHAPES,
        *map(chart.family, CHARTS),
        joints.HODOGRAPHS,
        joints.ORBITS,
        *joints.MAPS,
        energy.family(BALANCES),
        wear.HISTORY,
    )
}

ANIMATION: Final = Animation(film.MechanismFilm, film.solids)
