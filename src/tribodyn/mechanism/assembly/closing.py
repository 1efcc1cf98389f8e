"""A mechanism while its drawing is closed, its rows as full matrices.

One file because all that assembly asks of these matrices shares the bodies that it moves.
"""

import math
from functools import cached_property
from typing import Any, Final, TypeAlias

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.kernels import dense
from tribodyn.kernels.mechanism import solution
from tribodyn.kernels.mechanism.bodies import move, place
from tribodyn.kernels.mechanism.data import ANGLE, DIRECTION, NONE, POSITION, MechanismData, Parts
from tribodyn.kernels.mechanism.equations import ROUNDS
from tribodyn.kernels.mechanism.follow import follow
from tribodyn.kernels.mechanism.redundancy import SMALL, choose_rows, row_scale
from tribodyn.mechanism.assembly.decompositions import DEPENDENT, factors, null_space, svd, with_unit_rows
from tribodyn.mechanism.assembly.odd_axes import odd_axes
from tribodyn.mechanism.assembly.parts_by_number import Model, ModelError
from tribodyn.mechanism.assembly.records import mechanism_data, new_memory
from tribodyn.mechanism.frames import GROUND
from tribodyn.mechanism.joints import JOINTS
from tribodyn.mechanism.model.drives_and_loads import GIVEN

#: What tolerances take for the size of a mechanism [m]; where joints close it counts as much as a radian.
SIZE: Final = 1.0
CLOSED: Final = 1.0e-12  #: Residual, in units of the mechanism's size or in radians, of a joint that closes.
CLOSES: Final = 1.0e-9  #: The same, of joints of a mechanism on its way.
_MOST_STEPS: Final = 60
_TRIES: Final = 4  #: Times that joints are closed as runs do where rows depend on each other.
#: Largest turn [rad], or way in units of the size, of one step, so that the branch that was drawn is kept.
_LONGEST: Final = 0.2
_WRONG: Final = 0.1
#: Bounds of the relative error of reactions from which on a mechanism is refused, and a warning is given.
_INEXACT: Final = 1.0e-6
#: Factor by which masses reduce the least singular value squared before an error is attributed to them.
_BY_MASS: Final = 1.0e-2
#: Ratio of masses, and square root of that of moments of inertia, up to which no body is called light.
_ALIKE: Final = 100.0
_TINY: Final = 1.0e-300
_TAKES_PART: Final = 0.1  #: Share of a row in a combination of unit length from which on it counts.
_NEAR: Final = 0.03  #: Distance of positions near by, in the same units.

Position: TypeAlias = tuple[Any, Any]  #: Records of the bodies, and marks of the angles of all couplings.


