"""Figures of the vane of the paper, in the order in which one reads them."""

from typing import Any, Final

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from mebdf.arrays import FloatArray
from tribodyn.figures import chart, pressure, style
from tribodyn.figures.chart import Family
from tribodyn.papers.cheng_2022.reduced.case import VsvCase
from tribodyn.papers.cheng_2022.reduced.sections import (
    CHARTS,
    MM,
    case_of,
    crank_pivot,
    crank_tip,
    ring_points,
)
from tribodyn.views.bushing_sections import ORBIT
from tribodyn.views.playback import finite, series
from tribodyn.views.wear import WEAR_HISTORY

TITLE: Final = "The mechanism at three vane positions"
_LOOKS: Final[tuple[tuple[str, style.LineStyle], ...]] = (
    (style.BLUE, style.DASHED),
    (style.INK, style.SOLID),
    (style.VERMILION, style.DOTTED),
)


def draw(dataset: xr.Dataset) -> Figure:
    """Draw crank, drag link, unison ring, lever and vane [mm]."""
    figure = style.sheet(dataset, TITLE, 3.3)
    along, above = figure.subplots(1, 2, width_ratios=(2.1, 1.0))
    case, angle = case_of(dataset), series(dataset, "theta_v", 180.0 / np.pi)
    for axes, text in ((along, "seen along the casing axis"), (above, "seen from above")):
        style.caption(axes, text)
        axes.set_aspect("equal")
    if case is None or not finite(angle).size:
        style.note(along, "nothing to draw")
    else:
        for moment, look in zip(_moments(angle), _LOOKS, strict=True):
            _draw_at(along, above, case, dataset, moment, look)
        _frame(along, above, case)
        style.legend_below(figure, above, 3)
    style.finish(along, "X [mm]", "Z [mm]")
    style.finish(above, "X [mm]", "Y [mm]")
    return figure


def _moments(angle: FloatArray) -> tuple[int, int, int]:
    """Return the positions of the smallest, the middle and the largest vane angle."""
    middle = 0.5 * (np.nanmin(angle) + np.nanmax(angle))
    return int(np.nanargmin(angle)), int(np.nanargmin(np.abs(angle - middle))), int(np.nanargmax(angle))


def _draw_at(
    along: Axes,
    above: Axes,
    case: VsvCase,
    dataset: xr.Dataset,
    moment: int,
    look: tuple[str, style.LineStyle],
) -> None:
    """Draw every body at one row of the result."""
    at = {name: float(dataset[name].values[moment]) for name in ("theta_a", "theta_b", "theta_v", "h_1")}
    colour, dash = look
    drawn: dict[str, Any] = {"color": colour, "linestyle": dash, "linewidth": 1.6}
    m = case.mechanism
    joint = ring_points(case, at["theta_b"], at["h_1"], np.array([m.ring_angle]))[0]
    chain = np.stack([crank_pivot(case), crank_tip(case, np.array([at["theta_a"]]))[0], joint])
    along.plot(chain[:, 0], chain[:, 2], marker="o", ms=4, **drawn)
    arc = ring_points(case, at["theta_b"], at["h_1"], np.linspace(-0.15, m.ring_angle + 0.15, 90))
    along.plot(arc[:, 0], arc[:, 2], color=style.PALE, linewidth=3.5, zorder=1)
    near = ring_points(case, at["theta_b"], at["h_1"], np.linspace(-0.1, 0.1, 9))
    above.plot(near[:, 0], near[:, 1], color=style.PALE, linewidth=3.5, zorder=1)
    lever = MM * m.lever_length * np.array([np.cos(at["theta_v"]), np.sin(at["theta_v"])])
    label = f"vane at {np.rad2deg(at['theta_v']):.1f}°"
    above.plot([0.0, lever[0]], [0.0, lever[1]], marker="o", ms=4, label=label, **drawn)
    along.plot([0.0, lever[0]], [MM * m.ring_radius] * 2, **drawn)


def _frame(along: Axes, above: Axes, case: VsvCase) -> None:
    """Draw the bodies at rest, and name the bodies."""
    m, joint = case.mechanism, case.joint
    top, half = MM * m.ring_radius, MM * joint.radius
    along.plot(
        [0.0, 0.0], [top - MM * m.vane_length, top], color=style.GREY, linewidth=5.0, alpha=0.6, zorder=1
    )
    along.plot([-2 * half, 2 * half], [top - MM * joint.length] * 2, color=style.GREY, linewidth=2.0)
    pivot = crank_pivot(case)
    places = {
        "vane": (12.0, top - 0.6 * MM * m.vane_length),
        "unison ring": (0.62 * top * np.sin(m.ring_angle), 1.02 * top * np.cos(0.55 * m.ring_angle)),
        "crank": (pivot[0] - 12.0, pivot[2] - 8.0),
    }
    for name, (x, z) in places.items():
        along.text(x, z, name, size=style.SMALL, color=style.INK, ha="left" if name != "crank" else "right")
    above.text(6.0, -4.0, "trunnion", size=style.SMALL, color=style.INK)
    above.set_ylim(bottom=-0.3 * MM * m.lever_length)


FAMILY: Final = Family(
    name="mechanism",
    title=TITLE,
    caption=(
        "Crank, drag link, unison ring and lever where the vane stands at its ends and halfway, to scale."
    ),
    needs=("theta_a", "theta_b", "theta_v", "h_1"),
    draw=draw,
)


FIGURES: Final[dict[str, Family]] = {
    family.name: family
    for family in (
        *map(chart.family, CHARTS),
        pressure.family(ORBIT),
        pressure.FAMILY,
        pressure.WEAR_FAMILY,
        FAMILY,
        chart.family(WEAR_HISTORY),
    )
}
