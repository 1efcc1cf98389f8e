"""History variables of clearance joints: begin of contact, sliding, what sticks, peaks; and work arrays.

Friction may hold at rest. Of a shaft whose velocity and angular velocity are V, tractions follow the slip of
V + U/τ. U is what sticks: a displacement and a rotation, with those of the shaft since the last accepted
step, scaled down where the slip u of the contact's middle and the spin w about its normal there are more than
breaks away, u² + (l w)² > δ² with a lever l. A node at rest then resists with the stiffness μ p/(u_s τ). At
accepted steps U becomes that slip and that spin alone; where nothing touches there is none.
"""

import math
from typing import Annotated, Final, NamedTuple

import numpy as np

from mebdf.arrays import FloatArray, FloatMatrix, IntArray, IntMatrix
from tribodyn.core.quantities import Record, record_type
from tribodyn.kernels.jit import inlined, kernel, new_record
from tribodyn.kernels.joints.surface.data import Peaks, Report, SurfaceData
from tribodyn.kernels.joints.surface.listed import Listed
from tribodyn.kernels.joints.surface.station import Station
from tribodyn.kernels.joints.surface.tilt import Pose, Tilt
from tribodyn.kernels.lanes import WIDTH

BLOCK_GROUPS: Final = 26 * WIDTH  #: Begins of the groups of the block.
COLUMNS: Final = 12  #: Lanes of a group.
N_SUMS: Final = 105  #: Sums over the nodes of a ring for derivatives, see ``ring_slopes``.

SHARE: Final = 6  #: Sliding speed over that of the tractions, at the last report; before it U [m] and [rad].
RATE: Final = 7  #: 1/τ [1/s], 0 without friction at rest.
DEPTH: Final = 8
#: Distance of the nodes from the origin of the shaft along the normal, and as a root of mean squares [m].
LEVER: Final = 9
LARGEST: Final = 10  #: Bound δ of U [m].
MIDDLE: Final = 11
#: Middle [m] and normal of the contact at the last accepted step, zero without one.
NORMAL: Final = 14
N_STRAIN: Final = 17  #: Numbers of a surface.
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
    ("growth", "f8", (6,)),
    ("magnitude", "f8"),
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
moving, strained, growth, magnitude
    Slip and angular velocity of the station without what sticks; U, see above; the size √(u² + l² w²) of what
    U was before its bound, and the derivative of half its square.
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
    #: Of each surface, see ``data``, shape (n_surfaces,).
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
def _size_of(strain: FloatArray, x: FloatArray, growth: FloatArray) -> float:
    """Return the size of slip and spin of ``x`` (6,), and fill ``growth`` (6,) as ``Scratch`` says."""
    middle, n, lever = strain[MIDDLE:], strain[NORMAL:], strain[LEVER]
    across = spin = 0.0
    for i in range(3):
        a, b = (i + 1) % 3, (i + 2) % 3
        growth[i] = x[i] + x[3 + a] * middle[b] - x[3 + b] * middle[a]
        across += n[i] * growth[i]
        spin += n[i] * x[3 + i]
    square = (lever * spin) ** 2
    for i in range(3):
        growth[i] -= across * n[i]
        square += growth[i] * growth[i]
    for i in range(3):
        a, b = (i + 1) % 3, (i + 2) % 3
        growth[3 + i] = middle[a] * growth[b] - middle[b] * growth[a] + lever * lever * spin * n[i]
    return math.sqrt(square)


@inlined
def _bound(strain: FloatArray, size: float) -> float:
    return strain[LARGEST] / size if size > strain[LARGEST] else 1.0


@kernel
def add_strain(memory: SurfaceMemory, s: int, j: int, pose: Record) -> None:
    """Add the elastic slip of a surface to its station."""
    scratch, station, strain = memory.scratch, memory.scratch.station, memory.strains[s]
    for i in range(3):
        scratch.moving[i], scratch.moving[3 + i] = station.slip[i], station.w[i]
    x, z, u = scratch.strained, station.height, station.axis
    _fill_strained(memory, s, j, pose, x)
    scratch.magnitude = _size_of(strain, x, scratch.growth)
    bound = _bound(strain, scratch.magnitude)
    for i in range(6):
        x[i] *= bound
    for i in range(3):
        a, b = (i + 1) % 3, (i + 2) % 3
        station.slip[i] += strain[RATE] * (x[i] - z * (x[3 + a] * u[b] - x[3 + b] * u[a]))
        station.w[i] += strain[RATE] * x[3 + i]


