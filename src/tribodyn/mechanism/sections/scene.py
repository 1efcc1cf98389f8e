"""Parts of a scene beside bodies: motion in clearances, to be magnified; forces and moments as arrows."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, Final

import numpy as np
import xarray as xr

from mebdf.arrays import FloatArray
from tribodyn.cases.case import unit
from tribodyn.core.signals import Signal
from tribodyn.joints.point_contact import FlatWalls
from tribodyn.joints.shapes import Guide, Slot
from tribodyn.mechanism.assembly.clearance_surfaces import axes_of
from tribodyn.mechanism.assembly.skeleton import MM, Skeleton, rotated
from tribodyn.mechanism.frames import frame, tilted
from tribodyn.mechanism.mechanism_case import MechanismCase
from tribodyn.mechanism.model.drives_and_loads import LoadKeys
from tribodyn.mechanism.model.parts import JointKeys
from tribodyn.mechanism.results.derived_columns import OBSERVED, coordinate, followed_by
from tribodyn.mechanism.sections.charts import Shafts
from tribodyn.mechanism.sections.joints import loaded_joints
from tribodyn.mechanism.shapes import SHAPES
from tribodyn.mechanisms.shaft_loads import Factors, parts_of
from tribodyn.views.encode import packed
from tribodyn.views.numbers import fitting, in_words
from tribodyn.views.playback import magnification, playback_times

_OVER: Final = ("times", *OBSERVED)
_NUMBERS: Final = {over: number for number, over in enumerate(_OVER)}  #: Numbers of what signals follow.


@dataclass(frozen=True)
class LoadArrows:
    """Point, force and moment of a load at the frames."""

    point: FloatArray  #: Where its force acts [mm], shape (n_frames, 3).
    #: Global axes [N] and [N m], shapes (n_frames, 3).
    force: FloatArray
    moment: FloatArray


def load_arrows(
    dataset: xr.Dataset, case: MechanismCase, drawn: Skeleton, position: FloatArray, orientation: FloatArray
) -> dict[str, LoadArrows]:
    """Return points, forces and moments of loads at the frames, by name, for those with stored motion.

    ``dataset``, ``case``, ``drawn``: the result, its case, and what is drawn of it; ``position``,
    ``orientation``: of all bodies at the frames, shapes (n_frames, n_bodies, 3) and (n_frames, n_bodies, 4).
    """
    found = {}
    for name, load in case.loads.items():
        if not {*followed_by(load)} <= set(map(str, dataset.variables)):
            continue
        body = drawn.bodies.index(load.body)
        moved, turned = position[:, body], orientation[:, body]
        point = np.array([load.acts_at(case.bodies[load.body].centre)])
        where = drawn.moved(point, body, moved, turned)[:, 0]
        arm = rotated(turned, np.broadcast_to(point[0] - drawn.centres[body], moved.shape))
        force, moment = _Load(dataset, case, load, body).at(turned, arm)
        found[name] = LoadArrows(where, force, moment)
    return found


@dataclass(frozen=True)
class _Load:
    """A load on the body with a number, in a result."""

    dataset: xr.Dataset
    case: MechanismCase
    load: LoadKeys
    body: int

    def at(self, turned: FloatArray, arm: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return force and moment at the frames, from quaternions of the body and the arm of the force."""
        if self.load.frame == "motion":
            return self._opposing(arm)
        wrench = np.zeros((arm.shape[0], 6))
        for vector, factors in parts_of(self.load, _NUMBERS, self.case.period, self.case.span):
            wrench += self._product(factors)[:, None] * vector
        force, moment = wrench[:, :3], wrench[:, 3:]
        return (
            (rotated(turned, force), rotated(turned, moment))
            if self.load.frame == "body"
            else (force, moment)
        )

    def _opposing(self, arm: FloatArray) -> tuple[FloatArray, FloatArray]:
        spin = self._interpolated(self.dataset["angular_velocity"].values[:, self.body])
        of_moment = "moment" in self.load.given
        speed = spin
        if not of_moment:
            speed = self._interpolated(self.dataset["velocity"].values[:, self.body]) + np.cross(spin, arm)
        if self.load.direction is not None:
            line = np.array(unit(self.load.direction, "direction"))
            speed = np.outer(speed @ line, line)
        own = np.linalg.norm(speed, axis=-1)
        size = np.zeros_like(own)
        for _, factors in parts_of(self.load, _NUMBERS, self.case.period, self.case.span):
            size += self._product(factors, own)
        vector = -(size / np.maximum(own, self.load.slip))[:, None] * speed
        nothing = np.zeros_like(vector)
        return (nothing, vector) if of_moment else (vector, nothing)

    def _product(self, factors: Factors, own: FloatArray | None = None) -> FloatArray:
        """Return the product of signals at the frames; tables may follow the load's own speed."""
        found = np.ones(playback_times(self.dataset).shape)
        for signal, number in factors:
            found = found * _values(signal, self._followed(_OVER[number], own))
        return found

    def _followed(self, over: str, own: FloatArray | None) -> FloatArray:
        if over == "times":
            return playback_times(self.dataset)
        if self.load.along is None:
            assert own is not None
            return own
        columns = {OBSERVED[over]: self.dataset[OBSERVED[over]].values}
        return self._interpolated(coordinate(self.case, columns, self.load.along, over))

    def _interpolated(self, values: FloatArray) -> FloatArray:
        """Return rows at the frames, shape (n_frames, ...)."""
        times, time = playback_times(self.dataset), self.dataset["time"].values
        if values.ndim == 1:
            return np.interp(times, time, values)
        return np.stack([np.interp(times, time, column) for column in values.T], axis=-1)


