"""Derivatives of the wrench of a bushing by the compiled Jacobian."""

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.joints.bushing import new_memory, pose_at
from tribodyn.kernels.joints.bushing import BushingData, wrench_and_jacobian
from tribodyn.kernels.joints.pose import from_jacobian


def joint_jacobian(
    data: BushingData,
    y: FloatArray,
    *,
    omega: float = 0.0,
    sign: float = 1.0,
    entry_velocity: FloatArray | None = None,
) -> FloatArray:
    """Return the derivative of the wrench of a bushing in the eight states and ω_v, shape (5, 9)."""
    memory, out = new_memory(data, entry_velocity), np.empty((5, 9))
    scratch = memory.scratch
    wrench_and_jacobian(data, memory, pose_at(y, omega=omega, sign=sign), scratch.wrench, scratch.jacobian)
    from_jacobian(scratch.jacobian, out)
    return out
