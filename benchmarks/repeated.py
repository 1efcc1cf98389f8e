"""Kernels called many times from compiled code."""

from __future__ import annotations

from tribodyn.core.arrays import FloatArray
from tribodyn.kernels.bushing.data import BushingData
from tribodyn.kernels.bushing.wrench import wrench, wrench_and_jacobian
from tribodyn.kernels.jit import kernel


@kernel
def many_wrenches(
    joint: BushingData, entry: FloatArray, y: FloatArray, omega: float, out: FloatArray, calls: int
) -> None:
    """Call ``wrench`` ``calls`` times."""
    for _ in range(calls):
        wrench(joint, entry, y, omega, 1.0, out)


@kernel
def many_jacobians(
    joint: BushingData,
    entry: FloatArray,
    y: FloatArray,
    omega: float,
    out: FloatArray,
    jacobian: FloatArray,
    gradient: FloatArray,
    calls: int,
) -> None:
    """Call ``wrench_and_jacobian`` ``calls`` times."""
    for _ in range(calls):
        wrench_and_jacobian(joint, entry, y, omega, 1.0, out, jacobian, gradient)
