"""The bushing laid flat, as the script ``field`` draws it."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from tribodyn.core.arrays import FloatArray
from tribodyn.views.encode import packed, quantised
from tribodyn.views.section import Payload
from tribodyn.views.unrolled import height_marks, rolled, shortened, wall_angles


@dataclass(frozen=True)
class Unrolled:
    """Nodes of the bushing when it is cut open.

    Attributes
    ----------
    theta
        Angles of the nodes from +X towards +Y [rad], shape (n_theta,).
    z
        Heights of the nodes [mm], shape (n_z,), increasing from edge to edge.
    cut
        Where it is cut [°].
    empty
        Height [mm] below which nothing happens and the drawing is shortened; 0 where it is not.
    middle
        What is added to heights where they are shown [mm]: the middle of a surface that is not about zero.
    """

    theta: FloatArray
    z: FloatArray
    cut: float
    empty: float
    middle: float = 0.0

    def reordered(self, fields: FloatArray) -> FloatArray:
        """Return fields of shape (n, n_theta, n_z) as rows for the drawing, (n, n_z, n_theta + 1)."""
        turned = np.moveaxis(fields, 1, 0)
        return np.moveaxis(rolled(self.theta, turned, self.cut)[1], 0, 2)

    def axes(self) -> dict[str, Any]:
        """Return coordinates and tick marks."""
        angle = rolled(self.theta, np.zeros((self.theta.size, 1)), self.cut)[0]
        half = float(self.z[-1])
        marks = np.array([-half, 0.0, half]) if self.middle else height_marks(half, self.empty)
        turns = 45.0 * np.arange(np.ceil(angle[0] / 45.0 - 1e-9), np.floor(angle[-1] / 45.0 + 1e-9) + 1.0)
        return {
            "angle": packed(angle),
            "height": packed(self._drawn(self.z)),
            "z": packed(self.z + self.middle),
            "angle_ticks": [float(turn) for turn in turns],
            "angle_texts": [f"{turn % 360:.0f}" for turn in turns],
            "height_ticks": [float(mark) for mark in self._drawn(marks)],
            "height_texts": [f"{mark + self.middle:.3g}".replace("-", "−") for mark in marks],
            "empty": [float(edge) for edge in self._drawn(np.array([-self.empty, self.empty]))]
            if self.empty
            else [],
        }

    def payload(
        self,
        fields: FloatArray,
        label: str,
        unit: str,
        usual: Callable[[NDArray[np.float32]], float] = np.max,
        stages: Sequence[str] = (),
    ) -> Payload:
        """Return the data of the script ``field``: fields in 255 steps of their own peaks.

        Parameters
        ----------
        fields
            In their unit, shape (n, n_theta, n_z).
        label, unit
            What they are.
        usual
            Returns the end of the common scale of colours from the peaks, shape (n,).
        stages
            What each field is of; empty where they follow the playback.
        """
        steps, peaks = quantised(self.reordered(fields))
        return {
            **self.axes(),
            "unit": unit,
            "stages": list(stages),
            "label": f"{label} [{unit}]",
            "largest": float(peaks.max()),
            "usual": float(usual(peaks)),
            "steps": packed(steps, "uint8"),
            "peaks": packed(peaks),
        }

    def _drawn(self, z: FloatArray) -> FloatArray:
        """Return the places of heights in the picture [mm]."""
        return shortened(z, self.empty, float(self.z[-1]))


def unrolled(dataset: xr.Dataset, cut: float, empty: float) -> Unrolled:
    """Return the places of a result's nodes.

    Parameters
    ----------
    dataset
        A result with ``theta`` [rad] and ``z`` [m].
    cut
        Where the bushing is cut open [°].
    empty
        From :func:`tribodyn.figures.unrolled.unloaded_middle` [mm].
    """
    return Unrolled(wall_angles(dataset), dataset["z"].values * 1e3, cut, empty)
