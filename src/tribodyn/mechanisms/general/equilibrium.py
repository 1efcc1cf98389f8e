"""Equilibrium of the loads on the shafts of a mechanism, its bodies displaced within the clearances.

With the mass matrix M, the forces Q of contact and all else, the accelerations a that ideal joints ask for,
and the motions B that clearances alone allow,

    Bᵀ (Q(q) − M a) = 0,

solved by Newton's method over B. Traction and loads against the motion are those of the motion that is there,
or, at rest, of the last one or of the one that is about to begin.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Final

import numpy as np

from tribodyn.core.arrays import FloatArray, IntArray
from tribodyn.core.stopping import ask
from tribodyn.integrate.binding import kernel_types, machine_code
from tribodyn.kernels import dense
from tribodyn.kernels.mechanism.bodies import collect, move, place
from tribodyn.kernels.mechanism.data import (
    CONTACT,
    LOAD_LINE,
    LOAD_MOTION,
    N_STATES,
    NONE,
    NOTHING,
    SPRING,
    SPRINGS,
    VELOCITY,
)
from tribodyn.kernels.mechanism.newton import N_PLACES
from tribodyn.mechanisms.general.assembly import Assembly, memory_of
from tribodyn.mechanisms.general.closing import System
from tribodyn.mechanisms.general.decompositions import row_space, shortest
from tribodyn.mechanisms.general.nodes import JointNodes, alike, nodes_of
from tribodyn.mechanisms.general.problem import mechanism_problem
from tribodyn.mechanisms.general.shaft_motions import ShaftMotions, forces, of_bodies, products, ways
from tribodyn.mechanisms.general.speeds import Speeds, start

_MOVING: Final = 1.0e-6
"""Slip over the one at which traction is developed that is rest."""
_SLIDING: Final = 100.0
"""The same with which a motion that is about to begin is looked at."""
_ROUNDING: Final = 1.0e-10
"""Acceleration over the one that loads would cause without joints that counts as zero."""
_MOST_LOOKS: Final = 20
_MOST_STEPS: Final = 100
_SETTLED: Final = 1.0e-3
"""Change of a gap, over the roughness, that counts as zero."""
_BALANCED: Final = 1.0e-6
"""Load over the largest one met on the way that counts as zero."""
_LOST: Final = 3.0
"""Ratio of a shaft's largest motion to the gap of its joint in a search for a support."""
_TILTED: Final = 30.0
"""The same of a shaft that touches: tilted within a short bore, its end faces are further away."""
_TOUCHING: Final = 5.0
"""Gap over the roughness at which surfaces touch."""
_LEAST: Final = 1.0
"""Stiffness of springs where there is no contact yet [N/m]."""
_FLOOR: Final = 1.0e-6
"""The same over the largest stiffness."""
_STIFFER: Final = 4.0
_SOFTER: Final = 3.0
"""Factors by which springs change."""
_BACK: Final = 0.5
"""Share of the load along a step that may have turned against it."""
_NEARER: Final = 4.0
"""Factor by which bodies that do not come to rest count as near from look to look."""
_ADRIFT: Final = 1.0e-3
"""Load along a freedom that nothing holds, over all loads, that counts as zero."""
_TINY: Final = 1.0e-300
_FAR: Final = 0.5
"""Part of the largest gap of a joint that a step may not pass."""


