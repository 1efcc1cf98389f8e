"""Sweeps: one figure for each key result.

A parameter that runs over numbers gives a line, with one line for each value of a second one that runs over
names; two that run over numbers give a map; samples, and grids of more parameters, give the number over each
parameter, samples with their distribution. Points that failed are marked.
"""

import json
import math
from collections.abc import Iterator
from functools import partial
from itertools import cycle, product
from textwrap import fill
from typing import Final

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from mebdf.arrays import FloatArray
from tribodyn.figures import style
from tribodyn.figures.chart import Family
from tribodyn.views.numbers import as_read
from tribodyn.views.playback import finite

SAMPLES: Final = "point"
_COLOURS: Final = (style.BLUE, style.VERMILION, style.GREEN, style.PURPLE, style.ORANGE, style.INK)
_DASHES: Final = (style.SOLID, style.DASHED, style.DOTTED, style.DASHDOT)
_MARKERS: Final = "os^Dv"
_MOST_PANELS: Final = 6
_MOST_BINS: Final = 100
_ROUNDING: Final = 1e-12  #: Range of values over the largest of them up to which rounding alone parts them.
_WIDE_RANGE: Final = 50.0  #: Largest over smallest value of a parameter above which its axis is logarithmic.
_MOST_WRITTEN: Final = 60  #: Cells of a map up to which each has its number written into it.
EFFORT_GROUP: Final = "Effort"


def families(dataset: xr.Dataset) -> dict[str, Family]:
    """Return the figures of a sweep by name, one for each of its key results.

    Where they are not asked for by the attribute ``shown``, numbers that are the same at all points in the
    digits that hold are left out, unless all are, and so is how much work the points were.
    """
    asked = str(dataset.attrs.get("shown", "")).split(",")
    numbers = {str(name): found for name, found in dataset.data_vars.items() if found.dtype.kind == "f"}
    of_machine = [name for name, found in numbers.items() if found.attrs.get("group") != EFFORT_GROUP]
    differ = [name for name in of_machine if _differs(numbers[name])] or of_machine
    names = [name for name in numbers if name in differ or name in asked]
    return {
        name: Family(
            name=name,
            title=str(dataset[name].attrs.get("long_name", name)),
            caption=str(dataset[name].attrs.get("comment") or "Key result of each point."),
            needs=(name,),
            draw=partial(draw, name=name),
        )
        for name in names
    }


def _differs(numbers: xr.DataArray) -> bool:
    """Return whether numbers differ in the digits that hold, where there are several."""
    values = numbers.values[np.isfinite(numbers.values)]
    digits = int(numbers.attrs.get("digits", 0))
    resolved = 0.05 * 10.0 ** (1 - digits) if digits else _ROUNDING
    return values.size < 2 or bool(np.ptp(values) > resolved * np.max(np.abs(values)))


def draw(dataset: xr.Dataset, name: str) -> Figure:
    """Draw one key result over what varies.

    ``name``: name of the number.
    """
    figure = _drawn(dataset, name)
    limit = json.loads(dataset.attrs.get("limits", "{}")).get(name)
    if limit is not None and not any(axes.collections for axes in figure.axes):
        for axes in figure.axes:
            axes.axhline(limit, color=style.VERMILION, lw=1.0, ls="--", label="_limit")
    return figure


def _drawn(dataset: xr.Dataset, name: str) -> Figure:
    values = dataset[name]
    if SAMPLES in values.dims or values.ndim > 2:
        return _panels(dataset, name)
    if values.ndim == 2 and all(
        _numeric(dataset[dim]) == _numeric(dataset[values.dims[0]]) for dim in values.dims
    ):
        return _map(dataset, name)
    return _curves(dataset, name)


def _numeric(coordinate: xr.DataArray) -> bool:
    return coordinate.dtype.kind in "fiu"


