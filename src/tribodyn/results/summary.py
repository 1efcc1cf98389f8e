"""Key results of a run: few, flat, with the unit in the name."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Final, TypeAlias

import numpy as np
import xarray as xr

from tribodyn.results.attributes import DATA_HASH, ROWS_HASH
from tribodyn.results.dataset import json_attribute
from tribodyn.results.reading import column, statistic


@dataclass(frozen=True)
class Headline:
    """One headline number.

    Attributes
    ----------
    label
        What it is, for a table.
    unit
        Unit as printed.
    group
        What kind of question it answers.
    meaning
        Why an engineer cares, in a sentence.
    compute
        Returns the number, NaN or an error of lookup where the result does not hold it.
    count
        Whether it is a whole number.
    digits
        How many digits of it hold: neighbouring tolerances agree in them, or nearly.
    over
        Of a peak, the name of the headline number that says in how much of the motion it was looked for.
    span
        That in words; a plural s follows them.
    part
        Of one of several parts, such as joints, its name.
    column
        Label without the name of the part: the heading of a column, where each part has a row.
    """

    label: str
    unit: str
    group: str
    meaning: str
    compute: Callable[[xr.Dataset], float]
    count: bool = False
    digits: int = 3
    over: str = ""
    span: str = "after {} reversal"
    part: str = ""
    column: str = ""

    def label_in(self, summary: Mapping[str, object]) -> str:
        """Return the label in a summary: a peak says in how much of the motion it was looked for."""
        if not self.part:
            return self.label + self._span_in(summary)
        return f"{self.column_in(summary)}, {self.part}"

    def column_in(self, summary: Mapping[str, object]) -> str:
        """Return the heading of the column in a summary."""
        return self.column + self._span_in(summary)

    def _span_in(self, summary: Mapping[str, object]) -> str:
        if self.over not in summary:
            return ""
        n = summary[self.over]
        return f" {self.span.format(n)}" + ("" if n == 1 else "s")

    def of_part(self, part: str) -> Headline:
        """Return the number as that of a part with a name."""
        return replace(self, label=f"{self.label}, {part}", part=part, column=self.label)


Summary: TypeAlias = dict[str, float | int | str | list[str]]
"""Headline numbers and texts of a run, as in ``summary.json``."""


def _real_time_factor(dataset: xr.Dataset) -> float:
    """Return simulated time over wall time; a wear campaign simulates far more than the result holds."""
    if "wear_cycles" in dataset:
        return math.nan
    time = column(dataset, "time")
    return float(time[-1] - time[0]) / statistic("wall_time")(dataset)


EFFORT: Final[dict[str, Headline]] = {
    "simulated_time_s": Headline(
        "Simulated time",
        "s",
        "Effort",
        "How much of the motion this result holds.",
        lambda d: float(np.ptp(column(d, "time"))),
        digits=4,
    ),
    "steps": Headline(
        "Steps", "", "Effort", "Accepted steps of the integrator.", statistic("steps"), count=True
    ),
    "rhs_evaluations": Headline(
        "Evaluations",
        "",
        "Effort",
        "Calls of the equations of motion.",
        statistic("rhs_evaluations"),
        count=True,
    ),
    "wall_time_s": Headline(
        "Wall time", "s", "Effort", "How long the integration took.", statistic("wall_time")
    ),
    "real_time_factor": Headline(
        "Real-time factor",
        "",
        "Effort",
        "Seconds of motion simulated in a second of computing.",
        _real_time_factor,
    ),
}
"""What every run has, by its name in ``summary.json``."""


DOUBTFUL: Final = 0.05
"""Energy that a run misses, over the largest term of its balance, beyond which no number should be used."""


def doubt(dataset: xr.Dataset) -> str:
    """Return why the numbers of a run should not be used: its energy balance; empty where it closes."""
    missed = dataset.attrs.get("energy_residual", 0.0)
    if not isinstance(missed, float) or missed <= DOUBTFUL:
        return ""
    return "the energy balance misses " + ("all" if math.isnan(missed) else f"{100 * missed:.2g} %")


def caution(doubt: object, numbers: str = "these numbers") -> str:
    """Return the sentence that accompanies doubtful numbers, see :func:`doubt`; empty without a reason."""
    return f"Do not use {numbers}: {doubt}." if doubt else ""


def summarise(dataset: xr.Dataset, headlines: Mapping[str, Headline]) -> Summary:
    """Return the headline numbers of a result.

    A number that the result cannot give (a partial run) is left out.

    Parameters
    ----------
    dataset
        A result.
    headlines
        Those of its mechanism, by name.

    Returns
    -------
    dict
        Kind, title, ``status`` (``"complete"`` or ``"failed"``), ``failure`` (empty when there is none),
        ``doubtful`` (see :func:`doubt`), the lists of ``warnings`` and ``notes``, the
        hashes of data and rows, then numbers by name.
    """
    failure = str(dataset.attrs.get("failure", ""))
    summary: Summary = {
        "kind": str(dataset.attrs.get("kind", "")),
        "title": str(dataset.attrs.get("title", "")),
        "status": "failed" if failure else "complete",
        "failure": failure,
        "doubtful": doubt(dataset),
        "warnings": json_attribute(dataset, "warnings", []),
        "notes": json_attribute(dataset, "notes", []),
        **{name: str(dataset.attrs[name]) for name in (DATA_HASH, ROWS_HASH) if name in dataset.attrs},
    }
    for name, headline in {**headlines, **EFFORT}.items():
        value = _number(headline, dataset)
        if math.isfinite(value):
            summary[name] = int(value) if headline.count else value
    return summary


def _number(headline: Headline, dataset: xr.Dataset) -> float:
    """Return a headline number, NaN where the result does not hold what it needs."""
    try:
        return headline.compute(dataset)
    except (KeyError, ValueError, ZeroDivisionError, IndexError):
        return math.nan
