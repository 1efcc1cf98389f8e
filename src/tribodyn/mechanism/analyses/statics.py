"""Quasi-static analysis: equilibrium in the clearances at positions along the drives.

At each position the bodies are those of the ideal mechanism, displaced to where the forces of contact balance
all loads and the inertia forces of the ideal motion, by :mod:`tribodyn.mechanism.assembly.equilibrium`. The
dynamics of the motion within the clearances is left out: impacts, vibration, and damping. Friction opposes
the ideal motion, so positions that are passed in both directions have two equilibria.
"""

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Final

import numpy as np

from tribodyn.core.arrays import FloatArray
from tribodyn.core.errors import InputError, IntegrationFailure
from tribodyn.core.problem import Problem, Solution
from tribodyn.kernels.mechanism.bodies import collect
from tribodyn.kernels.mechanism.data import N_STATES, ORIENTATION, TURNING, VELOCITY
from tribodyn.mechanism.analyses.ideal_motion import IdealMechanism, in_body_axes, unreached
from tribodyn.mechanism.analyses.kinematics import require_motion
from tribodyn.mechanism.analyses.led_loads import LedLoads, developed
from tribodyn.mechanism.analyses.linearised import LinearEquations, Linearised
from tribodyn.mechanism.assembly.assembly import Assembly, assemble
from tribodyn.mechanism.assembly.closing import System
from tribodyn.mechanism.assembly.output_values import rotations
from tribodyn.mechanism.assembly.passage import closes, lead, placed, where_drives_are
from tribodyn.mechanism.assembly.positions import DrivePath, undamped, walked
from tribodyn.mechanism.assembly.start import settled
from tribodyn.mechanisms.self_checks import TOO_CLOSE

_SETTLED: Final = 1.0e-5
"""Change of gaps over the roughness that counts as zero."""
_CREEP: Final = 1.0e-7
"""Slip velocity at which friction is developed, over the fastest speed of a body."""
_NEAR: Final = 0.1
"""Change of gaps over the roughness that turns the directions of possible motions by less than rounding."""


def require_equilibria(assembly: Assembly) -> None:
    """Refuse a mechanism that has no static equilibrium whatever the position.

    Raises
    ------
    InputError
        No drive prescribes a motion, ideal joints cannot follow it, or an oil film carries a joint.
    """
    require_motion(assembly)
    require_no_film(assembly)


def require_no_film(assembly: Assembly) -> None:
    """Refuse a mechanism with an oil film, which carries by motion alone."""
    oiled = [assembly.model.joints[number] for number in assembly.model.oiled]
    if oiled:
        words = (
            f"the oil film of joint {oiled[0]} carries by motion alone and has no stiffness at rest; leave "
            "its film out, or run the dynamic analysis"
        )
        raise InputError(words, key=f"joints.{oiled[0]}.film")


def find_equilibria(
    assembly: Assembly,
    turn: float,
    problem: Problem,
    times: FloatArray,
    picture_times: FloatArray,
    progress: Callable[[float], None] | None,
) -> Solution:
    """Return the equilibria at positions along the drives.

    Parameters
    ----------
    assembly
        The mechanism.
    turn
        When the drives turn back [s]; infinite where they do not.
    problem
        The same mechanism.
    times, picture_times, progress
        As for :func:`tribodyn.mechanism.assembly.positions.walked`.
    """
    path = DrivePath(times, turn)
    equilibria = Equilibria(assembly, path)
    data = developed(undamped(problem.data), assembly.model, equilibria.slip)
    still = replace(problem, data=data)
    found = walked(still, path, equilibria, picture_times, progress)
    words = (
        f"forces on all bodies balance to {equilibria.unbalance:.1g} of the loads or better at every position"
    )
    return replace(found, notes=(words,) if found.t.size else ())


