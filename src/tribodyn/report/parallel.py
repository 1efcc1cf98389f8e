"""Sweep: every point as a line across parallel axes, from its parameters to its key results."""

import json
from collections.abc import Collection
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final
from urllib.parse import quote

import numpy as np
import xarray as xr

from mebdf.arrays import FloatArray
from tribodyn.results.store import POINTS
from tribodyn.results.summary import caution
from tribodyn.views.encode import packed
from tribodyn.views.numbers import as_read, in_words
from tribodyn.views.section import Payload

_MOST_AT_FIRST: Final = 6


@dataclass(frozen=True)
class ParallelAxis:
    """One axis."""

    name: str  #: Path of a parameter or name of a number.
    label: str  #: What it is, with its unit.
    #: Where each point lies, shape (n,): the value in that unit, or the number of the text.
    values: FloatArray
    texts: tuple[str, ...]  #: The values in words, of the points in their order.
    categories: tuple[str, ...]  #: Texts of an axis without numbers, in order; empty where there are numbers.
    parameter: bool  #: Whether it is a parameter rather than a number that came out.


def axes_of(dataset: xr.Dataset) -> list[ParallelAxis]:
    """Return all axes of a sweep, parameters first."""
    dims = dataset["failure"].dims
    varied = json.loads(str(dataset.attrs.get("varied", "[]")))
    parameters = [_parameter(dataset, name, dims) for name in varied if name in dataset.coords]
    numbers = [
        _number(dataset, str(name))
        for name, variable in dataset.data_vars.items()
        if variable.dtype.kind == "f"
    ]
    return parameters + numbers


def _parameter(dataset: xr.Dataset, name: str, dims: tuple[Any, ...]) -> ParallelAxis:
    """Return the axis of a parameter, in the unit it was given in."""
    flat = dataset[name].broadcast_like(dataset["failure"]).transpose(*dims).values.ravel()
    unit = as_read(str(dataset[name].attrs.get("shown_unit", "")))
    label = f"{name} [{unit}]" if unit else name
    if flat.dtype.kind in "fiu":
        values = flat / float(dataset[name].attrs.get("shown_scale", 1.0))
        return ParallelAxis(name, label, values, tuple(in_words(float(v)) for v in values), (), True)
    texts = tuple(str(value) for value in flat.tolist())
    categories = tuple(dict.fromkeys(texts))
    places = np.array([categories.index(text) for text in texts], dtype=np.float64)
    return ParallelAxis(name, label, places, texts, categories, True)


def _number(dataset: xr.Dataset, name: str) -> ParallelAxis:
    """Return the axis of a key result."""
    about = dataset[name].attrs
    unit = str(about.get("units", ""))
    label = str(about.get("long_name", name)) + (f" [{unit}]" if unit not in ("", "1") else "")
    values = np.asarray(dataset[name].values, dtype=np.float64).ravel()
    texts = tuple(in_words(float(value)) if np.isfinite(value) else "—" for value in values)
    return ParallelAxis(name, label, values, texts, (), False)


@dataclass(frozen=True)
class ParallelPoint:
    """One point of a sweep."""

    name: str  #: Its folder below ``points/``.
    failure: str  #: Why it has no numbers, empty where it has.
    link: str  #: Address of its own report, empty where there is none.
    doubtful: str = ""  #: Why its numbers should not be used, empty where they can be.


def points_of(dataset: xr.Dataset, folder: Path | None) -> list[ParallelPoint]:
    """Return the points of a sweep.

    ``folder``: where it is stored: reports of points that are there are linked.
    """
    names = [str(name) for name in dataset["points"].values.ravel()]
    failures = [str(failure) for failure in dataset["failure"].values.ravel()]
    given = dataset["doubtful"].values.ravel() if "doubtful" in dataset else [""] * len(names)
    return [
        ParallelPoint(name, failure, _link(folder, name), str(warning))
        for name, failure, warning in zip(names, failures, given, strict=True)
    ]


def _link(folder: Path | None, name: str) -> str:
    """Return the address of a point's report from the folder of the sweep, and from nowhere else."""
    report = Path(POINTS, name, "report.html")
    inside = Path(name).name == name and folder is not None and (folder / report).is_file()
    return quote(report.as_posix()) if inside else ""


def at_first(axes: list[ParallelAxis], key_numbers: Collection[str]) -> list[str]:
    """Return the names of the axes that are shown first: key numbers, where there are any, or the first."""
    numbers = [axis.name for axis in axes if not axis.parameter and np.isfinite(axis.values).any()]
    wanted = [name for name in key_numbers if name in numbers] or numbers
    return [axis.name for axis in axes if axis.parameter] + wanted[:_MOST_AT_FIRST]


def payload(
    axes: list[ParallelAxis], points: list[ParallelPoint], key_numbers: Collection[str]
) -> Payload | None:
    """Return the data of the script; nothing where no point has numbers."""
    if not any(np.isfinite(axis.values).any() for axis in axes if not axis.parameter):
        return None
    return {
        "axes": [
            {
                "name": axis.name,
                "label": axis.label,
                "values": packed(axis.values, "float64"),
                "texts": list(axis.texts),
                "categories": list(axis.categories),
            }
            for axis in axes
        ],
        "shown": at_first(axes, key_numbers),
        "points": [
            {"name": point.name, "link": point.link, "caution": caution(point.doubtful)} for point in points
        ],
    }
