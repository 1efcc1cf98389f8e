"""Joints whose model no longer holds: looked for at the end of every accepted step."""

from typing import Final

from mebdf.kernels.elementary import hypot
from tribodyn.core.arrays import FloatArray
from tribodyn.core.quantities import Record
from tribodyn.kernels.jit import kernel
from tribodyn.kernels.joints.surface.data import SurfaceData
from tribodyn.kernels.joints.surface.memory import SurfaceMemory
from tribodyn.kernels.mechanism.data import (
    CONTACT,
    COORDINATE,
    DISTANCE,
    INTACT,
    LEFT,
    OPENED,
    OVERLAPPED,
    POINT,
    POSITION,
    MechanismData,
    MechanismMemory,
)

OPEN: Final = 1.0e-6
"""Residual of an ideal joint, in units of the mechanism's size or in radians, that is not rounding."""


@kernel
def watch(data: MechanismData, memory: MechanismMemory) -> None:
    """Note the first joint whose model does not hold where ``advance`` has left the mechanism."""
    course, size = memory.now.course, data.parts.constants.size
    for k in range(data.parts.couplings.size):
        if course.broken != INTACT:
            return
        coupling, now = data.parts.couplings[k], memory.now.couplings[k]
        for m in range(coupling.n_rows):
            is_length = coupling.row_kind[m] in (POINT, POSITION, COORDINATE, DISTANCE)
            if not abs(now.residual[m]) <= OPEN * (size if is_length else 1.0):
                course.broken, course.broken_at = OPENED, k
        if coupling.force == CONTACT:
            _watch_surfaces(data.contact, memory.contact, coupling.contact, now.pose.d, course)


@kernel
def _watch_surfaces(
    joints: SurfaceData, memory: SurfaceMemory, j: int, d: FloatArray, course: Record
) -> None:
    """Note the first surface of a joint that is beyond its contact law, or whose shaft has left it."""
    for s in range(joints.joints[j], joints.joints[j + 1]):
        surface = joints.surfaces[s]
        if memory.reports[s].separation_min < surface.deepest:
            course.broken, course.broken_at = OVERLAPPED, s
            return
        if hypot(d[0], d[1]) > surface.reach[0] or abs(d[2]) > surface.reach[1]:
            course.broken, course.broken_at = LEFT, s
            return
