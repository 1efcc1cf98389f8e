"""Quasi-static analysis: equilibrium in the clearances at positions along the drives.

At each position the bodies are those of the ideal mechanism, displaced to where the forces of contact balance
all loads and the inertia forces of the ideal motion, by :mod:`tribodyn.mechanism.assembly.equilibrium`. The
dynamics of the motion within the clearances is left out: impacts, vibration, and damping. Friction opposes
the ideal motion, so positions that are passed in both directions have two equilibria.

Where hysteresis is asked for, each position also follows from those before. Slip is that of the ideal motion
and of the ways u of the bodies from it, u̇ = (3 u − 4 u₋₁ + u₋₂)/(2 h) with the time h of the drives between
two positions; by u and u₋₁ alone in the first ones, and where a body stops that has gone three times as far
before: the rate would point back. A shaft then walks along its bore as it does in slow motion, by
friction that points against its whole slip, and does not jump. The path depends on no speed.
"""

import math
from collections.abc import Callable
from dataclasses import replace
from itertools import pairwise, product
from typing import ClassVar, Final

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.core.errors import InputError, IntegrationFailure
from tribodyn.core.problem import Problem, Solution
from tribodyn.kernels.mechanism.bodies import collect
from tribodyn.kernels.mechanism.data import N_STATES, ORIENTATION, VELOCITY
from tribodyn.mechanism.analyses.ideal_motion import IdealMechanism, in_body_axes, unreached
from tribodyn.mechanism.analyses.led_loads import LedLoads, developed
from tribodyn.mechanism.analyses.linearised import NEVER_ENTERED, Linearised
from tribodyn.mechanism.assembly.assembly import Assembly, assemble
from tribodyn.mechanism.assembly.closing import System
from tribodyn.mechanism.assembly.mechanism_problem import fastest
from tribodyn.mechanism.assembly.output_values import rotations
from tribodyn.mechanism.assembly.passage import closes, lead, placed, where_drives_are
from tribodyn.mechanism.assembly.positions import DrivePath, walked
from tribodyn.mechanism.assembly.shaft_motions import applied, products
from tribodyn.mechanism.assembly.start import settled
from tribodyn.mechanisms.self_checks import TOO_CLOSE

