"""Figures of the journal, in the order in which one reads them."""

from __future__ import annotations

from typing import Final

from tribodyn.figures import chart, energy
from tribodyn.figures.base import Family
from tribodyn.mechanisms.journal.energy_balance import BALANCE
from tribodyn.mechanisms.journal.figures import path
from tribodyn.mechanisms.journal.sections.charts import DEVIATION, FORCES

FIGURES: Final[dict[str, Family]] = {
    family.name: family
    for family in (
        chart.family(DEVIATION),
        path.FAMILY,
        chart.family(FORCES),
        energy.family((BALANCE,)),
    )
}