def _values(signal: Signal, places: FloatArray) -> FloatArray:
    """Return the values of a signal, shape of ``places``."""
    if signal.kind != "table":
        return np.array([signal.at(place) for place in places.tolist()])
    if signal.period:
        places = signal.knots[0] + np.mod(places - signal.knots[0], signal.period)
    return signal(places)


_SUSTAINED: Final = 99.0  #: Percentile of the force over time for which an arrow has its full length.


def clearances(
    dataset: xr.Dataset, case: MechanismCase, drawn: Skeleton, orientation: FloatArray
) -> dict[str, dict[str, Any]]:
    """Return the pins and balls of joints with clearance at the frames, by the names of the joints.

    ``dataset``, ``case``, ``drawn``: the result, its case, and what is drawn of it; ``orientation``:
    quaternions of the bodies at the frames, shape (n_frames, n_bodies, 4). Returns radii, length and radial
    clearance [mm]; at the frames the offset of the pin from the axis of its bore [mm] and the difference of
    their directions, global axes. The length of a ball is zero.
    """
    shafts, times, known = Shafts(dataset, case), playback_times(dataset), dataset["clearance"].values
    found = {}
    for number, (name, joint) in enumerate(case.joints.items()):
        keys = joint.real
        if keys is None or not np.isfinite(known[number]):
            continue
        shape = SHAPES[joint.shape].of(keys, np.asarray)
        radius = shape.radius if isinstance(shape, Guide) else keys.radius
        if radius is None:
            continue
        to_global = _axes(case, joint, drawn, orientation)
        offset, tilt = shafts.at(number, times), _tilt(dataset, number, times)
        tilt = 0.0 * offset if isinstance(shape, Slot) else tilt
        walls = _walls(shape, MM * offset[:, 2]) if isinstance(shape, FlatWalls) else {}
        if walls:
            walls |= {"slid": packed(MM * offset[:, 2]), "aside": packed(to_global[:, :, 0])}
        if joint.kind.COORDINATES:
            offset = offset * [1.0, 1.0, 0.0]
        if not (np.isfinite(offset).all() and np.isfinite(tilt).all()):
            continue
        found[name] = {
            "radius": MM * radius,
            "length": MM * (keys.length or 0.0),
            "radial": MM * float(known[number]),
            "offset": packed(MM * np.einsum("nij,nj->ni", to_global, offset)),
            "tilt": packed(np.einsum("nij,nj->ni", to_global, tilt)),
            **walls,
        }
    return found


def _walls(shape: FlatWalls, way: FloatArray) -> dict[str, Any]:
    """Return the cross-sections of walls that a block or pin slides some way along, and their ends [mm].

    Each has its corners, and by how much a gap sets them off. A pin has half its length across its slot.
    """
    half, low, high = 0.5 * MM * shape.length, float(way.min(initial=0.0)), float(way.max(initial=0.0))
    walls = [{"corners": (MM * points).tolist(), "ways": ways.tolist()} for points, ways in shape.outlines()]
    if isinstance(shape, Slot):
        beyond = 1.5 * MM * shape.radius
        return {"walls": walls, "across": True, "half": half, "ends": [low - beyond, high + beyond]}
    if shape.through:
        return {"walls": walls, "half": half + max(high, -low), "ends": [-half, half]}
    return {"walls": walls, "half": half, "ends": [low - half, high + half]}


