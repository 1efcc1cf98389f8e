"""Entry velocities of the bushing, changed at accepted steps only; and the pressure field."""

from __future__ import annotations

import math

import numpy as np

from tribodyn.core.arrays import FloatArray
from tribodyn.core.quantities import Record
from tribodyn.kernels.arrays import clear
from tribodyn.kernels.jit import inlined, kernel
from tribodyn.kernels.joints.cylinder.data import BushingData
from tribodyn.kernels.joints.cylinder.nodes import lean, least_clearance, row_motion
from tribodyn.kernels.joints.cylinder.window import contact_window
from tribodyn.kernels.joints.memory import JointMemory
from tribodyn.kernels.joints.pressure import node_pressure, reference_velocity


@kernel
def pressure_field(joint: BushingData, memory: JointMemory, pose: Record, pressure: FloatArray) -> None:
    """Fill ``pressure`` (n_z + 2, n_theta) with the contact pressure P_c [Pa] at all nodes."""
    clear(pressure)
    n_theta = joint.cos_theta.size
    limit = joint.table.h_last * joint.roughness
    tan_x, tan_y = math.tan(pose.phi_x), math.tan(pose.phi_y)
    clearance, least, r_j = joint.clearance + pose.opening, least_clearance(joint, pose), joint.journal_radius
    l_a, l_b, v_la, v_lb = lean(pose)
    for j in range(joint.z.size):
        a, b, v_a, v_b = row_motion(pose, tan_x, tan_y, joint.z[j])
        first, count = contact_window(least, a, b, limit, n_theta)
        for k in range(count):
            i = first + k if first + k < n_theta else first + k - n_theta
            c, s = joint.cos_theta[i], joint.sin_theta[i]
            w = l_a * c + l_b * s
            _, pressure[j, i], _, _ = node_pressure(
                joint.table,
                joint.roughness,
                joint.minimum_entry_velocity,
                joint.clip,
                clearance + a * c + b * s - 0.5 * r_j * w * w + joint.wear[j, i],
                r_j * w * (v_la * c + v_lb * s) - (v_a * c + v_b * s + pose.v_opening),
                memory.entry_velocity[j, i],
            )


@inlined
def _update(
    joint: BushingData,
    row: int,
    first: int,
    until: int,
    motion: tuple[float, float, float, float, float, float],
    leaning: tuple[float, float, float, float],
    entry_velocity: FloatArray,
) -> None:
    """Update nodes ``first`` to ``until`` of a row with the given clearance, offset and their velocities."""
    clearance, a, b, v_opening, v_a, v_b = motion
    l_a, l_b, v_la, v_lb = leaning
    r_j = joint.journal_radius
    cos, sin, wear = joint.cos_theta, joint.sin_theta, joint.wear
    onset = joint.onset * joint.roughness
    j = np.uint64(row)
    for i in range(np.uint64(first), np.uint64(until)):
        c, s = cos[i], sin[i]
        w = l_a * c + l_b * s
        gap = clearance + a * c + b * s - 0.5 * r_j * w * w + wear[j, i]
        speed = v_a * c + v_b * s + v_opening - r_j * w * (v_la * c + v_lb * s)
        known = reference_velocity(entry_velocity[j, i], speed, joint.minimum_entry_velocity)
        entry_velocity[j, i] = 0.0 if gap >= onset else known


@inlined
def _forget(row: int, first: int, until: int, entry_velocity: FloatArray) -> None:
    """Clear nodes ``first`` to ``until`` of a row."""
    j = np.uint64(row)
    for i in range(np.uint64(first), np.uint64(until)):
        entry_velocity[j, i] = 0.0


@kernel
def update_entry_velocity(joint: BushingData, memory: JointMemory, pose: Record, at_start: float) -> None:
    """Let nodes enter and leave contact at the end of an accepted step.

    A node below the onset separation without a memory takes max(|δ̇|, v_min); one above the onset
    forgets. Points already in contact at the start of a run take v_min.

    Parameters
    ----------
    joint, memory, pose
        As for ``wrench``; the entry velocities are changed in place.
    at_start
        1 at the start of a run, 0 otherwise.
    """
    entry_velocity = memory.entry_velocity
    onset = joint.onset * joint.roughness
    tan_x, tan_y = math.tan(pose.phi_x), math.tan(pose.phi_y)
    n_theta = joint.cos_theta.size
    heed = 0.0 if at_start > 0.0 else 1.0
    clearance, v_opening = joint.clearance + pose.opening, heed * pose.v_opening
    least, (l_a, l_b, v_la, v_lb) = least_clearance(joint, pose), lean(pose)
    leaning = (l_a, l_b, heed * v_la, heed * v_lb)
    for j in range(joint.z.size):
        a, b, v_a, v_b = row_motion(pose, tan_x, tan_y, joint.z[j])
        first, count = contact_window(least, a, b, onset, n_theta)
        motion = (clearance, a, b, v_opening, heed * v_a, heed * v_b)
        until = min(first + count, n_theta)
        again = first + count - until
        _update(joint, j, first, until, motion, leaning, entry_velocity)
        _update(joint, j, 0, again, motion, leaning, entry_velocity)
        _forget(j, again, first, entry_velocity)
        _forget(j, until, n_theta, entry_velocity)
