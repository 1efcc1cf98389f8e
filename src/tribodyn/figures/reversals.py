"""Reversals in figures: marked, and kept from flattening what lies between them."""

from __future__ import annotations

from matplotlib.axes import Axes

from tribodyn.core.arrays import FloatArray
from tribodyn.figures.style import GREY, SMALL
from tribodyn.views.events import smooth_limits
from tribodyn.views.series import peak


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


def limit_to_smooth(
    axes: Axes, time: FloatArray, values: FloatArray, turns: FloatArray, impact_time: float, unit: str
) -> None:
    """Scale the y axis to the smooth motion where impacts would flatten it, and say what lies outside.

    Parameters
    ----------
    axes
        Axes to scale; an axis that begins at zero stays so.
    time
        Times [s], shape (n_t,).
    values
        What is drawn, shape (..., n_t).
    turns, impact_time
        Reversal times, and how long impacts last after them [s].
    unit
        Unit of the values.
    """
    limits = smooth_limits(time, values, turns, impact_time)
    if not limits:
        return
    axes.set_ylim(*limits)
    loud = peak(values)
    text = f"cut off: impacts reach {loud:.3g} {unit}"
    axes.text(1.0, 1.02, text, transform=axes.transAxes, ha="right", size=SMALL - 0.5, color=GREY)
