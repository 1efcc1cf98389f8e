"""Motion of the ideal counterpart of a mechanism: every joint ideal, the same drives.

Drives and joints determine it without forces, position by position. Where they leave freedoms, an output
may depend on these; then there is no ideal value that it could be compared with.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from tribodyn.core.arrays import FloatArray
from tribodyn.kernels.mechanism.bodies import collect, place
from tribodyn.kernels.mechanism.data import N_STATES, ORIENTATION, TURNING, VELOCITY
from tribodyn.mechanisms.general.assembly import Assembly
from tribodyn.mechanisms.general.closing import DEPENDENT, System
from tribodyn.mechanisms.general.cycle import closes, lead, placed
from tribodyn.mechanisms.general.outputs import Motion, Output

_STEP: Final = 1.0e-4
"""Displacement along a freedom by which outputs are tried, in units of the size or radians."""
_PLACES: Final = 5
"""Number of times at which they are tried."""


@dataclass(frozen=True)
class IdealOutputs:
    """Outputs of the ideal counterpart.

    Attributes
    ----------
    components
        Of each output, shape (n_t, m) each; NaN where drives do not determine it.
    notes
        Why an output has no ideal value, in words.
    """

    components: tuple[FloatArray, ...]
    notes: tuple[str, ...]


def ideal_outputs(assembly: Assembly, outputs: Sequence[Output], times: FloatArray) -> IdealOutputs:
    """Return the outputs as they are with ideal joints.

    Parameters
    ----------
    assembly
        The mechanism, without findings.
    outputs
        To be evaluated.
    times
        Rising, from 0 [s], shape (n_t,).
    """
    unknown = np.full((times.size, 1), np.nan)
    if assembly.strain:
        reason = "ideal joints cannot follow the drives, so outputs have no ideal value and no error"
        return IdealOutputs((unknown,) * len(outputs), (reason,))
    system = placed(System(assembly.model.counterpart), assembly)
    rank = system.independence()[0]
    system.set_rank(rank)
    follower = _Follower(system, outputs, rank)
    motion, free = follower.follow(times)
    reached = motion.position.shape[0]
    found = []
    for output, is_free in zip(outputs, free, strict=True):
        components = unknown.copy() if is_free else output.components(motion)
        rest = np.full((times.size - len(components), components.shape[1]), np.nan)
        found.append(np.concatenate([components, rest]))
    notes = [
        f"output {output.name} depends on a freedom that drives and ideal joints leave: it has no ideal "
        "value and no error"
        for output, is_free in zip(outputs, free, strict=True)
        if is_free
    ]
    if reached < times.size:
        notes.append(f"ideal joints cannot follow the drives after t = {times[max(reached - 1, 0)]:.4g} s")
    return IdealOutputs(tuple(found), tuple(notes))


def compared(
    assembly: Assembly, outputs: Sequence[Output], times: FloatArray, motion: Motion
) -> tuple[dict[str, FloatArray], tuple[str, ...]]:
    """Return the columns of outputs, each of shape (n_t, n_outputs), and notes.

    Parameters
    ----------
    assembly
        The mechanism, without findings.
    outputs
        At least one.
    times
        Of the motion, from 0 [s], shape (n_t,).
    motion
        Of the mechanism with clearance.
    """
    ideal = ideal_outputs(assembly, outputs, times)
    real = [output.components(motion) for output in outputs]
    pairs = list(zip(outputs, real, ideal.components, strict=True))
    return {
        "output_value": np.stack([output.value(found) for output, found, _ in pairs], axis=1),
        "output_ideal": np.stack([output.value(at_ideal) for output, _, at_ideal in pairs], axis=1),
        "output_error": np.stack([output.error(*both) for output, *both in pairs], axis=1),
    }, ideal.notes


@dataclass
class _Follower:
    """The ideal mechanism that is led through given times."""

    system: System
    outputs: Sequence[Output]
    rank: int

    def follow(self, times: FloatArray) -> tuple[Motion, list[bool]]:
        """Return the motion as far as the joints close, and which outputs drives leave free."""
        system, n_rows = self.system, len(self.system.rows)
        states, matrix = np.zeros((times.size, N_STATES * system.n)), np.zeros((n_rows, n_rows))
        k, led = system.follow(times, 0, matrix, states), -1
        while led < k < times.size and self._over(times, k, states):
            k, led = system.follow(times, k, matrix, states), k
        tried = np.unique(np.linspace(0, max(k - 1, 0), _PLACES).astype(int))
        free = np.any([self._free(times[i], states[i]) for i in tried if i < k], axis=0)
        return _motion(states[:k]), np.broadcast_to(free, len(self.outputs)).tolist()

    def _over(self, times: FloatArray, k: int, states: FloatArray) -> bool:
        """Lead the bodies to a time that they cannot reach at once; return whether joints close there."""
        if k > 0:
            self._put(times[k - 1], states[k - 1])
        return lead(self.system, float(times[k]), lambda: closes(self.system)) and closes(self.system)

    def _put(self, t: float, state: FloatArray) -> None:
        place(state, self.system.now.bodies)
        self.system.at(float(t))

    def _free(self, t: float, state: FloatArray) -> NDArray[np.bool_]:
        """Return which outputs change along a freedom that is left, each tried both ways."""
        self._put(t, state)
        system, found = self.system, np.zeros(len(self.outputs), dtype=bool)
        units = np.tile(np.repeat([system.size, 1.0], 3), system.n)
        scales = np.array([1.0 if output.unit == "rad" else system.size for output in self.outputs])
        kept = system.position()
        for freedom in system.freedoms(self.rank):
            ends = []
            for side in (1.0, -1.0):
                system.step(side * _STEP * units * freedom)
                collect(system.now.bodies, state := np.zeros_like(state))
                ends.append([output.as_place().components(_motion(state[None])) for output in self.outputs])
                system.restore(kept)
            changes = [np.max(np.abs(a - b)) / (2.0 * _STEP) for a, b in zip(*ends, strict=True)]
            found |= np.array(changes) > DEPENDENT * scales
        return found


def _motion(states: FloatArray) -> Motion:
    """Return states of shape (n_t, 13 n_bodies), angular velocities in global axes, as a motion."""
    parts = states.reshape(len(states), -1, N_STATES)
    return Motion(*np.split(parts, [ORIENTATION, VELOCITY, TURNING], axis=2))