def _shown(coordinate: xr.DataArray) -> FloatArray:
    """Return the values of a parameter in the unit in which its key shows them; names count from 0."""
    if not _numeric(coordinate):
        return np.arange(coordinate.size, dtype=np.float64)
    return np.asarray(coordinate.values / coordinate.attrs.get("shown_scale", 1.0), dtype=np.float64)


def _names(coordinate: xr.DataArray) -> list[str]:
    """Return the values of a parameter as labels."""
    if not _numeric(coordinate):
        return [str(value) for value in coordinate.values]
    unit = _unit(coordinate)
    return [f"{value:.4g} {unit}".strip() for value in _shown(coordinate)]


def _unit(coordinate: xr.DataArray) -> str:
    return as_read(str(coordinate.attrs.get("shown_unit", "")))


def _label(coordinate: xr.DataArray) -> str:
    """Return a parameter's axis label, with its unit."""
    if not _numeric(coordinate):
        return str(coordinate.name)
    words = style.plain(str(coordinate.attrs.get("long_name", coordinate.name)))
    return f"{words} [{_unit(coordinate) or '–'}]"


def _value_label(values: xr.DataArray) -> str:
    unit = values.attrs.get("units", "1")
    return style.plain(f"{values.attrs.get('long_name', values.name)} [{'–' if unit == '1' else unit}]")


def _sheet(dataset: xr.Dataset, name: str, height: float) -> Figure:
    """Return an empty figure that says how many points the sweep has and how many of them failed."""
    figure = style.sheet(dataset, str(dataset[name].attrs.get("long_name", name)), height)
    total, lost = int(dataset.attrs["points_in_all"]), int(dataset.attrs["points_failed"])
    words = f"{total} points" + (f", {lost} without a result (×)" if lost else "")
    right, top = 1.0 - 0.12 / figure.get_figwidth(), 1.0 - 0.1 / height
    figure.text(
        right,
        top,
        words,
        ha="right",
        va="top",
        size=style.SMALL,
        color=style.VERMILION if lost else style.GREY,
    )
    return figure


def _dress(axes: Axes, coordinate: xr.DataArray, y_label: str = "") -> None:
    """Give axes the labels of a parameter below, and a logarithmic scale where its values ask for one."""
    style.finish(axes, _label(coordinate), y_label)
    if not _numeric(coordinate):
        _name_ticks(axes, coordinate)
    elif _logarithmic(coordinate):
        axes.set_xscale("log")


def _name_ticks(axes: Axes, coordinate: xr.DataArray) -> None:
    names = _names(coordinate)
    turned = sum(map(len, names)) > 50
    axes.set_xticks(
        range(len(names)), names, rotation=30 if turned else 0, ha="right" if turned else "center"
    )
    axes.margins(x=max(0.05, 0.3 / len(names)))


def _logarithmic(coordinate: xr.DataArray) -> bool:
    shown = _shown(coordinate)
    return bool(shown.min() > 0.0 and shown.max() > _WIDE_RANGE * shown.min())


def _mark_failed(axes: Axes, x: FloatArray, y: FloatArray) -> None:
    """Put a cross on the lower edge where a point has no result."""
    lost = ~np.isfinite(y)
    if lost.any():
        axes.plot(
            x[lost],
            np.zeros(lost.sum()),
            "x",
            color=style.VERMILION,
            transform=axes.get_xaxis_transform(),
            clip_on=False,
            label="_failed",
        )
    if lost.all():
        style.note(axes, "no point gave this number")


