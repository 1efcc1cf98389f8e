"""The kernels of a clearance joint, whatever its surfaces: what mechanisms call.

``j`` counts the clearance joints of a mechanism, ``pose`` is a record as ``tilt`` describes it; of the memory
a kernel changes the scratch, and what it says.
"""

from typing import Annotated

from mebdf.arrays import FloatArray, FloatMatrix
from tribodyn.core.quantities import Record
from tribodyn.kernels.jit import clear, entry, kernel
from tribodyn.kernels.joints.pose import V, W
from tribodyn.kernels.joints.surface import entry as of_node
from tribodyn.kernels.joints.surface import point, ring_entry, ring_jacobian, ring_wrench
from tribodyn.kernels.joints.surface import report as over_surface
from tribodyn.kernels.joints.surface.data import SurfaceData, is_ring
from tribodyn.kernels.joints.surface.jacobian import wrench as surface_wrench
from tribodyn.kernels.joints.surface.jacobian import wrench_and_derivatives
from tribodyn.kernels.joints.surface.memory import (
    RATE,
    SHARE,
    SurfaceMemory,
    add_stiffness,
    add_strain,
    take_over,
    tell_motion,
)
from tribodyn.kernels.joints.surface.station import (
    derivatives_at_origin,
    fill_station,
    friction_at_origin,
    pressure_at_origin,
)
from tribodyn.kernels.joints.surface.tilt import TURN, Pose, fill_derivatives, fill_tilt, moment_of


@kernel
def _look(data: SurfaceData, memory: SurfaceMemory, s: int, j: int, pose: Record) -> None:
    """Fill tilt and station of the scratch for surface ``s`` of joint ``j``."""
    surface, scratch = data.surfaces[s], memory.scratch
    opens, station = surface.opens, scratch.station
    fill_tilt(surface.tilt, pose.rotation, pose.w, scratch.tilt)
    fill_station(surface.slides, pose, scratch.tilt, station)
    station.opening = opens[0] * pose.opening[0] + opens[1] * pose.opening[1]
    station.v_opening = opens[0] * pose.v_opening[0] + opens[1] * pose.v_opening[1]
    if memory.strains[s, RATE] > 0.0:
        add_strain(memory, s, j, pose)


@kernel
def _add_wrench(memory: SurfaceMemory, out: FloatArray) -> None:
    """Add normal and friction of the scratch to ``out`` (6,)."""
    scratch = memory.scratch
    pressure_at_origin(scratch.station, scratch.normal)
    friction_at_origin(scratch.station, scratch.friction)
    for k in range(3):
        out[k] += scratch.normal[k] + scratch.friction[k]
        out[3 + k] += scratch.friction[3 + k]
    moment_of(scratch.tilt, scratch.normal[3:], out[3:])


@kernel
def fill_wrench(data: SurfaceData, s: int, memory: SurfaceMemory) -> None:
    """Fill normal and friction of surface ``s`` in the scratch, whose tilt and station are filled."""
    surface = data.surfaces[s]
    if surface.points > 0.0:
        point.add_points(data, s, memory, memory.scratch.station, 0.0, 0.0)
    elif is_ring(data, surface):
        ring_wrench.wrench(data, surface, memory, memory.scratch.station)
    else:
        surface_wrench(data, surface, memory, memory.scratch.station)


@kernel
def fill_wrench_and_derivatives(data: SurfaceData, s: int, memory: SurfaceMemory) -> None:
    """Fill these with their derivatives."""
    if data.surfaces[s].points > 0.0:
        point.add_points(data, s, memory, memory.scratch.station, 1.0, 0.0)
    elif is_ring(data, data.surfaces[s]):
        ring_jacobian.wrench_and_derivatives(data, data.surfaces[s], memory, memory.scratch.station)
    else:
        wrench_and_derivatives(data, data.surfaces[s], memory, memory.scratch.station)


