"""Motion of the ideal counterpart of a mechanism: joints ideal and in place, no backlash, the same drives.

Drives and joints determine it without forces, position by position. Where they leave freedoms, an output
may depend on these. Then the counterpart follows the motion that joints had in the run: those of motors,
controllers, drives by a torque or a force, or the one that the output names. Where that leaves the output
free, too, there is no ideal value that it could be compared with.
"""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Final

import numpy as np
from numpy.typing import NDArray

from mebdf.arrays import FloatArray
from tribodyn.cases.signals import AngleSignal, PositionSignal
from tribodyn.kernels.mechanism.bodies import collect, place
from tribodyn.kernels.mechanism.data import N_STATES, ORIENTATION, TURNING, VELOCITY
from tribodyn.mechanism.assembly.assembly import Assembly
from tribodyn.mechanism.assembly.closing import CLOSES, System
from tribodyn.mechanism.assembly.decompositions import DEPENDENT
from tribodyn.mechanism.assembly.output_values import Motion, Output, rotations
from tribodyn.mechanism.assembly.passage import closes, lead, placed
from tribodyn.mechanism.assembly.positions import DrivePath
from tribodyn.mechanism.model.drives_and_loads import DriveKeys

#: Displacement along a freedom by which outputs are tried, in units of the size or radians.
_STEP: Final = 1.0e-4
_AWAY: Final = 0.02  #: Displacement to a place beside a dead centre, in the same units.
_PLACES: Final = 5  #: Number of times at which they are tried.


@dataclass(frozen=True)
class IdealOutputs:
    """Outputs of the ideal counterpart."""

    #: Of each output, shape (n_t, m) each; NaN where drives do not determine it.
    components: tuple[FloatArray, ...]
    notes: tuple[str, ...]  #: Why all have no ideal value, or from when on, in words.
    free: tuple[bool, ...]  #: Whether an output depends on a freedom that drives leave.


def ideal_outputs(assembly: Assembly, outputs: Sequence[Output], path: DrivePath) -> IdealOutputs:
    """Return the outputs as they are with ideal joints.

    ``assembly``: the mechanism, without findings; ``outputs``: to be evaluated; ``path``: the times, n_t of
    them.
    """
    n_t = path.times.size
    unknown = np.full((n_t, 1), np.nan)
    if assembly.strain:
        reason = "ideal joints cannot follow the drives, so outputs have no ideal value and no error"
        return IdealOutputs((unknown,) * len(outputs), (reason,), (False,) * len(outputs))
    times, where = np.unique(path.of_drives, return_inverse=True)
    mechanism = IdealMechanism(assembly)
    states = mechanism.follow(times)
    free = mechanism.leaves_free(outputs, times, states)
    known = where < len(states)
    motion = motion_of(states[where[known]], path.forward[known])
    found = []
    for output, is_free in zip(outputs, free, strict=True):
        components = output.components(motion)
        whole = np.full((n_t, components.shape[1]), np.nan)
        if not is_free:
            whole[known] = components
        found.append(whole)
    notes = () if known.all() else (unreached(times, states),)
    return IdealOutputs(tuple(found), notes, tuple(free))


def compared(
    assembly: Assembly,
    outputs: Sequence[Output],
    path: DrivePath,
    motion: Motion,
    moved: Callable[[str], FloatArray],
    at_rest: Callable[[], FloatArray] | None,
) -> tuple[dict[str, FloatArray], tuple[str, ...]]:
    """Return the columns of outputs, each of shape (n_t, n_outputs), and notes.

    ``assembly``: the mechanism, without findings; ``outputs``: at least one; ``path``: times of the motion,
    n_t of them; ``motion``: of the mechanism with clearance; ``moved``: gives the angle or the position that
    a joint had in the run, shape (n_t,); ``at_rest``: gives the states of the ideal mechanism where its
    forces balance, shape (n, 13 n_bodies); None where the mechanism is not at rest.
    """
    ideal, notes = _at_the_same_place(assembly, outputs, path, moved, at_rest)
    real = [output.components(motion) for output in outputs]
    pairs = list(zip(outputs, real, ideal, strict=True))
    return {
        "output_value": np.stack([output.value(found) for output, found, _ in pairs], axis=1),
        "output_ideal": np.stack([output.value(at_ideal) for output, _, at_ideal in pairs], axis=1),
        "output_error": np.stack([output.error(*both) for output, *both in pairs], axis=1),
    }, tuple(notes)


