"""Errors of outputs by superposition: every joint displaces its bodies by itself.

In the ideal mechanism a joint with clearance passes on a reaction R. Its shaft then lies displaced by the
clearance c against the reaction, turned by the angle of friction,

    e = −c R_z(−s arctan μ) F / |F|,

s being the sense of rotation of the shaft. A cylinder of length L touches at both ends, each of which carries
F/2 ∓ z × M / L of force F and moment M: ends on one side displace the shaft, ends on opposite sides tilt it.
Between flat walls a shaft goes and tilts as far as these let force and moment push it; friction
acts along them. The pieces of elastic bodies yield to their reactions by their flexibility.

By virtual work an output moves with the displacement (e, φ) of joint k by the reaction in k to a unit load
along the output; with the constraints G of the ideal mechanism, and those of the joint N over (e, φ), by

    δq = G⁺ N (e, φ).

Surfaces are smooth and rigid here: roughness, which holds them apart, is left out.
"""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Final, TypeAlias

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.joints.clearances import Clearance
from tribodyn.joints.point_contact import Cornered, resting
from tribodyn.joints.shapes import Cylinder, Sphere
from tribodyn.kernels.mechanism.bodies import collect
from tribodyn.mechanism.analyses.ideal_motion import IdealMechanism, in_global_axes, motion_of
from tribodyn.mechanism.assembly.output_values import Output

#: Parts of the error of a joint; the last one is that of the pieces of elastic bodies.
CAUSES: Final = ("clearance", "tilt", "friction", "bending")
_NOTHING: Final = 1.0e-9  #: Force over the largest one that counts as zero.
#: Returns rates of the constraints at the position with a number, shape (n_rows, m).
Asked: TypeAlias = Callable[[int], FloatArray]


@dataclass(frozen=True)
class JointReaction:
    """Wrench of an ideal joint on its shaft over time, in axes of the joint."""

    clearance: Clearance  #: Of the real joint.
    friction: float  #: Its coefficient of friction.
    #: [N] and [N m], shape (n_t, 3).
    force: FloatArray
    moment: FloatArray
    spin: FloatArray  #: Angular velocity of the shaft about the axis [rad/s], shape (n_t,).

    def displacements(self) -> FloatArray:
        """Return displacement and rotation of the shaft by cause, shape (n_t, 4, 6), see ``CAUSES``."""
        found = np.zeros((len(self.force), len(CAUSES), 6))
        if isinstance(self.clearance.shape, Cornered):
            rests = resting(self.clearance.shape, -np.hstack([self.force, self.moment]))
            found[:, 0, :3], found[:, 1, 3:] = rests[:, :3], rests[:, 3:]
            return found
        straight, turned = self._ends(0.0), self._ends(math.atan(self.friction))
        found[:, 0, :3] = straight.mean(axis=0)
        found[:, 2, :3] = turned.mean(axis=0) - found[:, 0, :3]
        if isinstance(self.clearance.shape, Cylinder):
            slope = (straight[1] - straight[0]) / self.clearance.shape.length
            found[:, 1, 3], found[:, 1, 4] = -slope[:, 1], slope[:, 0]
        return found

    def _ends(self, friction: float) -> FloatArray:
        """Return the displacements at lower and upper end, of a ball twice one [m], shape (2, n_t, 3)."""
        shape = self.clearance.shape
        across = self.force if isinstance(shape, Sphere) else self.force * [1.0, 1.0, 0.0]
        arm = np.zeros_like(across)
        if isinstance(shape, Cylinder):
            arm[:, 0], arm[:, 1] = -self.moment[:, 1] / shape.length, self.moment[:, 0] / shape.length
        ends = -shape.clearance * np.stack([_unit(0.5 * across + arm), _unit(0.5 * across - arm)])
        angle = -friction * np.sign(self.spin)
        cosine, sine = np.cos(angle), np.sin(angle)
        x, y = ends[..., 0].copy(), ends[..., 1].copy()
        ends[..., 0], ends[..., 1] = cosine * x - sine * y, sine * x + cosine * y
        if isinstance(shape, Cylinder) and shape.faces:
            ends[..., 2] = self._along(shape)
        return ends

    def _along(self, shape: Cylinder) -> FloatArray:
        """Return the displacement along the axis until an end face carries [m], shape (n_t,)."""
        force = self.force[:, 2]
        least = _NOTHING * np.max(np.abs(self.force), initial=0.0)
        upper, lower = (shape.faces.get(end, 0.0) for end in ("upper", "lower"))
        return np.where(force < -least, upper, np.where(force > least, -lower, 0.0))


