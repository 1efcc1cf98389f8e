"""Equations of motion of a mechanism at rest, linear in small displacements.

With displacements B x that joints and drives allow, Bᵀ M B = 1, and the Jacobian of the equations of motion
in positions q and velocities v,

    ẍ = r − C ẋ − K x,   r = Bᵀ M a,   C = −Bᵀ M (∂a/∂v) B,   K = −Bᵀ M (∂a/∂q) B.

Reactions do no work along B. Damping of impacts is left out: contact and stops are elastic.
"""

from dataclasses import dataclass
from typing import Final

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.core.problem import ask
from tribodyn.kernels import dense
from tribodyn.kernels.mechanism.bodies import collect, place
from tribodyn.kernels.mechanism.data import N_STATES, ORIENTATION, VELOCITY
from tribodyn.mechanism.assembly.assembly import Assembly
from tribodyn.mechanism.assembly.closing import SIZE, System
from tribodyn.mechanism.assembly.decompositions import null_space
from tribodyn.mechanism.assembly.mechanism_problem import length_scale, mechanism_problem
from tribodyn.mechanism.assembly.passage import closes, placed
from tribodyn.mechanism.assembly.positions import held

NEVER_ENTERED: Final = 1.0e30  #: Speed at which contact began that leaves no damping of impacts [m/s].
_MOST_STEPS: Final = 200
#: Largest step, turns [rad] and ways in units of the length that positions are resolved against.
_LONGEST: Final = 0.2
_STILL: Final = 1.0e-8  #: Step in the same units that counts as zero.
_TINY: Final = 1.0e-300
_FLAT: Final = 1.0e-9  #: Stiffness over the largest one that counts as zero.
#: Change of forces over all forces, for a displacement by the length that positions are resolved against or a
#: radian, that is rounding: a rod between two balls turns about itself, and nothing gives it a stiffness.
_SLACK: Final = 1.0e-9
_UNLOADED: Final = 1.0e-6  #: Force along a motion without stiffness, over all forces, that counts as zero.


@dataclass(frozen=True)
class LinearEquations:
    """The equations at one position."""

    motions: FloatArray  #: B: displacements in global axes and turns in those of each body, shape (6 n, f).
    rest: FloatArray  #: r, shape (f,).
    #: C and K, shape (f, f) each.
    damping: FloatArray
    stiffness: FloatArray
    load: float  #: Size of all forces but those of constraints, over the roots of masses.
    units: FloatArray  #: Lengths and turns that displacements are measured in, shape (6 n,).

    def turning_over(self, shapes: FloatArray) -> FloatArray:
        """Return the stiffness along motions x by which one unit changes forces by their own size.

        ``shapes`` are unit vectors, shape (f, m); the stiffness has the shape (m,).
        """
        ways = np.abs(self.motions @ shapes) / self.units[:, None]
        return np.asarray(self.load * np.max(ways, axis=0, initial=0.0))


