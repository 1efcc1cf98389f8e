"""Velocities of a mechanism at the start.

Drives, given speeds and ideal joints are satisfied exactly. A joint with clearance moves as the ideal joint
that holds the same, so that pin and bore have no relative velocity that only the clearance allows. Where
ideal joints cannot move that way, the sum of squares of these velocities over the clearances is least. Of
the motions that remain possible, the one with the least kinetic energy is taken.
"""

from dataclasses import dataclass
from typing import Final

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.kernels import dense
from tribodyn.mechanism.assembly.closing import System
from tribodyn.mechanism.assembly.decompositions import DEPENDENT, least_squares, null_space
from tribodyn.mechanism.assembly.misfit import Misfit
from tribodyn.mechanism.assembly.parts_by_number import Model, ModelError

_TINY: Final = 1.0e-300

#: Speeds of free coordinates as (joint, coordinate, value in [rad/s] or [m/s]).
Speeds = tuple[tuple[int, str, float], ...]


def speeds_of(model: Model) -> Speeds:
    """Return the speeds at the start that joints are given."""
    return tuple(
        (number, coordinate, speed)
        for number, joint in enumerate(model.case.joints.values())
        for coordinate, speed in (("angle", joint.start_speed), ("position", joint.start_velocity))
        if speed is not None
    )


@dataclass(frozen=True)
class _Rows:
    """Linear equations for the velocities of all bodies."""

    matrix: FloatArray  #: Shape (m, 6 n).
    target: FloatArray  #: Shape (m,).

    def missed_by(self, velocity: FloatArray) -> float:
        """Return the largest residual."""
        return float(np.max(np.abs(dense.product(self.matrix, velocity) - self.target), initial=0.0))


def start(
    system: System, speeds: Speeds, ideal: Misfit | None = None, *, fits: bool = True
) -> list[ModelError]:
    """Fill the velocities at the start; return what makes given speeds impossible.

    The ideal counterpart at the same place is None where no joint has clearance; ``fits`` says whether it can
    move as its drives do: its rows must then be satisfied exactly.
    """
    exact, root = _rows(system, speeds), system.metric
    scaled = dense.product(exact.matrix, root)
    length = np.maximum(np.linalg.norm(scaled, axis=1, keepdims=True), _TINY)
    found = system.solve(scaled / length, exact.target / length[:, 0], exact.matrix if speeds else None)
    velocity = dense.product(root, found)
    missed = exact.missed_by(velocity)
    if ideal is not None:
        held = _rows(ideal.system, ())
        velocity += _guided(exact, held, velocity, root, ideal)
        missed = max(missed, held.missed_by(velocity) if fits and speeds else 0.0)
    v = velocity.reshape(-1, 6)
    system.now.bodies.v[:-1], system.now.bodies.w[:-1] = v[:, :3], v[:, 3:]
    system.refresh()
    is_met = missed <= DEPENDENT * float(np.max(np.abs(exact.target), initial=_TINY))
    return [] if is_met else [_contrary(system, speeds)]


def _rows(system: System, speeds: Speeds) -> _Rows:
    """Return the demands of constraints, drives and given speeds on the velocities."""
    matrices, targets = [system.matrix()], [-system.entries("rate")] if system.rows else []
    for k, coordinate, value in speeds:
        coupling, now = system.parts.couplings[k], system.now.couplings[k]
        row = np.zeros(6 * (system.n + 1))
        entry = 5 if coordinate == "angle" else 2
        for side, body in enumerate((coupling.socket, coupling.shaft)):
            row[6 * body : 6 * body + 6] += now.H[entry, 6 * side : 6 * side + 6]
        matrices.append(row[None, : 6 * system.n])
        targets.append(np.array([value * system.model.joint(k).sign]))
    return _Rows(np.vstack(matrices), np.concatenate(targets) if targets else np.zeros(0))


def _guided(exact: _Rows, held: _Rows, velocity: FloatArray, root: FloatArray, ideal: Misfit) -> FloatArray:
    """Return the change of velocities by which joints with clearance move as ideal ones, shape (6 n,).

    It leaves the exact rows as they are, and is the one of least kinetic energy.
    """
    system = ideal.system
    n_exact = system.rank(exact.matrix)
    n_held = system.rank(np.vstack([exact.matrix, held.matrix])) - n_exact
    free = dense.product(root, null_space(dense.product(exact.matrix, root), n_exact))
    weights = ideal.weights / system.row_units
    missing = weights * (held.target - dense.product(held.matrix, velocity))
    shares = least_squares(weights[:, None] * dense.product(held.matrix, free), missing, n_held)
    return np.asarray(dense.product(free, shares))


def _contrary(system: System, speeds: Speeds) -> ModelError:
    """Return that drives and given speeds contradict each other."""
    asked = [system.model.joints[k] for k, _, _ in speeds]
    text = "no motion has the speeds at the start that drives and joints ask for"
    key = f"joints.{asked[0]}" if asked else "drives"
    return ModelError(key, f"{text}; given are those of {', '.join(asked)}" if asked else text)
