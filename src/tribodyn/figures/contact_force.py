"""Contact force with its rigid and damping parts, and its impact after a reversal."""

from typing import Final

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tribodyn.core.arrays import FloatArray
from tribodyn.figures import style
from tribodyn.figures.chart import cut_off, mark_reversals
from tribodyn.figures.figure_family import Family
from tribodyn.views.charts import ChartCurve, Panel
from tribodyn.views.events import finite, impact_time, peak, reversal_times, series

TITLE: Final = "Contact force on the trunnion"
TOTAL: Final = "#b4b4b4"


def draw(dataset: xr.Dataset) -> Figure:
    """Draw total, rigid and damping force along X and Y [N]: the whole run, and one reversal close up."""
    figure = style.sheet(dataset, TITLE, 5.6)
    grid = figure.subplots(2, 2, sharex="col", width_ratios=(1.7, 1.0))
    turns, settling, (start, end) = reversal_times(dataset), impact_time(dataset), close_up(dataset)
    time = series(dataset, "time")
    for (whole, close), axis in zip(grid, "xy", strict=True):
        curves = _curves(dataset, axis)
        _draw_curves(whole, time, curves)
        panel = Panel("force [N]", [ChartCurve(name, values) for values, name, *_ in curves], smooth=True)
        cut_off(whole, *panel.ordinate(time, turns, settling))
        mark_reversals(whole, turns)
        _shade(whole, time, start, end)
        _draw_close_up(close, time, curves, start, end)
        style.finish(whole, y_label=f"force along {axis.upper()} [N]")
        style.finish(close)
    _label(figure, grid[0, 0], grid[0, 1], start)
    grid[1, 0].set_xlabel("time [s]")
    grid[1, 1].set_xlabel(f"time after {start:.4g} s [ms]")
    return figure


def _curves(dataset: xr.Dataset, axis: str) -> style.Curves:
    """Return the three curves of one direction."""
    return [
        (series(dataset, f"F_c{axis}"), "total contact force", TOTAL, style.SOLID),
        (series(dataset, f"F_k{axis}"), "rigid part", style.BLUE, style.SOLID),
        (series(dataset, f"F_d{axis}"), "damping part", style.VERMILION, style.DASHED),
    ]


def _draw_curves(axes: Axes, time: FloatArray, curves: style.Curves) -> None:
    """Draw the total as a broad band with its parts as fine lines on top: where they agree, both are seen."""
    style.lines(axes, time, curves[:1], width=3.2)
    style.lines(axes, time, curves[1:], width=1.1)
    axes.axhline(0.0, color=style.GREY, linewidth=0.8, zorder=1)


def close_up(dataset: xr.Dataset) -> tuple[float, float]:
    """Return start and end [s] of the close-up: the reversal with the hardest impact, until it is quiet."""
    time = series(dataset, "time")
    size = np.hypot(series(dataset, "F_cx"), series(dataset, "F_cy"))
    if not finite(size).size:
        return 0.0, 0.1
    start = _hardest(time, size, reversal_times(dataset), impact_time(dataset))
    return start, start + _ringing_time(dataset, start)


def _hardest(time: FloatArray, size: FloatArray, turns: FloatArray, settling: float) -> float:
    """Return the reversal followed by the largest force; without reversals, the time of the largest force."""
    if not turns.size:
        return float(time[np.nanargmax(size)])
    peaks = [peak(size[(time >= turn) & (time <= turn + settling)]) for turn in turns]
    return float(turns[int(np.argmax(peaks))])


def _ringing_time(dataset: xr.Dataset, start: float) -> float:
    """Return the time after ``start`` for which the damping force exceeds 0.1 of its peak, 0.03 to 0.3 s."""
    time = series(dataset, "time")
    near = (time >= start) & (time <= start + 0.3)
    damping = np.hypot(series(dataset, "F_dx"), series(dataset, "F_dy"))[near]
    loud = time[near][damping > 0.1 * peak(damping)]
    return float(np.clip(1.4 * (loud[-1] - start), 0.03, 0.3)) if loud.size else 0.1


def _draw_close_up(axes: Axes, time: FloatArray, curves: style.Curves, start: float, end: float) -> None:
    """Draw the stretch from just before ``start`` [s] to ``end`` [s], its time counted in ms."""
    lead = 0.1 * (end - start)
    inside = (time >= start - lead) & (time <= end)
    values = finite(np.array([curve[0][inside] for curve in curves]))
    shifted = [(curve[inside], label, colour, dash) for curve, label, colour, dash in curves]
    _draw_curves(axes, (time[inside] - start) * 1e3, shifted)
    axes.set_xlim(-lead * 1e3, (end - start) * 1e3)
    if values.size:
        margin = 0.08 * max(float(np.ptp(values)), 1e-9)
        axes.set_ylim(float(values.min()) - margin, float(values.max()) + margin)
    axes.set_facecolor("#fdf8ee")


def _shade(axes: Axes, time: FloatArray, start: float, end: float) -> None:
    """Shade the stretch of the close-up, a little wider so that it is seen in a long run."""
    more = 0.012 * float(np.ptp(time)) if time.size else 0.0
    axes.axvspan(start - more, end + more, color="#f3e2c0", zorder=0)


def _label(figure: Figure, whole: Axes, close: Axes, start: float) -> None:
    """Write the headings and the one legend."""
    style.caption(whole, "whole run")
    style.caption(close, f"close up at {start:.4g} s (shaded)")
    handles, labels = whole.get_legend_handles_labels()
    figure.legend(
        handles,
        labels,
        loc="outside lower center",
        ncols=3,
        frameon=False,
        fontsize=style.SMALL,
        handlelength=2.8,
    )


FAMILY: Final = Family(
    name="contact_force",
    title=TITLE,
    caption=(
        "Force of the bushing on the trunnion along X and Y, and the two parts it is made of. The close-up "
        "is the hardest reversal: the trunnion crosses the clearance and lands on the other side."
    ),
    needs=("F_cx", "F_cy", "F_kx", "F_ky", "F_dx", "F_dy", "omega_v_ideal"),
    draw=draw,
)
