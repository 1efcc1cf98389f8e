"""The mechanism as a film: its bodies as lines between their joints, one moment after the other."""

from __future__ import annotations

from typing import Final

import numpy as np
import xarray as xr

from tribodyn.core.arrays import FloatArray
from tribodyn.core.errors import InputError
from tribodyn.figures.style import INK, caption, finish, sheet
from tribodyn.mechanism.assembly.skeleton import MM, Skeleton, case_of, outline_at, skeleton, view
from tribodyn.mechanism.figures.mechanism import direction, draw_at, draw_joints, paper
from tribodyn.mechanism.sections.mechanism import at_times
from tribodyn.views.playback import time_unit

TITLE: Final = "The mechanism in motion"
_ROOM: Final = 0.08
"""Room around the mechanism, as a share of its size."""


def moving(dataset: xr.Dataset, times: FloatArray) -> tuple[Skeleton, FloatArray, FloatArray]:
    """Return the picture's content, with positions and orientations at some times; refuse a body at rest."""
    case, motion = case_of(dataset), at_times(dataset, times)
    if case is None or motion is None:
        raise InputError("this result holds no motion to show", key="animate")
    return skeleton(case), *motion


class MechanismFilm:
    """A figure that shows the mechanism at one of some times.

    Parameters
    ----------
    dataset
        A result.
    times
        Times that may be shown [s], shape (n_t,).
    """

    def __init__(self, dataset: xr.Dataset, times: FloatArray) -> None:
        self._drawn, self._position, self._orientation = moving(dataset, times)
        unit, scale = time_unit(dataset)
        self._times = [f"{scale * t:.4g} {unit}" for t in times]
        self._plane = paper(*view(MM * self._position.reshape(-1, 3)))
        self.figure = sheet(dataset, TITLE, 4.2)
        self._axes = self.figure.subplots()
        everywhere = np.concatenate([part.reshape(-1, 3) for part in self._parts()]) @ self._plane.T
        low, high = everywhere.min(axis=0), everywhere.max(axis=0)
        room = _ROOM * float(np.linalg.norm(high - low))
        self._limits = [(a - room, b + room) for a, b in zip(low, high, strict=True)]
        self.show(0)
        # Arranging the parts of a figure takes longer than drawing it: once is enough.
        self.figure.draw_without_rendering()
        self.figure.set_layout_engine("none")

    def _parts(self) -> list[FloatArray]:
        """Return all points that are drawn at any time [mm]."""
        drawn, position, orientation = self._drawn, self._position, self._orientation
        lines = [drawn.lines(b, position[:, b], orientation[:, b]) for b in range(len(drawn.bodies))]
        elements = (*drawn.outlines, *drawn.springs)
        return [*lines, *(outline_at(drawn, line, position, orientation) for line in elements)]

    def show(self, frame: int) -> None:
        """Draw the mechanism at one of the times."""
        axes = self._axes
        axes.clear()
        axes.set_aspect("equal")
        now = self._position[frame], self._orientation[frame]
        draw_at(axes, self._drawn, self._plane, *now, INK)
        draw_joints(axes, self._drawn, self._plane, *now)
        axes.set_xlim(self._limits[0])
        axes.set_ylim(self._limits[1])
        finish(axes, *(direction(row) for row in self._plane))
        caption(axes, self._times[frame], "right")
