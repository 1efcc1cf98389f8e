"""Figures of a mechanism, in the order in which one reads them."""

from typing import Final

from tribodyn.figures import chart, pressure
from tribodyn.figures.chart import Animation, Family
from tribodyn.mechanism.figures import animation as film
from tribodyn.mechanism.figures import joints, mechanism
from tribodyn.mechanism.sections.charts import CHARTS, ENERGY
from tribodyn.mechanism.sections.joints import ORBITS
from tribodyn.views.wear import WEAR_HISTORY

FIGURES: Final[dict[str, Family]] = {
    family.name: family
    for family in (
        mechanism.FAMILY,
        mechanism.MODE_SHAPES,
        *map(chart.family, CHARTS),
        joints.COPIES_FIGURE,
        joints.HODOGRAPHS,
        pressure.family(ORBITS),
        *joints.MAPS,
        chart.family(ENERGY),
        chart.family(WEAR_HISTORY),
    )
}

ANIMATION: Final = Animation(film.MechanismFilm, film.solids)
