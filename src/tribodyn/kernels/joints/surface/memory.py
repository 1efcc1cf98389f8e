"""History variables of clearance joints: begin of contact, sliding, what sticks, peaks; and work arrays.

Friction may hold at rest. Of a shaft whose velocity and angular velocity are V, tractions follow the slip of
V + U/τ. U is what sticks: a displacement and a rotation, with those of the shaft since the last accepted
step. A node at rest then resists with the stiffness μ p/(u_s τ). At accepted steps U becomes the slip of the
contact's middle and the spin about its normal, both bounded; where nothing touches there is none.
"""

import math
from typing import Annotated, Final, NamedTuple

import numpy as np

from tribodyn.core.arrays import FloatArray, FloatMatrix, IntArray, IntMatrix
from tribodyn.core.quantities import Record, record_type
from tribodyn.kernels.arrays import new_record
from tribodyn.kernels.jit import kernel
from tribodyn.kernels.joints.surface.data import SurfaceData
from tribodyn.kernels.joints.surface.listed import Listed
from tribodyn.kernels.joints.surface.pose import Pose
from tribodyn.kernels.joints.surface.quantities import Peaks, Report
from tribodyn.kernels.joints.surface.station import Station
from tribodyn.kernels.joints.surface.tilt import Tilt
from tribodyn.kernels.lanes import WIDTH

BLOCK_GROUPS: Final = 26 * WIDTH  #: Begins of the groups of the block.
COLUMNS: Final = 12  #: Lanes of a group.
N_SUMS: Final = 105  #: Sums over the nodes of a ring for derivatives, see ``ring_slopes``.

SHARE: Final = 6  #: Sliding speed over that of the tractions, at the last report; before it U [m] and [rad].
RATE: Final = 7  #: 1/τ [1/s], 0 without friction at rest.
DEPTH: Final = 8
#: Distance of the nodes from the origin of the shaft along the normal, and as a root of mean squares [m].
LEVER: Final = 9
LARGEST: Final = 10  #: Bound of U [m].
N_STRAIN: Final = 11  #: Numbers of a surface.
KNOWN: Final = 12
#: Numbers of a joint: displacement and rotation of the shaft at the last accepted step, and 1 with one.
N_ANCHOR: Final = 13

Scratch: Final = record_type(
    ("pose", Pose),
    ("tilt", Tilt),
    ("station", Station),
    ("normal", "f8", (6,)),
    ("rigid", "f8", (6,)),
    ("friction", "f8", (6,)),
    *((name, "f8", (6, 6)) for name in ("normal_place", "normal_rate", "friction_place", "friction_rate")),
    ("friction_slip", "f8", (6, 6)),
    ("rigid_load", "f8"),
    ("moment", "f8", (3,)),
    ("rigid_moment", "f8", (3,)),
    ("moving", "f8", (6,)),
    ("strained", "f8", (6,)),
    ("ring_sums", "f8", (WIDTH * WIDTH * N_SUMS,)),
    ("ring_slopes", "f8", (WIDTH * 5 * 36,)),
    ("listed", Listed),
    ("blank", Report),
)
"""Work of one surface; nothing is carried from one evaluation to the next, ``blank`` stays zero.

pose
    For whoever calls.
normal, rigid, friction
    (F, m) of the pressure, of its rigid part, and (F, M) of friction, moments of pressure not yet turned by
    Gᵀ.
rigid_load
    ∫P_k dA of the last report [N]: an opening clearance does its work.
normal_place, normal_rate, friction_place, friction_rate, friction_slip
    Derivatives of normal and friction in (d, φ), (v, φ̇), and (v, ω).
moment, rigid_moment
    Moments of the pressure and of its rigid part, turned.
moving, strained
    Slip and angular velocity of the station without what sticks; U, see above.
"""