def _curves(dataset: xr.Dataset, name: str) -> Figure:
    """Draw the number over one parameter, one line for each value of another that runs over names."""
    values = dataset[name]
    along = next((dim for dim in values.dims if _numeric(dataset[dim])), values.dims[0])
    others = [dim for dim in values.dims if dim != along]
    figure = _sheet(dataset, name, 3.6)
    axes = figure.subplots()
    x = _shown(dataset[along])
    curves = [(values.values, "")] if not others else _by_name(dataset, name, str(others[0]))
    for i, (y, label) in enumerate(curves):
        colour, dash, marker = (family[i % len(family)] for family in (_COLOURS, _DASHES, _MARKERS))
        dash = dash if _numeric(dataset[along]) else "None"
        axes.plot(x, y, color=colour, linestyle=dash, marker=marker, ms=4.5, lw=1.4, label=label or "_")
        _mark_failed(axes, x, y)
    if others:
        style.legend(axes, 4)
    _dress(axes, dataset[along], _value_label(values))
    return figure


def _by_name(dataset: xr.Dataset, name: str, dim: str) -> list[tuple[FloatArray, str]]:
    values = dataset[name]
    axis = values.dims.index(dim)
    labels = _names(dataset[dim])
    return [(np.take(values.values, i, axis), label) for i, label in enumerate(labels)]


def _map(dataset: xr.Dataset, name: str) -> Figure:
    """Draw the number over two parameters as a map."""
    values = dataset[name]
    down, across = (dataset[dim] for dim in values.dims)
    figure = _sheet(dataset, name, 4.4)
    axes = figure.subplots()
    # Equal cells, each labelled with its value: what was computed are points, not areas.
    mesh = axes.pcolormesh(
        np.arange(across.size), np.arange(down.size), values.values, shading="nearest", cmap="viridis"
    )
    axes.set_facecolor("#ececec")
    for i, j in np.argwhere(~np.isfinite(values.values)):
        axes.plot(j, i, "x", color=style.VERMILION)
    _write_cells(axes, values.values)
    style.finish(axes, _label(across), _label(down))
    axes.grid(False)
    _cell_ticks(axes, across, down)
    style.colour_bar(figure, mesh, axes, _value_label(values))
    return figure


def _cell_ticks(axes: Axes, across: xr.DataArray, down: xr.DataArray) -> None:
    for axis, coordinate, most in ((axes.xaxis, across, 12), (axes.yaxis, down, 14)):
        places = np.unique(np.linspace(0, coordinate.size - 1, min(coordinate.size, most)).astype(int))
        shown = _names(coordinate) if not _numeric(coordinate) else [f"{v:.4g}" for v in _shown(coordinate)]
        axis.set_ticks(places.tolist(), [shown[i] for i in places])


def _write_cells(axes: Axes, values: FloatArray) -> None:
    """Write its number into each cell of a small map."""
    if values.size > _MOST_WRITTEN or not finite(values).size:
        return
    middle = 0.5 * (np.nanmin(values) + np.nanmax(values))
    for i, j in np.argwhere(np.isfinite(values)):
        colour = style.INK if values[i, j] > middle else "white"
        axes.text(j, i, f"{values[i, j]:.3g}", ha="center", va="center", size=style.SMALL, color=colour)


