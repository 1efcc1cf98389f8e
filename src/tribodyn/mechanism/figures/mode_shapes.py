"""Shapes of the lowest modes about the first position at rest."""

from __future__ import annotations

from typing import Final

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from tribodyn.core.arrays import FloatArray
from tribodyn.figures.base import Family
from tribodyn.figures.style import INK, PALE, finish, note, sheet
from tribodyn.mechanism.assembly.skeleton import MM, case_of, skeleton, view
from tribodyn.mechanism.figures.mechanism import direction, draw_at, paper

TITLE: Final = "Shapes of the modes"
_DRAWN: Final = 3
"""Modes that are drawn, those of the lowest frequency."""
_FAR: Final = 0.15
"""Largest displacement over the size of the mechanism, and largest turn [rad], as drawn."""


def draw(dataset: xr.Dataset) -> Figure:
    """Draw every body at rest, pale, and displaced by a mode, exaggerated."""
    figure = sheet(dataset, TITLE, 3.4)
    case, modes = case_of(dataset), dataset.isel(time=slice(0, 1), mode=slice(0, _DRAWN))
    panels = figure.subplots(1, max(modes.sizes["mode"], 1), squeeze=False)[0]
    if case is None or modes["mode_shape"].size == 0:
        note(panels[0], "nothing to draw")
        return figure
    drawn, position, orientation = skeleton(case), *(modes[n].values[0] for n in ("position", "orientation"))
    lines = [drawn.lines(body, position[body], orientation[body]) for body in range(len(drawn.bodies))]
    plane, size = paper(*view(np.concatenate(lines))), np.ptp(np.concatenate(lines), axis=0).max() / MM
    for number, axes in enumerate(panels):
        way, turn = (modes[name].values[0, number] for name in ("mode_shape", "mode_rotation"))
        scale = _FAR / max(np.abs(way).max() / size, np.abs(turn).max())
        axes.set_aspect("equal")
        axes.margins(0.12)
        frequency = (
            f"mode {modes['mode'].values[number]}, {modes['natural_frequency'].values[0, number]:.4g} Hz"
        )
        draw_at(axes, drawn, plane, position, orientation, PALE)
        draw_at(axes, drawn, plane, position + scale * way, turned(orientation, scale * turn), INK)
        axes.set_title(frequency)
        finish(axes, *(direction(row) for row in plane))
    return figure


def turned(orientation: FloatArray, turn: FloatArray) -> FloatArray:
    """Return quaternions (n, 4) after small turns about global axes [rad], shape (n, 3)."""
    w, v = orientation[:, :1], orientation[:, 1:]
    found = np.hstack(
        [w - 0.5 * np.sum(turn * v, axis=1, keepdims=True), v + 0.5 * (w * turn + np.cross(turn, v))]
    )
    return np.asarray(found / np.linalg.norm(found, axis=1, keepdims=True))


FAMILY: Final = Family(
    name="mode_shapes",
    title=TITLE,
    caption="Bodies at the first position at rest, pale, and displaced by the lowest modes, magnified.",
    needs=("mode_shape", "mode_rotation", "natural_frequency", "mode", "position", "orientation"),
    draw=draw,
)