def magnified(found: Iterable[dict[str, Any]]) -> dict[str, Any] | None:
    """Return the range of the magnification, None where there is no clearance to magnify."""
    ratios = [one["radius"] / one["radial"] for one in found if one["radial"] > 0.0]
    return magnification(min(ratios)) if ratios else None


def _axes(case: MechanismCase, joint: JointKeys, drawn: Skeleton, orientation: FloatArray) -> FloatArray:
    """Return the axes of a joint at the frames as columns, which its bore carries; shape (n_frames, 3, 3)."""
    columns, by_first = frame(*axes_of(case, joint)), joint.sign > 0.0
    carrier = joint.between[0 if by_first else 1]
    columns = tilted(columns, joint.tilt) if by_first else columns
    if carrier not in drawn.bodies:
        return np.broadcast_to(columns, (orientation.shape[0], 3, 3))
    turned = rotated(orientation[:, None, drawn.bodies.index(carrier)], columns.T)
    return np.asarray(np.swapaxes(turned, 1, 2))


def _tilt(dataset: xr.Dataset, joint: int, times: FloatArray) -> FloatArray:
    """Return the tilt of a shaft against its bore, axes of the joint, shape (n, 3)."""
    time = dataset["time"].values
    x, y = (np.interp(times, time, dataset[name].values[:, joint]) for name in ("tilt_x", "tilt_y"))
    return np.stack([y, -x, 0.0 * x], axis=-1)


def forces(
    dataset: xr.Dataset, case: MechanismCase, drawn: Skeleton, position: FloatArray, orientation: FloatArray
) -> dict[str, Any]:
    """Return arrows: forces and moments of the joints that carry most, on their second bodies, and of loads.

    In global axes. Those of joints are from the axes of the joints, which results of large models hold, too.
    Each kind has the size that an arrow of full length represents, which impacts exceed. Parameters are those
    of :func:`clearances` and the positions of the bodies at the frames, shape (n_frames, n_bodies, 3).
    """
    times, time = playback_times(dataset), dataset["time"].values
    joints = list(case.joints.items())
    loads = load_arrows(dataset, case, drawn, position, orientation)
    points = {name: load.point for name, load in loads.items()}
    found: dict[str, Any] = {}
    for kind, of in (("force", "N"), ("moment", "N m")):
        arrows = {}
        for j in loaded_joints(dataset).joints:
            columns = np.nan_to_num(dataset[f"reaction_{kind}"].values[:, j]).T
            own = np.stack([np.interp(times, time, column) for column in columns], axis=-1)
            name, joint = joints[j]
            arrows[name] = np.einsum("nij,nj->ni", _axes(case, joint, drawn, orientation), own)
        found |= _arrows(kind, f"Joint {kind}s", of, arrows)
        of_loads = {name: getattr(load, kind) for name, load in loads.items()}
        found |= _arrows(f"load_{kind}", f"Load {kind}s", of, of_loads, points)
    return found


def _arrows(
    kind: str,
    label: str,
    unit: str,
    vectors: Mapping[str, FloatArray],
    points: Mapping[str, FloatArray] = MappingProxyType({}),
) -> dict[str, Any]:
    """Return arrows of one kind as the script reads them; nothing where all are zero."""
    sizes = {
        name: float(np.percentile(np.linalg.norm(one, axis=-1), _SUSTAINED)) for name, one in vectors.items()
    }
    scale = max(sizes.values(), default=0.0)
    if not 0.0 < scale < np.inf:
        return {}
    shown = [name for name, size in sizes.items() if size > 0.0]
    of, factor = fitting(unit, [scale])
    about = {"label": label, "words": f"{in_words(scale * factor, 2)} {of}", "scale": scale}
    at = {name: packed(vectors[name]) for name in shown}
    return {
        kind: about | {"at": at, "points": {name: packed(points[name]) for name in shown if name in points}}
    }
