"""Where a mechanism with clearance begins: its shafts laid against their sockets, where loads balance.

Bodies move as those of the mechanism whose joints are ideal do at that time, and are displaced within the
clearances until contact gives what that motion asks of the joints. With the mass matrix M, the forces Q of
contact and all else, the accelerations a that ideal joints ask for, and the motions B that clearances alone
allow,

    Bᵀ (Q(q) − M a) = 0,

solved by Newton's method over B. Freedoms of the mechanism as a whole are left to themselves. Traction and
loads against the motion are those of the motion that is there, or, at rest, of the one that is about to
begin.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Final

import numpy as np

from tribodyn.core.arrays import FloatArray, IntArray
from tribodyn.core.stopping import ask
from tribodyn.kernels.joints.surface.data import GAP, NORMAL, POSITION, SurfaceData
from tribodyn.kernels.joints.surface.tilt import NO_TILT
from tribodyn.kernels.mechanism import functions, newton
from tribodyn.kernels.mechanism.bodies import collect, move, place
from tribodyn.kernels.mechanism.data import CONTACT, LOAD_LINE, LOAD_MOTION, N_STATES, NONE, NOTHING, VELOCITY
from tribodyn.mechanisms.general.assembly import Assembly, memory_of
from tribodyn.mechanisms.general.closing import System
from tribodyn.mechanisms.general.speeds import speeds_of, start

_MOVING: Final = 1.0e-6
"""Slip over the one at which traction is developed that is rest."""
_SLIDING: Final = 100.0
"""The same with which a motion that is about to begin is looked at."""
_ROUNDING: Final = 1.0e-10
"""Acceleration over the one that loads would cause without joints that is none."""
_MOST_LOOKS: Final = 20
_MOST_STEPS: Final = 100
_SETTLED: Final = 1.0e-3
"""Change of a gap, over the roughness, that is none."""
_BALANCED: Final = 1.0e-6
"""Load over the largest one met on the way that is none."""
_LOST: Final = 3.0
"""How many times its largest gap a shaft may move without finding what holds it."""
_LEAST: Final = 1.0
"""Stiffness of springs where there is no contact yet [N/m]."""
_FLOOR: Final = 1.0e-6
"""The same over the largest stiffness."""
_STIFFER: Final = 4.0
_SOFTER: Final = 3.0
"""Factors by which springs change."""
_BACK: Final = 0.5
"""Share of the load along a step that may have turned against it."""
_FAR: Final = 0.5
"""Part of the largest gap of a joint that a step may not pass."""
_TINY: Final = 1.0e-300


def initial_state(assembly: Assembly) -> FloatArray | None:
    """Return the state in which the loads on all shafts balance, shape (13 n,); None if none is found.

    Without clearance it is that of the assembly. So it is of joints with an oil film, which carries by motion
    alone: they begin in the middle of their bores.

    Raises
    ------
    Stopped
        If the caller wanted to stop before the end of the search.
    """
    if not assembly.model.without_films.clearances:
        return assembly.state
    ideal = System(assembly.model.counterpart)
    ideal.adopt(assembly.state)
    ideal.close()
    return _settled(_Loads(assembly, ideal))


@dataclass(frozen=True)
class _Contact:
    """Nodes of a joint with clearance.

    Attributes
    ----------
    coupling
        Number of the joint.
    gradient
        −∂h/∂(d, φ), shape (n, 6).
    position
        x_k [m], shape (n, 3).
    drawn, roughness
        Gaps as drawn, and σ [m], shape (n,).
    slides
        1 where the shaft slides past the node, shape (n,).
    deepest
        Gap at which the contact law ends [m], shape (n,).
    lean
        Radius ρ of the second-order term of the tilt [m], shape (n,).
    slip
        u_s [m/s].
    """

    coupling: int
    gradient: FloatArray
    position: FloatArray
    drawn: FloatArray
    roughness: FloatArray
    slides: FloatArray
    deepest: FloatArray
    lean: FloatArray
    slip: float

    @cached_property
    def root(self) -> FloatArray:
        """Square root of the stiffness of springs under all nodes, 1 N/m altogether, shape (6, 6)."""
        values, vectors = np.linalg.eigh(self.gradient.T @ self.gradient / self.drawn.size)
        return np.asarray(np.sqrt(np.maximum(values, 0.0))[:, None] * vectors.T)

    def gaps(self, place: FloatArray) -> FloatArray:
        """Return the gaps [m] at displacement and tilt (d, φ), shape (6,)."""
        axis = self.gradient[:, :3] @ np.array([place[4], -place[3], 1.0])
        squares = 0.5 * self.lean * (axis - self.gradient[:, 2]) ** 2
        return np.asarray(self.drawn - self.gradient @ place + self.slides * place[2] * axis - squares)


class _Loads:
    """The loads on bodies that are displaced within the clearances."""

    def __init__(self, assembly: Assembly, ideal: System) -> None:
        self.data, self.n = assembly.data, ideal.n
        self.state = np.zeros(N_STATES * self.n)
        collect(ideal.now.bodies, self.state)
        self.memory = memory_of(assembly, self.state)
        couplings = self.data.parts.couplings
        self.couplings = self.memory.now.couplings
        self.contacts = _contacts(self.data.contact, np.flatnonzero(couplings.force == CONTACT))
        self.by_slip = np.isin(couplings.force, (CONTACT, LOAD_MOTION, LOAD_LINE))
        parts = newton.N_PLACES + newton.N_BODY
        self.laws = np.flatnonzero(couplings.law)
        self.entries = np.zeros(parts * self.n + newton.N_COUPLING * couplings.size)
        self.ideal, self.real = ideal, System(assembly.model.without_films)
        self.real.adopt(self.state)
        self.speeds, self.largest = speeds_of(assembly.model), 0.0
        self.ahead: FloatArray | None = None

    def look(self) -> None:
        """Look at the motions that clearances allow where the bodies are, and at how these are to move.

        Ideal joints are closed; shafts rest in their sockets.
        """
        ask()
        self.state.reshape(-1, N_STATES)[:, VELOCITY:] = 0.0
        place(self.state, self.real.now.bodies)
        self.real.refresh()
        self.real.close()
        collect(self.real.now.bodies, self.state)
        place(self.state, self.ideal.now.bodies)
        self.ideal.refresh()
        start(self.ideal, self.speeds)
        collect(self.ideal.now.bodies, self.state)
        g, self.root, length = self.ideal.scaled()
        self.wanted = self.ideal.inverse(g, self.ideal.matrix()) @ (self.ideal.entries("gamma") / length)
        self.held, _ = _spaces(g, self.ideal.rank())
        # Where real joints hold something, so do the ideal ones.
        _, allowed = _spaces(self.real.scaled()[0] @ self.held, self.real.rank())
        self.motions, self.asked = self.root @ self.held @ allowed, allowed.T @ (self.held.T @ self.wanted)
        self.velocity = self.slipping = self.state.reshape(-1, N_STATES)[:, VELOCITY:].copy()
        if not np.any(self._slips() > _MOVING):
            # Once, from the middle: traction itself must not decide where it points.
            self.ahead = self._ahead() if self.ahead is None else self.ahead
            self.slipping = self.ahead

    def _ahead(self) -> FloatArray:
        """Return velocities along the accelerations that motion begins with, shape (n, 6), or none."""
        free = self.root @ self._evaluated()
        begins = self.wanted + free - self.held @ (self.held.T @ free)
        if np.linalg.norm(begins) <= _ROUNDING * np.linalg.norm(free):
            return self.velocity
        self.slipping = (self.root @ begins).reshape(-1, 6)
        slips = self._slips()
        moving = slips[slips > _MOVING * np.max(slips, initial=0.0)]
        return self.slipping * (_SLIDING / moving.min() if moving.size else 0.0)

    def _evaluate(self, velocity: FloatArray) -> FloatArray:
        """Fill forces and slopes of all couplings at given velocities; return the force on bodies (6 n,)."""
        y = self.state.copy()
        y.reshape(-1, N_STATES)[:, VELOCITY:] = velocity
        functions.jac_entries(0.0, y, self.data, self.memory, np.zeros(y.size), self.entries)
        forces = np.array(self.memory.now.bodies.force[: self.n]).ravel()
        return forces + self._pushes("constraint", self.laws)

    def _of_slip(self) -> FloatArray:
        """Return the part of that force that slip decides."""
        return self._pushes("wrench", np.flatnonzero(self.by_slip))

    def _pushes(self, wrench: str, couplings: IntArray) -> FloatArray:
        """Return what a wrench of some couplings does to the bodies, shape (6 n,)."""
        parts, force = self.data.parts.couplings, np.zeros((self.n + 1, 6))
        for k in couplings:
            push = self.couplings[k][wrench] @ self.couplings[k].H
            force[parts[k].socket] += push[:6]
            force[parts[k].shaft] += push[6:]
        return force[: self.n].ravel()

    def _evaluated(self) -> FloatArray:
        """Return the force on all bodies, slip as it is looked at, all else as bodies move."""
        rest = self._evaluate(self.velocity)
        rest -= self._of_slip()
        self._evaluate(self.slipping)
        return np.asarray(rest + self._of_slip())

    def _slips(self) -> FloatArray:
        """Return the largest slip of each joint over the one at which its traction is developed."""
        self._evaluate(self.slipping)
        twists = [(self.couplings[contact.coupling].twist, contact) for contact in self.contacts]
        return np.array(
            [
                np.linalg.norm(twist[:3] + np.cross(twist[3:], contact.position), axis=1).max() / contact.slip
                for twist, contact in twists
            ]
        )

    def residual(self) -> FloatArray:
        """Return the loads that do not balance, over the motions that clearances allow, shape (m,)."""
        found = np.asarray(self.motions.T @ self._evaluated() - self.asked)
        self.largest = max(self.largest, float(np.linalg.norm(found)))
        return found

    def stiffness(self) -> tuple[FloatArray, FloatArray]:
        """Return the stiffness of what was evaluated last, and of springs under all nodes, (m, m) each."""
        m = self.motions.shape[1]
        total, even = np.zeros((m, m)), np.zeros((m, m))
        for k in np.flatnonzero(self.data.parts.couplings.force != NOTHING).tolist():
            way = self._way(k, self.motions)
            total -= way.T @ self.couplings[k].slope[:, :6] @ way
        for first in self.laws[self.data.parts.couplings.first_leg[self.laws] == NONE].tolist():
            row = self._row(first)
            total -= self.couplings[first].law.in_position * np.outer(row, row)
        for contact in self.contacts:
            way = contact.root @ self._way(contact.coupling, self.motions)
            even += way.T @ way
        return total, even

    def _row(self, leg: int) -> FloatArray:
        """Return what the motions do to the coordinate of an element from a leg on, shape (m,)."""
        row = np.asarray(self.couplings[leg].N[0] @ self._way(leg, self.motions))
        following = int(self.data.parts.couplings[leg].next_leg)
        return row if following == NONE else np.asarray(row + self._row(following))

    def _way(self, coupling: int, motions: FloatArray) -> FloatArray:
        """Return what motions of all bodies (6 n, ...) do to the shaft of a coupling, shape (6, ...)."""
        record, ways = self.data.parts.couplings[coupling], np.zeros((6, *motions.shape[1:]))
        for side, body in enumerate((record.socket, record.shaft)):
            if body < self.n:
                own = motions[6 * body : 6 * body + 6]
                ways += self.couplings[coupling].H[:, 6 * side : 6 * side + 6] @ own
        return ways

    def _place(self, contact: _Contact) -> FloatArray:
        """Return displacement and tilt of a shaft where it was evaluated last, shape (6,)."""
        pose = self.couplings[contact.coupling].pose
        x, y, z = pose.rotation[:, 2]
        twist = 0.5 * (pose.rotation[1, 0] - pose.rotation[0, 1])
        return np.array([*pose.d, -y / z, x / z, twist])

    def change(self, step: FloatArray) -> tuple[float, float]:
        """Return by how much a step (m,) changes gaps at most, over the roughness and over gaps as drawn."""
        ask()
        moved = self.motions @ step
        over_roughness = over_gap = 0.0
        for contact in self.contacts:
            change = np.abs(contact.gradient @ self._way(contact.coupling, moved))
            over_roughness = max(over_roughness, float(np.max(change / contact.roughness)))
            over_gap = max(over_gap, float(np.max(change) / np.max(contact.drawn)))
        return over_roughness, over_gap

    def move(self, step: FloatArray) -> None:
        """Displace the bodies by a step (m,)."""
        change, bodies = self.motions @ step, self.memory.now.bodies
        place(self.state, bodies)
        for b in range(self.n):
            move(bodies[b], change[6 * b : 6 * b + 6], np.zeros(4))
        collect(bodies, self.state)

    @property
    def beyond_law(self) -> bool:
        """Whether surfaces overlap further than their contact law reaches."""
        return any(np.any(contact.gaps(self._place(contact)) < contact.deepest) for contact in self.contacts)

    @property
    def lost(self) -> bool:
        """Whether a shaft has left its socket without meeting anything."""
        gaps = [(contact.gaps(self._place(contact)), contact.drawn) for contact in self.contacts]
        return any(not np.max(np.abs(gap)) <= _LOST * np.max(drawn) for gap, drawn in gaps)


def _contacts(joints: SurfaceData, couplings: IntArray) -> list[_Contact]:
    """Return the nodes of all joints with clearance."""
    found = []
    for j, coupling in enumerate(couplings):
        surfaces = joints.surfaces[joints.joints[j] : joints.joints[j + 1]]
        counts = surfaces["last_node"] - surfaces["first_node"]
        nodes = joints.nodes[:, surfaces["first_node"][0] : surfaces["last_node"][-1]].T
        position, normal = nodes[:, POSITION:NORMAL], nodes[:, NORMAL : NORMAL + 3]
        turning = np.cross(position, normal) * np.repeat(surfaces["tilt"] != NO_TILT, counts)[:, None]
        found.append(
            _Contact(
                coupling=int(coupling),
                gradient=np.hstack([normal, turning]),
                position=position,
                drawn=nodes[:, GAP],
                roughness=np.repeat(surfaces["roughness"], counts),
                slides=np.repeat(surfaces["slides"], counts),
                deepest=np.repeat(surfaces["h_first"] * surfaces["roughness"], counts),
                lean=np.repeat(surfaces["lean"], counts),
                slip=float(max(surfaces["slip_velocity"].max(), _TINY)),
            )
        )
    return found


def _spaces(matrix: FloatArray, rank: int) -> tuple[FloatArray, FloatArray]:
    """Return orthonormal columns that span the rows of a matrix, and what is at right angles to them."""
    _, _, rows = np.linalg.svd(matrix)
    return rows[:rank].T, rows[rank:].T


def _settled(loads: _Loads) -> FloatArray | None:
    """Move the bodies to where their loads balance; return the state there, or None."""
    soft = 0.0
    for _ in range(_MOST_LOOKS):
        loads.look()
        steps, soft = _newton(loads, soft) if loads.motions.size else (0, soft)
        if steps == 0:
            return None if loads.beyond_law else loads.state
        if loads.lost:
            return None
    return None


def _newton(loads: _Loads, soft: float) -> tuple[int, float]:
    """Make steps until one changes nothing; return how many did, and the stiffness of springs.

    Springs under all nodes, of stiffness ``soft`` [N/m] in each joint, hold a step where contact does not.
    They are stiffer after a step that overshoots the place where the loads along it balance, else softer.
    """
    residual = loads.residual()
    for steps in range(_MOST_STEPS):
        stiffness, even = loads.stiffness()
        soft = max(soft, _FLOOR * float(np.max(np.abs(stiffness))), _LEAST)
        for _ in range(_MOST_STEPS):
            step = np.asarray(np.linalg.lstsq(stiffness + soft * even, residual, rcond=None)[0], np.float64)
            change, way = loads.change(step)
            if way < _FAR:
                loads.move(step)
                after = loads.residual()
                if after @ step >= -_BACK * (residual @ step):
                    break
                loads.move(-step)
            soft *= _STIFFER
        else:
            return _MOST_STEPS, soft
        residual, soft = after, soft / _SOFTER
        if change < _SETTLED and np.linalg.norm(after) <= _BALANCED * loads.largest:
            return steps, soft
    return _MOST_STEPS, soft
