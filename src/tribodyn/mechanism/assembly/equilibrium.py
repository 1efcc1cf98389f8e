"""Equilibrium of the loads on the shafts of a mechanism, its bodies displaced within the clearances.

With the mass matrix M, the forces Q of contact and all else, the accelerations a that ideal joints ask for,
and the motions B that clearances alone allow,

    Bᵀ (Q(q) − M a) = 0,

solved by Newton's method over B. Traction and loads against the motion are those of the motion that is there,
or, at rest, of the last one or of the one that is about to begin.

One file because all steps of the search change the same displaced bodies.
"""

import math
from collections.abc import Iterator
from typing import Final

import numpy as np

from mebdf.arrays import FloatArray, IntArray
from tribodyn.core.problem import ask
from tribodyn.kernels import dense
from tribodyn.kernels.mechanism.bodies import collect, move, place
from tribodyn.kernels.mechanism.data import (
    BEAM,
    CONTACT,
    LOAD_LINE,
    LOAD_MOTION,
    N_STATES,
    NONE,
    NOTHING,
    VELOCITY,
)
from tribodyn.kernels.mechanism.newton import N_PLACES
from tribodyn.mechanism.assembly.assembly import Assembly, memory_of
from tribodyn.mechanism.assembly.closing import System
from tribodyn.mechanism.assembly.decompositions import row_space
from tribodyn.mechanism.assembly.mechanism_problem import FUNCTIONS
from tribodyn.mechanism.assembly.shaft_motions import (
    JointNodes,
    ShaftMotions,
    alike,
    applied,
    forces,
    length,
    nodes_of,
    of_bodies,
    products,
    ways,
)
from tribodyn.mechanism.assembly.start_speeds import Speeds, start

_MOVING: Final = 1.0e-6  #: Slip over the one at which traction is developed that is rest.
_SLIDING: Final = 100.0  #: The same with which a motion that is about to begin is looked at.
#: Acceleration over the one that loads would cause without joints that counts as zero.
_ROUNDING: Final = 1.0e-10
_ROUNDINGS: Final = 64.0  #: Roundings of a position by all that it is a product of.
_LOST: Final = 3.0  #: Ratio of a shaft's largest motion to the gap of its joint in a search for a support.
#: The same of a shaft that touches: tilted within a short bore, its end faces are further away.
_TILTED: Final = 30.0
_TOUCHING: Final = 5.0  #: Gap over the roughness at which surfaces touch.
_TINY: Final = 1.0e-300
_ADRIFT: Final = 1.0e-3  #: Load along a freedom that nothing holds, over all loads, that counts as zero.
_TRIED: Final = 1.0e-6  #: Step along freedoms, in the same units, by which their stiffness is tried.
_TRIED_GAP: Final = 1.0e-3  #: The same along all other motions, as a change of gaps over the roughness.