def _at_the_same_place(
    assembly: Assembly,
    outputs: Sequence[Output],
    path: DrivePath,
    moved: Callable[[str], FloatArray],
    at_rest: Callable[[], FloatArray] | None,
) -> tuple[list[FloatArray], list[str]]:
    """Return ideal outputs, those left free where joints are as they were in the run, and notes."""
    ideal = ideal_outputs(assembly, outputs, path)
    components, free, notes = list(ideal.components), list(ideal.free), list(ideal.notes)
    for joints, led, numbers in led_along(assembly, outputs, path, moved):
        if not joints:
            continue
        anew = ideal_outputs(led, [outputs[number] for number in numbers], path)
        settled = [k for k, is_free in enumerate(anew.free) if not is_free]
        for k in settled:
            components[numbers[k]], free[numbers[k]] = anew.components[k], False
            name, places = outputs[numbers[k]].name, " and ".join(joints)
            notes.append(f"the error of output {name} is that at the same place of {places}")
        notes += anew.notes if settled else ()
    if any(free) and at_rest is not None and not assembly.strain:
        motion = motion_of(at_rest())
        for number in np.flatnonzero(free).tolist():
            found = outputs[number].components(motion)
            components[number] = np.full((path.times.size, found.shape[1]), np.nan)
            components[number][: len(found)], free[number] = found, False
            notes.append(f"the error of output {outputs[number].name} is that against rest in ideal joints")
    left = [
        f"output {output.name} depends on a freedom that drives and ideal joints leave: it has no ideal "
        "value and no error"
        for output, is_free in zip(outputs, free, strict=True)
        if is_free
    ]
    return components, left + notes


def led_along(
    assembly: Assembly, outputs: Sequence[Output], path: DrivePath, moved: Callable[[str], FloatArray]
) -> Iterator[tuple[tuple[str, ...], Assembly, list[int]]]:
    """Yield joints, a mechanism in which they are driven as they moved, and the numbers of its outputs.

    Outputs that follow the drives alone come with no joint.
    """
    follows = not assembly.strain and math.isinf(path.turn) and path.times.size > 1
    pushed = tuple(assembly.model.case.pushed) if follows else ()
    pushed = pushed if pushed and IdealMechanism(assembly).freedoms else ()
    found: dict[tuple[str, ...], list[int]] = {}
    for number, output in enumerate(outputs):
        joints = (output.keys.follows,) if follows and output.keys.follows else pushed
        found.setdefault(joints, []).append(number)
    for joints, numbers in found.items():
        yield joints, _driven_as(assembly, path.times, {joint: moved(joint) for joint in joints}), numbers


def _driven_as(assembly: Assembly, times: FloatArray, joints: Mapping[str, FloatArray]) -> Assembly:
    """Return a mechanism in which joints are driven as they moved."""
    if not joints:
        return assembly
    case = assembly.model.case
    drives = {name: drive for name, drive in case.drives.items() if drive.joint not in joints}
    at, first = np.unique(times, return_index=True)
    for joint, moved in joints.items():
        turns = "angle" in case.joints[joint].kind.COORDINATES
        table = {"times": tuple(at.tolist()), "values": tuple(moved[first].tolist())}
        given = {"angle": AngleSignal(**table)} if turns else {"position": PositionSignal(**table)}
        drives[f"as {joint} moved"] = DriveKeys(joint=joint, **given)
    model = replace(assembly.model, case=case.model_copy(update={"drives": drives}))
    return replace(assembly, model=model)


