"""A bushing and its trunnion, and a thrust collar that rests on the rim of its bushing.

A pose counts the tilts of the trunnion as angles, and as the source paper has it, friction opposes the slip
around the axis alone, with rates of the tilts for angular velocities, and moments do work on the slope of the
axis. A node lies at −r_j (cos θ, sin θ), so that θ is the direction of the pressure on the trunnion.

Tilted, it rests on the side to which it leans, at the radius r_t; turning, it rubs there:

    M = N r_t (−φ_x/φ, −φ_y/φ, −s μ),    φ = √(φ_x² + φ_y² + φ_0²),

with the axial force N, which the mechanism knows, and the direction s of the rotation. The corner at φ = 0 is
rounded within φ_0. The collar cannot pull: a mechanism lets it go where N would be negative.
"""

import math
from typing import Annotated, Final, NamedTuple

import numpy as np

from mebdf.arrays import FloatArray, FloatMatrix
from mebdf.kernels.elementary import tan
from tribodyn.core.quantities import Quantity, Record, of_table
from tribodyn.kernels.jit import clear, entry, kernel
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


TILT_FLOOR: Final = 1.0e-6  #: φ_0 [rad].

CONSTANTS: Final = (
    Quantity("radius", "m", "radius r_t of the collar", ()),
    Quantity("friction", "m", "coefficient of friction times that radius", ()),
)
EXTREMES: Final = (Quantity("collar_lift_off_time", "s", "time during which the collar carries nothing", ()),)
Collar: Final = of_table(CONSTANTS)
Extremes: Final = of_table(EXTREMES)


@kernel
def moments(collar: Record, phi_x: float, phi_y: float, direction: float) -> tuple[float, float, float]:
    """Return M_x, M_y and M_z per unit of axial force [m] at a tilt [rad].

    About X and Y the collar answers a tilt with the opposite moment, whatever the hand in which both count.
    """
    tilt = math.sqrt(phi_x * phi_x + phi_y * phi_y + TILT_FLOOR * TILT_FLOOR)
    return -collar.radius * phi_x / tilt, -collar.radius * phi_y / tilt, -direction * collar.friction


@kernel
def stiffness(collar: Record, phi_x: float, phi_y: float, force: float) -> tuple[float, float, float]:
    """Return ∂M_x/∂φ_x, ∂M_y/∂φ_y and ∂M_x/∂φ_y = ∂M_y/∂φ_x [N m/rad] under an axial force [N]."""
    tilt = math.sqrt(phi_x * phi_x + phi_y * phi_y + TILT_FLOOR * TILT_FLOOR)
    load = collar.radius * force
    along_x = -load * (tilt * tilt - phi_x * phi_x) / tilt**3
    along_y = -load * (tilt * tilt - phi_y * phi_y) / tilt**3
    return along_x, along_y, load * phi_x * phi_y / tilt**3


@kernel
def note_lift_off(extremes: Record, h: float, force: float) -> None:
    """Note a part of an accepted step of length ``h`` [s] with the axial force at its end [N]."""
    if force == 0.0:
        extremes.collar_lift_off_time += h
