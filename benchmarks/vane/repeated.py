"""Kernels called many times from compiled code."""

from __future__ import annotations

from mebdf.arrays import FloatArray
from tribodyn.core.quantities import Record
from tribodyn.kernels.jit import kernel
from tribodyn.kernels.joints.bushing import BushingData, wrench, wrench_and_jacobian
from tribodyn.kernels.joints.memory import JointMemory


@kernel
def many_wrenches(joint: BushingData, memory: JointMemory, pose: Record, out: FloatArray, calls: int) -> None:
    """Call ``wrench`` ``calls`` times."""
    for _ in range(calls):
        wrench(joint, memory, pose, out)


@kernel
def many_jacobians(
    joint: BushingData, memory: JointMemory, pose: Record, out: FloatArray, jacobian: FloatArray, calls: int
) -> None:
    """Call ``wrench_and_jacobian`` ``calls`` times."""
    for _ in range(calls):
        wrench_and_jacobian(joint, memory, pose, out, jacobian)
