"""Key results of a run: few, flat, with the unit in the name."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Final, TypeAlias

import numpy as np

from tribodyn.results.dataset import ASSUMED_WEAR, DATA_HASH, ROWS_HASH, WEAR_SCATTER, json_attribute
from tribodyn.results.reading import column, reading_once, statistic

if TYPE_CHECKING:
    import xarray as xr


@dataclass(frozen=True)
class KeyResult:
    """One key result."""

    label: str  #: What it is, for a table.
    unit: str  #: Unit as printed.
    group: str  #: What kind of question it answers.
    meaning: str  #: Why an engineer cares, in a sentence.
    #: Returns the number, NaN or an error of lookup where the result does not hold it.
    compute: Callable[[xr.Dataset], float]
    count: bool = False  #: Whether it is a whole number.
    digits: int = 3  #: How many digits of it hold: neighbouring tolerances agree in them, or nearly.
    #: Of a peak, the name of the key result that says in how much of the motion it was looked for.
    over: str = ""
    span: str = "after {} reversal"  #: That in words; a plural s follows them.
    part: str = ""  #: Of one of several parts, such as joints, its name.
    #: Label without the name of the part: the heading of a column, where each part has a row.
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

    def of_part(self, part: str) -> KeyResult:
        """Return the number as that of a part with a name."""
        return replace(self, label=f"{self.label}, {part}", part=part, column=self.label)


Interval: TypeAlias = tuple[float, float]
#: Key results and texts of a run, as in ``summary.json``.
Summary: TypeAlias = dict[str, float | int | str | list[str] | dict[str, list[float]]]


class _Numbers(Summary):
    """Key results by name; earlier names find those of today."""

    def __missing__(self, name: str) -> float | int | str | list[str] | dict[str, list[float]]:
        """Return the key result that had another name earlier."""
        if (now := name_today(name)) == name:
            raise KeyError(name)
        return self[now]


def name_today(name: str) -> str:
    """Return the name of a key result, also for one that it had earlier."""
    return name.replace("_lasting", "_sustained")


def _real_time_factor(dataset: xr.Dataset) -> float:
    """Return simulated time over wall time; a wear campaign simulates far more than the result holds."""
    if "wear_cycles" in dataset:
        return math.nan
    time = column(dataset, "time")
    return float(time[-1] - time[0]) / statistic("wall_time")(dataset)


#: Key results of every run, by name in ``summary.json``.
EFFORT: Final[dict[str, KeyResult]] = {
    "simulated_time_s": KeyResult(
        "Simulated time",
        "s",
        "Effort",
        "How much of the motion this result holds.",
        lambda d: float(np.ptp(column(d, "time"))),
        digits=4,
    ),
    "steps": KeyResult(
        "Steps", "", "Effort", "Accepted steps of the integrator.", statistic("steps"), count=True
    ),
    "rhs_evaluations": KeyResult(
        "Evaluations",
        "",
        "Effort",
        "Calls of the equations of motion.",
        statistic("rhs_evaluations"),
        count=True,
    ),
    "wall_time_s": KeyResult(
        "Wall time", "s", "Effort", "How long the integration took.", statistic("wall_time")
    ),
    "real_time_factor": KeyResult(
        "Real-time factor",
        "",
        "Effort",
        "Seconds of motion simulated in a second of computing.",
        _real_time_factor,
    ),
}


#: Names of wear rates and lives by wear.
_OF_WEAR: Final = re.compile(r"wear_(depth_)?rate|(wear|bore|shaft)_life")
_LIFE: Final = re.compile(r"(wear|bore|shaft|error)_life_cycles")
#: Beginnings of names of numbers that go with the inverse of the wear rate, and with the wear rate.
_WORN: Final = re.compile(r"(partner_)?wear_(depth|rate)_|worn_volume_")
#: Energy that a run misses, over the largest term of its balance, beyond which no number should be used.
DOUBTFUL: Final = 0.05


def warning(dataset: xr.Dataset) -> str:
    """Return why the numbers of a run should not be used: its energy balance; empty where it closes."""
    missed = dataset.attrs.get("energy_residual", 0.0)
    if not isinstance(missed, float) or missed <= DOUBTFUL:
        return ""
    return "the energy balance misses " + ("all" if math.isnan(missed) else f"{100 * missed:.2g} %")


def caution(reason: object, numbers: str = "these numbers") -> str:
    """Return the sentence beside numbers that should not be used, see :func:`warning`; else an empty one."""
    return f"Do not use {numbers}: {reason}." if reason else ""


def summarise(dataset: xr.Dataset, key_results: Mapping[str, KeyResult]) -> Summary:
    """Return the key results of a result.

    A number that the result cannot give (a partial run) is left out.

    Parameters
    ----------
    dataset
        A result.
    key_results
        Those of its mechanism, by name.

    Returns
    -------
    dict
        Kind, title, ``status`` (``"complete"`` or ``"failed"``), ``failure`` (empty when there is none),
        ``doubtful`` (see :func:`warning`), the lists of ``warnings`` and ``notes``, the
        hashes of data and rows, then numbers by name; at last ``assumed``, the names of wear rates and lives
        that follow from a material that nobody chose, and ``intervals``, of wear and lives by name.
    """
    failure = str(dataset.attrs.get("failure", ""))
    summary: Summary = _Numbers(
        {
            "kind": str(dataset.attrs.get("kind", "")),
            "title": str(dataset.attrs.get("title", "")),
            "status": "failed" if failure else "complete",
            "failure": failure,
            "doubtful": warning(dataset),
            "warnings": json_attribute(dataset, "warnings", []),
            "notes": json_attribute(dataset, "notes", []),
            **{name: str(dataset.attrs[name]) for name in (DATA_HASH, ROWS_HASH) if name in dataset.attrs},
        }
    )
    with reading_once():
        for name, key_result in {**key_results, **EFFORT}.items():
            value = _number(key_result, dataset)
            if math.isfinite(value):
                summary[name] = int(value) if key_result.count else value
    there = {name: key_results[name] for name in summary if name in key_results}
    least, largest = (json_attribute(dataset, name, {}) for name in WEAR_SCATTER)
    scatter = {joint: (low, largest[joint]) for joint, low in least.items() if joint in largest}
    summary["assumed"] = _assumed(dataset, there)
    summary["intervals"] = {
        name: [end * float(number) for end in ends]
        for name, one in there.items()
        if isinstance(number := summary[name], float)
        and (ends := wear_interval(name, one.part, scatter)) is not None
    }
    return summary


def wear_interval(name: str, part: str, scatter: Mapping[str, Interval]) -> Interval | None:
    """Return the interval of a key result of wear over its value [1]; None for any other number.

    ``name``, ``part``: of the key result; ``scatter``: least and largest wear of equal joints over that at
    the rate, by joint and an empty name for all.
    """
    low, high = scatter.get(part, scatter.get("", (1.0, 1.0)))
    if low == high or not (_LIFE.match(name) or _WORN.match(name)):
        return None
    return (1.0 / high, 1.0 / low) if _LIFE.match(name) else (low, high)


def _assumed(dataset: xr.Dataset, key_results: Mapping[str, KeyResult]) -> list[str]:
    """Return the names of wear rates and lives that follow from a wear rate that nobody chose."""
    joints = json_attribute(dataset, ASSUMED_WEAR, [])
    of_joints = set(joints) if any(joints) else set()
    return [
        name
        for name, key_result in key_results.items()
        if joints and _OF_WEAR.search(name) and (not key_result.part or key_result.part in of_joints)
    ]


def _number(key_result: KeyResult, dataset: xr.Dataset) -> float:
    """Return a key result, NaN where the result does not hold what it needs."""
    try:
        return key_result.compute(dataset)
    except (KeyError, ValueError, ZeroDivisionError, IndexError):
        return math.nan