class Linearised:
    """Moves a mechanism at rest to where its forces balance, and linearises its equations there.

    ``assembly``: the mechanism, without findings; ``times``: of positions at which its drives and loads are
    held [s], rising, shape (n_t,).

    Attributes
    ----------
    system
        With the bodies where they were looked at last.
    """

    def __init__(self, assembly: Assembly, times: FloatArray) -> None:
        problem = mechanism_problem(assembly, duration=1.0, rtol=0.1, dense=True)
        self._functions = problem.functions
        self._data, self._memory = held(problem.data, times), problem.memory
        self.system = placed(System(assembly.model), assembly)
        self.system.data = held(self.system.data, times)
        self._rank = 6 * self.system.n - assembly.freedoms
        self.system.set_rank(self._rank)
        # Without clearances freedoms go far, whatever friction resolves.
        length = length_scale(assembly) if assembly.model.clearances else 0.1 * SIZE
        self._units = np.tile(np.repeat([length, 1.0], 3), self.system.n)

    def at(self, t: float, state: FloatArray) -> LinearEquations:
        """Return the equations at a time of the drives [s] and a state (13 n,), whose velocities are zero."""
        system, y, memory = self.system, state.copy(), self._memory
        place(y, system.now.bodies)
        system.at(t)
        g, root, _ = system.scaled()
        allowed = null_space(g, self._rank) if system.rows else np.eye(6 * system.n)
        memory.now.couplings["angle_mark"] = system.now.couplings["angle_mark"]
        self._functions.enter(t, y, self._data, memory)
        memory.contact.entry_velocity[:] = NEVER_ENTERED
        memory.now.couplings["law"]["entry_rate"] = NEVER_ENTERED
        rates, jacobian = np.empty(y.size), np.zeros((y.size, y.size))
        self._functions.jac(t, y, self._data, memory, rates, jacobian)
        rows = [N_STATES * body + entry for body in range(system.n) for entry in range(VELOCITY, N_STATES)]
        motions, momentum = dense.product(root, allowed), np.linalg.solve(root, allowed).T
        accelerations = jacobian[rows]
        return LinearEquations(
            motions,
            momentum @ rates[rows],
            -momentum @ accelerations[:, rows] @ motions,
            -momentum @ accelerations @ _in_states(y, motions),
            float(np.linalg.norm(root @ np.array(memory.now.bodies.force[: system.n]).ravel())),
            self._units,
        )

    def balanced(self, t: float, state: FloatArray) -> FloatArray | None:
        """Return the state at rest near by in which all forces balance, shape (13 n,); None without one.

        Steps lead to lower energy: a position that is unstable is left unless it is met exactly.
        """
        for _ in range(_MOST_STEPS):
            ask()
            linear = self.at(t, state)
            values, vectors = np.linalg.eigh(0.5 * (linear.stiffness + linear.stiffness.T))
            size, pushed = np.abs(values), vectors.T @ linear.rest
            stiff = size > np.maximum(
                _FLAT * np.max(size, initial=0.0), _SLACK * linear.turning_over(vectors)
            )
            loaded = np.linalg.norm(pushed[~stiff]) > _UNLOADED * linear.load
            # Where nothing holds a force the way leads along it, as far as a step goes.
            pushed[stiff] /= size[stiff]
            step = self._limited(linear.motions @ (vectors[:, stiff] @ pushed[stiff]))
            if loaded:
                step += self._limited(linear.motions @ (vectors[:, ~stiff] @ pushed[~stiff]), at_least=True)
            elif self._far(step) <= _STILL:
                return state
            self.system.step(step)
            closes(self.system)
            state = np.zeros(N_STATES * self.system.n)
            collect(self.system.now.bodies, state)
            state.reshape(-1, N_STATES)[:, VELOCITY:] = 0.0
        return None

    def _far(self, step: FloatArray) -> float:
        return float(np.max(np.abs(step) / self._units, initial=0.0))

    def _limited(self, step: FloatArray, *, at_least: bool = False) -> FloatArray:
        """Return a step no longer than the longest one, or just as long."""
        factor = _LONGEST / max(self._far(step), _TINY)
        return step * (factor if at_least else min(factor, 1.0))


def _in_states(state: FloatArray, motions: FloatArray) -> FloatArray:
    """Return the effect of displacements (6 n, f) on positions and quaternions of a state, shape (13 n, f).

    Quaternions change by ½ p ∘ (0, δθ).
    """
    n, f = state.size // N_STATES, motions.shape[1]
    parts, found = motions.reshape(n, 6, f), np.zeros((n, N_STATES, f))
    found[:, :ORIENTATION] = parts[:, :3]
    p = state.reshape(-1, N_STATES)[:, ORIENTATION:VELOCITY, None]
    turn = 0.5 * parts[:, 3:]
    found[:, ORIENTATION] = -np.sum(p[:, 1:] * turn, axis=1)
    found[:, ORIENTATION + 1 : VELOCITY] = p[:, :1] * turn + np.cross(p[:, 1:], turn, axis=1)
    return found.reshape(state.size, f)
