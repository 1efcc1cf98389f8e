"""The joint integral as sums over NumPy arrays of all nodes: what the kernels are measured against."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
from numpy.typing import NDArray

from tribodyn.joints import BushingJoint

FloatArray = NDArray[np.float64]


def arrays_of(joint: BushingJoint) -> SimpleNamespace:
    """Return the constants of a bushing that is not worn as NumPy takes them."""
    return SimpleNamespace(
        clearance=joint.geometry.clearance,
        journal_radius=joint.geometry.radius,
        z=joint.z,
        cos_theta=np.cos(joint.theta),
        sin_theta=np.sin(joint.theta),
        wear=joint.form_gap,
        area=joint.node_area,
        table=joint.table,
        roughness=joint.roughness,
        friction_coefficient=joint.friction.coefficient,
        slip_velocity=joint.friction.slip_velocity,
        minimum_entry_velocity=joint.entry.minimum_velocity,
        onset=joint.entry.onset,
    )


def gap_and_approach(
    joint: SimpleNamespace, y: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """Return gap [m], approach speed [m/s], and the velocities v_a, v_b of the axis at each row [m/s]."""
    tan_x, tan_y = np.tan(y[2:4])
    z, c, s = joint.z[:, None], joint.cos_theta, joint.sin_theta
    v_a, v_b = y[4] - z * y[7] * (1 + tan_y**2), y[5] - z * y[6] * (1 + tan_x**2)
    w, w_dot = leaning(y, c, s)
    gap = joint.clearance + (y[0] - z * tan_y) * c + (y[1] - z * tan_x) * s + joint.wear
    bulge = joint.journal_radius * w
    return gap - 0.5 * bulge * w, bulge * w_dot - (v_a * c + v_b * s), v_a, v_b


def leaning(y: FloatArray, c: FloatArray, s: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the slope w of the axis along the normal of each column, and its rate [1/s]."""
    tan_x, tan_y = np.tan(y[2:4])
    return -(tan_y * c + tan_x * s), -(y[7] * (1 + tan_y**2) * c + y[6] * (1 + tan_x**2) * s)


def numpy_wrench(
    joint: SimpleNamespace, entry: FloatArray, y: FloatArray, omega: float
) -> tuple[FloatArray, FloatArray]:
    """Return the wrench (5,) with friction as traction, and the normal force (2,) alone."""
    z, c, s = joint.z[:, None], joint.cos_theta, joint.sin_theta
    gap, approach, v_a, v_b = gap_and_approach(joint, y)
    table = joint.table
    place = (gap / joint.roughness - table.h_first) * table.inverse_step + 1.0
    number = np.clip(np.floor(place), 0, table.nodes.shape[0])
    x, first = place - number, 8 * number.astype(np.int64)
    rigid, damping = (
        table.cubics[at] + x * (table.cubics[at + 1] + x * (table.cubics[at + 2] + x * table.cubics[at + 3]))
        for at in (first, first + 4)
    )
    reference = np.where(entry > 0.0, entry, np.maximum(np.abs(approach), joint.minimum_entry_velocity))
    pressure = np.maximum(rigid + damping * approach / reference, 0.0)
    slip = omega * joint.journal_radius + v_a * s - v_b * c
    tau = -joint.friction_coefficient * pressure * slip / np.hypot(slip, joint.slip_velocity)
    area = joint.area[:, None]
    normal = np.array([(area * pressure * c).sum(), (area * pressure * s).sum()])
    p_x, p_y, tau_x, tau_y = area * pressure * c, area * pressure * s, area * tau * s, -area * tau * c
    arm = z - joint.journal_radius * leaning(y, c, s)[0]
    torque = (area * joint.journal_radius * tau).sum()
    m_x, m_y = -(arm * p_y + z * tau_y).sum(), -(arm * p_x + z * tau_x).sum()
    return np.array([(p_x + tau_x).sum(), (p_y + tau_y).sum(), m_x, m_y, torque]), normal


def numpy_update(joint: SimpleNamespace, y: FloatArray, entry: FloatArray) -> None:
    """Let nodes enter and leave contact at the end of an accepted step."""
    gap, approach, _, _ = gap_and_approach(joint, y)
    fresh = np.maximum(np.abs(approach), joint.minimum_entry_velocity)
    entry[:] = np.where(gap < joint.onset * joint.roughness, np.where(entry > 0.0, entry, fresh), 0.0)
