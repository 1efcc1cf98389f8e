"""A mechanism as lines between its joints: where the points of every body are, as pictures need it."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING, Final, TypeAlias

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.cases.case import unit
from tribodyn.cases.fields import Vector
from tribodyn.cases.load import parse
from tribodyn.core.errors import InputError
from tribodyn.mechanism.frames import GROUND
from tribodyn.mechanism.mechanism_case import MechanismCase

if TYPE_CHECKING:
    import xarray as xr

#: Numbers of bodies, −1 for the ground, with points of each in the drawing [m], shape (n, 3).
Outline: TypeAlias = tuple[tuple[int, FloatArray], ...]

MM: Final = 1e3
_FLAT: Final = 0.2  #: A mechanism thinner than this share of its size is looked at across its plane.


def case_of(dataset: "xr.Dataset") -> MechanismCase | None:
    """Return the case of a result; nothing where its text is not (or no longer) one of a mechanism."""
    return _case_of(str(dataset.attrs.get("case", "")))


@lru_cache(maxsize=1)
def _case_of(text: str) -> MechanismCase | None:
    """Return the case of a text, which several figures and sections of one result ask for."""
    kinds = {MechanismCase.kind(): MechanismCase}
    try:
        case = parse(text, "case of the result", kinds)
    except InputError:
        return None
    return case if isinstance(case, MechanismCase) else None


_BOX: Final = 0.06  #: Half the length of the box that a slider is drawn as, over the extent of all joints.


@dataclass(frozen=True)
class Mark:
    """A joint as it is drawn."""

    name: str  #: Its name.
    body: int  #: Number of the body that carries it; −1 for the ground.
    #: Place [m] and direction in the drawing; no direction for a ball.
    point: FloatArray
    axis: FloatArray | None
    real: bool  #: Whether it has clearance.
    grounded: bool  #: Whether one of its bodies is the ground.


@dataclass(frozen=True)
class Skeleton:
    """Lines and points of a picture of a mechanism."""

    bodies: tuple[str, ...]  #: Names.
    centres: FloatArray  #: Mass centres in the drawing [m], shape (n_bodies, 3).
    #: Of each body the ends of its lines as modelled [m], shape (n, 3): joints, ends of rods, points of loads
    #: and outputs; the mass centre where these are fewer than two.
    points: tuple[FloatArray, ...]
    marks: tuple[Mark, ...]  #: The joints.
    #: Lines that show elements: numbers of the bodies that carry one, −1 for the ground, and the points of
    #: each in the drawing [m], shape (n, 3).
    outlines: tuple[Outline, ...] = ()
    springs: tuple[Outline, ...] = ()  #: Lines along springs, likewise.

    def lines(self, body: int, position: FloatArray, orientation: FloatArray) -> FloatArray:
        """Return the ends of the lines of a body [mm], (..., n, 3); its mass centre is in metres."""
        return self.moved(self.points[body], body, position, orientation)

    def moved(
        self, points: FloatArray, body: int, position: FloatArray, orientation: FloatArray
    ) -> FloatArray:
        """Return the places of points (n, 3) of the model [m] that a body carries [mm], shape (..., n, 3).

        −1 is the number of the ground; then the position and the orientation are those of any body.
        """
        if body < 0:
            return np.broadcast_to(MM * points, (*position.shape[:-1], *points.shape))
        arms = points - self.centres[body]
        return MM * (position[..., None, :] + rotated(orientation[..., None, :], arms))


def outline_at(
    drawn: Skeleton, outline: Outline, position: FloatArray, orientation: FloatArray
) -> FloatArray:
    """Return a line [mm], shape (..., n, 3), from the motion of all bodies, (..., n_bodies, 3 or 4)."""
    parts = [
        drawn.moved(points, body, position[..., body, :], orientation[..., body, :])
        for body, points in outline
    ]
    return np.concatenate(parts, axis=-2)


def skeleton(case: MechanismCase) -> Skeleton:
    """Return the picture's lines for the mechanism of a case."""
    names = tuple(case.bodies)
    centres = np.array([body.centre for body in case.bodies.values()])
    ends: list[list[FloatArray]] = [[] for _ in names]
    for name, point in _ends(case):
        if name != GROUND:
            own = ends[names.index(name)]
            own += [] if any(np.allclose(point, other) for other in own) else [np.array(point)]
    points = tuple(
        np.array(own if len(own) > 1 else [*own, centre]) for own, centre in zip(ends, centres, strict=True)
    )
    marks = tuple(_mark(case, name, names) for name in case.joints)
    return Skeleton(
        names, centres, points, marks, tuple(_outlines(case, names)), tuple(_springs(case, names))
    )


