"""Shafts between flat walls: which of their corners touch, over time, and the shares of time of that.

The four situations are those of the literature on sliders with clearance: a free block, one corner, two
corners on one face, and two on faces that look at each other, where the block is tilted as far as it goes.
"""

from collections.abc import Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import NDArray

from mebdf.arrays import FloatArray
from tribodyn.joints.clearances import Place
from tribodyn.joints.point_contact import FlatWalls
from tribodyn.joints.shapes import Surface
from tribodyn.kernels.joints.surface.data import GAP, SurfaceData
from tribodyn.kernels.joints.surface.tilt import LINE
from tribodyn.mechanism.assembly.parts_by_number import Model
from tribodyn.mechanism.results import joint_readings as readings
from tribodyn.mechanisms.mechanism_protocol import ByPart
from tribodyn.results.reading import of_part, time_mean
from tribodyn.results.summary import KeyResult

if TYPE_CHECKING:
    import xarray as xr

#: Contacts of a block by names, with labels; results hold their numbers.
SITUATIONS: Final = {
    "free": ("Free", "nothing of the block touches"),
    "corner": ("On one corner", "one corner touches"),
    "face": ("On one face", "two corners of one face touch, or all of it"),
    "tilted": ("On opposite faces", "corners of opposite faces touch: it is tilted as far as it goes"),
}
_POSE: Final = ("displacement", "tilt_x", "tilt_y", "joint_angle")


def guide_columns(
    model: Model,
    data: SurfaceData,
    places: Sequence[Place],
    rows: Mapping[str, FloatArray],
    openings: FloatArray,
) -> dict[str, FloatArray]:
    """Return the situations of guides over time, (n_t, n_joints), NaN for others; nothing without any.

    The data are those of the run, with its wear; ``rows`` are observed of all couplings, openings what
    temperatures have added to the clearances of joints that have one [m], shape (n_t, n, 2).
    """
    found = np.full((len(rows["tilt_x"]), len(model.joints)), np.nan)
    for j, (number, clearance) in enumerate(zip(model.real, model.clearances.values(), strict=True)):
        if not isinstance(clearance.shape, FlatWalls):
            continue
        pose = np.column_stack([rows[name][:, number] for name in _POSE])
        walls = [place for place in places if place.joint == j]
        gaps = [_gaps(one.surface, data.nodes[GAP, one.nodes], pose, openings[:, j]) for one in walls]
        touching = np.stack(gaps, axis=1) < clearance.onset * clearance.roughness
        found[:, number] = situation(touching, np.array([wall.surface.normal[0] for wall in walls]))
    return {"guide_contact": found} if np.isfinite(found).any() else {}


def _gaps(wall: Surface, drawn: FloatArray, pose: FloatArray, openings: FloatArray) -> FloatArray:
    """Return the least gap of a wall at its first and its last row [m], shape (n_t, 2)."""
    rows, columns = wall.field_shape
    ends = np.arange(rows * columns).reshape(rows, columns)[[0, -1]]
    place, n = np.where([1, 1, 1, 0, 0, 1] if wall.tilt == LINE else True, pose, 0.0), wall.normal[0]
    arms = np.cross(wall.position[ends], n)
    near = (place[:, :3] @ n)[:, None, None] + np.einsum("ti,eki->tek", place[:, 3:], arms)
    if wall.slides:
        near -= (pose[:, 2] * (n[0] * pose[:, 4] - n[1] * pose[:, 3]))[:, None, None]
    return np.asarray((drawn[ends] - near).min(axis=2) + (openings @ wall.opens)[:, None])


def situation(touching: NDArray[np.bool_], normals: FloatArray) -> FloatArray:
    """Return the numbers of situations (n_t,) from whether ends of walls touch, (n_t, n_walls, 2)."""
    facing = normals @ normals.T < -_FACING
    crossed = np.einsum("twe,wv,tve->t", touching, facing, touching[..., ::-1]) > 0.0
    flat = np.all(touching, axis=2).any(axis=1)
    return np.where(crossed, 3.0, np.where(flat, 2.0, 1.0 * np.any(touching, axis=(1, 2))))


_FACING: Final = 1.0e-6  #: Least cosine against each other of the normals of two faces that are opposite.


def _share(number: int, label: str, what: str) -> ByPart:
    """Return the share of time in which a guide is in a situation."""

    def value(dataset: "xr.Dataset", joint: str) -> float:
        where = of_part(dataset, "guide_contact", readings.of_joint(dataset, joint))
        inside = np.where(np.isnan(where), np.nan, 100.0 * (where == number))
        return time_mean(dataset, inside)

    def made(joint: str) -> KeyResult:
        meaning = f"Share of the time in which {what}."
        return KeyResult(label, "%", "Guides", meaning, partial(value, joint=joint)).of_part(joint)

    return made


#: Key results of each guide, by what stands before its name.
BY_GUIDE: Final[dict[str, ByPart]] = {
    f"{name}_share_percent": _share(number, *about) for number, (name, about) in enumerate(SITUATIONS.items())
}