class SurfaceMemory(NamedTuple):
    """The memory of all clearance joints of a mechanism."""

    #: δ̇₋ at the nodes [m/s], shape (n_nodes,); 0 where there is no contact. A point contact keeps its own at
    #: the first nodes of its surface.
    entry_velocity: FloatArray
    remembering: FloatArray  #: Whether any node of a row has one, shape (n_rows,).
    sliding_load: FloatArray  #: ∫P_c |s| dt [N/m], shape (n_nodes,).
    #: P_c |s| of the last report [W/m²] at the nodes within reach, each surface from its first node on; of
    #: rings as ``ring_report.first_kept`` says.
    sliding: FloatArray
    #: First group and number of groups of each ring that it belongs to, shape (n_rows, 2).
    reached: IntMatrix
    #: Nodes of patches that it belongs to, shape (n_nodes,), and their number, shape (n_surfaces,).
    touched: IntArray
    n_touched: IntArray
    #: Of each surface, see ``quantities``, shape (n_surfaces,).
    reports: Annotated[Record, Report, 1]
    peaks: Annotated[Record, Peaks, 1]
    #: Of friction that holds at rest, shapes (n_surfaces, ``N_STRAIN``) and (n_joints, ``N_ANCHOR``).
    strains: FloatMatrix
    anchors: FloatMatrix
    #: Four rings and the groups of their nodes, see ``block`` and ``ring``; work, as ``scratch`` is.
    block: FloatArray
    scratch: Annotated[Record, Scratch]  #: See :data:`Scratch`.


