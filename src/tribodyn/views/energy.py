"""An energy ledger over time."""

from __future__ import annotations

from functools import partial
from typing import Final

import xarray as xr

from tribodyn.views.charts import LOOKS, Chart, ChartCurve, Panel
from tribodyn.views.ledger import Ledger
from tribodyn.views.series import peak, series

_SEEN: Final = 0.01
"""Share of the largest term above which a term is drawn."""


def ledger_chart(ledger: Ledger, *, name: str, title: str, caption: str) -> Chart:
    """Return the chart of a ledger."""
    return Chart(name, title, caption, needs=(ledger.residual,), panels=partial(_panels, ledger))


def _panels(ledger: Ledger, dataset: xr.Dataset) -> list[Panel]:
    """Return one ledger, in J or mJ: what is seen beside the largest term, and what is missed."""
    terms = {name: label for name, label in ledger.terms.items() if name in dataset}
    sizes = {name: peak(series(dataset, name)) for name in terms}
    largest = max(sizes.values())
    unit, scale = ("J", 1.0) if largest >= 0.1 else ("mJ", 1e3)
    seen = sorted((name for name in terms if sizes[name] >= _SEEN * largest), key=lambda name: -sizes[name])
    curves = [
        ChartCurve(terms[name], series(dataset, name, scale), colour, dash)
        for name, (colour, dash) in zip(seen, LOOKS, strict=False)
    ]
    curves.append(ChartCurve("residual", series(dataset, ledger.residual, scale), "grey", width=4.0))
    return [Panel(f"energy [{unit}]", curves)]