class System:
    """A mechanism while it is put together, its rows as full matrices.

    ``data`` may be that of an earlier system of the same model, which is not used any more; where
    ``known_rank``, the number of independent constraints, is set, it is not found anew at each position.
    """

    def __init__(
        self,
        model: Model,
        worn: FloatArray | None = None,
        *,
        contacts: bool = True,
        data: MechanismData | None = None,
    ) -> None:
        self.model = model
        self.data = mechanism_data(model, worn, contacts=contacts) if data is None else data
        self.data.parts.constants.rank = self.data.parts.constants.n_rows
        memory = new_memory(self.data)
        self.parts, self.now, self._blocks = self.data.parts, memory.now, memory.blocks
        self.rows = [(k, m) for k, c in enumerate(self.parts.couplings) for m in range(c.n_rows)]
        self.n = len(model.bodies)
        self.size = SIZE
        self._wait = 0
        self.known_rank: int | None = None
        self._later_legs = [
            (self.rows.index((int(c.first_leg), 0)), k)
            for k, c in enumerate(self.parts.couplings)
            if c.first_leg != NONE and c.law == 0
        ]
        self._places = tuple(np.array(self.rows, dtype=np.int64).reshape(-1, 2).T)
        self.row_units = np.array([1.0 if row_is_turn(self.parts, *row) else self.size for row in self.rows])
        self.t = 0.0
        self.refresh()

    def at(self, t: float) -> None:
        """Fill kinematics where the bodies are, with the drives at another time [s]."""
        self.t = t
        self.refresh()

    def refresh(self) -> None:
        """Fill kinematics where the bodies are, and count whole turns from there."""
        solution.kinematics(self.parts, self.now, self.data.signals, self.t)
        solution.mark_angles(self.now.couplings)

    def put(self, state: FloatArray) -> None:
        """Put the bodies where a state has them."""
        place(state, self.now.bodies)
        self.refresh()

    def position(self) -> Position:
        """Return the positions of the bodies, with their whole turns, for :meth:`restore`."""
        return self.now.bodies.copy(), self.now.couplings.angle_mark.copy()

    def restore(self, position: Position) -> None:
        """Put the bodies back where they were."""
        self.now.bodies[:], self.now.couplings.angle_mark[:] = position
        self.refresh()

    def adopt(self, state: FloatArray) -> None:
        """Put the bodies where a state on the constraints has them, and count angles from there."""
        self.put(state)
        solution.set_offsets(self.parts, self.now)
        self.refresh()

    def take_positions(self, other: "System") -> None:
        """Take over where the bodies of another system are."""
        for name in ("r", "p", "A"):
            self.now.bodies[name][:] = other.now.bodies[name]
        self.now.couplings.angle_mark[:] = other.now.couplings.angle_mark
        self.refresh()
        row_scale(self.parts, self.now)

    def drive_rows(self) -> list[tuple[int, int, str]]:
        """Return coupling, row and name of the drives that are constraints."""
        found = []
        for name, drive in self.model.case.drives.items():
            coordinate, level = GIVEN[drive.gives]
            if level < 2:
                k = self.model.joints.index(drive.joint)
                kind = ANGLE if coordinate == "angle" else POSITION
                of_joint = self.parts.couplings[k].row_kind[: self.parts.couplings[k].n_rows]
                found += [(k, m, name) for m in np.flatnonzero(of_joint == kind).tolist()]
        return found

    def matrix(self) -> FloatArray:
        """Return G over the velocities of all bodies, shape (n_rows, 6 n)."""
        g = np.zeros((len(self.rows), 6 * (self.n + 1)))
        entries, couplings = self.now.couplings.G[self._places], self._places[0]
        for side, bodies in enumerate((self.parts.couplings.socket, self.parts.couplings.shaft)):
            columns = 6 * bodies[couplings][:, None] + np.arange(6)
            g[np.arange(len(self.rows))[:, None], columns] += entries[:, 6 * side : 6 * side + 6]
            for row, leg in self._later_legs:
                column = 6 * bodies[leg]
                g[row, column : column + 6] += self.now.couplings.G[leg, 0, 6 * side : 6 * side + 6]
        return g[:, : 6 * self.n]

    def entries(self, name: str) -> FloatArray:
        """Return one quantity of all rows, shape (n_rows,)."""
        return np.asarray(self.now.couplings[name][self._places], np.float64)

    @cached_property
    def metric(self) -> FloatArray:
        """Inverse square root of the mass matrix, shape (6 n, 6 n)."""
        root = np.zeros((6 * self.n, 6 * self.n))
        for b, body in enumerate(self.parts.bodies):
            root[6 * b : 6 * b + 3, 6 * b : 6 * b + 3] = np.eye(3) / np.sqrt(body.mass)
            values, vectors = dense.eigh(body.inertia)
            turned = dense.product(dense.product(vectors, np.diag(1.0 / np.sqrt(values))), vectors.T)
            root[6 * b + 3 : 6 * b + 6, 6 * b + 3 : 6 * b + 6] = turned
        return root

    def scaled(self) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return G over the metric with rows of length one, the metric and the lengths."""
        root = self.metric
        g = dense.product(self.matrix(), root)
        length = np.linalg.norm(g, axis=1)
        length[length == 0.0] = 1.0
        return g / length[:, None], root, length

    def over_sizes(self, rows: FloatArray) -> FloatArray:
        """Return rows (m, 6 n) over ways in units of the size and turns, each of length one.

        Whether rows depend on each other follows from these: it is a matter of places, not of masses.
        """
        return with_unit_rows(rows * np.tile(np.repeat([self.size, 1.0], 3), self.n))

    def rank(self, rows: FloatArray | None = None) -> int:
        """Return the number of independent rows among these, or among the constraints."""
        if rows is None and self.known_rank is not None:
            return self.known_rank
        given = self.over_sizes(self.matrix() if rows is None else rows)
        found = factors(given)
        return rank_of(svd(given)[1]) if found is None else found.rank

    def inverse(self, scaled: FloatArray, rows: FloatArray | None = None) -> FloatArray:
        """Return the pseudo-inverse of rows that were scaled by mass, of the rank of ``rows`` or of all."""
        rank = self.rank(rows)
        u, values, v = svd(scaled)
        return np.asarray(dense.product(v[:rank].T / values[:rank], u[:, :rank].T))

    def solve(self, scaled: FloatArray, right: FloatArray, rows: FloatArray | None = None) -> FloatArray:
        """Return the pseudo-inverse of such rows times a right-hand side (m,)."""
        found = factors(scaled)
        if found is not None and found.rank == self.rank(rows):
            return found.solve(right)
        return np.asarray(dense.product(self.inverse(scaled, rows), right))

    def step(self, change: FloatArray) -> None:
        """Move the bodies by a change (6 n,), not too far at once."""
        ways = np.abs(change.reshape(-1, 6)) / np.repeat([self.size, 1.0], 3)
        change = change / max(1.0, float(np.max(ways, initial=0.0)) / _LONGEST)
        for b in range(self.n):
            move(self.now.bodies[b], change[6 * b : 6 * b + 6], np.zeros(4))
        self.refresh()

    def gap(self) -> float:
        """Return the largest residual, ways in units of the size."""
        return float(np.max(np.abs(self.entries("residual")) / self.row_units, initial=0.0))

    def set_rank(self, rank: int) -> None:
        """Let compiled solutions know how many rows are independent, and what each row moves."""
        self.parts.constants.rank = rank
        row_scale(self.parts, self.now)
        solution.set_compliance(self.parts, self.now)
        self._wait = 0

    def close_fast(self) -> float:
        """Move the bodies onto the constraints as runs do, from near by; return the gap left.

        Where joints stay open, rows that were independent at an earlier position may hardly be: they are
        chosen anew, many rows only if closing once more does not help.
        """
        n, gap = len(self.rows), math.inf
        some_depend = self.parts.constants.rank < n
        for k in range(_TRIES if some_depend else 1):
            if some_depend and (self._wait <= 0 or k > min(n // SMALL, 1)):
                choose_rows(self.parts, self.now, np.zeros((n, n)))
                self._wait = 1 + (n // SMALL) ** 3
            solution.close(self.parts, self.now, self.data.signals, self.data.mass, self._blocks, self.t)
            gap = self.gap()
            if gap <= CLOSES:
                break
        self._wait -= 1
        return gap

    def move_with_drives(self, direction: float) -> None:
        """Fill the velocities of the drives, running forward (1) or back (−1); freedoms are at rest."""
        self.now.bodies.v[:] = self.now.bodies.w[:] = 0.0
        self.refresh()
        solution.correct_velocities(self.parts, self.now, self.data.mass, self._blocks, 0.0)
        self.now.bodies.v[:] *= direction
        self.now.bodies.w[:] *= direction
        self.refresh()

    def follow(self, times: FloatArray, first: int, matrix: FloatArray, states: FloatArray) -> int:
        """Fill states at times from a number on; return the number of the first that is not reached at once.

        See :func:`tribodyn.kernels.mechanism.follow.follow`.
        """
        compiled = (self.parts, self.now, self.data.signals, self.data.mass, self._blocks)
        return int(follow(*compiled, times, first, _LONGEST, CLOSES, matrix, states))

    def freedoms(self, rank: int) -> FloatArray:
        """Return displacements that leave the joints closed, ways over the size, shape (n, 6 n_bodies)."""
        if rank in (0, 6 * self.n):  # all of them, or none
            return np.eye(6 * self.n)[rank:]
        return null_space(self.over_sizes(self.matrix()), rank).T

    def time_to_move(self, change: float) -> float:
        """Return the time in which no drive moves more than that, ways in units of the size [s]."""
        longest = math.inf
        for k, m, _ in self.drive_rows():
            unit = 1.0 if row_is_turn(self.parts, k, m) else self.size
            rates = np.abs(self.now.couplings[k].prescribed[m, 1:]) / (unit * change)
            longest = min(longest, 1.0 / max(rates[0], math.sqrt(rates[1]), _TINY))
        return longest

    def wander(self, chance: np.random.Generator) -> bool:
        """Move the bodies some way along the freedoms that are left; return whether there are any."""
        g, root, _ = self.scaled()
        anywhere = chance.normal(size=6 * self.n)
        way = dense.product(root, anywhere - self.solve(g, dense.product(g, anywhere)))
        ways = np.abs(way.reshape(-1, 6)) / np.repeat([self.size, 1.0], 3)
        if np.max(ways) <= CLOSED:
            return False
        self.step(_NEAR * way / np.max(ways))
        self.close()
        return True

    def close(self, most: int = _MOST_STEPS) -> float:
        """Move the bodies onto the constraints by Gauss and Newton, least by mass; return the gap left."""
        least = self.gap()
        nearest = self.position()
        for _ in range(most):
            if least < CLOSED:
                break
            g, root, length = self.scaled()
            change = self.solve(g, -self.entries("residual") / length)
            self.step(dense.product(root, change))
            if (gap := self.gap()) < least:
                least, nearest = gap, self.position()
        self.restore(nearest)
        return least

    def approach(self) -> list[ModelError]:
        """Close all joints, drives led from the drawing to where they start; return what fails."""
        pieces = self.data.signals.pieces
        starts = {
            int(self.parts.couplings[k].row_signal[m]): float(self.now.couplings[k].prescribed[m, 0])
            for k, m, _ in self.drive_rows()
        }
        driven = [self.data.signals.signals[i] for i in starts]
        firsts = [slice(signal.first, signal.first + signal.n) for signal in driven]
        if not self.rows:
            return []
        n_steps = 1 + int(max((abs(s) for s in starts.values()), default=0.0) / _LONGEST)
        drawn = np.array([math.dist(*joint.points) for joint in self.model.case.joints.values()])
        kept = pieces.c.copy()
        for step in range(n_steps + 1):
            pieces.c[:] = kept
            for part, start in zip(firsts, starts.values(), strict=True):
                pieces.c[part, 0] -= start * (1.0 - step / n_steps)
            self.refresh()
            gap = self.close()
        pieces.c[:] = kept
        if gap < CLOSED:
            return []
        return [self.open_joint() if np.max(drawn) < CLOSED * self.size else self._drawn_open(drawn)]

    def _drawn_open(self, gaps: FloatArray) -> ModelError:
        """Return the joint that is open in the model; closing spreads its gap over others."""
        name = self.model.joints[int(np.argmax(gaps))]
        first, second = self.model.case.joints[name].between
        text = (
            f"joint {name} between {first} and {second} does not close: its points stand "
            f"{np.max(gaps) * 1e3:.4g} mm apart in the model, and no motion of bodies closes the gap"
        )
        return ModelError(f"joints.{name}", text)

    def open_joint(self) -> ModelError:
        """Return the joint with the largest gap, with its gap and its bodies."""
        residuals, rows = self.now.couplings.residual, self.parts.couplings.n_rows
        gaps = [np.max(np.abs(residuals[k, : rows[k]]), initial=0.0) for k in range(len(self.model.joints))]
        size = float(max(gaps, default=-1.0))
        if (element := self._open_element(size)) is not None:
            return element
        worst = int(np.argmax(gaps))
        name = self.model.joints[worst]
        now = self.now.couplings[worst]
        way = float(dense.norm(now.pose.d[JOINTS[self.model.kind(name)].held]))
        first, second = self.model.case.joints[name].between
        text = (
            f"joint {name} between {first} and {second} does not close: when all joints are nearest to "
            + (
                f"closing, {way * 1e3:.4g} mm are left between its points"
                if way >= size
                else f"closing, its directions stay {math.degrees(math.asin(min(size, 1.0))):.3g}° apart"
            )
            + odd_axes(self.model.case.joints)
        )
        return ModelError(f"joints.{name}", text)

    def _open_element(self, least: float) -> ModelError | None:
        """Return the element with the largest error of its equation, if one exceeds that [m]."""
        first = self.model.first_leg
        gaps = np.where(
            self.parts.couplings.n_rows[first:] > 0, abs(self.now.couplings.residual[first:, 0]), 0.0
        )
        if not np.max(gaps, initial=0.0) > least:
            return None
        element = self.model.element_of(first + int(np.argmax(gaps)))
        text = (
            f"{element.keys.METHOD} {element.name} does not hold: when all joints are nearest to closing, "
            f"it misses by {np.max(gaps) * 1e3:.4g} mm"
        )
        return ModelError(f"{element.keys.TABLE}.{element.name}", text)

    def independence(self) -> tuple[int, FloatArray]:
        """Return the number of independent rows, and the combinations that vanish, shape (m, n_rows).

        They combine rows of length one.

        Taken here and at two positions near by, because where a mechanism is drawn rows may depend on each
        other that elsewhere do not.
        """
        if not self.rows:
            return 0, np.zeros((0, 0))
        rank, vanishing = self._rank()
        if rank == min(len(self.rows), 6 * self.n):
            return rank, vanishing
        kept = self.position()
        rng = np.random.default_rng(1)
        for _ in range(2):
            if self.wander(rng):
                other, others = self._rank()
                if other > rank:
                    rank, vanishing = other, others
            self.restore(kept)
        return rank, vanishing

    def _rank(self) -> tuple[int, FloatArray]:
        """Return rank and vanishing combinations of the rows, each of length one, here."""
        given = self.over_sizes(self.matrix())
        if (found := factors(given)) is not None:
            return found.rank, found.dependent
        _, values, left = svd(given.T)
        rank = rank_of(values)
        return rank, left[rank:]

    def unequal(self, rank: int) -> tuple[list[ModelError], list[str]]:
        """Return a finding, or a warning, where bodies that ideal joints connect differ too much in mass.

        Kernels give every row a compliance ε and iterate it away. With the least singular value σ of the rows
        scaled by mass, up to the share (ε/(ε + σ²))³ of a reaction is lost.
        """
        if rank == 0:
            return [], []
        rows_by_mass, rows_by_size = self.scaled()[0], self.over_sizes(self.matrix())
        by_mass, by_size = factors(rows_by_mass), factors(rows_by_size)
        # Bounds decide where they can. Of rows of length one the largest singular value is at least 1.
        if (
            (by_mass is not None and by_size is not None)
            and by_mass.rank == by_size.rank == rank
            and _is_exact(by_mass.bounds[0] ** 2, by_size.softest() ** 2)
        ):
            return [], []
        places = svd(rows_by_size)[1]
        # Of the transposed matrix also the rows that belong to the value zero are known.
        _, values, left = svd(rows_by_mass.T)
        share, of_places = float(values[rank - 1]) ** 2, float(places[rank - 1] / places[0]) ** 2
        if _is_exact(share, of_places):
            return [], []
        lost = _lost(share)
        rows = np.flatnonzero(np.abs(left[rank - 1]) > _TAKES_PART)
        bodies = self.model.case.bodies
        named = {b for i in rows for b in self.model.constraint(self.rows[i][0])[1] if b != GROUND}
        tied = sorted(named, key=lambda b: bodies[b].mass)
        light, heavy = tied[0], tied[-1]
        first, second = bodies[light], bodies[heavy]
        moments = [bodies[b].inertia for b in tied]
        # A long chain of like bodies is ill-conditioned by its length, and its reactions are exact.
        if second.mass <= _ALIKE * first.mass and np.max(moments) <= _ALIKE**2 * np.min(moments):
            return [], []
        pair = f"light beside {heavy} with {second.mass:.3g} kg for the ideal joints that tie them"
        change = "give it more mass, or make a joint of it a spring-damper"
        body = f"{light} with {first.mass:.3g} kg"
        if lost >= _WRONG:
            return [ModelError(f"bodies.{light}.mass", f"{body} is too {pair}: {change}")], []
        return [], [f"{body} is {pair}, whose reactions may be wrong by up to {100.0 * lost:.1g} %: {change}"]


def _lost(share: float) -> float:
    """Return the relative error of reactions; ``share`` is the least singular value, by mass, squared."""
    return float((solution.HARD / (solution.HARD + share)) ** ROUNDS)


def _is_exact(share: float, of_places: float) -> bool:
    """Return whether masses leave reactions exact; ``of_places`` is that of rows scaled by size."""
    return _lost(share) < _INEXACT or share > _BY_MASS * of_places


def rank_of(values: FloatArray) -> int:
    """Return the number of these singular values, falling, that belong to independent rows."""
    return int(np.sum(values > DEPENDENT * np.max(values, initial=0.0)))


def row_is_turn(parts: Parts, coupling: int, row: int) -> bool:
    """Tell whether a row is about directions, not about ways."""
    return bool(parts.couplings[coupling].row_kind[row] in (DIRECTION, ANGLE))