class JointLoads:
    """The loads on bodies that are displaced within the clearances.

    Parameters
    ----------
    assembly
        The mechanism, without findings.
    ideal
        Its ideal counterpart at the same place and time.
    speeds
        Given speeds of free coordinates.
    freedoms
        Whether loads balance along the freedoms of the mechanism that springs hold, too.
    """

    def __init__(
        self, assembly: Assembly, ideal: System, speeds: Speeds = (), *, freedoms: bool = False
    ) -> None:
        self.n = ideal.n
        self.state = np.zeros(N_STATES * self.n)
        collect(ideal.now.bodies, self.state)
        problem = mechanism_problem(assembly, duration=1.0, rtol=0.1, state=self.state)
        self.data, self.memory = problem.data, memory_of(assembly, self.state)
        self._forces = machine_code(problem, kernel_types(problem)).jac
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
        self.by_slip = np.flatnonzero(np.isin(couplings.force, (CONTACT, LOAD_MOTION, LOAD_LINE)))
        self.laws = np.flatnonzero(couplings.law)
        self.entries = np.zeros(N_PLACES * self.n + int(self.data.parts.constants.n_entries))
        self.ideal, self.real = ideal, System(assembly.model.without_films, contacts=False)
        self.real.adopt(self.state)
        self.springs = np.flatnonzero(np.isin(couplings.force, (SPRINGS, SPRING)))
        self.speeds, self.freedoms, self.largest = speeds, freedoms, 0.0
        self.ahead: FloatArray | None = None

    def look(self) -> None:
        """Look at the motions that clearances allow where the bodies are, and at how these are to move.

        Ideal joints are closed; shafts rest in their sockets.
        """
        ask()
        self.state.reshape(-1, N_STATES)[:, VELOCITY:] = 0.0
        place(self.state, self.real.now.bodies)
        self.real.refresh()
        self.close()
        collect(self.real.now.bodies, self.state)
        place(self.state, self.ideal.now.bodies)
        self.ideal.refresh()
        self.begin_to_move()
        collect(self.ideal.now.bodies, self.state)
        g, self.root, length = self.ideal.scaled()
        self.held = row_space(g, self.ideal.rank())
        self.wanted = self.held.solve(self.ideal.entries("gamma") / length)
        # Where real joints hold something, so do the ideal ones.
        allowed = self.held.left_by(self.real.scaled()[0], self.real.rank())
        self.velocity = self.slipping = self.state.reshape(-1, N_STATES)[:, VELOCITY:].copy()
        carried, self.adrift = self._divided(self.held.free)
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

    def close(self) -> None:
        """Close the ideal joints of the mechanism."""
        self.real.close()

    def begin_to_move(self) -> None:
        """Fill the velocities of the ideal counterpart."""
        start(self.ideal, self.speeds)

    def _divided(self, free: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the freedoms that springs hold, of those that joints and drives leave, and all others."""
        if not (self.freedoms and free.size):
            return free[:, :0], free
        self._evaluate(self.velocity)
        moving = dense.product(self.root, free)
        held_by = ShaftMotions(moving, self.ends[:, self.springs])
        values, vectors = dense.eigh(self._held_by(moving, held_by, self.springs)[0])
        held = values > _FLOOR * np.max(values, initial=_TINY)
        return dense.product(free, vectors[:, held]), dense.product(free, vectors[:, ~held])

    def unbalanced(self) -> int | None:
        """Return the number of a body that loads push along a freedom which nothing holds; None without one.

        What slip decides does not count: a body that is free to spin finds the speed at which it vanishes.
        """
        if self.adrift.size == 0:
            return None
        loads = self._evaluate(np.zeros_like(self.velocity))
        pushed = dense.product(
            self.root,
            dense.product(self.adrift, dense.product(self.adrift.T, dense.product(self.root, loads))),
        )
        if dense.norm(pushed) <= _ADRIFT * dense.norm(
            dense.product(self.root, dense.product(self.root, loads))
        ):
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
        self._forces(self.ideal.t, y, self.data, self.memory, np.zeros(y.size), self.entries)
        forces = np.array(self.memory.now.bodies.force[: self.n]).ravel()
        return forces + self._pushes("constraint", self.laws)

    def _of_slip(self) -> FloatArray:
        """Return the part of that force that slip decides."""
        return self._pushes("wrench", self.by_slip)

    def _pushes(self, wrench: str, couplings: IntArray) -> FloatArray:
        """Return the wrench on the bodies from a wrench of some couplings, shape (6 n,)."""
        pushes = products(self.couplings[wrench][couplings, None], self.couplings["H"][couplings])
        return forces(pushes, self.ends[:, couplings], self.n)

    def _evaluated(self) -> FloatArray:
        """Return the force on all bodies, slip as it is looked at, all else as bodies move."""
        rest = self._evaluate(self.velocity)
        if self.slipping is self.velocity:
            return rest
        rest -= self._of_slip()
        self._evaluate(self.slipping)
        return np.asarray(rest + self._of_slip())

    def _slips(self) -> FloatArray:
        """Return the largest slip of each joint over the one at which its traction is developed."""
        self._evaluate(self.slipping)
        twists = [(self.couplings["twist"][contact.coupling], contact) for contact in self.contacts]
        return np.array(
            [
                np.linalg.norm(twist[:3] + np.cross(twist[3:], contact.position), axis=1).max() / contact.slip
                for twist, contact in twists
            ]
        )

    def residual(self) -> FloatArray:
        """Return the loads that do not balance, over the motions that clearances allow, shape (m,)."""
        found = np.asarray(dense.product(self.motions.T, self._evaluated()) - self.asked)
        self.largest = max(self.largest, float(dense.norm(found)))
        return found

    def stiffness(self) -> tuple[FloatArray, FloatArray]:
        """Return the stiffness of what was evaluated last, and of springs under all nodes, (m, m) each."""
        return self._held_by(self.motions, self.moving, self.acting)

    def _held_by(
        self, motions: FloatArray, moving: ShaftMotions, couplings: IntArray
    ) -> tuple[FloatArray, FloatArray]:
        """Return the stiffness of some couplings and of all force laws over motions, and of such springs.

        ``motions`` have shape (6 n, m); ``moving`` are the same for these couplings.
        """
        arms, slopes = (self.couplings[name][couplings] for name in ("H", "slope"))
        found, even = moving.stiffness(arms, slopes[..., :6], self.roots[couplings])
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
        x, y, z = rotation[:, 2]
        twist = 0.5 * (rotation[1, 0] - rotation[0, 1])
        return np.array([*pose["d"], -y / z, x / z, twist])

    def change(self, step: FloatArray) -> tuple[float, float]:
        """Return by how much a step (m,) changes gaps at most, over the roughness and over gaps as drawn."""
        ask()
        moved = dense.product(self.motions, step)
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

    def move(self, step: FloatArray) -> None:
        """Displace the bodies by a step (m,)."""
        change, bodies = dense.product(self.motions, step), self.memory.now.bodies
        place(self.state, bodies)
        for b in range(self.n):
            move(bodies[b], change[6 * b : 6 * b + 6], np.zeros(4))
        collect(bodies, self.state)

    def overlapping(self) -> int | None:
        """Return the first joint whose surfaces overlap further than their contact law reaches."""
        return next((contact.coupling for contact in self.contacts if self._overlaps(contact)), None)

    def lost(self) -> int | None:
        """Return the first joint whose pin has left its bore, or moves along it without end."""
        return next((contact.coupling for contact in self.contacts if self._has_left(contact)), None)

    def _overlaps(self, contact: JointNodes) -> bool:
        return bool(np.any(contact.gaps(self._place(contact)) < contact.deepest))

    def _has_left(self, contact: JointNodes) -> bool:
        """Return whether the shaft of one joint has left its socket."""
        gaps = contact.gaps(self._place(contact))
        touches = bool(np.any(gaps < _TOUCHING * contact.roughness))
        return not np.max(np.abs(gaps)) <= (_TILTED if touches else _LOST) * np.max(contact.drawn)


def settled(loads: JointLoads, *, change: float = _SETTLED, near: float = 0.0) -> FloatArray | None:
    """Move the bodies to where their loads balance; return the state there, or None.

    Parameters
    ----------
    loads
        With the bodies where the search begins.
    change
        Change of gaps, over the roughness, that counts as zero.
    near
        Change of gaps, over the roughness, after which the possible motions are not looked for again; it
        grows from look to look.
    """
    soft = 0.0
    for _ in range(_MOST_LOOKS):
        loads.look()
        steps, moved, soft = _newton(loads, soft, change) if loads.motions.size else (0, 0.0, soft)
        if steps == 0 or moved < near:
            return loads.state if loads.overlapping() is None else None
        if loads.lost() is not None:
            return None
        # Where a force passes through zero its shaft lies anywhere, and no look is the last.
        near *= _NEARER
    return None


def _newton(loads: JointLoads, soft: float, least: float) -> tuple[int, float, float]:
    """Make steps until one changes nothing; return their number and changes, and the stiffness of springs.

    Springs under all nodes, of stiffness ``soft`` [N/m] in each joint, hold a step where contact does not.
    They are stiffer after a step that overshoots the place where the loads along it balance, else softer.
    """
    residual, moved = loads.residual(), 0.0
    for steps in range(_MOST_STEPS):
        stiffness, even = loads.stiffness()
        soft = max(soft, _FLOOR * float(np.max(np.abs(stiffness))), _LEAST)
        for _ in range(_MOST_STEPS):
            step = shortest(stiffness + soft * even, residual)
            change, way = loads.change(step)
            if way < _FAR:
                loads.move(step)
                after = loads.residual()
                if dense.product(after, step) >= -_BACK * dense.product(residual, step):
                    break
                loads.move(-step)
            soft *= _STIFFER
        else:
            return _MOST_STEPS, math.inf, soft
        residual, soft, moved = after, soft / _SOFTER, moved + change
        if change < least and dense.norm(after) <= _BALANCED * loads.largest:
            return steps, moved, soft
    return _MOST_STEPS, math.inf, soft