class Equilibria:
    """Finds the equilibrium at one position after the other, each from the one before.

    Attributes
    ----------
    slip
        Slip velocity at which friction is developed [m/s].
    unbalance
        Largest load so far that does not balance, over all loads.
    """

    def __init__(self, assembly: Assembly, path: DrivePath) -> None:
        times, self._where = np.unique(path.of_drives, return_inverse=True)
        found = IdealMechanism(assembly).follow(times)
        self._path, self._bodies, self._joints = path, assembly.model.bodies, assembly.model.joints
        self._reason = unreached(times, found)
        self._ideal = in_body_axes(found).reshape(len(found), -1, N_STATES)
        self._ways: list[FloatArray] = []
        counterpart = placed(System(assembly.model.counterpart), assembly)
        rank, self.slip = counterpart.independence()[0], _CREEP * _fastest(self._ideal, counterpart.size)
        self._loads, self.unbalance = LedLoads(assembly, rank, self.slip), 0.0
        self.centred: Linearised | None = None
        if rank < 6 * len(assembly.model.bodies):
            self.centred = Linearised(assemble(assembly.model.counterpart), times)
            self._leader = IdealMechanism(assembly)
        self._middle = self._ideal[:1]
        self._equations: LinearEquations | None = None
        self._marks: FloatArray | None = None

    def __call__(self, number: int) -> FloatArray:
        """Return the equilibrium at a position, see :class:`~.positions.States`."""
        t, direction = float(self._path.of_drives[number]), float(self._path.forward[number])
        self._middle = self._in_the_middle(number)
        starts = [*(self._displaced(ways) for ways in self._expected()), self._middle]
        for start in starts:
            self._loads.at(t, start.ravel(), direction, self._equations, self._marks)
            if settled(self._loads, change=_SETTLED, near=_NEAR) is not None:
                self._require_balance(number)
                self._remember()
                self.unbalance = max(self.unbalance, self._loads.unbalance())
                return self._loads.state
        raise self._failure(number, f"no static equilibrium was found: {self._why_not()}")

    def _in_the_middle(self, number: int) -> FloatArray:
        """Return the state of the ideal counterpart, freedoms where forces balance, shape (n_bodies, 13)."""
        found: FloatArray = self._ideal[self._require_reached(number)]
        if self.centred is None:
            return found
        t, system = float(self._path.of_drives[number]), self._leader.system
        state = np.zeros(found.size)
        if number == 0 or not lead(system, t, lambda: closes(system)):
            self._leader.put(t, found.ravel())
        collect(system.now.bodies, state)
        state.reshape(found.shape)[:, VELOCITY:] = 0.0
        self.centred.system.take_positions(system)
        state = self._at_rest(number, self.centred, state)
        self._equations = self.centred.at(t, state)
        system.take_positions(self.centred.system)
        self._marks = self.centred.system.now.couplings.angle_mark.copy()
        return np.asarray(state.reshape(found.shape))

    def _at_rest(self, number: int, mechanism: Linearised, state: FloatArray) -> FloatArray:
        """Return the state at rest near by in which all forces balance; the same where there is none."""
        found = mechanism.balanced(float(self._path.of_drives[number]), state)
        return state if found is None else found

    def _why_not(self) -> str:
        """Return why the last search ended without an equilibrium, in words."""
        joints, overlapping, lost = self._joints, self._loads.overlapping(), self._loads.lost()
        if lost is not None:
            return (
                f"the loads move the shaft of joint {joints[lost]} out of its bore; nothing holds it along "
                "its axis, or a joint is overloaded"
            )
        if overlapping is not None:
            return (
                f"the surfaces of joint {joints[overlapping]} come closer than the contact law reaches; "
                f"the load {TOO_CLOSE}"
            )
        return "the search for it did not converge"

    def _require_reached(self, number: int) -> int:
        """Return the number of the ideal state of a position, if joints close there."""
        k = int(self._where[number])
        if k >= len(self._ideal):
            raise IntegrationFailure(float(self._path.times[number]), self._reason)
        return k

    def _expected(self) -> list[FloatArray]:
        """Return displacements that the equilibria before suggest, the best first, (n_bodies, 6) each."""
        if len(self._ways) < 2:
            return self._ways
        return [2.0 * self._ways[-1] - self._ways[-2], self._ways[-1]]

    def _displaced(self, ways: FloatArray) -> FloatArray:
        """Return the ideal state, displaced, shape (n_bodies, 13)."""
        from scipy.spatial.transform import Rotation

        found = self._middle.copy()
        found[:, :ORIENTATION] += ways[:, :3]
        turned = Rotation.from_rotvec(ways[:, 3:]) * rotations(found[:, ORIENTATION:VELOCITY])
        found[:, ORIENTATION:VELOCITY] = np.roll(turned.as_quat(), 1, axis=1)
        return np.asarray(found)

    def _remember(self) -> None:
        """Keep the displacements from the ideal state, shape (n_bodies, 6), with those before."""
        real, ideal = self._loads.state.reshape(-1, N_STATES), self._middle
        after, before = (rotations(state[:, ORIENTATION:VELOCITY]) for state in (real, ideal))
        ways = real[:, :ORIENTATION] - ideal[:, :ORIENTATION]
        self._ways = [*self._ways[-1:], np.hstack([ways, (after * before.inv()).as_rotvec()])]

    def _require_balance(self, number: int) -> None:
        """Refuse an equilibrium of the clearances alone, where the mechanism as a whole is pushed away."""
        pushed = self._loads.unbalanced()
        if pushed is not None:
            words = (
                f"there is no static equilibrium: body {self._bodies[pushed]} moves under its loads, along a"
            )
            raise self._failure(number, f"{words} freedom that no joint, drive or spring holds")

    def _failure(self, number: int, words: str) -> IntegrationFailure:
        where = where_drives_are(self._loads.ideal)
        return IntegrationFailure(
            float(self._path.times[number]), f"with {where}, {words}" if where else words
        )


def _fastest(states: FloatArray, size: float) -> float:
    """Return the largest speed of a body at some states, turns times a size [m/s]; infinite at rest."""
    velocity, spin = states[..., VELOCITY:TURNING], states[..., TURNING:]
    fastest = max(
        float(np.max(np.abs(velocity), initial=0.0)), size * float(np.max(np.abs(spin), initial=0.0))
    )
    return fastest or math.inf
