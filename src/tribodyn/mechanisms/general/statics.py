"""Quasi-static analysis: equilibrium in the clearances at positions along the drives.

At each position the bodies are those of the ideal mechanism, displaced to where the forces of contact balance
all loads and the inertia forces of the ideal motion, by :mod:`tribodyn.mechanisms.general.equilibrium`. The
dynamics of the motion within the clearances is left out: impacts, vibration, and damping. Friction opposes
the ideal motion, so positions that are passed in both directions have two equilibria.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Final

import numpy as np

from tribodyn.core.arrays import FloatArray
from tribodyn.core.errors import InputError, IntegrationFailure
from tribodyn.core.problem import Problem, Solution
from tribodyn.kernels.mechanism.data import N_STATES, ORIENTATION, VELOCITY
from tribodyn.mechanisms.checks import TOO_CLOSE
from tribodyn.mechanisms.general.assembly import Assembly
from tribodyn.mechanisms.general.closing import System
from tribodyn.mechanisms.general.cycle import closes, placed, where_drives_are
from tribodyn.mechanisms.general.equilibrium import JointLoads, settled
from tribodyn.mechanisms.general.ideal_motion import IdealMechanism, in_body_axes, unreached
from tribodyn.mechanisms.general.kinematics import require_motion
from tribodyn.mechanisms.general.outputs import rotations
from tribodyn.mechanisms.general.positions import DrivePath, held, undamped, walked

_SETTLED: Final = 1.0e-5
"""Change of gaps over the roughness that counts as zero."""
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
        As for :func:`tribodyn.mechanisms.general.positions.walked`.
    """
    path, still = DrivePath(times, turn), replace(problem, data=undamped(problem.data))
    return walked(still, path, Equilibria(assembly, path), picture_times, progress)


class LedLoads(JointLoads):
    """The loads on bodies whose drives are led along, by compiled solutions."""

    def __init__(self, assembly: Assembly, ideal_rank: int) -> None:
        ideal = placed(System(assembly.model.counterpart), assembly)
        super().__init__(assembly, ideal, freedoms=True)
        self.data = undamped(self.data)
        self._direction = 1.0
        for system, rank in ((self.ideal, ideal_rank), (self.real, 6 * self.n - assembly.freedoms)):
            system.set_rank(rank)
            system.known_rank = rank

    def at(self, t: float, state: FloatArray, direction: float) -> None:
        """Put the bodies elsewhere, with the drives at another time [s], running forward (1) or back (−1)."""
        self.ideal.t = self.real.t = t
        self.state[:], self._direction, self.largest = state, direction, 0.0

    def hold(self, times: FloatArray) -> None:
        """Hold drives and loads at some times [s] as they are then."""
        self.data = held(self.data, times)
        for system in (self.ideal, self.real):
            system.data = held(system.data, times)

    def close(self) -> None:
        """Close the ideal joints of the mechanism."""
        closes(self.real)

    def begin_to_move(self) -> None:
        """Fill the velocities of the ideal counterpart."""
        self.ideal.move_with_drives(self._direction)


class Equilibria:
    """Finds the equilibrium at one position after the other, each from the one before."""

    def __init__(self, assembly: Assembly, path: DrivePath) -> None:
        times, self._where = np.unique(path.of_drives, return_inverse=True)
        mechanism = IdealMechanism(assembly)
        found = mechanism.follow(times)
        self._path, self._bodies, self._joints = path, assembly.model.bodies, assembly.model.joints
        self._reason = unreached(times, found)
        self._ideal = in_body_axes(found).reshape(len(found), -1, N_STATES)
        self._ways: list[FloatArray] = []
        self._loads = LedLoads(
            assembly, placed(System(assembly.model.counterpart), assembly).independence()[0]
        )

    def __call__(self, number: int) -> FloatArray:
        """Return the equilibrium at a position, see :class:`~.positions.States`."""
        k, t = self._require_reached(number), float(self._path.of_drives[number])
        centred, direction = self._ideal[k], float(self._path.forward[number])
        starts = [*(self._displaced(number, ways) for ways in self._expected()), centred]
        for start in starts:
            self._loads.at(t, start.ravel(), direction)
            if settled(self._loads, change=_SETTLED, near=_NEAR) is not None:
                self._require_balance(number)
                self._remember(number)
                return self._loads.state
        raise self._failure(number, f"no static equilibrium was found: {self._why_not()}")

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

    def _displaced(self, number: int, ways: FloatArray) -> FloatArray:
        """Return the ideal state, displaced, shape (n_bodies, 13)."""
        from scipy.spatial.transform import Rotation

        found = self._ideal[self._where[number]].copy()
        found[:, :ORIENTATION] += ways[:, :3]
        turned = Rotation.from_rotvec(ways[:, 3:]) * rotations(found[:, ORIENTATION:VELOCITY])
        found[:, ORIENTATION:VELOCITY] = np.roll(turned.as_quat(), 1, axis=1)
        return np.asarray(found)

    def _remember(self, number: int) -> None:
        """Keep the displacements from the ideal state, shape (n_bodies, 6), with those before."""
        real, ideal = self._loads.state.reshape(-1, N_STATES), self._ideal[self._where[number]]
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
