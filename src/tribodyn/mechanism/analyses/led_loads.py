"""Loads on bodies whose drives are led along, with the freedoms that springs and weights hold.

Where the ideal counterpart has freedoms, its linear equations near by say how stiff they are: the forces of
springs, and of all loads as the bodies turn. Velocities along them are those at which no spring changes its
length; inertia forces along them are left out.
"""

from collections.abc import Callable
from typing import Final

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.kernels import dense
from tribodyn.kernels.mechanism.bodies import collect
from tribodyn.kernels.mechanism.data import N_STATES, VELOCITY, MechanismData
from tribodyn.mechanism.analyses.linearised import NEVER_ENTERED, LinearEquations
from tribodyn.mechanism.assembly.assembly import Assembly
from tribodyn.mechanism.assembly.closing import System
from tribodyn.mechanism.assembly.decompositions import row_space
from tribodyn.mechanism.assembly.equilibrium import JointLoads
from tribodyn.mechanism.assembly.parts_by_number import Model
from tribodyn.mechanism.assembly.passage import closes, placed
from tribodyn.mechanism.assembly.positions import held
from tribodyn.mechanism.assembly.shaft_motions import ShaftMotions, applied

#: Names of parameters of laws: where friction is developed, and the least speed at which contact begins.
SLIP: Final = "slip_velocity"
ENTRY: Final = "least_rate"
#: Factors of slip velocities: the friction of shafts that walk turns within a ten-millionth of a step, or a
#: hundred-thousandth where there is no equilibrium otherwise.
_BLURS: Final = (1.0e4, 1.0e3, 1.0e2, 1.0)
_CORRECTIONS: Final = 3  #: By which shafts follow a step along freedoms.
_FLAT: Final = 1.0e-9  #: Stiffness over the largest one that counts as zero.


def developed(data: MechanismData, model: Model, slip: float) -> MechanismData:
    """Return a mechanism whose friction is developed from a slip velocity on [m/s], undamped, in its data.

    Positions along drives have no time scale: friction has its direction from the motion, and its size not,
    and forces of contacts, stops and flanks do not depend on the speed of approach.
    """
    surfaces, couplings = data.contact.surfaces.copy(), data.parts.couplings.copy()
    for records in (surfaces, couplings):
        records["slip_velocity"] = np.minimum(records["slip_velocity"], slip)
    surfaces["minimum_entry_velocity"] = NEVER_ENTERED
    number = model.first_leg
    for element in model.elements:
        for equation in element.equations:
            names = [] if equation.law is None else list(equation.law.function.parameters)
            values = couplings["parameters"]["values"][number : number + len(equation.legs)]
            if SLIP in names:
                values[:, names.index(SLIP)] = np.minimum(values[:, names.index(SLIP)], slip)
            if ENTRY in names:
                values[:, names.index(ENTRY)] = NEVER_ENTERED
            number += len(equation.legs)
    parts = data.parts._replace(couplings=couplings)
    return data._replace(contact=data.contact._replace(surfaces=surfaces), parts=parts)