class JointLoads:
    """The loads on bodies that are displaced within the clearances.

    The ideal counterpart of the assembly is at the same place and time. With ``over_loads`` what is left of
    the loads is compared with all loads, not with the largest one met on the way.
    """

    def __init__(
        self, assembly: Assembly, ideal: System, speeds: Speeds = (), *, over_loads: bool = False
    ) -> None:
        self.n = ideal.n
        self.state = np.zeros(N_STATES * self.n)
        collect(ideal.now.bodies, self.state)
        self.data, self.memory = assembly.data, memory_of(assembly, self.state)
        couplings = self.data.parts.couplings
        self.couplings = self.memory.now.couplings
        self.contacts = nodes_of(self.data.contact, np.flatnonzero(couplings.force == CONTACT))
        self.touching = np.array([contact.coupling for contact in self.contacts], np.intp)
        self.alike = alike(self.contacts)
        self.ends = np.stack([couplings.socket, couplings.shaft])
        self.acting = np.flatnonzero(couplings.force != NOTHING)
        self.roots = np.zeros((couplings.size, 6, 6))
        for contact in self.contacts:
            self.roots[contact.coupling] = contact.root
        self.bends = bool(assembly.model.elastic)
        for number in np.flatnonzero(couplings.force == BEAM):
            self.roots[number] = np.diag(np.repeat([1.0, couplings.length[number]], 3))
        self.others = self.acting[couplings.force[self.acting] != CONTACT]
        self.by_slip = np.flatnonzero(np.isin(couplings.force, (CONTACT, LOAD_MOTION, LOAD_LINE)))
        self.laws = np.flatnonzero(couplings.law)
        self.entries = np.zeros(N_PLACES * self.n + int(self.data.parts.constants.n_entries))
        self.ideal, self.real = ideal, System(assembly.model.without_films, contacts=False)
        self.real.adopt(self.state)
        self.units = np.tile(np.repeat([self.real.size, 1.0], 3), self.n)
        self.speeds, self.over_loads, self.largest = speeds, over_loads, 0.0
        self.carried, self.turning, self.waits = 0, np.zeros((0, 0)), False
        self.surveyed = False
        self.pace = 0.0  # rate of slips over the displacement that changes them [1/s]
        self.ahead: FloatArray | None = None
        self.blurs: tuple[float, ...] = ()  # factors of slip velocities on the way to friction as it is

    def look(self) -> None:
        """Look at the motions that clearances allow where the bodies are, and at how these are to move.

        Ideal joints are closed; shafts rest in their sockets.
        """
        ask()
        self.state.reshape(-1, N_STATES)[:, VELOCITY:] = 0.0
        self.real.put(self.state)
        self.close()
        collect(self.real.now.bodies, self.state)
        self.ideal.put(self.state)
        self.begin_to_move()
        collect(self.ideal.now.bodies, self.state)
        g, self.root, lengths = self.ideal.scaled()
        self.held = row_space(g, self.ideal.rank())
        self.velocity = self.state.reshape(-1, N_STATES)[:, VELOCITY:].copy()
        carried, self.adrift = self.divided(self.held.free)
        self.slipping = self.velocity
        self.wanted = self.held.solve(self.ideal.entries("gamma") / lengths)
        # Where real joints hold something, so do the ideal ones.
        allowed = self.held.left_by(self.real.scaled()[0], self.real.rank())
        self.carried = carried.shape[1]
        self.way, self.surveyed = np.zeros(allowed.shape[1] + self.carried), False
        motions = np.hstack([allowed, carried])
        self.motions = dense.product(self.root, motions)
        self.asked = dense.product(motions.T, self.held.part_of(self.wanted))
        self.moving = ShaftMotions(self.motions, self.ends[:, self.acting])
        if np.any(self._slips() > _MOVING):
            self.ahead = self.velocity
        else:
            # Once, from the middle: traction itself must not decide where it points.
            self.ahead = self._ahead() if self.ahead is None else self.ahead
            self.slipping = self.ahead
        if self.over_loads and self.largest == 0.0:
            self.largest = self.size_of_loads()

    def survey(self) -> None:
        """Find the stiffness along all motions that forces do not show, by looking from either side."""
        self.look()
        kept, motions, basis = self.state.copy(), self.motions, np.linalg.solve(self.root, self.motions)
        found = np.zeros((self.way.size,) * 2)
        for k in range(len(found)):
            found[:, k] -= self._shown(k)
            step = self._small_step(k)
            for side in (1.0, -1.0):
                self.motions = motions
                JointLoads.move(self, side * step)
                self.look()
                seen = np.linalg.solve(self.root, self.motions) @ self.residual()
                found[:, k] -= side * (basis.T @ seen) / (2.0 * step[k])
                self.state[:] = kept
            self.motions = motions
        self.look()
        self.missing = found
        self.surveyed = True

    def _small_step(self, k: int) -> FloatArray:
        """Return a step along one motion by which stiffness is tried."""
        step = np.zeros(self.motions.shape[1])
        step[k] = 1.0
        far = self.turned(step) / _TRIED
        return step / max(far, self.change(step)[0] / _TRIED_GAP, _TINY)

    def _shown(self, k: int) -> FloatArray:
        """Return the stiffness along one motion, motions as they are, shape (m,)."""
        step, kept, ends = self._small_step(k), self.state.copy(), []
        for side in (1.0, -1.0):
            JointLoads.move(self, side * step)
            ends.append(self.residual())
            self.state[:] = kept
        self.way[:] = 0.0
        return np.asarray((ends[1] - ends[0]) / (2.0 * step[k]))

    def kept(self) -> tuple[FloatArray, FloatArray]:
        """Return the place of the bodies since they were looked at, for :meth:`restore`."""
        return self.state.copy(), self.way.copy()

    def restore(self, kept: tuple[FloatArray, FloatArray], factor: float) -> None:
        """Put the bodies back, and develop friction at a multiple of its slip velocities."""
        self.state[:], self.way[:] = kept

    def close(self) -> None:
        """Close the ideal joints of the mechanism."""
        self.real.close()

    def begin_to_move(self) -> None:
        """Fill the velocities of the ideal counterpart."""
        start(self.ideal, self.speeds)

    def divided(self, free: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the freedoms whose loads balance, and all others, of those of the ideal counterpart."""
        return free[:, :0], free

    def unbalance(self) -> float:
        """Return the loads that do not balance where bodies were looked at last, over all loads."""
        return length(self.residual()) / (self.largest or 1.0)

    def size_of_loads(self) -> float:
        """Return the size of all loads but contact, inertia forces included, over the roots of masses."""
        rest = self._evaluate(self.velocity) - self._pushes("wrench", self.acting)
        total = np.abs(rest - self._pushes("constraint", self.laws))
        for wrench, couplings in (("wrench", self.others), ("constraint", self.laws)):
            pushes = products(self.couplings[wrench][couplings, None], self.couplings["H"][couplings])
            total += forces(np.abs(pushes), self.ends[:, couplings], self.n)
        return float(dense.norm(dense.product(self.root, total))) + float(dense.norm(self.wanted))

    def rounding(self, stiffest: float) -> float:
        """Return the load over the motions that rounding of the positions causes in the stiffest parts."""
        reach = float(np.max(np.abs(self.motions) / self.units[:, None]))
        return _ROUNDINGS * float(np.finfo(float).eps) * stiffest / reach

    def unbalanced(self) -> int | None:
        """Return the number of a body that loads push along a freedom which nothing holds; None without one.

        What slip decides does not count: a body that is free to spin finds the speed at which it vanishes.
        """
        if self.adrift.size == 0:
            return None
        loads = self._evaluate(np.zeros_like(self.velocity))
        forced = dense.product(self.root, loads)
        pushed = dense.product(self.root, dense.product(self.adrift, dense.product(self.adrift.T, forced)))
        if dense.norm(pushed) <= _ADRIFT * dense.norm(dense.product(self.root, forced)):
            return None
        return int(np.argmax(np.linalg.norm((dense.product(self.root, pushed)).reshape(-1, 6), axis=1)))

    def _ahead(self) -> FloatArray:
        """Return velocities along the accelerations that motion begins with, shape (n, 6), or none."""
        free = dense.product(self.root, self._evaluated())
        begins = self.wanted + free - self.held.part_of(free)
        if dense.norm(begins) <= _ROUNDING * dense.norm(free):
            return self.velocity
        self.slipping = dense.product(self.root, begins).reshape(-1, 6)
        slips = self._slips()
        moving = slips[slips > _MOVING * np.max(slips, initial=0.0)]
        return self.slipping * (_SLIDING / moving.min() if moving.size else 0.0)

    def _evaluate(self, velocity: FloatArray) -> FloatArray:
        """Fill forces and slopes of all couplings at given velocities; return the force on bodies (6 n,)."""
        y = self.state.copy()
        y.reshape(-1, N_STATES)[:, VELOCITY:] = velocity
        FUNCTIONS.jac(self.ideal.t, y, self.data, self.memory, np.zeros(y.size), self.entries)
        forces = np.array(self.memory.now.bodies.force[: self.n]).ravel()
        return forces + self._pushes("constraint", self.laws)

    def _pushes(self, wrench: str, couplings: IntArray) -> FloatArray:
        """Return the wrench on the bodies from a wrench of some couplings, shape (6 n,)."""
        if couplings.size == 0:
            return np.zeros(6 * self.n)
        pushes = products(self.couplings[wrench][couplings, None], self.couplings["H"][couplings])
        return forces(pushes, self.ends[:, couplings], self.n)

    def _evaluated(self) -> FloatArray:
        """Return the force on all bodies, slip as it is looked at, all else as bodies move."""
        rest = self._evaluate(self.velocity)
        if self.slipping is self.velocity:
            return rest
        rest -= self._pushes("wrench", self.by_slip)
        self._evaluate(self.slipping)
        return np.asarray(rest + self._pushes("wrench", self.by_slip))

    def _slips(self) -> FloatArray:
        """Return the largest slip of each joint over the one at which its traction is developed."""
        self._evaluate(self.slipping)
        twists = self.couplings["twist"][self.touching]
        found = []
        for (u, v, w, a, b, c), contact in zip(twists.tolist(), self.contacts, strict=True):
            x, y, z = contact.position.T
            slip = u + (b * z - c * y), v + (c * x - a * z), w + (a * y - b * x)
            square = slip[0] * slip[0] + slip[1] * slip[1] + slip[2] * slip[2]
            found.append(math.sqrt(np.max(square)) / contact.slip)
        return np.array(found)

    def residual(self) -> FloatArray:
        """Return the loads that do not balance, over the motions that clearances allow, shape (m,)."""
        found = np.asarray(applied(self.motions.T, self._evaluated()) - self.asked)
        if self.surveyed:
            # What the motions themselves change on the way.
            found -= applied(self.missing, self.way)
        if not self.over_loads:
            self.largest = max(self.largest, length(found))
        return found

    def stiffness(self) -> tuple[FloatArray, FloatArray]:
        """Return the stiffness of what was evaluated last, and of springs under all nodes, (m, m) each."""
        found, even = self.held_by(self.motions, self.moving, self.acting)
        if self.surveyed:
            found += self.missing
        elif self.carried:
            found[-self.carried :, -self.carried :] += self.turning
        return found, even

    def held_by(
        self, motions: FloatArray, moving: ShaftMotions, couplings: IntArray
    ) -> tuple[FloatArray, FloatArray]:
        """Return the stiffness of some couplings and of all force laws over motions, and of such springs.

        ``motions`` have shape (6 n, m); ``moving`` are the same for these couplings.
        """
        arms, slopes = (self.couplings[name][couplings] for name in ("H", "slope"))
        paces = self.pace * np.isin(couplings, self.touching)[:, None, None]
        slopes = slopes[..., :6] + paces * slopes[..., 6:]
        found, even = moving.stiffness(arms, slopes, self.roots[couplings])
        total = -found
        for first, row in self._rows(motions):
            total -= self.couplings[first].law.in_position * np.outer(row, row)
        return total, even

    def _rows(self, motions: FloatArray) -> Iterator[tuple[int, FloatArray]]:
        """Yield the first legs of all force laws, and what motions do to their coordinates, shape (m,)."""
        arms, directions = self.couplings["H"][self.laws], self.couplings["N"][self.laws, :1]
        rows = products(directions, ways(arms, of_bodies(motions, self.ends[:, self.laws])))[:, 0]
        of_leg = dict(zip(self.laws.tolist(), rows, strict=True))
        following = self.data.parts.couplings.next_leg
        for first in self.laws[self.data.parts.couplings.first_leg[self.laws] == NONE].tolist():
            legs = [first]
            while following[legs[-1]] != NONE:
                legs.append(int(following[legs[-1]]))
            row = of_leg[legs[-1]]
            for leg in reversed(legs[:-1]):
                row = of_leg[leg] + row
            yield first, row

    def _place(self, contact: JointNodes) -> FloatArray:
        """Return displacement and tilt of a shaft where it was evaluated last, shape (6,)."""
        pose = self.couplings["pose"][contact.coupling]
        rotation = pose["rotation"]
        if not contact.gradient[:, 3:5].any():
            return np.array([*pose["d"], 0.0, 0.0, rotation[1, 0] / rotation[0, 0]])
        x, y, z = rotation[:, 2]
        twist = 0.5 * (rotation[1, 0] - rotation[0, 1])
        return np.array([*pose["d"], -y / z, x / z, twist])

    def change(self, step: FloatArray) -> tuple[float, float]:
        """Return by how much a step (m,) changes gaps at most, over the roughness and over gaps as drawn."""
        ask()
        moved = applied(self.motions, step)
        bodies = of_bodies(moved[:, None], self.ends[:, self.touching])
        way = ways(self.couplings["H"][self.touching], bodies)[..., 0]
        over_roughness = over_gap = 0.0
        for numbers in self.alike:
            contact = self.contacts[numbers[0]]
            change = np.abs(dense.product(contact.gradient, way[numbers].T))
            over_roughness = max(over_roughness, float(np.max(change / contact.roughness[:, None])))
            drawn = [np.max(self.contacts[number].drawn) for number in numbers]
            over_gap = max(over_gap, float(np.max(np.max(change, axis=0) / drawn)))
        return over_roughness, over_gap

    def turned(self, step: FloatArray) -> float:
        """Return the length of a step (m,) along freedoms and of beams, turns [rad], ways over the size."""
        first = 0 if self.bends else step.size - self.carried
        moved = applied(self.motions[:, first:], step[first:])
        return float(np.max(np.abs(moved) / self.units, initial=0.0))

    def move(self, step: FloatArray) -> None:
        """Displace the bodies by a step (m,)."""
        self.way += step
        change, bodies = applied(self.motions, step), self.memory.now.bodies
        place(self.state, bodies)
        for b in range(self.n):
            move(bodies[b], change[6 * b : 6 * b + 6], np.zeros(4))
        collect(bodies, self.state)

    def undo(self, step: FloatArray) -> None:
        """Take back the last step (m,)."""
        self.move(-step)

    def overlapping(self) -> int | None:
        """Return the first joint whose surfaces overlap further than their contact law reaches."""
        found = (at.coupling for at in self.contacts if np.any(at.gaps(self._place(at)) < at.deepest))
        return next(found, None)

    def lost(self) -> int | None:
        """Return the first joint whose pin has left its bore, or moves along it without end."""
        for contact in self.contacts:
            gaps = contact.gaps(self._place(contact))
            far = _TILTED if np.any(gaps < _TOUCHING * contact.roughness) else _LOST
            if not np.max(np.abs(gaps)) <= far * np.max(contact.drawn):
                return contact.coupling
        return None
