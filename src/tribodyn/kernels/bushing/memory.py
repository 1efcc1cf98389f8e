"""The memory of the bushing: entry velocities and sliding loads, changed at accepted steps only."""

from __future__ import annotations

import math

from tribodyn.core.arrays import FloatArray
from tribodyn.kernels.arrays import clear
from tribodyn.kernels.bushing.data import BushingData
from tribodyn.kernels.bushing.pressure import node_pressure, reference_velocity
from tribodyn.kernels.bushing.window import contact_window
from tribodyn.kernels.bushing.wrench import row_motion
from tribodyn.kernels.jit import kernel


@kernel
def pressure_field(
    joint: BushingData, entry_velocity: FloatArray, y: FloatArray, pressure: FloatArray
) -> None:
    """Fill ``pressure`` (n_z + 2, n_theta) with the contact pressure P_c [Pa] at all nodes."""
    n_theta = joint.cos_theta.size
    limit = joint.table.h_last * joint.roughness
    tan_x, tan_y = math.tan(y[2]), math.tan(y[3])
    clear(pressure)
    for j in range(joint.z.size):
        a, b, v_a, v_b = row_motion(y, tan_x, tan_y, joint.z[j])
        first, count = contact_window(joint.clearance, a, b, limit, n_theta)
        i = first % n_theta - 1
        for _ in range(count):
            i = i + 1 if i + 1 < n_theta else 0
            c = joint.cos_theta[i]
            s = joint.sin_theta[i]
            gap = joint.clearance + a * c + b * s + joint.wear[j, i]
            if gap < limit:
                _, p, _, _ = node_pressure(
                    joint.table,
                    joint.roughness,
                    joint.minimum_entry_velocity,
                    joint.clip,
                    gap,
                    -(v_a * c + v_b * s),
                    entry_velocity[j, i],
                )
                pressure[j, i] = p


@kernel
def update_entry_velocity(
    joint: BushingData, y: FloatArray, entry_velocity: FloatArray, at_start: float
) -> None:
    """Let nodes enter and leave contact at the end of an accepted step.

    A node below the onset separation without a memory takes max(|δ̇|, v_min); one above the onset
    forgets. Points already in contact at the start of a run take v_min.

    Parameters
    ----------
    joint
        Constants of the joint.
    y
        The eight states, shape (8,).
    entry_velocity
        Memory [m/s], shape (n_z + 2, n_theta), changed in place.
    at_start
        1 at the start of a run, 0 otherwise.
    """
    onset = joint.onset * joint.roughness
    tan_x, tan_y = math.tan(y[2]), math.tan(y[3])
    n_theta = joint.cos_theta.size
    for j in range(joint.z.size):
        a, b, v_a, v_b = row_motion(y, tan_x, tan_y, joint.z[j])
        first, count = contact_window(joint.clearance, a, b, onset, n_theta)
        i = first % n_theta - 1
        for _ in range(count):
            i = i + 1 if i + 1 < n_theta else 0
            c = joint.cos_theta[i]
            s = joint.sin_theta[i]
            gap = joint.clearance + a * c + b * s + joint.wear[j, i]
            if gap >= onset:
                entry_velocity[j, i] = 0.0
            elif entry_velocity[j, i] == 0.0:
                if at_start > 0.0:
                    entry_velocity[j, i] = joint.minimum_entry_velocity
                else:
                    approach = -(v_a * c + v_b * s)
                    entry_velocity[j, i] = reference_velocity(0.0, approach, joint.minimum_entry_velocity)
        for _ in range(count, n_theta):
            i = i + 1 if i + 1 < n_theta else 0
            entry_velocity[j, i] = 0.0