_SETTLED: Final = 1.0e-5  #: Change of gaps over the roughness that counts as zero.
_CREEP: Final = 1.0e-7  #: Slip velocity at which friction is developed, over the fastest speed of a body.
#: Change of gaps over the roughness that turns the directions of possible motions by less than rounding.
_NEAR: Final = 0.1
#: Square of the way of a body, over that of the one that goes farthest, which counts as none.
_GOES: Final = 1.0e-4
#: Way of a body in one position over that in the one before, and over the widest clearance, that is a snap.
_SUDDENLY: Final = 10.0
_PART: Final = 0.1
_JUMPS: Final = (
    "shafts were put into equilibrium without friction on their ways from the position before: hysteresis "
    "may jump there"
)
_BLUNT: Final = "shafts that walk balance with friction that turns less sharply than elsewhere"
_SNAPS: Final = (
    "a shaft snaps to another place: where it ends in slow motion depends on its inertia, too, and so may "
    "the loop after it"
)
_GOES_ON: Final = "and after them shafts walk as with friction.rest: nothing balances along the ideal motion"
_NO_REST: Final = "no position at rest was found where all forces balance; drives may hold what friction does"
_NO_COSINE: Final = 1.0e-6  #: Least square of the cosine of half a rotation.


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

    ``turn``: when the drives turn back [s]; infinite where they do not; ``times``, ``picture_times``,
    ``progress``: as for :func:`tribodyn.mechanism.assembly.positions.walked`.
    """
    path = DrivePath(times, turn)
    equilibria = Equilibria(assembly, path)
    data = developed(problem.data, assembly.model, equilibria.slip)
    still = replace(problem, data=data)
    found = walked(still, path, equilibria, picture_times, progress)
    least = f"{equilibria.unbalance:.1g} of the loads or better"
    notes = [f"forces on all bodies balance to {least} at every position"]
    if equilibria.middle is not None and assembly.model.case.moves:
        notes.append(
            "freedoms that drives leave rest where loads and springs balance: inertia forces along them, as "
            "those that lift the balls of a governor, are left out; a dynamic run has them"
        )
    notes += [f"at {number} positions {words}" for words, number in equilibria.counts.items() if number]
    return replace(found, notes=tuple(notes) if found.t.size else ())


class Middle:
    """Leads the mechanism of ideal joints, whose freedoms are at rest where forces balance.

    ``assembly``: the mechanism with its clearances; backlash of elements remains; ``times``: of positions at
    which drives and loads are held [s], rising, shape (n_t,).

    Attributes
    ----------
    linear
        Its equations.
    marks
        Whole turns of its angles.
    rests
        Whether it was at rest at the last position.
    """

    def __init__(self, assembly: Assembly, times: FloatArray) -> None:
        self.linear = Linearised(assemble(assembly.model.counterpart), times)
        self._leader = IdealMechanism(assembly, play=True)
        self.marks = self.linear.system.now.couplings.angle_mark.copy()
        self.rests = True

    def at(self, t: float, ideal: FloatArray, *, anew: bool, must: bool = False) -> FloatArray | None:
        """Return the state at a time of the drives [s], shape (n_bodies, 13).

        ``t``: time [s]; ``ideal``: the state as drives lead it, freedoms at rest, shape (n_bodies, 13);
        ``anew``: whether to begin there instead of at the state before; ``must``: whether there is no state
        where no rest is found; else it is the one from which it was searched.
        """
        system, centred = self._leader.system, self.linear.system
        state = np.zeros(ideal.size)
        if anew or not lead(system, t, lambda: closes(system)):
            self._leader.put(t, ideal.ravel())
        collect(system.now.bodies, state)
        state.reshape(ideal.shape)[:, VELOCITY:] = 0.0
        centred.take_positions(system)
        balanced = self.linear.balanced(t, state) if self.rests else None
        self.rests = balanced is not None
        if must and not self.rests:
            return None
        # Where nothing holds a load along a freedom the search has led anywhere, and would again.
        kept, other = (centred, system) if balanced is None else (system, centred)
        kept.take_positions(other)
        state = state if balanced is None else balanced
        self.marks = centred.now.couplings.angle_mark.copy()
        return np.asarray(state.reshape(ideal.shape))


def at_rest(assembly: Assembly, path: DrivePath) -> FloatArray:
    """Return the states of the ideal mechanism without play at rest where forces balance.

    ``path``: times of the positions, n_t of them. Returns shape (n, 13 n_bodies), n positions from the first
    on at which joints close.
    """
    without_play = replace(assembly, model=assembly.model.without_play)
    times, where = np.unique(path.of_drives, return_inverse=True)
    ideal = in_body_axes(IdealMechanism(without_play).follow(times))
    middle, known = Middle(without_play, times), where[where < len(ideal)]
    shape = (len(without_play.model.bodies), N_STATES)
    states = [middle.at(times[k], ideal[k].reshape(shape), anew=n == 0) for n, k in enumerate(known)]
    return np.array(states).reshape(known.size, -1)


class Equilibria:
    """Finds the equilibrium at one position after the other, each from the one before.

    Attributes
    ----------
    slip
        Slip velocity at which friction is developed [m/s].
    unbalance
        Largest load so far that does not balance, over all loads.
    counts
        Number of positions so far by what a note says of them.
    MUST_REST
        Whether ideal joints must be at rest, too.
    """

    MUST_REST: ClassVar[bool] = False

    def __init__(self, assembly: Assembly, path: DrivePath) -> None:
        times, self._where = np.unique(path.of_drives, return_inverse=True)
        found = IdealMechanism(assembly).follow(times)
        self._path, self._model = path, assembly.model
        self._reason = unreached(times, found)
        self._ideal = in_body_axes(found).reshape(len(found), -1, N_STATES)
        self._ways: list[FloatArray] = []
        run = assembly.model.case.run
        asks = assembly.model.case.friction.rest or run.directions == "both"
        self._walks = asks and run.analysis == "static"
        self.counts = dict.fromkeys((_JUMPS, _BLUNT, _SNAPS, _GOES_ON), 0)
        self._wide = max((real.shape.clearance for real in assembly.model.clearances.values()), default=0.0)
        counterpart = placed(System(assembly.model.counterpart), assembly)
        rank = counterpart.independence()[0]
        self.slip = _CREEP * fastest(self._ideal[..., VELOCITY:], counterpart.size) or math.inf
        self._loads, self.unbalance = LedLoads(assembly, rank, self.slip), 0.0
        self.middle = Middle(assembly, times) if rank < 6 * len(self._model.bodies) else None

    def __call__(self, number: int) -> FloatArray:
        """Return the equilibrium at a position, see :class:`~.positions.States`."""
        t, direction = float(self._path.of_drives[number]), float(self._path.forward[number])
        ideal = self._in_the_middle(number)
        equations = marks = None
        if self.middle is not None:
            equations, marks = self.middle.linear.at(t, ideal.ravel()), self.middle.marks
        expected = [2.0 * last - before for before, last in pairwise(self._ways)] + self._ways[-1:]
        starts = [*(self._displaced(ideal, ways) for ways in expected), ideal]
        for walks, start in product(dict.fromkeys((self._walks, self._walks and not self._ways)), starts):
            self._walk(number, ideal, walks=walks)
            self._loads.at(t, start.ravel(), direction, equations, marks)
            if settled(self._loads, change=_SETTLED, near=_NEAR) is not None:
                ways = [*self._ways, _ways(self._loads.state, ideal)]
                if self._walks and len(ways) > 2 and _stops(ways, self._loads.units.reshape(-1, 6)):
                    self._ways = self._ways[1:]
                    return self(number)
                self.counts[_JUMPS] += self._walks and not walks
                self.counts[_BLUNT] += self._loads.blunt
                self.counts[_SNAPS] += walks and len(ways) > 2 and _snaps(ways, self._wide)
                self._require_balance(number)
                self._ways = ways[-2:]
                self.unbalance = max(self.unbalance, self._loads.unbalance())
                return self._loads.walking()
        why = self._failure(number, f"no static equilibrium was found: {self._why_not()}")
        # Friction may leave bodies no place along the ideal motion: they walk, at first from one without any.
        if self.MUST_REST or (self._ways and self._walks):
            raise why
        if not self._ways:
            self._loads.at(t, ideal.ravel(), direction, equations, marks)
            self._loads.restore(self._loads.kept(), NEVER_ENTERED)
            if settled(self._loads, change=_SETTLED, near=_NEAR) is None:
                raise why
            self._loads.ahead = self._loads.velocity  # the motion that loads begin without friction is over
            self._ways = [_ways(self._loads.state, ideal)]
        self.counts[_GOES_ON] += not self._walks
        self._walks = True
        return self(number)

    def _in_the_middle(self, number: int) -> FloatArray:
        """Return the state of the ideal counterpart, freedoms where forces balance, shape (n_bodies, 13)."""
        t, k = float(self._path.of_drives[number]), int(self._where[number])
        if k >= len(self._ideal):
            raise IntegrationFailure(float(self._path.times[number]), self._reason)
        ideal: FloatArray = self._ideal[k]
        if self.middle is None:
            return ideal
        found = self.middle.at(t, ideal, anew=number == 0, must=self.MUST_REST)
        if found is None:
            raise self._no_rest(number)
        return found

    def _no_rest(self, number: int) -> IntegrationFailure:
        """Return the failure to find rest at a position."""
        self._loads.ideal.at(float(self._path.times[number]))
        return self._failure(number, _NO_REST)

    def _why_not(self) -> str:
        """Return why the last search ended without an equilibrium, in words."""
        joints, overlapping, lost = self._model.joints, self._loads.overlapping(), self._loads.lost()
        if self.middle is not None and not self.middle.rests:
            return f"with ideal joints, too, {_NO_REST}"
        if lost is not None:
            return (
                f"the loads move the shaft of joint {joints[lost]} out of its bore; nothing holds it along "
                "its axis, or a joint is overloaded"
            )
        if overlapping is not None:
            return (
                f"the surfaces of joint {joints[overlapping]} come closer than the contact law reaches; "
                f"the load {TOO_CLOSE}{self._model.yielding(joints[overlapping])}"
            )
        left = np.linalg.solve(self._loads.root, applied(self._loads.motions, self._loads.residual()))
        body = self._model.bodies[int(np.argmax(np.linalg.norm(left.reshape(-1, 6), axis=1)))]
        return (
            f"the search for it did not converge: loads on body {body} do not balance; more positions, "
            "friction.rest = true, more clearance or less friction in its joints, or a dynamic run may help"
        )

    def _displaced(self, ideal: FloatArray, ways: FloatArray) -> FloatArray:
        """Return the ideal state, displaced, shape (n_bodies, 13)."""
        found = ideal.copy()
        found[:, :ORIENTATION] += ways[:, :3]
        found[:, ORIENTATION:VELOCITY] = _after(_turn(ways[:, 3:]), found[:, ORIENTATION:VELOCITY])
        return np.asarray(found)

    def _walk(self, number: int, ideal: FloatArray, *, walks: bool) -> None:
        """Let friction follow the displacements since the last position, too, or the ideal motion alone."""
        span = abs(float(np.diff(self._path.of_drives[max(number - 1, 0) :][:2]).sum()))
        if not (walks and self._ways and span > 0.0 and math.isfinite(self.slip)):
            self._loads.walk(None, 0.0)
            return
        # Two steps back: the rate is then exact to the second order.
        last = (4.0 * self._ways[-1] - self._ways[0]) / 3.0 if len(self._ways) > 1 else self._ways[-1]
        into_bodies = rotations(ideal[:, ORIENTATION:VELOCITY]).inv().as_matrix()

        def walked(state: FloatArray) -> FloatArray:
            ways = _ways(state, ideal)
            passed = ways - last
            passed[:, 3:] = products(into_bodies, _turned(ways[:, 3:], passed[:, 3:])[..., None])[..., 0]
            return passed

        led = None if self.middle is not None else float(self._path.forward[number]) * ideal[:, VELOCITY:]
        self._loads.walk(walked, (0.5 + 0.5 * len(self._ways)) / span, led)

    def _require_balance(self, number: int) -> None:
        """Refuse an equilibrium of the clearances alone, where the mechanism as a whole is pushed away."""
        pushed = self._loads.unbalanced()
        if pushed is not None:
            body = self._model.bodies[pushed]
            words = f"there is no static equilibrium: body {body} moves under its loads, along a"
            raise self._failure(number, f"{words} freedom that no joint, drive or spring holds")

    def _failure(self, number: int, words: str) -> IntegrationFailure:
        where = where_drives_are(self._loads.ideal)
        words = f"with {where}, {words}" if where else words
        return IntegrationFailure(float(self._path.times[number]), words)


def _ways(state: FloatArray, ideal: FloatArray) -> FloatArray:
    """Return displacements and rotations from the ideal state (n_bodies, 13), shape (n_bodies, 6).

    Rotations are axes times twice the sine of half the angle.
    """
    real = state.reshape(ideal.shape)
    before = ideal[:, ORIENTATION:VELOCITY] * (1.0, -1.0, -1.0, -1.0)
    turn = _after(real[:, ORIENTATION:VELOCITY], before)
    ways = real[:, :ORIENTATION] - ideal[:, :ORIENTATION]
    return np.hstack([ways, np.where(turn[:, :1] < 0.0, -2.0, 2.0) * turn[:, 1:]])


def _stops(ways: list[FloatArray], units: FloatArray) -> bool:
    """Return whether a body went so little farther in the last position that its rate points back."""
    before, way = np.diff(np.array(ways) / units, axis=0)
    far = np.sum(before**2, axis=1)
    return bool(np.any((np.sum(way * (3.0 * way - before), axis=1) < 0.0) & (far > _GOES * np.max(far))))


def _snaps(ways: list[FloatArray], wide: float) -> bool:
    """Return whether a body went much farther than before, by a good part of the widest clearance [m]."""
    before, way = np.linalg.norm(np.diff(np.array(ways)[..., :3], axis=0), axis=2)
    return bool(np.any((way > _SUDDENLY * before) & (way > _PART * wide)))


def _turn(rotations: FloatArray) -> FloatArray:
    """Return the quaternions of rotations as :func:`_ways` gives them, shape (n, 4)."""
    half = 0.5 * rotations
    return np.hstack([np.sqrt(np.maximum(1.0 - np.sum(half**2, axis=1, keepdims=True), _NO_COSINE)), half])


def _turned(rotations: FloatArray, rates: FloatArray) -> FloatArray:
    """Return angular velocities in the axes that rotate, from rates of rotations as above, (n, 3) each."""
    turn = _turn(rotations)
    along = np.sum(turn[:, 1:] * rates, axis=1, keepdims=True)
    return _after(turn * (1.0, -1.0, -1.0, -1.0), np.hstack([-along / turn[:, :1], rates]))[:, 1:]


def _after(second: FloatArray, first: FloatArray) -> FloatArray:
    """Return the quaternions of rotations after others, shape (n, 4)."""
    (a, b, c, d), (p, q, r, s) = second.T, first.T
    parts = a * p - b * q - c * r - d * s, a * q + b * p + c * s - d * r
    return np.stack([*parts, a * r - b * s + c * p + d * q, a * s + b * r - c * q + d * p], axis=1)
