"""Values of the outputs of a mechanism from the motion of its bodies.

With the observed point P and the point Q of the reference, whose attitude is A, the quantities are the
components of

    position: Aᵀ (P − Q),    velocity: its rate,    distance: |P − Q|,

and the angle of the body about an axis of the reference: that of the relative rotation, of whose unit
quaternion the axis takes the part

    2 atan2(q·a, q₀)

(the twist of the decomposition into swing and twist); the angular velocity is its rate.
"""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from typing import TYPE_CHECKING, Final

import numpy as np

from mebdf.arrays import FloatArray
from mebdf.kernels.elementary import portable
from tribodyn.cases.case import unit
from tribodyn.kernels import dense
from tribodyn.kernels.mechanism.data import N_STATES, ORIENTATION, TURNING, VELOCITY
from tribodyn.mechanism.assembly.pieces import RigidPieces, pieces_of
from tribodyn.mechanism.assembly.skeleton import rotated
from tribodyn.mechanism.mechanism_case import MechanismCase
from tribodyn.mechanism.model.output_declarations import OutputKeys

if TYPE_CHECKING:
    from scipy.spatial.transform import Rotation


@dataclass(frozen=True)
class Motion:
    """Motion of all bodies at some times, in global axes."""

    position: FloatArray  #: Of the mass centres [m], shape (n_t, n_bodies, 3).
    #: Quaternions, scalar first, that turn the bodies from the drawing, shape (n_t, n_bodies, 4).
    orientation: FloatArray
    velocity: FloatArray  #: Of the mass centres [m/s], shape (n_t, n_bodies, 3).
    angular_velocity: FloatArray  #: In global axes [rad/s], shape (n_t, n_bodies, 3).


#: Quantities that are rates, with what they are rates of.
_RATE_OF: Final = {"velocity": "position", "angular_velocity": "angle"}
MOTION: Final = tuple(field.name for field in fields(Motion))  #: Motion from which outputs are computed.


@dataclass(frozen=True)
class Output:
    """An output of a mechanism whose bodies are counted."""

    name: str  #: Its name.
    keys: OutputKeys  #: Its table.
    #: Numbers of the pieces of the two bodies; −1 for the ground.
    body: int
    reference: int
    #: Mass centres of the pieces as drawn, zeros for the ground, and of the first body [m], shape (3, 3).
    centres: FloatArray

    @property
    def is_rate(self) -> bool:
        """Whether it is the rate of another quantity."""
        return self.keys.quantity in _RATE_OF

    @property
    def has_displacement(self) -> bool:
        """Whether its error is that of a displacement and has a sign: no velocity, no length of a vector."""
        return not self.is_rate and (self.keys.quantity == "distance" or self.keys.along is not None)

    @property
    def unit(self) -> str:
        """Its SI unit."""
        return self.keys.unit

    def components(self, motion: Motion) -> FloatArray:
        """Return the value of an output for a motion, shape (n_t, 1), or (n_t, 3) without a direction."""
        if self.keys.quantity == "angle":
            return self._angle(motion)[:, None]
        if self.keys.quantity == "angular_velocity":
            return self._turning(motion)[:, None]
        point, rate = self._point_in_reference(motion)
        if self.keys.quantity == "distance":
            return np.asarray(np.linalg.norm(point, axis=1, keepdims=True))
        found = rate if self.keys.quantity == "velocity" else point
        return found if self.keys.along is None else (dense.product(found, self._along))[:, None]

    def as_place(self) -> Output:
        """Return the position or angle whose rate a velocity is; any other output itself."""
        if not self.is_rate:
            return self
        return replace(self, keys=self.keys.model_copy(update={"quantity": _RATE_OF[self.keys.quantity]}))

    def value(self, components: FloatArray) -> FloatArray:
        """Return its value over time, shape (n_t,): of three components the length."""
        if components.shape[1] == 1:
            return components[:, 0]
        return np.asarray(np.linalg.norm(components, axis=1))

    def error(self, components: FloatArray, ideal: FloatArray) -> FloatArray:
        """Return the difference from the ideal motion, shape (n_t,): of three components its length."""
        difference = components - ideal
        if self.keys.quantity == "angle":
            # Motions that differ by whole turns are the same.
            difference = np.remainder(difference + np.pi, 2.0 * np.pi) - np.pi
        return self.value(difference)

    def rate(self, motion: Motion) -> FloatArray:
        """Return the rate of its value, of a velocity the value itself, shape (n_t,)."""
        if self.is_rate:
            return self.value(self.components(motion))
        if self.keys.quantity == "angle":
            return self._turning(motion)
        point, rate = self._point_in_reference(motion)
        if self.keys.quantity == "distance" or self.keys.along is None:
            length = np.linalg.norm(point, axis=1)
            return np.asarray(np.sum(point * rate, axis=1) / np.where(length > 0.0, length, np.nan))
        return np.asarray(dense.product(rate, self._along))

    @property
    def _along(self) -> FloatArray:
        assert self.keys.along is not None
        return np.array(unit(self.keys.along, "along"))

    def _angle(self, motion: Motion) -> FloatArray:
        """Return the angle about the axis, without jumps [rad], shape (n_t,)."""
        q = self._relative(motion)
        return np.asarray(np.unwrap(2.0 * portable.atan2(dense.product(q[:, :3], self._along), q[:, 3])))

    def _relative(self, motion: Motion) -> FloatArray:
        """Return the quaternions that turn the reference to the body, scalar last, shape (n_t, 4)."""
        of_body, of_reference = (_rotation(motion, b) for b in (self.body, self.reference))
        return np.atleast_2d((of_reference.inv() * of_body).as_quat())

    def _turning(self, motion: Motion) -> FloatArray:
        """Return the rate of the angle about the axis [rad/s], shape (n_t,): q̇ = (0, ω) q / 2."""
        q, against = self._relative(motion), _spin(motion, self.body) - _spin(motion, self.reference)
        spin, vector, scalar = (
            _rotation(motion, self.reference).apply(against, inverse=True),
            q[:, :3],
            q[:, 3],
        )
        scalar_rate = -np.sum(spin * vector, axis=1)
        rate = dense.product(scalar[:, None] * spin + np.cross(spin, vector), self._along)
        twist = dense.product(vector, self._along)
        return np.asarray((scalar * rate - twist * scalar_rate) / (scalar**2 + twist**2))

    def _point_in_reference(self, motion: Motion) -> tuple[FloatArray, FloatArray]:
        """Return the way from the reference point to the point, and its rate, in axes of the reference."""
        drawn = self.centres[2] if self.keys.point is None else np.array(self.keys.point)
        other = drawn if self.keys.reference_point is None else np.array(self.keys.reference_point)
        first, first_rate = _of_point(motion, self.body, drawn - self.centres[0])
        second, second_rate = _of_point(motion, self.reference, other - self.centres[1])
        turn, spin = _rotation(motion, self.reference), _spin(motion, self.reference)
        way = first - second
        rate = first_rate - second_rate - np.cross(spin, way)
        return turn.apply(way, inverse=True), turn.apply(rate, inverse=True)


