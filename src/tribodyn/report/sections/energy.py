"""The two energy ledgers over time."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final

import xarray as xr

from tribodyn.figures.energy import CLEARANCE, WHOLE
from tribodyn.figures.style import peak, series
from tribodyn.report.base import Payload, Section
from tribodyn.report.lines import LOOKS, Curve, Panel, over_time

_SEEN: Final = 0.01
"""Share of the largest term above which a term is drawn."""


def whole(dataset: xr.Dataset) -> Payload | None:
    """Return the ledger of the whole mechanism."""
    return over_time(dataset, [_panel(dataset, WHOLE)])


def clearance(dataset: xr.Dataset) -> Payload | None:
    """Return the ledger of the motion in the clearance."""
    return over_time(dataset, [_panel(dataset, CLEARANCE)])


def _panel(dataset: xr.Dataset, terms: Mapping[str, str]) -> Panel:
    """Return one ledger, in J or mJ: what is seen beside the largest term, and what is missed."""
    sizes = {term: peak(series(dataset, term)) for term in terms}
    largest = max(sizes.values())
    unit, scale = ("J", 1.0) if largest >= 0.1 else ("mJ", 1e3)
    seen = [term for term in terms if sizes[term] >= _SEEN * largest and not term.endswith("residual")]
    seen = sorted(seen, key=lambda term: -sizes[term])[: len(LOOKS)]
    curves = [
        Curve(terms[term], series(dataset, term, scale), colour, dash)
        for term, (colour, dash) in zip(seen, LOOKS, strict=False)
    ]
    residual = next(term for term in terms if term.endswith("residual"))
    curves.append(Curve("residual", series(dataset, residual, scale), "grey", width=4.0))
    return Panel(f"energy [{unit}]", curves)


LEDGER: Final = Section(
    name="energy",
    title="Energy ledger of the whole mechanism",
    caption=(
        "What all bodies, the drive and the loads took in, stored and turned into heat since the start. The "
        "residual is what the sum misses: an error of the integration would show there."
    ),
    needs=tuple(WHOLE),
    widget="lines",
    data=whole,
    still="energy",
)
CLEARANCE_LEDGER: Final = Section(
    name="clearance-energy",
    title="Energy ledger of the motion in the clearance",
    caption=(
        "The same for the small motion of the trunnion alone, where an error in the contact heat cannot hide "
        "behind the work of the drive. Steps are the impacts after reversals."
    ),
    needs=tuple(CLEARANCE),
    widget="lines",
    data=clearance,
)