def _ends(case: MechanismCase) -> Iterator[tuple[str, Vector]]:
    """Yield the points of bodies that lines lead to: joints, ends of rods, points of loads and outputs."""
    for joint in case.joints.values():
        yield from zip(joint.between, (joint.point, joint.other_point or joint.point), strict=True)
    for name, body in case.bodies.items():
        yield from ((name, end) for end in (body.start, body.end) if end is not None)
    for load in case.loads.values():
        yield from [] if load.point is None else [(load.body, load.point)]
    for output in case.outputs.values():
        yield from [] if output.point is None else [(output.body, output.point)]
        yield from [] if output.reference_point is None else [(output.reference, output.reference_point)]


def _outlines(case: MechanismCase, bodies: tuple[str, ...]) -> Iterator[Outline]:
    """Yield the lines that show elements but springs."""
    yield from (_numbered(outline, bodies) for outline in _sliders(case))
    for _, _, keys in case.elements():
        for outline in () if keys.IS_SPRING else keys.outlines(case.joints):
            yield _numbered(outline, bodies)


def _sliders(case: MechanismCase) -> Iterator[Iterable[tuple[str, FloatArray]]]:
    """Yield a box around the pin of each body on a straight guide, and the line of the guide."""
    size = _BOX * float(np.max(np.ptp([joint.point for joint in case.joints.values()], axis=0)))
    for guide in case.joints.values():
        if (
            "angle" in guide.kind.COORDINATES
            or "position" not in guide.kind.COORDINATES
            or guide.axis is None
        ):
            continue
        carrier, slider = guide.between if guide.between[1] != GROUND else guide.between[::-1]
        pins = [one for one in case.joints.values() if slider in one.between and one is not guide]
        pin = next((one for one in pins if one.axis is not None), None)
        along, middle = np.array(unit(guide.axis, "axis")), np.array((pin or guide).point)
        across = np.cross(
            unit(pin.axis, "axis") if pin and pin.axis else np.eye(3)[np.argmin(np.abs(along))], along
        )
        if not across.any():
            continue
        across *= size / np.linalg.norm(across)
        corners = [
            a * size * along + b * 0.6 * across for a, b in ((1, 1), (-1, 1), (-1, -1), (1, -1), (1, 1))
        ]
        yield [(slider, middle + np.array(corners))]
        yield [(carrier, middle + np.array([[-3.0], [3.0]]) * size * along)]


def _springs(case: MechanismCase, bodies: tuple[str, ...]) -> Iterator[Outline]:
    """Yield the lines along springs, linear ones first."""
    for spring in case.springs.values():
        first, second = np.array(spring.points)[:, None]
        yield _numbered(zip(spring.between, (first, second), strict=True), bodies)
    for _, _, keys in case.elements():
        for outline in keys.outlines(case.joints) if keys.IS_SPRING else ():
            yield _numbered(outline, bodies)


def _numbered(outline: Iterable[tuple[str, FloatArray]], bodies: tuple[str, ...]) -> Outline:
    """Return a line by the numbers of its bodies."""
    return tuple((-1 if body == GROUND else bodies.index(body), points) for body, points in outline)


def _mark(case: MechanismCase, name: str, bodies: tuple[str, ...]) -> Mark:
    joint = case.joints[name]
    first = joint.between[0]
    axis = np.array(unit(joint.axis, "axis")) if joint.axis is not None and joint.kind.AXIS else None
    body = -1 if first == GROUND else bodies.index(first)
    return Mark(name, body, np.array(joint.point), axis, joint.real is not None, GROUND in joint.between)


def rotated(quaternion: FloatArray, vectors: FloatArray) -> FloatArray:
    """Return vectors turned by unit quaternions (w, x, y, z); shapes (..., 4) and (..., 3)."""
    w, axis = quaternion[..., :1], quaternion[..., 1:]
    twice = 2.0 * np.cross(axis, vectors)
    return np.asarray(vectors + w * twice + np.cross(axis, twice))


def back(quaternion: FloatArray) -> FloatArray:
    """Return the inverse of unit quaternions (w, x, y, z), shape (..., 4)."""
    return np.asarray(quaternion * np.array([1.0, -1.0, -1.0, -1.0]))


def view(points: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the directions from which a mechanism that comes to points (n, 3) is seen, and up."""
    spans = np.ptp(points, axis=0)
    thin = int(np.argmin(spans))
    up = np.eye(3)[2 if thin != 2 else 1]
    if spans[thin] <= _FLAT * spans.max():
        across = np.eye(3)[thin]
        return (across if thin == 2 else -across), up
    eye = np.array([0.55, -1.0, 0.45])
    return eye / np.linalg.norm(eye), up