def _panels(dataset: xr.Dataset, name: str) -> Figure:
    """Draw the number over each parameter that is sampled (or varies), and the distribution of samples."""
    sampled = SAMPLES in dataset.dims
    parameters = [
        str(p) for p in dataset.coords if p != SAMPLES and (not sampled or SAMPLES in dataset[p].dims)
    ][:_MOST_PANELS]
    figure = _sheet(dataset, name, 3.6)
    panels = figure.subplots(1, len(parameters) + sampled, sharey=True, squeeze=False)[0]
    groups = list(_groups(dataset)) if sampled else [(dataset, "")]
    for axes, parameter in zip(panels, parameters, strict=False):
        for (part, _), colour, marker in zip(groups, cycle(_COLOURS), cycle(_MARKERS)):
            _points(axes, part, name, parameter, colour, marker)
        _dress(axes, dataset[parameter], _value_label(dataset[name]) if axes is panels[0] else "")
        axes.set_xlabel(fill(axes.get_xlabel(), 100 // len(panels)))
        if len(groups) == 1 and _numeric(dataset[parameter]):
            style.caption(axes, _rank_correlation(*_pairs(dataset, name, parameter)))
    if sampled:
        _distributions(panels[-1], [(finite(part[name].values), label) for part, label in groups])
    return figure


def _groups(dataset: xr.Dataset) -> Iterator[tuple[xr.Dataset, str]]:
    """Give the samples of each combination of the parameters that form a grid, with its name."""
    dims = [str(dim) for dim in dataset.dims if dim != SAMPLES]
    for places in product(*(range(dataset.sizes[dim]) for dim in dims)):
        labels = (_names(dataset[dim])[i] for dim, i in zip(dims, places, strict=True))
        yield dataset.isel(dict(zip(dims, places, strict=True))), ", ".join(labels)


def _pairs(dataset: xr.Dataset, name: str, parameter: str) -> tuple[FloatArray, FloatArray]:
    """Return the values of a parameter, as shown, and of the number, of all points."""
    places = dataset[parameter].copy(data=_shown(dataset[parameter])).reset_coords(drop=True)
    number, place = xr.broadcast(dataset[name], places)
    return np.ravel(place.values), np.ravel(number.values)


def _points(axes: Axes, part: xr.Dataset, name: str, parameter: str, colour: str, marker: str) -> None:
    x, y = _pairs(part, name, parameter)
    axes.plot(x, y, marker, ms=3.5, color=colour, alpha=0.6, mec="none")
    _mark_failed(axes, x, y)


def _rank_correlation(x: FloatArray, y: FloatArray) -> str:
    """Return Spearman's rank correlation in words, empty where there is none."""
    from scipy.stats import spearmanr

    good = np.isfinite(y)
    if good.sum() < 3 or not all(np.ptp(values[good]) for values in (x, y)):
        return ""
    correlation = float(spearmanr(x[good], y[good])[0])
    return f"rank correlation {correlation:+.2f}".replace("-", "−")


def _distributions(axes: Axes, groups: list[tuple[FloatArray, str]]) -> None:
    """Draw the distribution of the samples of each group; of one group alone with the middle 90 %."""
    style.finish(axes, "number of points [–]")
    for (values, label), colour, dash in zip(groups, cycle(_COLOURS), cycle(_DASHES)):
        if values.size:
            axes.hist(
                values,
                bins=_bins(values),
                orientation="horizontal",
                color=colour,
                alpha=0.35,
                label=label or "_",
            )
            axes.axhline(float(np.median(values)), color=colour, lw=1.2, ls=dash)
    if len(groups) > 1 and any(values.size for values, _ in groups):
        style.legend(axes, 2)
    elif groups[0][0].size:
        _mark_quantiles(axes, groups[0][0])


def _bins(values: FloatArray) -> int:
    """Return the number of bins by the rules of Sturges or of Freedman and Diaconis, whichever gives more.

    NumPy's ``auto`` is the same without a bound: one value far from all others makes it ask for any number.
    It refuses more than one where values differ by rounding alone.
    """
    if np.ptp(values) <= _ROUNDING * np.max(np.abs(values)):
        return 1
    quarter, most = np.percentile(values, [25.0, 75.0])
    width = 2.0 * (most - quarter) / np.cbrt(values.size)
    fine = float(np.ptp(values)) / width if width > 0.0 else 0.0
    return math.ceil(min(max(fine, math.log2(values.size) + 1.0), _MOST_BINS))


def _mark_quantiles(axes: Axes, values: FloatArray) -> None:
    for percent, label in ((5.0, "5 %"), (50.0, "median"), (95.0, "95 %")):
        value = float(np.percentile(values, percent))
        axes.axhline(value, color=style.INK, lw=0.9, ls=style.SOLID if percent == 50.0 else style.DOTTED)
        place = ("axes fraction", "data")
        axes.annotate(
            f"{label} {value:.3g}", (1.0, value), xycoords=place, ha="right", va="bottom", size=style.SMALL
        )
