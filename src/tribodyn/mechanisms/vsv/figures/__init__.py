"""Figures of the vane mechanism, in the order in which one reads them."""

from __future__ import annotations

from typing import Final

from tribodyn.figures import chart, contact_force, energy, pressure, trajectory, wear, wear_history
from tribodyn.figures.base import Family
from tribodyn.mechanisms.vsv.figures import mechanism, vane_error
from tribodyn.mechanisms.vsv.ledger import LEDGERS
from tribodyn.mechanisms.vsv.sections.clearance import WARMING
from tribodyn.mechanisms.vsv.sections.motion import MOTION
from tribodyn.views.bushing_charts import TILT

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
        energy.family(LEDGERS),
        mechanism.FAMILY,
        wear_history.FAMILY,
    )
}
