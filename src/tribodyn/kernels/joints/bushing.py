"""A bushing and its trunnion: a surface of ``kernels/joints/surface`` in coordinates of its own.

A pose counts the tilts of the trunnion as angles, and as the source paper has it, friction opposes the slip
around the axis alone, with rates of the tilts for angular velocities, and moments do work on the slope of the
axis. A node lies at −r_j (cos θ, sin θ), so that θ is the direction of the pressure on the trunnion.
"""

from typing import Annotated, Final, NamedTuple

import numpy as np

from mebdf.kernels.elementary import tan
from tribodyn.core.arrays import FloatArray, FloatMatrix
from tribodyn.core.quantities import Record
from tribodyn.kernels.arrays import clear
from tribodyn.kernels.jit import entry, kernel
from tribodyn.kernels.joints.memory import JointMemory
from tribodyn.kernels.joints.pose import PHI, D, Pose, V, W
from tribodyn.kernels.joints.surface import joint as surfaces
from tribodyn.kernels.joints.surface.data import SurfaceData

_JOINT: Final = np.int64(0)  #: Number of the joint; numba would compile for a plain 0 by itself.


class BushingData(NamedTuple):
    """Constants of a bushing."""

    clearance: float  #: Radial clearance c [m], not in the gaps of the nodes.
    z: FloatArray  #: Axial positions of the rows of nodes, both edges included [m], shape (n_z + 2,).
    #: What the gap at the nodes is more than the clearance [m], shape (n_z + 2, n_theta): wear and form.
    wear: FloatMatrix
    surface: SurfaceData  #: The bushing as the only surface of the only joint.

    @property
    def roughness(self) -> float:
        """Combined rms roughness σ [m], for who is not compiled."""
        return float(self.surface.surfaces[0]["roughness"])


@kernel
def _look(joint: BushingData, memory: JointMemory, pose: Record) -> None:
    """Fill tilt and station of the surface."""
    tilt, station = memory.surface.scratch.tilt, memory.surface.scratch.station
    tan_x, tan_y = tan(pose.phi_x), tan(pose.phi_y)
    tilt.phi[0], tilt.phi[1] = tan_x, tan_y
    tilt.rate[0], tilt.rate[1] = (1.0 + tan_x * tan_x) * pose.w_x, (1.0 + tan_y * tan_y) * pose.w_y
    station.d[0], station.d[1] = pose.d_x, pose.d_y
    station.v[0] = station.slip[0] = pose.v_x
    station.v[1] = station.slip[1] = pose.v_y
    station.w[0], station.w[1], station.w[2] = tilt.rate[0], tilt.rate[1], pose.w_z
    station.opening, station.v_opening = joint.clearance + pose.opening, pose.v_opening
    station.direction = pose.direction


@entry
def wrench(joint: BushingData, memory: JointMemory, pose: Annotated[Record, Pose], out: FloatArray) -> None:
    """Fill ``out`` (6,) with the wrench on the trunnion [N, N m]; only the scratch of the memory changes."""
    scratch = memory.surface.scratch
    _look(joint, memory, pose)
    surfaces.fill_wrench(joint.surface, _JOINT, memory.surface)
    for k in range(6):
        out[k] = scratch.normal[k] + scratch.friction[k]


@entry
def wrench_and_jacobian(
    joint: BushingData,
    memory: JointMemory,
    pose: Annotated[Record, Pose],
    out: FloatArray,
    jacobian: FloatMatrix,
) -> None:
    """Fill ``out`` with the wrench and ``jacobian`` (6, 12) with its derivatives."""
    scratch = memory.surface.scratch
    _look(joint, memory, pose)
    surfaces.fill_wrench_and_derivatives(joint.surface, _JOINT, memory.surface)
    clear(jacobian)
    phi, w = scratch.tilt.phi, (pose.w_x, pose.w_y)
    for i in range(6):
        out[i] = scratch.normal[i] + scratch.friction[i]
        for k in range(2):
            sec2, turned = 1.0 + phi[k] * phi[k], 3 + k
            rate = scratch.normal_rate[i, turned] + scratch.friction_rate[i, turned]
            rate += scratch.friction_slip[i, turned]
            place = scratch.normal_place[i, turned] + scratch.friction_place[i, turned]
            jacobian[i, D + k] = scratch.normal_place[i, k] + scratch.friction_place[i, k]
            jacobian[i, PHI + k] = sec2 * (place + 2.0 * w[k] * phi[k] * rate)
            jacobian[i, V + k] = scratch.normal_rate[i, k] + scratch.friction_rate[i, k]
            jacobian[i, V + k] += scratch.friction_slip[i, k]
            jacobian[i, W + k] = sec2 * rate
        jacobian[i, W + 2] = scratch.friction_slip[i, 5]


@entry
def report(joint: BushingData, memory: JointMemory, pose: Annotated[Record, Pose]) -> None:
    """Fill the report in ``memory.scratch``, moments right-handed."""
    _look(joint, memory, pose)
    surfaces.fill_report(joint.surface, _JOINT, memory.surface)
    scratch, found, out = memory.surface.scratch, memory.surface.reports[0], memory.scratch.report
    normal, rigid, friction = scratch.normal, scratch.rigid, scratch.friction
    out.F_cx, out.F_cy, out.M_jcx, out.M_jcy = normal[0], normal[1], normal[3], normal[4]
    out.F_kx, out.F_ky, out.M_kx, out.M_ky = rigid[0], rigid[1], rigid[3], rigid[4]
    out.F_fx, out.F_fy, out.M_fx, out.M_fy = friction[0], friction[1], friction[3], friction[4]
    out.M_jf = friction[5]
    out.damping_power, out.friction_power = found.damping_power, found.friction_power
    out.energy_contact, out.p_max = found.energy_contact, found.p_max
    out.separation_min = found.separation_min
    out.tensile_clip_share, out.contact_fraction = found.tensile_clip_share, found.contact_fraction


@kernel
def slide(joint: BushingData, memory: JointMemory, h: float) -> None:
    """Let the trunnion slide for ``h`` [s] as it did at the last report: add to the sliding load."""
    surfaces.slide(joint.surface, memory.surface, _JOINT, h)


@entry
def update_entry_velocity(
    joint: BushingData, memory: JointMemory, pose: Annotated[Record, Pose], at_start: float
) -> None:
    """Let contact begin and end at the end of an accepted step; 1 ``at_start`` of a run, 0 otherwise."""
    _look(joint, memory, pose)
    surfaces.fill_entry_velocity(joint.surface, _JOINT, memory.surface, at_start)


@entry
def pressure_field(
    joint: BushingData, memory: JointMemory, pose: Annotated[Record, Pose], pressure: FloatMatrix
) -> None:
    """Fill ``pressure`` (n_z + 2, n_theta) with the contact pressure P_c [Pa]; points have none."""
    _look(joint, memory, pose)
    surfaces.fill_pressure(joint.surface, _JOINT, memory.surface, pressure.reshape(pressure.size))
