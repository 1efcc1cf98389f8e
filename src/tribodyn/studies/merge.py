"""From the summaries of all points to one dataset."""

import json
import math
from collections.abc import Mapping, Sequence
from typing import Any, Final

import numpy as np
import xarray as xr

from tribodyn.cases import Key
from tribodyn.cases.units import si_unit, to_si
from tribodyn.core.versions import version
from tribodyn.mechanisms.results import known
from tribodyn.results.attributes import SWEEP
from tribodyn.results.dataset import assembled, variable
from tribodyn.results.summary import Summary
from tribodyn.results.variables import POINT_TEXTS
from tribodyn.studies.plan import POINT, SweepPlan

NOT_COMPUTED: Final = "not computed: the sweep was stopped before"


def merge(plan: SweepPlan, summaries: Mapping[str, Summary]) -> xr.Dataset:
    """Return the dataset of a sweep.

    Parameters
    ----------
    plan
        Its points.
    summaries
        Key results of those that were computed, by name of the point.

    Returns
    -------
    xarray.Dataset
        One dimension for each parameter of a grid, named by its dotted path, and ``point`` for samples. The
        values of the parameters are coordinates (SI; ``shown_unit`` and ``shown_scale`` say how to print
        them). One variable for each key result, NaN where a point failed or was not reached, with
        ``units`` and ``long_name``; the texts ``failure``, ``warnings``, ``doubtful`` and ``points`` of each
        point.
    """
    rows = [summaries.get(point.name, {"failure": NOT_COMPUTED}) for point in plan.points]
    shape = tuple(axis.size for axis in plan.axes)
    dims = tuple(axis.name for axis in plan.axes)

    def laid_out(values: Sequence[Any], dtype: Any, about: dict[str, str]) -> xr.Variable:
        return variable(dims, np.array(values, dtype=dtype).reshape(shape), about)

    kind = plan.case.kind()
    texts = {name: [_text(row.get(name, "")) for row in rows] for name in ("failure", "warnings", "doubtful")}
    texts["points"] = [point.name for point in plan.points]
    numbers = {name: laid_out(*_column(name, rows, kind)) for name in _numbers(rows, kind)}
    words = {
        name: laid_out(values, object, {"long_name": POINT_TEXTS[name]}) for name, values in texts.items()
    }
    return assembled(numbers | words, _coordinates(plan), _attributes(plan, rows))


def _numbers(rows: Sequence[Summary], kind: str) -> list[str]:
    """Return the names of all numbers that any point gave, the known ones first and in their order."""
    given = {name: None for row in rows for name, value in row.items() if isinstance(value, int | float)}
    first = known(given, kind)
    return [*first, *(name for name in given if name not in first)]


def _column(name: str, rows: Sequence[Summary], kind: str) -> tuple[list[float], type, dict[str, Any]]:
    """Return the values of a key result over all points; a point that failed has none."""
    values = [math.nan if row.get("failure") else _number(row.get(name)) for row in rows]
    one = known([name], kind).get(name)
    if one is None:
        return values, float, {"long_name": name}
    about = {"units": one.unit or "1", "long_name": one.label, "group": one.group, "comment": one.meaning}
    return values, float, about | {"digits": 0 if one.count else one.digits}


def _text(about_number: object) -> str:
    return "; ".join(about_number) if isinstance(about_number, list) else str(about_number)


def _number(value: object) -> float:
    return float(value) if isinstance(value, int | float) else math.nan


def _coordinates(plan: SweepPlan) -> dict[str, xr.Variable]:
    coordinates = {}
    for axis in plan.axes:
        if axis.name == POINT:
            numbers = np.arange(axis.size)
            coordinates[POINT] = variable((POINT,), numbers, {"long_name": "number of the sample"})
        for key, values in axis.columns.items():
            coordinates[key.path] = variable((axis.name,), np.asarray(values), _about(key))
    return coordinates


def _about(key: Key) -> dict[str, Any]:
    about: dict[str, Any] = {"long_name": key.description}
    if key.kind == "quantity":
        scale = to_si(f"1 {key.unit}", key.unit)
        about |= {"units": si_unit(key.unit), "shown_unit": key.unit, "shown_scale": scale}
    elif key.kind in {"number", "count"}:
        about["units"] = "1"
    return about


def _attributes(plan: SweepPlan, rows: Sequence[Summary]) -> dict[str, Any]:
    sampling: dict[str, Any] = {}
    if plan.sampled:
        s = plan.sampling
        sampling = {"samples": s.samples, "sampling_method": s.method, "sampling_seed": s.seed}
    return {
        "kind": SWEEP,
        "swept_kind": plan.case.kind(),
        "title": plan.case.title,
        "case": plan.case.to_toml(),
        "tribodyn_version": version("tribodyn"),
        "varied": json.dumps([key.path for axis in plan.axes for key in axis.columns]),
        "points_in_all": len(rows),
        "points_failed": sum(bool(row.get("failure")) for row in rows),
        **sampling,
    }