class LedLoads(JointLoads):
    """The loads on bodies whose drives are led along, by compiled solutions.

    ``ideal_rank``: number of independent constraints of its ideal counterpart; ``slip``: slip velocity at
    which friction is developed [m/s], where that of a joint is not less.
    """

    def __init__(self, assembly: Assembly, ideal_rank: int, slip: float) -> None:
        ideal = placed(System(assembly.model.counterpart), assembly)
        super().__init__(assembly, ideal, over_loads=True)
        self.data = developed(self.data, assembly.model, slip)
        self._slips_given = self.data.contact.surfaces["slip_velocity"].copy()
        self._direction = 1.0
        self._centred: LinearEquations | None = None
        self._walked: Callable[[FloatArray], FloatArray] | None = None
        self._led: FloatArray | None = None
        for system, rank in ((self.ideal, ideal_rank), (self.real, 6 * self.n - assembly.freedoms)):
            system.set_rank(rank)
            system.known_rank = rank

    def at(
        self,
        t: float,
        state: FloatArray,
        direction: float,
        centred: LinearEquations | None = None,
        marks: FloatArray | None = None,
    ) -> None:
        """Put the bodies elsewhere, with the drives at another time [s], running forward (1) or back (−1).

        ``centred`` are the equations of the ideal counterpart near by, with the freedoms that drives leave,
        and ``marks`` the angles of its couplings [rad], whole turns included.
        """
        self.ideal.t = self.real.t = t
        if marks is not None:
            for now in (self.ideal.now, self.real.now, self.memory.now):
                now.couplings["angle_mark"] = marks
        self.state[:], self._direction, self.largest = state, direction, 0.0
        self.data.contact.surfaces["slip_velocity"] = self._slips_given
        self._centred, self.waits = centred, centred is not None

    def walk(
        self, walked: Callable[[FloatArray], FloatArray] | None, pace: float, led: FloatArray | None = None
    ) -> None:
        """Let shafts slip by their ways since the last position, too: ``pace`` positions in a second.

        ``walked`` returns these ways of all bodies at a state, as their velocities over the pace, (n, 6);
        ``led``: the velocities of the place that ways are counted from, (n, 6); those of the place itself
        without it.
        """
        self._walked, self.pace, self._led = walked, 0.0 if walked is None else pace, led
        self.blurs = () if walked is None else _BLURS

    def restore(self, kept: tuple[FloatArray, FloatArray], factor: float) -> None:
        """Put the bodies back, and develop friction at a multiple of its slip velocities."""
        super().restore(kept, factor)
        self._follow()
        self.data.contact.surfaces["slip_velocity"] = factor * self._slips_given

    @property
    def blunt(self) -> bool:
        """Whether friction is developed at larger slip velocities than given."""
        return not np.array_equal(self.data.contact.surfaces["slip_velocity"], self._slips_given)

    def walking(self) -> FloatArray:
        """Return the state with the velocities by which shafts slip, shape (13 n,)."""
        state = self.state.copy()
        if self._walked is not None:
            if self._led is not None:
                state.reshape(-1, N_STATES)[:, VELOCITY:] = self._led
            state.reshape(-1, N_STATES)[:, VELOCITY:] += self.pace * self._walked(state)
        return state

    def _evaluated(self) -> FloatArray:
        kept = self.slipping
        if self._walked is not None:
            passing = kept if self._led is None or kept is not self.velocity else self._led
            self.slipping = passing + self.pace * self._walked(self.state)
        found = super()._evaluated()
        self.slipping = kept
        return found

    def hold(self, times: FloatArray) -> None:
        """Hold drives and loads at some times [s] as they are then."""
        self.data = held(self.data, times)
        for system in (self.ideal, self.real):
            system.data = held(system.data, times)

    def close(self) -> None:
        """Close the ideal joints of the mechanism."""
        closes(self.real)

    def move(self, step: FloatArray) -> None:
        """Displace the bodies by a step (m,); along freedoms joints stay closed, and shafts in their bores.

        A turn by itself would carry pins away, by its square.
        """
        self._before = self.state.copy()
        if self.carried:
            self.ideal.put(self.state)
            way = dense.product(self.ideal.matrix(), applied(self.motions, step))
            meant = self.ideal.entries("residual") + way
        super().move(step)
        for _ in range(_CORRECTIONS if self.carried else 0):
            self.ideal.put(self.state)
            g, root, lengths = self.ideal.scaled()
            missed = (meant - self.ideal.entries("residual")) / lengths
            self.ideal.step(dense.product(root, self.ideal.solve(g, missed)))
            collect(self.ideal.now.bodies, self.state)
        self._follow()

    def _follow(self) -> None:
        """Turn the freedoms with the bodies: aside from them contact is stiffer by many orders."""
        if self.carried and not self.surveyed:
            self.ideal.put(self.state)
            g, root, _ = self.ideal.scaled()
            held = row_space(g, self.ideal.rank())
            for column in self.motions.T[-self.carried :]:
                way = np.linalg.solve(root, column)
                column[:] = dense.product(root, way - held.part_of(way))
            self.moving = ShaftMotions(self.motions, self.ends[:, self.acting])

    def undo(self, step: FloatArray) -> None:
        """Take back the last step (m,)."""
        self.way -= step
        self.state[:] = self._before
        self._follow()

    def begin_to_move(self) -> None:
        """Fill the velocities of the ideal counterpart."""
        self.ideal.move_with_drives(self._direction)

    def divided(self, free: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the freedoms that forces or friction hold, with stiffness ``turning``, and all others."""
        linear = self._centred
        if linear is None or free.size == 0:
            return super().divided(free)
        moving = dense.product(self.root, free)
        coefficients = np.linalg.solve(self.root, linear.motions).T @ free
        whole = coefficients.T @ linear.stiffness @ coefficients
        values, vectors = dense.eigh(0.5 * (whole + whole.T))
        # What rounding of the loads may cause over unit motions [1/s²].
        rounding = _FLAT * linear.load * float(np.max(np.abs(moving))) / self.ideal.size
        flat = max(_FLAT * float(np.max(np.abs(values))), rounding)
        stiff = np.abs(values) > flat
        by_springs = self._by_springs(moving)
        self._lock(moving, by_springs, rounding)
        # Contact comes first: without it nothing says how its forces turn with the bodies. Friction of shafts
        # that walk holds them along all freedoms.
        stiff = (stiff & (not self.waits)) | (self.pace > 0.0)
        self.turning = vectors[:, stiff].T @ (whole - by_springs) @ vectors[:, stiff]
        return dense.product(free, vectors[:, stiff]), dense.product(free, vectors[:, ~stiff])

    def _by_springs(self, moving: FloatArray) -> FloatArray:
        """Return the stiffness of all but contact over motions (6 n, m), positions as they are, (m, m)."""
        self._evaluate(self.velocity)
        return self.held_by(moving, ShaftMotions(moving, self.ends[:, self.others]), self.others)[0]

    def _lock(self, moving: FloatArray, stiffness: FloatArray, rounding: float) -> None:
        """Take from the velocities what changes the lengths of springs along the freedoms (6 n, m)."""
        values, vectors = dense.eigh(0.5 * (stiffness + stiffness.T))
        springs = values > max(_FLAT * float(np.max(np.abs(values))), rounding)
        if not np.any(springs):
            return
        moving, values = moving @ vectors[:, springs], values[springs]
        pulled = self._by_springs(np.hstack([moving, self.velocity.reshape(-1, 1)]))[:-1, -1]
        self.velocity = self.velocity - (moving @ (pulled / values)).reshape(-1, 6)
        bodies = self.ideal.now.bodies[: self.n]
        bodies.v[:], bodies.w[:] = self.velocity[:, :3], self.velocity[:, 3:]
        self.ideal.refresh()
        collect(self.ideal.now.bodies, self.state)