def _block_size(rows: Record) -> int:
    return BLOCK_GROUPS + COLUMNS * WIDTH * WIDTH * (int(rows["count"].max(initial=0)) // WIDTH + 1)


def new_memory(data: SurfaceData) -> SurfaceMemory:
    """Return the memory of joints that never touched."""
    n_nodes, n_surfaces = data.nodes.shape[1], data.surfaces.size
    peaks = np.zeros(n_surfaces, dtype=Peaks)
    peaks["separation_least"] = math.inf
    strains = np.zeros((n_surfaces, N_STRAIN))
    strains[:, SHARE] = 1.0
    return SurfaceMemory(
        entry_velocity=np.zeros(n_nodes),
        remembering=np.zeros(data.rows.size),
        sliding_load=np.zeros(n_nodes),
        sliding=np.zeros(n_nodes + (WIDTH - 1) * data.rows.size),
        reached=np.zeros((data.rows.size, 2), dtype=np.int64),
        touched=np.zeros(n_nodes, dtype=np.int64),
        n_touched=np.zeros(n_surfaces, dtype=np.int64),
        reports=np.zeros(n_surfaces, dtype=Report),
        peaks=peaks,
        strains=strains,
        anchors=np.zeros((data.joints.size - 1, N_ANCHOR)),
        block=np.zeros(_block_size(data.rows)),
        scratch=new_record(Scratch),
    )


@kernel
def note_peaks(data: SurfaceData, memory: SurfaceMemory, j: int, t: float, h: float) -> None:
    """Note the reports of joint ``j`` at ``t``, the end of a part of an accepted step of length ``h`` [s]."""
    for s in range(data.joints[j], data.joints[j + 1]):
        peaks, report = memory.peaks[s], memory.reports[s]
        force = math.sqrt(report.F_cx**2 + report.F_cy**2 + report.F_cz**2)
        if force > peaks.contact_force_peak:
            peaks.contact_force_peak, peaks.contact_force_peak_time = force, t
        if report.p_max > peaks.pressure_peak:
            peaks.pressure_peak, peaks.pressure_peak_time = report.p_max, t
        peaks.plastic_share = max(peaks.plastic_share, report.plastic_share)
        peaks.separation_least = min(peaks.separation_least, report.separation_min)
        peaks.tensile_clip_time += h * report.tensile_clip_share


@kernel
def _fill_strained(memory: SurfaceMemory, s: int, j: int, pose: Record, out: FloatArray) -> None:
    """Fill ``out`` (6,) with U of a surface at a pose: the rotation since the anchor is a small one."""
    strain, anchor, turned = memory.strains[s], memory.anchors[j], pose.rotation
    for i in range(6):
        out[i] = strain[i]
    if anchor[KNOWN] == 0.0:
        return
    for i in range(3):
        a, b = (i + 1) % 3, (i + 2) % 3
        out[i] += pose.d[i] - anchor[i]
        for m in range(3):
            out[3 + i] += 0.5 * (turned[b, m] * anchor[3 + 3 * a + m] - turned[a, m] * anchor[3 + 3 * b + m])


@kernel
def add_strain(memory: SurfaceMemory, s: int, j: int, pose: Record) -> None:
    """Add the elastic slip of a surface to its station."""
    scratch, station, rate = memory.scratch, memory.scratch.station, memory.strains[s, RATE]
    for i in range(3):
        scratch.moving[i], scratch.moving[3 + i] = station.slip[i], station.w[i]
    _fill_strained(memory, s, j, pose, scratch.strained)
    x, z, u = scratch.strained, station.height, station.axis
    for i in range(3):
        a, b = (i + 1) % 3, (i + 2) % 3
        station.slip[i] += rate * (x[i] - z * (x[3 + a] * u[b] - x[3 + b] * u[a]))
        station.w[i] += rate * x[3 + i]


@kernel
def add_stiffness(rate: float, slip: FloatArray, jacobian: FloatArray) -> None:
    """Add the derivatives of the elastic slip in the pose to ``jacobian`` (6, 12)."""
    for i in range(6):
        for k in range(6):
            jacobian[i, k] += rate * slip[i, k]


@kernel
def tell_motion(memory: SurfaceMemory, s: int, out: Record) -> None:
    """Put the power of the motion into a report, and note its share in that of the tractions."""
    scratch, power = memory.scratch, 0.0
    for i in range(6):
        power += scratch.friction[i] * scratch.moving[i]
    found = out.friction_power
    memory.strains[s, SHARE] = max(power / found, 0.0) if found < 0.0 else 1.0
    out.friction_power = power


@kernel
def take_over(data: SurfaceData, memory: SurfaceMemory, j: int, pose: Record) -> None:
    """Take over what sticks in joint ``j`` at the end of an accepted step, by its last reports."""
    anchor = memory.anchors[j]
    for s in range(data.joints[j], data.joints[j + 1]):
        if memory.strains[s, RATE] > 0.0:
            _fill_strained(memory, s, j, pose, memory.scratch.strained)
            _bound(memory.strains[s], memory.reports[s], memory.scratch.strained)
    anchor[KNOWN] = 1.0
    for i in range(3):
        anchor[i] = pose.d[i]
        for m in range(3):
            anchor[3 + 3 * i + m] = pose.rotation[i, m]


@kernel
def _bound(strain: FloatArray, report: Record, x: FloatArray) -> None:
    """Fill U with slip and spin of ``x`` (6,) at the middle of the contact, bounded."""
    force = (report.F_cx, report.F_cy, report.F_cz)
    moment = (report.M_cx, report.M_cy, report.M_cz)
    square = force[0] * force[0] + force[1] * force[1] + force[2] * force[2]
    if square == 0.0:
        for i in range(6):
            strain[i] = 0.0
        return
    size, spin, across, slips = math.sqrt(square), 0.0, 0.0, 0.0
    for i in range(3):
        a, b = (i + 1) % 3, (i + 2) % 3
        # The middle lies where the force passes, on the side that it comes from.
        strain[3 + i] = (force[a] * moment[b] - force[b] * moment[a]) / square - strain[DEPTH] * force[
            i
        ] / size
        spin += force[i] / size * x[3 + i]
    for i in range(3):
        a, b = (i + 1) % 3, (i + 2) % 3
        strain[i] = x[i] + x[3 + a] * strain[3 + b] - x[3 + b] * strain[3 + a]
        across += force[i] / size * strain[i]
    for i in range(3):
        strain[i] -= across * force[i] / size
        slips += strain[i] * strain[i]
    whole = math.sqrt(slips) + strain[LEVER] * abs(spin)
    factor = min(1.0, strain[LARGEST] / whole) if whole > 0.0 else 1.0
    n = (force[0] / size, force[1] / size, force[2] / size)
    c = (strain[3], strain[4], strain[5])
    for i in range(3):
        a, b = (i + 1) % 3, (i + 2) % 3
        strain[i] = factor * (strain[i] - spin * (n[a] * c[b] - n[b] * c[a]))
        strain[3 + i] = factor * spin * n[i]