@kernel
def fill_report(data: SurfaceData, s: int, memory: SurfaceMemory) -> None:
    """Fill the report of surface ``s`` but for its forces, left in the scratch."""
    memory.reports[s] = memory.scratch.blank
    if data.surfaces[s].points > 0.0:
        point.add_points(data, s, memory, memory.scratch.station, 0.0, 1.0)
    else:
        over_surface.report(data, s, memory, memory.scratch.station)
    if memory.strains[s, RATE] > 0.0:
        tell_motion(memory, s, memory.reports[s])
    memory.reports[s].expansion_power -= memory.scratch.station.v_opening * memory.scratch.rigid_load


@kernel
def fill_pressure(data: SurfaceData, s: int, memory: SurfaceMemory, pressure: FloatArray) -> None:
    """Fill the nodes of surface ``s`` in ``pressure`` (n_nodes,) with P_c [Pa]; points have none."""
    surface = data.surfaces[s]
    if surface.points > 0.0:
        for i in range(surface.first_node, surface.last_node):
            pressure[i] = 0.0
    elif is_ring(data, surface):
        ring_entry.pressure_field(data, surface, memory, memory.scratch.station, pressure)
    else:
        of_node.pressure_field(data, surface, memory, memory.scratch.station, pressure)


@kernel
def fill_entry_velocity(data: SurfaceData, s: int, memory: SurfaceMemory, at_start: float) -> None:
    """Let contact of surface ``s`` begin and end."""
    surface = data.surfaces[s]
    if surface.points > 0.0:
        point.update_entry_velocity(data, surface, memory, memory.scratch.station, at_start)
    elif is_ring(data, surface):
        ring_entry.update_entry_velocity(data, surface, memory, memory.scratch.station, at_start)
    else:
        of_node.update_entry_velocity(data, surface, memory, memory.scratch.station, at_start)


@entry
def wrench(
    data: SurfaceData, memory: SurfaceMemory, j: int, pose: Annotated[Record, Pose], out: FloatArray
) -> None:
    """Fill ``out`` (6,) with the wrench on the shaft of joint ``j`` [N, N m]."""
    for k in range(6):
        out[k] = 0.0
    for s in range(data.joints[j], data.joints[j + 1]):
        _look(data, memory, s, j, pose)
        fill_wrench(data, s, memory)
        _add_wrench(memory, out)


@entry
def wrench_and_jacobian(
    data: SurfaceData,
    memory: SurfaceMemory,
    j: int,
    pose: Annotated[Record, Pose],
    out: FloatArray,
    jacobian: FloatMatrix,
) -> None:
    """Fill ``out`` (6,) with the wrench and ``jacobian`` (6, 12) with its derivatives in d, ϑ, v and ω."""
    for k in range(6):
        out[k] = 0.0
    clear(jacobian)
    for s in range(data.joints[j], data.joints[j + 1]):
        surface = data.surfaces[s]
        _look(data, memory, s, j, pose)
        fill_wrench_and_derivatives(data, s, memory)
        if surface.slides > 0.0:
            derivatives_at_origin(memory.scratch, pose)
        _add_wrench(memory, out)
        add_derivatives(surface.tilt, memory.scratch, pose, jacobian)
        if memory.strains[s, RATE] > 0.0:
            add_stiffness(memory.strains[s], memory.scratch, jacobian)


@kernel
def _add_turned(normal: FloatArray, tilt: Record, out: FloatArray) -> None:
    """Add the derivative ``normal`` to ``out``, both (6, 6), its moments turned by Gᵀ."""
    for k in range(6):
        for i in range(3):
            out[i, k] += normal[i, k]
            for m in range(3):
                out[3 + i, k] += tilt.to_rate[m, i] * normal[3 + m, k]


@kernel
def add_derivatives(kind: float, scratch: Record, pose: Record, jacobian: FloatArray) -> None:
    """Carry the derivatives of the scratch to ``jacobian``: dφ = G dϑ and dφ̇ = G dω + (∂φ̇/∂ϑ) dϑ.

    ``kind`` is that of the tilt.
    """
    tilt, slip = scratch.tilt, scratch.friction_slip
    place, rate = scratch.friction_place, scratch.friction_rate
    fill_derivatives(kind, pose.rotation, pose.w, scratch.normal[3:], tilt, jacobian[3:, TURN:V])
    _add_turned(scratch.normal_place, tilt, place)
    _add_turned(scratch.normal_rate, tilt, rate)
    for i in range(6):
        for k in range(3):
            turn = spin = 0.0
            for m in range(3):
                turn += place[i, 3 + m] * tilt.to_rate[m, k] + rate[i, 3 + m] * tilt.rate_turn[m, k]
                spin += rate[i, 3 + m] * tilt.to_rate[m, k]
            jacobian[i, k] += place[i, k]
            jacobian[i, TURN + k] += turn
            jacobian[i, V + k] += rate[i, k] + slip[i, k]
            jacobian[i, W + k] += spin + slip[i, 3 + k]