def missing(mechanism: IdealMechanism, displaced: Mapping[int, FloatArray]) -> Asked:
    """Return by how much rows miss for each joint and cause, shape (n_rows, n_joints n_causes).

    ``displaced``: displacement and rotation of the shaft by the numbers of joints, shape (n_t, n_causes, 6)
    each. The outputs that respond are along a direction, about an axis, or a distance.
    """
    system = mechanism.system
    rows = {k: [i for i, (number, _) in enumerate(system.rows) if number == k] for k in displaced}
    n_causes = next(iter(displaced.values())).shape[1]

    def missed(position: int) -> FloatArray:
        found = np.zeros((len(system.rows), n_causes * len(displaced)))
        for place, k in enumerate(displaced):
            normals = system.now.couplings["N"][k][: len(rows[k])]
            columns = slice(n_causes * place, n_causes * (place + 1))
            found[rows[k], columns] = normals @ displaced[k][position].T
        return found

    return missed


def responses(
    mechanism: IdealMechanism, outputs: Sequence[Output], times: FloatArray, *asked: Asked
) -> list[FloatArray]:
    """Return the rates of outputs for given rates of the constraints, of each that is asked for.

    ``mechanism``: the ideal mechanism; while rates are asked for its bodies are at that position;
    ``outputs``: to be evaluated; ``times``: rising, from 0 [s], shape (n_t,); ``asked``: of m rates each.
    Returns shapes (n_t, n_outputs, m); NaN from where joints do not close.
    """
    states, system = mechanism.follow(times), mechanism.system
    moved: list[list[FloatArray]] = [[] for _ in asked]
    for i, state in enumerate(states):
        mechanism.put(times[i], state)
        scaled, root, length = system.scaled()
        inverse = system.inverse(scaled)
        for rates, own in zip([one(i) for one in asked], moved, strict=True):
            velocities = root @ (inverse @ (rates / length[:, None]))
            own.append(np.tile(state, (velocities.shape[1], 1)))
            for place, velocity in enumerate(velocities.T):
                parts = velocity.reshape(-1, 6)
                system.now.bodies.v[:-1], system.now.bodies.w[:-1] = parts[:, :3], parts[:, 3:]
                collect(system.now.bodies, own[-1][place])
    return [_rates(np.array(own), outputs, times.size) for own in moved]


def _rates(moved: FloatArray, outputs: Sequence[Output], n_times: int) -> FloatArray:
    """Return the rates of outputs in states (n, m, 13 n_bodies), shape (n_times, n_outputs, m)."""
    found = np.full((n_times, len(outputs), moved.shape[1]), np.nan)
    for place in range(moved.shape[1]):
        motion = motion_of(in_global_axes(np.ascontiguousarray(moved[:, place])))
        found[: len(moved), :, place] = np.stack([output.rate(motion) for output in outputs], axis=1)
    return found


def _unit(vectors: FloatArray) -> FloatArray:
    """Return unit vectors, zero for those beside which others are large."""
    length = np.linalg.norm(vectors, axis=-1, keepdims=True)
    least = _NOTHING * np.max(length, initial=0.0)
    return np.asarray(np.where(length > least, vectors / np.where(length > 0.0, length, 1.0), 0.0))