def outputs_of(case: MechanismCase) -> tuple[Output, ...]:
    """Return the outputs of a case."""
    pieces = pieces_of(case)
    return tuple(observing(pieces, name, keys) for name, keys in case.outputs.items())


def observing(pieces: RigidPieces, name: str, keys: OutputKeys) -> Output:
    """Return an output of the bodies of a case."""
    body, reference = pieces.numbers[keys.body], pieces.numbers[keys.reference]
    centres = [*pieces.centres[[body, reference]], pieces.bodies[keys.body].centre]
    return Output(name, keys, body, reference, np.array(centres))


def motion_of(state: FloatArray) -> Motion:
    """Return the motion at one instant, shapes (1, n_bodies, …), from the state (13 n_bodies,)."""
    parts = np.split(state.reshape(1, -1, N_STATES), [ORIENTATION, VELOCITY, TURNING], axis=2)
    position, orientation, velocity, turning = parts
    return Motion(position, orientation, velocity, rotated(orientation, turning))


def _rotation(motion: Motion, body: int) -> Rotation:
    """Return the rotation of a body from its position in the model; none for the ground."""
    from scipy.spatial.transform import Rotation

    if body < 0:
        return Rotation.from_quat(np.tile([0.0, 0.0, 0.0, 1.0], (motion.position.shape[0], 1)))
    return rotations(motion.orientation[:, body])


def rotations(quaternions: FloatArray) -> Rotation:
    """Return the rotations of quaternions, scalar first, shape (n, 4)."""
    from scipy.spatial.transform import Rotation

    return Rotation.from_quat(np.roll(quaternions, -1, axis=1))


def _spin(motion: Motion, body: int) -> FloatArray:
    """Return the angular velocity of a body [rad/s], shape (n_t, 3)."""
    return np.zeros_like(motion.position[:, 0]) if body < 0 else motion.angular_velocity[:, body]


def _of_point(motion: Motion, body: int, arm: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return place [m] and velocity [m/s] of a point of a body, ``arm`` from its mass centre as drawn."""
    if body < 0:
        place = np.tile(arm, (motion.position.shape[0], 1))
        return place, np.zeros_like(place)
    turned = _rotation(motion, body).apply(arm)
    velocity = motion.velocity[:, body] + np.cross(motion.angular_velocity[:, body], turned)
    return motion.position[:, body] + turned, velocity