@kernel
def _fill_parts(memory: SurfaceMemory, out: Record) -> None:
    """Fill the forces and moments of a report from the sums of the scratch."""
    scratch = memory.scratch
    pressure_at_origin(scratch.station, scratch.normal)
    pressure_at_origin(scratch.station, scratch.rigid)
    friction_at_origin(scratch.station, scratch.friction)
    for k in range(3):
        scratch.moment[k] = scratch.rigid_moment[k] = 0.0
    moment_of(scratch.tilt, scratch.normal[3:], scratch.moment)
    moment_of(scratch.tilt, scratch.rigid[3:], scratch.rigid_moment)
    out.F_cx, out.F_cy, out.F_cz = scratch.normal[0], scratch.normal[1], scratch.normal[2]
    out.M_cx, out.M_cy, out.M_cz = scratch.moment[0], scratch.moment[1], scratch.moment[2]
    out.F_kx, out.F_ky, out.F_kz = scratch.rigid[0], scratch.rigid[1], scratch.rigid[2]
    out.M_kx, out.M_ky, out.M_kz = scratch.rigid_moment[0], scratch.rigid_moment[1], scratch.rigid_moment[2]
    out.F_fx, out.F_fy, out.F_fz = scratch.friction[0], scratch.friction[1], scratch.friction[2]
    out.M_fx, out.M_fy, out.M_fz = scratch.friction[3], scratch.friction[4], scratch.friction[5]


@kernel
def add_reported(report: Record, out: FloatArray) -> None:
    """Add the wrench that a report tells to ``out`` (6,)."""
    out[0] += report.F_cx + report.F_fx
    out[1] += report.F_cy + report.F_fy
    out[2] += report.F_cz + report.F_fz
    out[3] += report.M_cx + report.M_fx
    out[4] += report.M_cy + report.M_fy
    out[5] += report.M_cz + report.M_fz


@entry
def report(data: SurfaceData, memory: SurfaceMemory, j: int, pose: Annotated[Record, Pose]) -> None:
    """Fill the reports of the surfaces of joint ``j``."""
    for s in range(data.joints[j], data.joints[j + 1]):
        _look(data, memory, s, j, pose)
        fill_report(data, s, memory)
        _fill_parts(memory, memory.reports[s])


@entry
def slide(data: SurfaceData, memory: SurfaceMemory, j: int, h: float) -> None:
    """Add the sliding in ``h`` [s], as at the last report, to the sliding load."""
    for s in range(data.joints[j], data.joints[j + 1]):
        over_surface.slide(data, s, memory, h * memory.strains[s, SHARE])


@entry
def pressure_field(
    data: SurfaceData, memory: SurfaceMemory, j: int, pose: Annotated[Record, Pose], pressure: FloatArray
) -> None:
    """Fill the nodes of joint ``j`` in ``pressure`` (n_nodes,) with P_c [Pa]; points have none."""
    for s in range(data.joints[j], data.joints[j + 1]):
        _look(data, memory, s, j, pose)
        fill_pressure(data, s, memory, pressure)


@entry
def update_entry_velocity(
    data: SurfaceData, memory: SurfaceMemory, j: int, pose: Annotated[Record, Pose], at_start: float
) -> None:
    """Let contact of joint ``j`` begin and end at the end of an accepted step."""
    for s in range(data.joints[j], data.joints[j + 1]):
        _look(data, memory, s, j, pose)
        fill_entry_velocity(data, s, memory, at_start)
    take_over(data, memory, j, pose)
