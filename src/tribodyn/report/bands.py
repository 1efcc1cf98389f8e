"""Effect of assumed numbers on a run: the band of its key results over a sweep in its folder."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Final

import numpy as np
import xarray as xr

from tribodyn.core.arrays import FloatArray
from tribodyn.core.errors import InputError
from tribodyn.mechanisms.catalogue import parse_case
from tribodyn.mechanisms.results import known, read
from tribodyn.views.numbers import as_read, in_words

FOLDER: Final = "assumptions"
"""Folder beside a result in which its report looks for the sweep."""
GROUPS: Final = ("Accuracy", "Load")
"""Groups of key results that the report shows."""


def bands(dataset: xr.Dataset, summary: Mapping[str, Any], folder: Path) -> dict[str, Any] | None:
    """Return the bands of a run as the page shows them; nothing without a sweep of the same case.

    Parameters
    ----------
    dataset
        The result of the run.
    summary
        Its key results.
    folder
        Where the report goes.

    Returns
    -------
    dict or None
        ``keys`` with their range in words, and ``rows`` with label, unit, value, whole band and the band of
        each key alone, the others being those of the run.
    """
    sweep = _sweep_of(dataset, folder / FOLDER / "sweep.nc")
    if sweep is None:
        return None
    case = parse_case(str(dataset.attrs["case"]), "case")
    keys = [key for key in json.loads(sweep.attrs["varied"]) if key in sweep.dims]
    here = {key: _nearest(sweep[key].values, case.at(key)) for key in keys}
    shown = known([name for name in summary if name in sweep], str(summary["kind"]))
    rows = [
        {
            "label": key_result.label,
            "unit": key_result.unit,
            "value": in_words(summary[name], key_result.digits),
            "whole": _band(sweep[name].values, key_result.digits),
            "alone": [_band(_alone(sweep[name], key, here), key_result.digits) for key in keys],
        }
        for name, key_result in shown.items()
        if key_result.group in GROUPS and not key_result.count
    ]
    return {"keys": [{"name": key, "range": _range(sweep[key])} for key in keys], "rows": rows}


def _sweep_of(dataset: xr.Dataset, file: Path) -> xr.Dataset | None:
    """Return the sweep in a file if it is one around the case of a result."""
    try:
        sweep = read(file)
    except InputError:
        return None
    around = bool(dataset.attrs.get("case")) and sweep.attrs.get("case") == dataset.attrs["case"]
    return sweep if around and "varied" in sweep.attrs else None


def _nearest(values: Any, value: Any) -> int:
    """Return the place of the run's own value among those of the sweep, or of the one nearest to it."""
    return int(np.argmin(np.abs(np.asarray(values, dtype=np.float64) - float(value))))


def _alone(numbers: xr.DataArray, key: str, here: Mapping[str, int]) -> FloatArray:
    """Return a number over one key, the others as in the run."""
    others = {name: place for name, place in here.items() if name != key}
    return np.asarray(numbers.isel(others).values, dtype=np.float64)


def _band(values: FloatArray, digits: int) -> str:
    """Return the smallest and the largest of the numbers that are there, in words."""
    finite = values[np.isfinite(values)]
    if not finite.size:
        return "—"
    low, high = in_words(float(finite.min()), digits), in_words(float(finite.max()), digits)
    return low if low == high else f"{low} to {high}"


def _range(values: xr.DataArray) -> str:
    """Return between which values a key was varied."""
    scale, unit = (
        float(values.attrs.get("shown_scale", 1.0)),
        as_read(str(values.attrs.get("shown_unit", ""))),
    )
    low, high = (in_words(float(end) / scale) for end in (values.min(), values.max()))
    return f"{low} to {high} {as_read(unit)}".rstrip()
