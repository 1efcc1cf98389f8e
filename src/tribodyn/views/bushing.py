"""The bushing laid flat: where it is cut open, and its part that the script ``field`` draws."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from mebdf.arrays import FloatArray
from tribodyn.views.encode import packed, quantised
from tribodyn.views.section import Payload

#: Angles at which the bushing is cut open [deg], the preferred one first.
CUTS: Final = (90.0, 270.0, 180.0, 0.0, 45.0, 135.0, 225.0, 315.0)
#: Further angles of the cut, for load at all of the others.
_BETWEEN: Final = tuple(float(cut) for cut in range(0, 360, 15) if cut not in CUTS)
_BORDERS: Final = (30.0, 15.0, 5.0)  #: Widths of free borders on both sides of a cut [deg], the best first.

_GAP: Final = 0.6 * np.pi  #: Angle without a node from which a surface is not all around [rad].
WALL: Final = "angle from +X towards +Y [°]"  #: Label of an axis with the angles of :func:`wall_angles`.
_MOST_STEPS: Final = 3  #: Labelled stretches between the middle and an edge.


def wall_angles(dataset: xr.Dataset) -> FloatArray:
    """Return the angles of the nodes of a bushing, from +X towards +Y [rad], shape (n_theta,).

    Clearance circles and maps of all mechanisms count angles so. The variable ``theta`` of a bushing follows
    the source paper: it is the direction in which the contact pushes the shaft, half a turn away.
    """
    return np.asarray((dataset["theta"].values + np.pi) % (2.0 * np.pi))


def best_cut(theta: FloatArray, load: FloatArray) -> float:
    """Return the angle [deg] of :data:`CUTS` with no load around it, or else any with the least at it.

    ``theta``: angles [rad], shape (n_theta,); ``load``: what should not be cut, at each angle, shape
    (n_theta,).
    """
    size = np.nan_to_num(np.abs(load))

    def near(cut: float, border: float) -> float:
        distance = np.abs((np.rad2deg(theta) - cut + 180.0) % 360.0 - 180.0)
        return float(size[distance <= border].max(initial=0.0))

    for border in _BORDERS:
        for cut in CUTS:
            # What is below a hundredth of the peak may be cut: the preferred cut then wins.
            if near(cut, border) <= 0.01 * size.max(initial=0.0):
                return cut
    return min((*CUTS, *_BETWEEN), key=lambda cut: near(cut, _BORDERS[-1]))


def shares(frames: FloatArray) -> FloatArray:
    """Return the largest share that each angle ever has of the peak of its frame: what may be seen there.

    ``frames``: fields, shape (n, n_theta, n_z). Returns shape (n_theta,), from 0 to 1.
    """
    size = np.nan_to_num(np.abs(frames))
    peaks = size.max(axis=(1, 2), keepdims=True, initial=0.0)
    of_frame = np.divide(size, peaks, out=np.zeros_like(size), where=peaks > 0.0)
    return np.asarray(of_frame.max(axis=(0, 2), initial=0.0))


def rolled(theta: FloatArray, field: FloatArray, cut: float) -> tuple[FloatArray, FloatArray]:
    """Return angles [deg] growing from ``cut`` once around, and the field in that order.

    ``theta``: angles [rad], shape (n_theta,); ``field``: values, shape (n_theta, ...); ``cut``: where the
    bushing is cut open [deg]. Returns shapes (n_theta + 1,) and (n_theta + 1, ...): the first point comes
    again at the end. Of a surface that is not all around, as a wall, angles begin behind its gap, and no
    point comes again.
    """
    gaps = np.diff(np.sort(theta), append=theta.min() + 2.0 * np.pi)
    if theta.size > 2 and gaps.max() > _GAP:
        order = np.roll(np.argsort(theta), -1 - int(np.argmax(gaps)))
        first = float(theta[order[0]])
        return np.rad2deg(first + (theta[order] - first) % (2.0 * np.pi)), field[order]
    # Rounded, so that an angle that is the cut does not lie a whole turn behind it.
    around = np.round(np.rad2deg(theta) - cut, 9) % 360.0
    order = np.argsort(around)
    angle = cut - 360.0 * (cut > 180.0) + around[order]
    return np.append(angle, angle[0] + 360.0), np.concatenate([field[order], field[order[:1]]])


def unloaded_middle(dataset: xr.Dataset, field: FloatArray) -> float:
    """Return the height [mm] below which nothing happens: a long empty middle is shown shortened.

    ``dataset``: a result with ``z`` [m]; ``field``: what is to be shown, shape (n_theta, n_z). Returns
    nothing above a hundredth of the peak lies at smaller distances from the middle; 0 where the empty part is
    less than half of the bushing.
    """
    distance = np.abs(dataset["z"].values) * 1e3
    loaded = distance[field.max(axis=0) > 0.01 * field.max(initial=0.0)]
    below = distance[distance < loaded.min()] if loaded.size else distance[:0]
    height = np.floor(2.0 * below.max()) / 2.0 if below.size else 0.0
    return float(height) if height >= 0.5 * distance.max() else 0.0


def shortened(z: FloatArray, empty: float, half: float) -> FloatArray:
    """Return the places of heights when the middle ``|z| < empty`` gets an eighth of the room.

    ``z``: heights, any shape; ``empty``, ``half``: where the middle ends and where the bushing ends, in the
    unit of ``z``; an ``empty`` of 0 leaves the heights as they are.
    """
    bend = (half - empty) / 7.0 if empty else 0.0
    near = z * (bend / empty) if empty else z
    return np.where(np.abs(z) < empty, near, np.sign(z) * (bend + np.abs(z) - empty))


def height_marks(half: float, empty: float) -> FloatArray:
    """Return round heights to label outside the middle, and both edges, increasing, in the unit given."""
    steps = _round_steps(empty, half)
    marks = np.union1d(steps[(steps >= empty) & (steps < half)], [half])
    return np.asarray(np.union1d(-marks, marks) + 0.0)  # makes a minus zero a plain one


def _round_steps(low: float, high: float) -> FloatArray:
    """Return multiples of 1, 2 or 5 times a power of ten, at most three stretches between the ends."""
    exact = (high - low) / _MOST_STEPS
    power = 10.0 ** np.floor(np.log10(exact))
    step = power * next(factor for factor in (1.0, 2.0, 5.0, 10.0) if factor * power >= exact * (1.0 - 1e-9))
    return np.asarray(step * np.arange(np.floor(low / step), np.ceil(high / step) + 1.0))


@dataclass(frozen=True)
class Unrolled:
    """Nodes of the bushing when it is cut open."""

    theta: FloatArray  #: Angles of the nodes from +X towards +Y [rad], shape (n_theta,).
    z: FloatArray  #: Heights of the nodes [mm], shape (n_z,), increasing from edge to edge.
    cut: float  #: Where it is cut [°].
    empty: float  #: Height [mm] below which nothing happens and the drawing is shortened; 0 where it is not.
    #: What is added to heights where they are shown [mm]: the middle of a surface that is not about zero.
    middle: float = 0.0

    @property
    def angle(self) -> FloatArray:
        """Angles from the cut once around [°], shape (n_theta + 1,); of a wall from edge to edge."""
        return rolled(self.theta, self.theta, self.cut)[0]

    def turned(self, field: FloatArray) -> FloatArray:
        """Return values of shape (n_theta, ...) at these angles."""
        return rolled(self.theta, field, self.cut)[1]

    @property
    def heights(self) -> FloatArray:
        """Places of the nodes in the drawing, shape (n_z,)."""
        return self.drawn(self.z)

    def drawn(self, z: ArrayLike) -> FloatArray:
        """Return the places of heights [mm] in the drawing."""
        return shortened(np.asarray(z, dtype=np.float64), self.empty, float(self.z[-1]))

    @property
    def label(self) -> str:
        """Label of the axial axis."""
        return "z [mm]\n(middle shortened)" if self.empty else "z [mm]"

    @property
    def angle_ticks(self) -> tuple[FloatArray, list[str]]:
        """Places and texts of the marks of angles."""
        first, last = self.angle[[0, -1]]
        turns = 45.0 * np.arange(np.ceil(first / 45.0 - 1e-9), np.floor(last / 45.0 + 1e-9) + 1.0)
        return turns, [f"{turn % 360:.0f}" for turn in turns]

    @property
    def height_ticks(self) -> tuple[FloatArray, list[str]]:
        """Places and texts of the marks of heights."""
        half = float(self.z[-1])
        marks = np.array([-half, 0.0, half]) if self.middle else height_marks(half, self.empty)
        return self.drawn(marks), [f"{mark + self.middle:.3g}".replace("-", "−") for mark in marks]

    @property
    def axes(self) -> dict[str, Any]:
        """Coordinates and tick marks for the script."""
        (turns, turn_texts), (marks, mark_texts) = self.angle_ticks, self.height_ticks
        return {
            "angle": packed(self.angle),
            "height": packed(self.heights),
            "z": packed(self.z + self.middle),
            "angle_ticks": turns.tolist(),
            "angle_texts": turn_texts,
            "height_ticks": marks.tolist(),
            "height_texts": mark_texts,
            "empty": self.drawn([-self.empty, self.empty]).tolist() if self.empty else [],
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

        ``fields``: in their unit, shape (n, n_theta, n_z); ``label``, ``unit``: what they are; ``usual``:
        returns the end of the common scale of colours from the peaks, shape (n,); ``stages``: what each field
        is of; empty where they follow the playback.
        """
        rows = np.moveaxis(self.turned(np.moveaxis(fields, 1, 0)), 0, 2)
        steps, peaks = quantised(rows)
        return {
            **self.axes,
            "unit": unit,
            "stages": list(stages),
            "label": f"{label} [{unit}]",
            "largest": float(peaks.max()),
            "usual": float(usual(peaks)),
            "steps": packed(steps, "uint8"),
            "peaks": packed(peaks),
        }


def unrolled(
    dataset: xr.Dataset, fields: FloatArray, load: FloatArray | None = None, theta: FloatArray | None = None
) -> Unrolled:
    """Return the bushing of a result, cut where it is not loaded, a long empty middle shortened.

    ``dataset``: a result with ``theta`` [rad] and ``z`` [m]; ``fields``: what is to be shown, shape (n,
    n_theta, n_z); ``load``: what should not be cut, at each angle, shape (n_theta,); by default the largest
    of the fields; ``theta``: angles of the nodes [rad], shape (n_theta,); by default those of the wall.
    """
    theta = wall_angles(dataset) if theta is None else theta
    envelope = np.max(fields, axis=0, initial=0.0)
    cut = best_cut(theta, envelope.max(axis=1, initial=0.0) if load is None else load)
    return Unrolled(theta, dataset["z"].values * 1e3, cut, unloaded_middle(dataset, envelope))
