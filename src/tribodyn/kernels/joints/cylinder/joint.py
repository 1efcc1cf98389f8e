"""The kernels of the bushing joint, whatever its contact: over the surface, or at a point of each end.

Mechanisms call these; the arguments are documented where the work is done.
"""

from __future__ import annotations

from tribodyn.core.arrays import FloatArray
from tribodyn.core.quantities import Record
from tribodyn.kernels.arrays import clear
from tribodyn.kernels.jit import inlined
from tribodyn.kernels.joints.cylinder import entry_velocity, point
from tribodyn.kernels.joints.cylinder import report as surface_report
from tribodyn.kernels.joints.cylinder import wrench as surface
from tribodyn.kernels.joints.cylinder.data import BushingData
from tribodyn.kernels.joints.memory import JointMemory


@inlined
def wrench(joint: BushingData, memory: JointMemory, pose: Record, out: FloatArray) -> None:
    """Fill ``out`` (6,) with the wrench on the trunnion."""
    if joint.point > 0.0:
        point.wrench(joint, memory, pose, out)
    else:
        surface.wrench(joint, memory, pose, out)


@inlined
def wrench_and_jacobian(
    joint: BushingData, memory: JointMemory, pose: Record, out: FloatArray, jacobian: FloatArray
) -> None:
    """Fill ``out`` (6,) with the wrench and ``jacobian`` (6, 12) with its derivatives."""
    if joint.point > 0.0:
        point.wrench_and_jacobian(joint, memory, pose, out, jacobian)
    else:
        surface.wrench_and_jacobian(joint, memory, pose, out, jacobian)


@inlined
def report(joint: BushingData, memory: JointMemory, pose: Record) -> None:
    """Fill the report of ``memory.scratch``."""
    if joint.point > 0.0:
        point.report(joint, memory, pose)
    else:
        surface_report.report(joint, memory, pose)


@inlined
def pressure_field(joint: BushingData, memory: JointMemory, pose: Record, pressure: FloatArray) -> None:
    """Fill ``pressure`` (n_z + 2, n_theta) with the contact pressure [Pa]; a point contact has none."""
    if joint.point > 0.0:
        clear(pressure)
    else:
        entry_velocity.pressure_field(joint, memory, pose, pressure)


@inlined
def slide(joint: BushingData, memory: JointMemory, h: float) -> None:
    """Add what slides in ``h`` [s], as at the last report, to the sliding load; nothing at a point."""
    if joint.point == 0.0:
        surface_report.slide(memory, h)


@inlined
def stored(joint: BushingData, memory: JointMemory, pose: Record) -> float:
    """Return the stored contact energy [J]."""
    at_a_point = joint.point > 0.0
    return point.stored(joint, pose) if at_a_point else surface_report.stored(joint, memory, pose)


@inlined
def squeeze(joint: BushingData, memory: JointMemory, pose: Record) -> float:
    """Return what the rigid part of the contact presses in all [N]: a closing clearance works against it."""
    at_a_point = joint.point > 0.0
    return point.squeeze(joint, pose) if at_a_point else surface_report.squeeze(joint, memory, pose)


@inlined
def update_entry_velocity(joint: BushingData, memory: JointMemory, pose: Record, at_start: float) -> None:
    """Let contact begin and end at the end of an accepted step."""
    if joint.point > 0.0:
        point.update_entry_velocity(joint, memory, pose, at_start)
    else:
        entry_velocity.update_entry_velocity(joint, memory, pose, at_start)
