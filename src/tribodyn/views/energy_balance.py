"""Energy balances: the columns of a result that balance, and their residual.

Energies gained and heats, minus works put in, are zero up to the error of the integration.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Final

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.views.charts import LOOKS, Chart, ChartCurve, Panel
from tribodyn.views.playback import peak, series

if TYPE_CHECKING:
    import xarray as xr


@dataclass(frozen=True)
class EnergyTerm:
    """Origin of an energy column in the observed rows."""

    row: str  #: Name of the observed quantity.
    sign: float = 1.0  #: -1 for the work of a force that turns into heat, else 1.
    since_start: bool = False  #: Whether the column is the change since the start.

    def column(self, rows: Mapping[str, FloatArray]) -> FloatArray:
        """Return the column [J], shape (n_t,)."""
        values = self.sign * rows[self.row]
        return _since_start(values) if self.since_start else values


def energy_columns(
    rows: Mapping[str, FloatArray], terms: Mapping[str, EnergyTerm], balances: Sequence[EnergyBalance]
) -> dict[str, FloatArray]:
    """Return the columns of energy balances and their residuals [J], each of shape (n_t,).

    ``rows``: observed quantities by name; ``terms``: origin of each column; ``balances``: the balances of
    these columns.
    """
    columns = {name: term.column(rows) for name, term in terms.items()}
    return columns | {balance.residual: balance.left_over(columns) for balance in balances}


@dataclass(frozen=True)
class EnergyBalance:
    """One energy balance of a mechanism."""

    title: str  #: What is balanced.
    put_in: Mapping[str, str]  #: Columns of work put in, with what figures call them.
    gained: Mapping[str, str]  #: Columns of energy gained, stored or turned into heat, likewise.
    residual: str  #: Name of the column of what is left over.
    measure: tuple[str, ...]  #: Columns against whose largest size the residual is measured.
    attribute: str  #: Attribute of a result that holds the largest residual as a fraction of that.
    yardstick: str  #: That size in words.

    @property
    def terms(self) -> dict[str, str]:
        """All columns but the residual, with what figures call them."""
        return {**self.put_in, **self.gained}

    def left_over(self, columns: Mapping[str, FloatArray]) -> FloatArray:
        """Return the residual [J], shape (n_t,); a column that is not there is zero."""
        left = sum(_since_start(columns[name]) for name in self.gained if name in columns)
        return np.asarray(left - sum(columns[name] for name in self.put_in if name in columns))

    def fraction(self, columns: Mapping[str, FloatArray], least: float = 0.0) -> float:
        """Return the largest residual as a fraction of the largest term of ``measure`` [1].

        Where the balance met a state that cannot be, it is not a number.

        ``columns``: with the residual; ``least``: energy below which no term counts as large [J].
        """
        # np.max keeps what is not a number; max would lose it.
        whole = np.max([least, *(_largest(columns[name]) for name in self.measure)])
        part = _largest(columns[self.residual])
        return 0.0 if whole == 0.0 else float(part / whole)


def _since_start(values: FloatArray) -> FloatArray:
    return values - values[0] if values.size else values


def _largest(values: FloatArray) -> float:
    return float(np.abs(values).max(initial=0.0))


_SEEN: Final = 0.01  #: Share of the largest term above which a term is drawn.


def balance_chart(balance: EnergyBalance, *, name: str, title: str, caption: str) -> Chart:
    """Return the chart of a balance."""
    return Chart(name, title, caption, needs=(balance.residual,), panels=partial(_panels, balance))


def _panels(balance: EnergyBalance, dataset: xr.Dataset) -> list[Panel]:
    """Return one balance [J]: what is seen beside the largest term, and what is missed."""
    terms = {name: label for name, label in balance.terms.items() if name in dataset}
    sizes = {name: peak(series(dataset, name)) for name in terms}
    largest = max(sizes.values())
    seen = sorted((name for name in terms if sizes[name] >= _SEEN * largest), key=lambda name: -sizes[name])
    curves = [
        ChartCurve(terms[name], series(dataset, name), colour, dash)
        for name, (colour, dash) in zip(seen, LOOKS, strict=False)
    ]
    curves.append(ChartCurve("residual", series(dataset, balance.residual), "grey", width=4.0))
    return [Panel("energy [J]", curves)]
