"""Figures: types of their families, their files, and a chart over time as a figure with its reversals."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Final, Protocol

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.backends.backend_pdf import FigureCanvasPdf
from matplotlib.figure import Figure
from numpy.typing import NDArray

from mebdf.arrays import FloatArray
from tribodyn.figures import style
from tribodyn.figures.style import GREY, SMALL, legend_below
from tribodyn.results.store import replacing
from tribodyn.views.charts import Chart, ChartMarks, Panel
from tribodyn.views.gltf import Solid
from tribodyn.views.playback import finite, impact_time, peak, reversal_times, series, time_unit
from tribodyn.views.section import angle_of


@dataclass(frozen=True)
class Family:
    """One figure that can be drawn from any result holding what it needs."""

    name: str  #: File name without ``.png``.
    title: str  #: What it shows.
    caption: str  #: How to read it, in a sentence or two.
    needs: tuple[str, ...]  #: Names of the variables without which it is not drawn.
    #: Draws it. A result may be short, empty or hold NaN: what is there is drawn, and a note names the rest.
    draw: Callable[[xr.Dataset], Figure]
    #: Whether a result that holds them has something to show.
    shows: Callable[[xr.Dataset], bool] = lambda dataset: True
    #: Draws it over the angle of a joint; None where it has no time axis.
    over: Callable[[xr.Dataset, str], Figure] | None = None

    def drawable(self, dataset: xr.Dataset) -> bool:
        """Whether the result holds the variables this figure needs, and something to show in them."""
        return all(name in dataset.variables for name in self.needs) and self.shows(dataset)


class MovingFigure(Protocol):
    """A figure that changes with time."""

    figure: Figure

    def show(self, frame: int) -> None:
        """Draw the state at one of the times."""


@dataclass(frozen=True)
class Animation:
    """Motion of a mechanism, as a film and as solids in space."""

    film: Callable[[xr.Dataset, FloatArray], MovingFigure]  #: From a result and times [s], shape (n_t,).
    #: Likewise the bodies with their motion, and the axis of the drawing that points upwards.
    solids: Callable[[xr.Dataset, FloatArray], tuple[list[Solid], str]]


FORMATS = (".png", ".pdf")


def save(figure: Figure, folder: Path, name: str) -> Path:
    """Write a figure as PNG and as PDF with its text as text.

    ``figure``: drawn; its layout is fixed by saving it; ``folder``: where to write; must exist; ``name``:
    file name without ending. Returns the PNG file; the PDF is in the same folder.
    """
    path = folder / f"{name}.png"
    save_png(figure, path)
    # Arranging the parts of a figure takes longer than drawing it: once is enough.
    figure.set_layout_engine("none")
    with replacing(path.with_suffix(".pdf")) as part:
        # Without a date the same result gives the same file.
        FigureCanvasPdf(figure).print_pdf(part, metadata={"CreationDate": None})
    return path


def save_png(figure: Figure, path: Path) -> None:
    """Write a figure as PNG.

    ``figure``: drawn; ``path``: file to write; its folder must exist.
    """
    with replacing(path) as part:
        # Figure.savefig would draw it twice. Compressed so it takes half of the time, and 4 % more bytes.
        FigureCanvasAgg(figure).print_png(part, pil_kwargs={"compress_level": 2})


def remove(folder: Path, name: str) -> None:
    """Remove the files of a figure, as far as there are any."""
    for ending in FORMATS:
        (folder / f"{name}{ending}").unlink(missing_ok=True)


COLOURS: Final = {
    "ink": style.INK,
    "blue": style.BLUE,
    "vermilion": style.VERMILION,
    "green": style.GREEN,
    "orange": style.ORANGE,
    "purple": style.PURPLE,
    "grey": style.GREY,
    "pale": "#b4b4b4",
}
DASHES: Final[dict[str, style.LineStyle]] = {
    "solid": style.SOLID,
    "dash": style.DASHED,
    "dot": style.DOTTED,
    "dashdot": style.DASHDOT,
    "longdash": (0, (9, 2)),
}
_PANEL: Final = 1.55  #: Height of a panel [in].
_WIDTHS: Final = (1.7, 1.0)  #: Of the columns of panels and of close-ups.
_LONGEST: Final = 0.3  #: Length of a close-up, at most [s].


def family(chart: Chart) -> Family:
    """Return the figure of a chart."""
    return Family(
        name=chart.name,
        title=chart.title,
        caption=chart.caption,
        needs=chart.needs,
        draw=partial(draw, chart),
        shows=lambda dataset: bool(chart.drawn(dataset)),
        over=partial(draw, chart) if chart.abscissa is None else None,
    )


def draw(chart: Chart, dataset: xr.Dataset, over: str = "") -> Figure:
    """Draw the panels of a chart above each other over its axis, or over the angle of a joint."""
    panels = chart.drawn(dataset)
    figure = style.sheet(dataset, chart.title, 1.1 + _PANEL * max(len(panels), 2))
    if not panels:
        style.note(figure.subplots(), "nothing varies")
        return figure
    closer = bool(chart.fading) and not over and dataset["time"].size > 1
    grid = figure.subplots(
        len(panels), 1 + closer, sharex="col", squeeze=False, width_ratios=_WIDTHS[: 1 + closer]
    )
    label, place, scale = _axis(chart, dataset, over)
    timed = chart.abscissa is None and not over
    turns = reversal_times(dataset) if timed else np.empty(0)
    for axes, panel in zip(grid[:, 0], panels, strict=True):
        _draw_panel(axes, panel, place)
        cut_off(axes, *panel.ordinate(place / scale, turns, impact_time(dataset) if timed else 0.0))
        if timed and panel.marks is not None:
            _draw_marks(axes, panel.marks, scale)
        mark_reversals(axes, scale * turns, label=axes is grid[-1, 0] and not panel.smooth)
        if len(panel.curves) > 1 and not closer:
            style.legend_beside(axes)
    grid[-1, 0].set_xlabel(label, size=style.TEXT)
    if closer:
        _draw_closer(grid, panels, series(dataset, "time"), close_up(dataset, chart), scale)
        legend_below(figure, grid[0, 0], 4)
    figure.align_ylabels()
    return figure


def _axis(chart: Chart, dataset: xr.Dataset, over: str) -> tuple[str, FloatArray, float]:
    """Return label and values of the axis, and their scale."""
    if over:
        return *angle_of(dataset, over), 1.0
    if chart.abscissa is not None:
        return *chart.abscissa(dataset), 1.0
    unit, scale = time_unit(dataset)
    return f"time [{unit}]", series(dataset, "time", scale), scale


def _draw_panel(axes: Axes, panel: Panel, place: FloatArray) -> None:
    for curve in panel.curves:
        look = curve.values, curve.name, COLOURS[curve.colour], DASHES[curve.dash]
        style.lines(axes, place, [look], width=0.75 * curve.width)
    style.finish(axes, y_label=panel.label)


def _draw_closer(
    grid: NDArray[np.object_],
    panels: Sequence[Panel],
    time: FloatArray,
    ends: tuple[float, float],
    scale: float,
) -> None:
    """Draw a stretch of each panel [s] beside it, from a tenth of its length before, in milliseconds."""
    start, end = ends
    lead, wider = 0.1 * (end - start), 0.012 * float(np.ptp(time))
    inside = (time >= start - lead) & (time <= end)
    for (whole, close), panel in zip(grid, panels, strict=True):
        whole.axvspan(scale * (start - wider), scale * (end + wider), color="#f3e2c0", zorder=0)
        shown = [replace(curve, values=curve.values[inside]) for curve in panel.curves]
        _draw_panel(close, replace(panel, curves=shown), 1e3 * (time[inside] - start))
        close.set(xlim=(-1e3 * lead, 1e3 * (end - start)), ylabel="", facecolor="#fdf8ee")
    style.caption(grid[0, 1], f"close up at {start:.4g} s (shaded)")
    grid[-1, 1].set_xlabel(f"time after {start:.4g} s [ms]", size=style.TEXT)


def close_up(dataset: xr.Dataset, chart: Chart) -> tuple[float, float]:
    """Return start and end [s] of the stretch from the hardest reversal until a curve has faded.

    The size of the first curves of all panels is largest after it; without reversals, at the start.
    """
    time, panels = series(dataset, "time"), chart.panels(dataset)
    size = np.linalg.norm([panel.curves[0].values for panel in panels], axis=0)
    if not finite(size).size:
        return 0.0, 0.1
    turns, settling = reversal_times(dataset), impact_time(dataset)
    peaks = [peak(size[(time >= turn) & (time <= turn + settling)]) for turn in turns]
    start = float(turns[int(np.argmax(peaks))] if peaks else time[np.nanargmax(size)])
    fading = [curve.values for panel in panels for curve in panel.curves if curve.name == chart.fading]
    near = (time >= start) & (time <= start + _LONGEST)
    left = np.linalg.norm(fading, axis=0)[near]
    loud = time[near][left > 0.1 * peak(left)]
    return start, start + (float(np.clip(1.4 * (loud[-1] - start), 0.03, _LONGEST)) if loud.size else 0.1)


def _draw_marks(axes: Axes, marks: ChartMarks, scale: float) -> None:
    middle = float(np.mean(axes.get_ylim()))
    axes.plot(scale * marks.times, marks.values, "o", ms=4.5, mfc="white", mec=style.BLUE, mew=1.2, zorder=4)
    for time, value, label in zip(scale * marks.times, marks.values, marks.labels, strict=False):
        offset = (0, 6) if value < middle else (0, -12)
        axes.annotate(
            label, (time, value), xytext=offset, textcoords="offset points", ha="center", size=style.SMALL
        )


def mark_reversals(axes: Axes, times: FloatArray, label: bool = False) -> None:
    """Draw a fine line at each reversal, and name the first one above the axes if asked."""
    for time in times:
        axes.axvline(time, color=GREY, linewidth=0.7, linestyle=(0, (1, 2)), zorder=1)
    if label and times.size:
        axes.annotate(
            "reversal",
            (times[0], 1.0),
            xycoords=("data", "axes fraction"),
            xytext=(0, 2),
            textcoords="offset points",
            ha="center",
            size=SMALL - 0.5,
            color=GREY,
        )


def cut_off(axes: Axes, limits: Sequence[float], note: str) -> None:
    """Give axes an ordinate that impacts or the first sample do not set, and say what lies outside."""
    if limits:
        axes.set_ylim(*limits)
        axes.text(1.0, 1.02, note, transform=axes.transAxes, ha="right", size=SMALL - 0.5, color=GREY)