class IdealMechanism:
    """The ideal counterpart of a mechanism, which is led through given times.

    ``play``: whether backlash of elements remains.

    Attributes
    ----------
    system
        With the bodies where they were led last.
    rank
        Number of its independent constraints.
    """

    def __init__(self, assembly: Assembly, *, play: bool = False) -> None:
        counterpart = assembly.model.counterpart
        self.system = placed(System(counterpart if play else counterpart.without_play), assembly)
        self.rank = self.system.independence()[0]
        self.system.set_rank(self.rank)

    @property
    def freedoms(self) -> int:
        """Number of degrees of freedom that drives leave."""
        return 6 * self.system.n - self.rank

    def follow(self, times: FloatArray) -> FloatArray:
        """Return the states at rising times [s], as far as the joints close, shape (n, 13 n_bodies).

        Angular velocities are in global axes.
        """
        system, n_rows = self.system, len(self.system.rows)
        states, matrix = np.zeros((times.size, N_STATES * system.n)), np.zeros((n_rows, n_rows))
        k, led = system.follow(times, 0, matrix, states), -1
        while led < k < times.size and self._over(times, k, states):
            k, led = system.follow(times, k, matrix, states), k
        return states[:k]

    def leaves_free(self, outputs: Sequence[Output], times: FloatArray, states: FloatArray) -> list[bool]:
        """Return the outputs that drives leave free, tried at some of the positions that were reached."""
        tried = np.unique(np.linspace(0, max(len(states) - 1, 0), _PLACES).astype(int))
        free = np.zeros(len(outputs), dtype=bool)
        for i in tried[tried < len(states)]:
            self.put(times[i], states[i])
            free |= self._free(outputs)
            if i == tried[0]:
                free |= self._free_beside(outputs)
        return free.tolist()

    def put(self, t: float, state: FloatArray) -> None:
        """Put the bodies into a state at a time [s]."""
        place(state, self.system.now.bodies)
        self.system.at(float(t))

    def _over(self, times: FloatArray, k: int, states: FloatArray) -> bool:
        """Lead the bodies to a time that they cannot reach at once; return whether joints close there."""
        if k > 0:
            self.put(times[k - 1], states[k - 1])
        return lead(self.system, float(times[k]), lambda: closes(self.system)) and closes(self.system)

    def _free(self, outputs: Sequence[Output]) -> NDArray[np.bool_]:
        """Return the outputs that change along a freedom here, each tried in both directions."""
        system, found = self.system, np.zeros(len(outputs), dtype=bool)
        scales = np.array([1.0 if output.as_place().unit == "rad" else system.size for output in outputs])
        kept = system.position()
        for way in self._ways():
            ends = []
            for side in (1.0, -1.0):
                system.step(side * _STEP * way)
                collect(system.now.bodies, state := np.zeros(N_STATES * system.n))
                ends.append([output.as_place().components(motion_of(state[None])) for output in outputs])
                system.restore(kept)
            changes = [np.max(np.abs(a - b)) / (2.0 * _STEP) for a, b in zip(*ends, strict=True)]
            found |= np.array(changes) > DEPENDENT * scales
        return found

    def _free_beside(self, outputs: Sequence[Output]) -> NDArray[np.bool_]:
        """Return the outputs that change along a freedom some way off: at a dead centre none does here."""
        found, kept = np.zeros(len(outputs), dtype=bool), self.system.position()
        for way in self._ways():
            self.system.step(_AWAY * way)
            if self.system.close() < CLOSES:
                found |= self._free(outputs)
            self.system.restore(kept)
        return found

    def _ways(self) -> FloatArray:
        """Return the freedoms as changes of the bodies, shape (n, 6 n_bodies)."""
        system = self.system
        return np.tile(np.repeat([system.size, 1.0], 3), system.n) * system.freedoms(self.rank)


def motion_of(states: FloatArray, forward: FloatArray | float = 1.0) -> Motion:
    """Return states as a motion.

    ``states``: of the bodies, angular velocities in global axes, shape (n_t, 13 n_bodies); ``forward``:
    direction of the motion, 1 or −1, shape (n_t,) or one number.
    """
    parts = states.reshape(len(states), states.shape[1] // N_STATES, N_STATES)
    sign = np.broadcast_to(forward, len(states))[:, None, None]
    position, orientation, velocity, spin = np.split(parts, [ORIENTATION, VELOCITY, TURNING], axis=2)
    return Motion(position, orientation, sign * velocity, sign * spin)


def in_body_axes(states: FloatArray) -> FloatArray:
    """Return states whose angular velocities are in global axes as problems have them: in those of bodies."""
    return _turned(states, inverse=True)


def in_global_axes(states: FloatArray) -> FloatArray:
    """Return states of problems with angular velocities in global axes."""
    return _turned(states, inverse=False)


def _turned(states: FloatArray, *, inverse: bool) -> FloatArray:
    found = states.reshape(-1, N_STATES).copy()
    turn = rotations(found[:, ORIENTATION:VELOCITY])
    found[:, TURNING:] = turn.apply(found[:, TURNING:], inverse=inverse)
    return np.asarray(found.reshape(states.shape))


def unreached(times: FloatArray, states: FloatArray) -> str:
    """Return after which time joints do not close, in words."""
    return f"ideal joints cannot follow the drives after t = {times[max(len(states) - 1, 0)]:.4g} s"
