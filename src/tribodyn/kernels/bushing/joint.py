"""The kernels of the bushing joint, whatever its contact: over the surface, or at a point of each end.

Mechanisms call these; the arguments are documented where the work is done.
"""

from __future__ import annotations

from tribodyn.core.arrays import FloatArray
from tribodyn.kernels.arrays import clear
from tribodyn.kernels.bushing import memory, point
from tribodyn.kernels.bushing import report as surface_report
from tribodyn.kernels.bushing import wrench as surface
from tribodyn.kernels.bushing.data import BushingData
from tribodyn.kernels.jit import inlined


@inlined
def wrench(
    joint: BushingData,
    entry_velocity: FloatArray,
    y: FloatArray,
    omega: float,
    sign: float,
    out: FloatArray,
) -> None:
    """Fill ``out`` (5,) with the wrench on the trunnion."""
    if joint.point > 0.0:
        point.wrench(joint, entry_velocity, y, omega, sign, out)
    else:
        surface.wrench(joint, entry_velocity, y, omega, sign, out)


@inlined
def wrench_and_jacobian(
    joint: BushingData,
    entry_velocity: FloatArray,
    y: FloatArray,
    omega: float,
    sign: float,
    out: FloatArray,
    jacobian: FloatArray,
    gradient: FloatArray,
) -> None:
    """Fill ``out`` (5,) with the wrench and ``jacobian`` (5, 9) with its derivatives."""
    if joint.point > 0.0:
        point.wrench_and_jacobian(joint, entry_velocity, y, omega, sign, out, jacobian, gradient)
    else:
        surface.wrench_and_jacobian(joint, entry_velocity, y, omega, sign, out, jacobian, gradient)


@inlined
def report(
    joint: BushingData,
    entry_velocity: FloatArray,
    y: FloatArray,
    omega: float,
    sign: float,
    out: FloatArray,
) -> None:
    """Fill ``out`` with the quantities named in ``kernels/bushing/report.py``."""
    if joint.point > 0.0:
        point.report(joint, entry_velocity, y, omega, sign, out)
    else:
        surface_report.report(joint, entry_velocity, y, omega, sign, out)


@inlined
def pressure_field(
    joint: BushingData, entry_velocity: FloatArray, y: FloatArray, pressure: FloatArray
) -> None:
    """Fill ``pressure`` (n_z + 2, n_theta) with the contact pressure [Pa]; a point contact has none."""
    if joint.point > 0.0:
        clear(pressure)
    else:
        memory.pressure_field(joint, entry_velocity, y, pressure)


@inlined
def slide(joint: BushingData, distance: float, load: FloatArray) -> None:
    """Add the pressure of the last report times ``distance`` [m] to ``load`` [N/m]; nothing at a point."""
    if joint.point == 0.0:
        surface_report.slide(joint, distance, load)


@inlined
def stored(joint: BushingData, entry_velocity: FloatArray, y: FloatArray) -> float:
    """Return the stored contact energy [J]."""
    at_a_point = joint.point > 0.0
    return point.stored(joint, y) if at_a_point else surface_report.stored(joint, entry_velocity, y)


@inlined
def update_entry_velocity(
    joint: BushingData, y: FloatArray, entry_velocity: FloatArray, at_start: float
) -> None:
    """Let contact begin and end at the end of an accepted step."""
    if joint.point > 0.0:
        point.update_entry_velocity(joint, y, entry_velocity, at_start)
    else:
        memory.update_entry_velocity(joint, y, entry_velocity, at_start)
