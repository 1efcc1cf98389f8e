"""Memory of a bushing: where contact began, how it slid, its extremes; and its work arrays."""

from typing import Annotated, Final, NamedTuple

from mebdf.arrays import FloatArray, FloatMatrix
from mebdf.kernels.elementary import hypot
from tribodyn.core.quantities import Record, record_type
from tribodyn.kernels.jit import kernel, new_record
from tribodyn.kernels.joints.pose import N_MOTION, N_WRENCH, Pose
from tribodyn.kernels.joints.quantities import Extremes, Report
from tribodyn.kernels.joints.surface.data import SurfaceData
from tribodyn.kernels.joints.surface.memory import SurfaceMemory
from tribodyn.kernels.joints.surface.memory import new_memory as new_surface_memory

#: Work of one evaluation; nothing is carried from one evaluation to the next.
Scratch: Final = record_type(
    ("pose", Pose),
    ("wrench", "f8", (N_WRENCH,)),
    ("jacobian", "f8", (N_WRENCH, N_MOTION)),
    ("report", Report),
)


class JointMemory(NamedTuple):
    """The memory of a bushing."""

    surface: SurfaceMemory  #: That of its surface.
    #: Its fields over the nodes, shape (n_z + 2, n_theta).
    entry_velocity: FloatMatrix
    sliding_load: FloatMatrix
    extremes: Annotated[Record, Extremes]  #: Over all accepted steps, see ``kernels/joints/quantities.py``.
    scratch: Annotated[Record, Scratch]  #: See :data:`Scratch`.


def new_memory(data: SurfaceData, field_shape: tuple[int, ...], clearance: float) -> JointMemory:
    """Return the memory of a joint that never touched, whose gaps are at most ``clearance`` [m]."""
    surface, extremes = new_surface_memory(data), new_record(Extremes)
    extremes.separation_least = clearance
    return JointMemory(
        surface,
        surface.entry_velocity.reshape(field_shape),
        surface.sliding_load.reshape(field_shape),
        extremes,
        new_record(Scratch),
    )


@kernel
def note_extremes(memory: JointMemory, h: float) -> None:
    """Note the report of an instant, the end of a part of an accepted step of length ``h`` [s]."""
    extremes, report = memory.extremes, memory.scratch.report
    extremes.separation_least = min(extremes.separation_least, report.separation_min)
    extremes.tensile_clip_time += h * report.tensile_clip_share


@kernel
def fill_watched(report: Record, y: FloatArray, watched: Record) -> None:
    """Fill the sizes whose peaks are kept from the report at a state ``y`` (8,)."""
    watched.contact_force = hypot(report.F_cx, report.F_cy)
    watched.rigid_force = hypot(report.F_kx, report.F_ky)
    watched.damping_force = hypot(report.F_cx - report.F_kx, report.F_cy - report.F_ky)
    watched.pressure = report.p_max
    watched.eccentricity = hypot(y[0], y[1])
    watched.tilt = hypot(y[2], y[3])
