"""Charts over time, described once: drawn by matplotlib for ``figures/`` and in a browser for the report.

A chart has panels, a panel has curves and marks; :func:`over` makes of them what a script of the report
draws.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.views.encode import stepped
from tribodyn.views.numbers import fitting
from tribodyn.views.playback import (
    finite,
    impact_time,
    impact_windows,
    peak,
    reversal_times,
    series,
    smooth_limits,
    time_unit,
)
from tribodyn.views.section import Payload, Section, coordinates

if TYPE_CHECKING:
    import xarray as xr

MOST: Final = 6000  #: Points of a curve above which it is thinned: three for each pixel of a wide screen.


def thinned(x: FloatArray, y: FloatArray, most: int = MOST) -> tuple[FloatArray, FloatArray]:
    """Return a curve of at most ``most`` points with every peak in it.

    The curve is cut into stretches of equally many points; of each, the first, the last, the smallest and the
    largest are kept. Where a stretch holds a gap (NaN), one NaN is kept too.

    ``x``: increasing, shape (n,); ``y``: shape (n,); ``most``: at least 5. Returns both of shape (m,), in the
    order of ``x``.
    """
    if x.size <= most:
        return x, y
    edges = np.linspace(0, x.size, most // 5 + 1).astype(int)
    kept = np.unique(np.concatenate([_extremes(y, a, b) for a, b in pairwise(edges)]))
    return x[kept], y[kept]


_APART: Final = 64
#: Parts of an ordinate that a curve may be off by: a tenth of a pixel where it is shown whole.
FINEST: Final = 4000


def straightened(x: FloatArray, y: FloatArray, tolerance: float) -> tuple[FloatArray, FloatArray]:
    """Return a curve without the points that a straight line between its neighbours replaces.

    Stretches are split where a line misses most until none misses more than the tolerance (Douglas and
    Peucker 1973, along y). Ends, and points at gaps (NaN), stay. Of a curve that is not
    straight every 64th point stays, too: half the time for a thirtieth more points.

    ``x``: increasing, shape (n,); ``y``: shape (n,); ``tolerance``: what a line may miss, in the unit of
    ``y``. Returns both of shape (m,), in the order of ``x``.
    """
    gap = np.concatenate([[True], ~np.isfinite(y), [True]])
    kept = gap[:-2] | gap[1:-1] | gap[2:]
    while True:
        knots = np.flatnonzero(kept)
        miss = np.abs(y - np.interp(x, x[knots], y[knots]))
        far = miss > tolerance  # False at gaps
        if not far.any():
            return x[kept], y[kept]
        kept |= far & (miss == np.fmax.reduceat(miss, knots)[np.cumsum(kept) - 1])
        kept[::_APART] = True


def _extremes(y: FloatArray, begin: int, end: int) -> np.ndarray[tuple[int], np.dtype[np.intp]]:
    """Return the indices to keep of ``y[begin:end]``."""
    part = y[begin:end]
    gaps = np.flatnonzero(np.isnan(part))
    ends = [0, part.size - 1, *gaps[:1]]
    inner = [] if gaps.size == part.size else [np.nanargmin(part), np.nanargmax(part)]
    return begin + np.array([*ends, *inner], dtype=np.intp)


#: Colour and dash of curves that have no look of their own; distinguished in grey by the dash.
LOOKS: Final = (
    ("ink", "solid"),
    ("blue", "dash"),
    ("vermilion", "dashdot"),
    ("green", "dot"),
    ("orange", "solid"),
    ("purple", "dash"),
    ("grey", "longdash"),
)


@dataclass(frozen=True)
class ChartCurve:
    """One curve."""

    name: str  #: For the legend.
    values: FloatArray  #: What is drawn, in the unit of its panel, shape (n,).
    colour: str = "ink"  #: Name of a colour of the page's style sheet.
    dash: str = "solid"  #: Dash pattern: solid, dash, dashdot, dot or longdash.
    width: float = 1.6  #: Line width [px].
    x: FloatArray | None = None  #: Its own abscissa, shape (n,); by default that of the figure.


@dataclass(frozen=True)
class ChartMarks:
    """Points with a letter each."""

    times: FloatArray  #: When [s], shape (n,).
    values: FloatArray  #: Where, in the unit of the panel, shape (n,).
    labels: tuple[str, ...]  #: Their letters.


@dataclass(frozen=True)
class Panel:
    """Curves with a common ordinate."""

    label: str  #: Quantity, and its unit in brackets.
    curves: Sequence[ChartCurve]  #: Drawn in this order.
    smooth: bool = False  #: Whether the panel opens on the smooth motion, where impacts would flatten it.
    marks: ChartMarks | None = None  #: Points to mark in the figure; none by default.

    @property
    def unit(self) -> str:
        """The unit in its label."""
        return "".join(_UNIT.findall(self.label))

    @property
    def quantity(self) -> str:
        """Its label without the unit."""
        return _UNIT.sub("", self.label)

    @property
    def fitted(self) -> tuple[Panel, float]:
        """The same in the unit that fits its values, and the factor to it."""
        unit, factor = fitting(self.unit, [peak(curve.values) for curve in self.curves])
        if factor == 1.0:
            return self, factor
        label = _UNIT.sub(f"[{unit}]", self.label)
        scaled = [replace(curve, values=factor * curve.values) for curve in self.curves]
        marks = self.marks and replace(self.marks, values=factor * self.marks.values)
        return replace(self, label=label, curves=scaled, marks=marks), factor

    def ordinate(self, time: FloatArray, turns: FloatArray, settling: float) -> tuple[list[float], str]:
        """Return the ordinate that impacts or the first sample do not set, and a note on what lies beyond.

        ``time``: times [s], shape (n_t,); ``turns``, ``settling``: times of reversals, and how long impacts
        last after them [s].
        """
        values = np.array([curve.values for curve in self.curves if curve.values.shape == time.shape])
        if values.size == 0 or time.size < _FEW:
            return [], ""
        limits = smooth_limits(time, values, turns, settling) if self.smooth else None
        if limits is not None:
            return list(limits), f"cut off: impacts reach {peak(values):.3g} {self.unit}".rstrip()
        later = finite(values[:, 1:])
        if later.size and np.ptp(later) < _FIRST * np.ptp(finite(values)):
            room = 0.06 * float(np.ptp(later))
            note = f"cut off: the first sample has {peak(values[:, 0]):.3g} {self.unit}".rstrip()
            return [float(later.min()) - room, float(later.max()) + room], note
        return [], ""


_UNIT: Final = re.compile(r"\[([^\]]*)\]$", re.MULTILINE)
_FEW: Final = 8  #: Samples below which the first one is like the others.
#: Range of all later samples over that of all below which the first one does not set the ordinate.
_FIRST: Final = 0.5
_CONSTANT: Final = 1.0e-6  #: Range of a curve over its largest value that counts as constant.
_NOTHING: Final = 1.0e-9  #: Size of a curve over the largest one of its panel that counts as zero.
#: Values of errors and offsets that are rounding or the solver's, by unit.
_NOISE: Final = {"µm": 1.0e-4, "mm": 1.0e-7, "°": 1.0e-8, "mm/s": 1.0e-6, "°/s": 1.0e-6}


def telling(panels: Sequence[Panel]) -> tuple[list[Panel], str]:
    """Return the panels that vary, without curves that are zero, and a note on those that are constant."""
    varying, constant = [], []
    if not any(finite(curve.values).size for panel in panels for curve in panel.curves):
        return [*panels], ""
    forces = [peak(curve.values) for panel in panels if panel.unit == "N" for curve in panel.curves]
    # A moment of rounding has no size of its own: it is that of forces on a metre.
    noise = {**_NOISE, "N m": _NOTHING * max(forces, default=0.0)}
    for panel in panels:
        reach = [peak(curve.values) for curve in panel.curves]
        least = max(_NOTHING * max(reach, default=0.0), noise.get(panel.unit, 0.0))
        curves = [curve for curve, size in zip(panel.curves, reach, strict=True) if size > least]
        if any(np.ptp(finite(curve.values)) > _CONSTANT * peak(curve.values) for curve in curves):
            varying.append(replace(panel, curves=curves))
        elif curves:
            held, _ = replace(panel, curves=curves).fitted
            values = ", ".join(f"{one.name} {finite(one.values)[0]:.4g}" for one in held.curves)
            constant.append(f"{held.label.replace(chr(10), ' ')}: {values}")
    return varying, f"Constant: {'; '.join(constant)}." if constant else ""


def over_time(dataset: xr.Dataset, panels: Sequence[Panel]) -> dict[str, Any] | None:
    """Return panels above each other over the simulated time; nothing where nothing varies."""
    time = series(dataset, "time")
    panels, note = telling(panels)
    if time.size < 2 or not panels:
        return None
    turns = reversal_times(dataset)
    unit, scale = time_unit(dataset)
    return {
        "x_label": f"time [{unit}]",
        "time": True,
        "unit": unit,
        "scale": scale,
        "note": note,
        "coordinates": coordinates(dataset, scale),
        "turns": [float(turn * scale) for turn in turns],
        "windows": [[float(end * scale) for end in window] for window in impact_windows(dataset)],
        "panels": [_panel(panel, time, scale, turns, impact_time(dataset)) for panel in panels],
    }


def over(x: FloatArray, x_label: str, panels: Sequence[Panel], *, equal: bool = False) -> dict[str, Any]:
    """Return panels over something other than time, ``equal`` with one scale on both axes."""
    none = np.empty(0)
    return {
        "x_label": x_label,
        "time": False,
        "note": "",
        "equal": equal,
        "coordinates": [],
        "turns": [],
        "windows": [],
        "panels": [_panel(panel, x, 1.0, none, 0.0) for panel in panels],
    }


def _panel(panel: Panel, x: FloatArray, scale: float, turns: FloatArray, settling: float) -> dict[str, Any]:
    """Return a panel as the script reads it, with the abscissa times a scale."""
    panel, factor = panel.fitted
    limits, note = panel.ordinate(x, turns, settling)
    shown = limits[1] - limits[0] if limits else _range(panel)
    return {
        "label": panel.label,
        "quantity": panel.quantity,
        "factor": factor,
        "limits": limits,
        "note": note,
        "curves": [_curve(curve, x, scale, shown / FINEST) for curve in panel.curves],
    }


def _range(panel: Panel) -> float:
    """Return the range of all finite values of a panel; 0 when there are none."""
    values = np.concatenate([np.empty(0), *(finite(curve.values) for curve in panel.curves)])
    return float(np.ptp(values)) if values.size else 0.0


def _curve(curve: ChartCurve, common: FloatArray, scale: float, tolerance: float) -> dict[str, Any]:
    """Return a curve as the script reads it, without what a screen cannot show."""
    x = scale * common if curve.x is None else curve.x
    y = curve.values
    if np.all(np.diff(x) > 0.0):
        x, y = straightened(*thinned(x, y), tolerance)
    return {
        "name": curve.name,
        "colour": curve.colour,
        "dash": curve.dash,
        "width": curve.width,
        "x": stepped(x, 0.0),
        "y": stepped(y, tolerance),
    }


@dataclass(frozen=True)
class Chart:
    """Panels above each other over the simulated time or something else: a section and a figure."""

    name: str  #: File name of its figure, and identifier of its section in the report.
    title: str  #: What it shows.
    caption: str  #: How to read it, in a sentence or two.
    needs: tuple[str, ...]  #: Names of the variables without which it is left out.
    panels: Callable[[xr.Dataset], Sequence[Panel]]  #: Returns what is drawn.
    #: Returns label and values of another axis than time, shape (n,).
    abscissa: Callable[[xr.Dataset], tuple[str, FloatArray]] | None = None
    fading: str = ""  #: Name of the curve that has faded where the close-up of a figure ends; empty for none.

    @property
    def section(self) -> Section:
        """The chart in the report."""
        return Section(
            name=self.name.replace("_", "-"),
            title=self.title,
            caption=self.caption,
            needs=self.needs,
            widget="lines",
            data=self._payload,
            still=self.name,
        )

    def drawn(self, dataset: xr.Dataset) -> list[Panel]:
        """Return the panels that vary, in units that fit."""
        return [panel.fitted[0] for panel in telling(self.panels(dataset))[0]]

    def _payload(self, dataset: xr.Dataset) -> Payload | None:
        if self.abscissa is None:
            return over_time(dataset, self.panels(dataset))
        label, x = self.abscissa(dataset)
        return over(x, label, self.panels(dataset)) if x.size > 1 else None