@kernel
def add_stiffness(strain: FloatArray, scratch: Record, jacobian: FloatArray) -> None:
    """Add the derivatives of the elastic slip in the pose to ``jacobian`` (6, 12)."""
    slip, bound = scratch.friction_slip, _bound(strain, scratch.magnitude)
    for i in range(6):
        along = 0.0
        if bound < 1.0:
            for k in range(6):
                along += slip[i, k] * scratch.strained[k] / scratch.magnitude**2
        for k in range(6):
            jacobian[i, k] += strain[RATE] * (bound * slip[i, k] - along * scratch.growth[k])


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
    anchor, scratch = memory.anchors[j], memory.scratch
    for s in range(data.joints[j], data.joints[j + 1]):
        if memory.strains[s, RATE] > 0.0:
            _fill_strained(memory, s, j, pose, scratch.strained)
            _put_contact(memory.strains[s], memory.reports[s])
            _keep(memory.strains[s], scratch.strained, scratch.growth)
    anchor[KNOWN] = 1.0
    for i in range(3):
        anchor[i] = pose.d[i]
        for m in range(3):
            anchor[3 + 3 * i + m] = pose.rotation[i, m]


@kernel
def _put_contact(strain: FloatArray, report: Record) -> None:
    """Put the middle and the normal of the contact of a surface where its last report has them."""
    force = (report.F_cx, report.F_cy, report.F_cz)
    moment = (report.M_cx, report.M_cy, report.M_cz)
    square = force[0] * force[0] + force[1] * force[1] + force[2] * force[2]
    for i in range(3):
        a, b = (i + 1) % 3, (i + 2) % 3
        n = force[i] / math.sqrt(square) if square > 0.0 else 0.0
        # The middle lies where the force passes, on the side that it comes from.
        passes = (force[a] * moment[b] - force[b] * moment[a]) / square if square > 0.0 else 0.0
        strain[MIDDLE + i], strain[NORMAL + i] = passes - strain[DEPTH] * n, n


@kernel
def _keep(strain: FloatArray, x: FloatArray, growth: FloatArray) -> None:
    """Make U the bounded slip and spin of ``x`` (6,); none without contact. ``growth`` (6,) is work.

    Of the rotation as much is kept as the slip has of it: it goes on as it is where the shaft slides so, and
    where the shaft rolls nothing accumulates.
    """
    bound = _bound(strain, _size_of(strain, x, growth))
    c, n = strain[MIDDLE:NORMAL], strain[NORMAL:]
    spin = n[0] * x[3] + n[1] * x[4] + n[2] * x[5]
    touches = n[0] * n[0] + n[1] * n[1] + n[2] * n[2]
    across = along = square = 0.0
    for i in range(3):
        a, b = (i + 1) % 3, (i + 2) % 3
        turned = x[3 + i] - spin * n[i]
        growth[3 + i] = (x[3 + a] - spin * n[a]) * c[b] - (x[3 + b] - spin * n[b]) * c[a]
        across += growth[3 + i] * n[i]
        strain[3 + i] = turned
    for i in range(3):
        growth[3 + i] -= across * n[i]
        along += growth[i] * growth[3 + i]
        square += growth[3 + i] * growth[3 + i]
    share = min(max(along / square, 0.0), 1.0) if square > 0.0 else 0.0
    for i in range(3):
        a, b = (i + 1) % 3, (i + 2) % 3
        slip = growth[i] - share * growth[3 + i] - spin * (n[a] * c[b] - n[b] * c[a])
        strain[i] = touches * bound * slip
        strain[3 + i] = touches * bound * (spin * n[i] + share * strain[3 + i])
