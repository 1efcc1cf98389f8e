"""History variables of clearance joints: begin of contact, sliding, peaks; and their work arrays."""

import math
from typing import Annotated, Final, NamedTuple

import numpy as np

from tribodyn.core.arrays import FloatArray, IntArray, IntMatrix
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

BLOCK_GROUPS: Final = 26 * WIDTH
"""Begins of the groups of the block."""
COLUMNS: Final = 12
"""Lanes of a group."""
N_SUMS: Final = 105
"""Sums over the nodes of a ring for derivatives, see ``ring_slopes``."""

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
"""


class SurfaceMemory(NamedTuple):
    """The memory of all clearance joints of a mechanism.

    Attributes
    ----------
    entry_velocity
        δ̇₋ at the nodes [m/s], shape (n_nodes,); 0 where there is no contact. A point contact keeps its own
        at the first nodes of its surface.
    remembering
        Whether any node of a row has one, shape (n_rows,).
    sliding_load
        ∫P_c |s| dt [N/m], shape (n_nodes,).
    sliding
        P_c |s| of the last report [W/m²] at the nodes within reach, each surface from its first node on; of
        rings as ``ring_report.first_kept`` says.
    reached
        First group and number of groups of each ring that it belongs to, shape (n_rows, 2).
    touched, n_touched
        Nodes of patches that it belongs to, shape (n_nodes,), and their number, shape (n_surfaces,).
    reports, peaks
        Of each surface, see ``quantities``, shape (n_surfaces,).
    block
        Four rings and the groups of their nodes, see ``block`` and ``ring``; work, as ``scratch`` is.
    scratch
        See :data:`Scratch`.
    """

    entry_velocity: FloatArray
    remembering: FloatArray
    sliding_load: FloatArray
    sliding: FloatArray
    reached: IntMatrix
    touched: IntArray
    n_touched: IntArray
    reports: Annotated[Record, Report, 1]
    peaks: Annotated[Record, Peaks, 1]
    block: FloatArray
    scratch: Annotated[Record, Scratch]


def _block_size(rows: Record) -> int:
    return BLOCK_GROUPS + COLUMNS * WIDTH * WIDTH * (int(rows["count"].max(initial=0)) // WIDTH + 1)


def new_memory(data: SurfaceData) -> SurfaceMemory:
    """Return the memory of joints that never touched."""
    n_nodes, n_surfaces = data.nodes.shape[1], data.surfaces.size
    peaks = np.zeros(n_surfaces, dtype=Peaks)
    peaks["separation_least"] = math.inf
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
