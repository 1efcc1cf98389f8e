"""Motion of the ideal counterpart of a mechanism: every joint ideal, the same drives.

Drives and joints determine it without forces, position by position. Where they leave freedoms, an output
may depend on these; then there is no ideal value that it could be compared with.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from tribodyn.core.arrays import FloatArray
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
        f"output {output.name} depends on a freedom that drives and ideal joints leave: it has no ideal value "
        "and no error"
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
        system = self.system
        with_speeds = any(output.keys.quantity == "velocity" for output in self.outputs)
        # At rest, the rates of the constraints are those of the drives alone.
        system.now.bodies.v[:], system.now.bodies.w[:] = 0.0, 0.0
        system.at(float(times[0]))
        tried = set(np.linspace(0, times.size - 1, _PLACES).astype(int).tolist())
        free, poses = np.zeros(len(self.outputs), dtype=bool), []
        for k, t in enumerate(times.tolist()):
            if not lead(system, t, lambda: closes(system)):
                break
            if k in tried:
                free |= self._free()
            poses.append(self._pose(with_speeds))
        return _joined(poses, system.n), free.tolist()

    def _pose(self, with_speeds: bool) -> tuple[FloatArray, ...]:
        bodies = self.system.now.bodies[:-1]
        if not with_speeds:
            still = np.zeros_like(bodies.r)
            return bodies.r.copy(), bodies.p.copy(), still, still
        g, root, length = self.system.scaled()
        inverse = self.system.inverse(g, self.system.matrix())
        speeds = (root @ (inverse @ (-self.system.entries("rate") / length))).reshape(-1, 6)
        return bodies.r.copy(), bodies.p.copy(), speeds[:, :3], np.einsum("nij,nj->ni", bodies.A, speeds[:, 3:])

    def _free(self) -> np.ndarray[tuple[int], np.dtype[np.bool_]]:
        """Return which outputs change along a freedom that is left, each tried both ways."""
        system = self.system
        units = np.tile(np.repeat([system.size, 1.0], 3), system.n)
        rows = system.over_sizes(system.matrix()) if system.rows else np.zeros((0, 6 * system.n))
        freedoms = np.linalg.svd(rows)[2][self.rank :] if system.rows else np.eye(6 * system.n)
        kept, found = system.position(), np.zeros(len(self.outputs), dtype=bool)
        for freedom in freedoms:
            ends = []
            for side in (1.0, -1.0):
                system.step(side * _STEP * units * freedom)
                motion = _joined([self._pose(False)], system.n)
                ends.append([_place(output, motion) for output in self.outputs])
                system.restore(kept)
            changes = [np.max(np.abs(a - b)) / (2.0 * _STEP) for a, b in zip(*ends, strict=True)]
            scales = [1.0 if output.unit == "rad" else system.size for output in self.outputs]
            found |= np.array(changes) > DEPENDENT * np.array(scales)
        return found


def _place(output: Output, motion: Motion) -> FloatArray:
    """Return the components of an output, of a velocity those of the place whose rate it is."""
    return output.as_place().components(motion)


def _joined(poses: Sequence[tuple[FloatArray, ...]], n: int) -> Motion:
    """Return poses one after the other as a motion."""
    if not poses:
        return Motion(np.zeros((0, n, 3)), np.zeros((0, n, 4)), np.zeros((0, n, 3)), np.zeros((0, n, 3)))
    return Motion(*(np.stack(parts) for parts in zip(*poses, strict=True)))
