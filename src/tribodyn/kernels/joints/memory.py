"""What a joint remembers: where contact began, how it slid, its peaks; and what it works with."""

from __future__ import annotations

import math
from typing import Final, NamedTuple

import numpy as np

from tribodyn.core.arrays import FloatArray, IntArray
from tribodyn.core.quantities import Record, record_type
from tribodyn.kernels.arrays import new_record
from tribodyn.kernels.jit import kernel
from tribodyn.kernels.joints.listed import PART, Listed
from tribodyn.kernels.joints.pose import N_MOTION, N_WRENCH, Pose
from tribodyn.kernels.joints.quantities import Peaks, Report

Scratch: Final = record_type(
    ("pose", Pose),
    ("wrench", "f8", (N_WRENCH,)),
    ("jacobian", "f8", (N_WRENCH, N_MOTION)),
    ("gradient", "f8", (3, 5)),
    ("report", Report),
    ("blank", Report),
    ("listed", Listed),
)
"""Work of one evaluation; nothing is carried from one evaluation to the next. ``blank`` stays zero."""


class JointMemory(NamedTuple):
    """The memory of one joint.

    Attributes
    ----------
    entry_velocity
        δ̇₋ at the nodes [m/s], shape (n_z + 2, n_theta); 0 where there is no contact.
    sliding_load
        ∫P_c |u| dt [N/m], same shape (Eq. 47 and the text below it).
    sliding, pieces
        P_c |u| of the last report [W/m²], and the nodes it belongs to, laid out as in ``Listed``, with the
        number of nodes beside that of pieces.
    peaks
        Over all accepted steps, see ``kernels/joints/quantities.py``.
    scratch
        See :data:`Scratch`.
    """

    entry_velocity: FloatArray
    sliding_load: FloatArray
    sliding: FloatArray
    pieces: IntArray
    peaks: Record
    scratch: Record


def new_memory(field_shape: tuple[int, int], clearance: float) -> JointMemory:
    """Return the memory of a joint that never touched.

    Parameters
    ----------
    field_shape
        Shape (n_z + 2, n_theta) of a field over the nodes.
    clearance
        Largest gap that it can have [m].
    """
    rows, columns = field_shape
    peaks = new_record(Peaks)
    peaks.separation_least = clearance
    return JointMemory(
        entry_velocity=np.zeros(field_shape),
        sliding_load=np.zeros(field_shape),
        sliding=np.zeros(rows * columns),
        pieces=np.zeros((2 * rows + rows * columns // PART + 3, 3), dtype=np.int64),
        peaks=peaks,
        scratch=new_record(Scratch),
    )


@kernel
def note_peaks(memory: JointMemory, t: float, h: float) -> None:
    """Note the report of an instant ``t``, the end of a part of an accepted step of length ``h`` [s]."""
    peaks, report = memory.peaks, memory.scratch.report
    force = math.hypot(report.F_cx, report.F_cy)
    if force > peaks.contact_force_peak:
        peaks.contact_force_peak, peaks.contact_force_peak_time = force, t
    if report.p_max > peaks.pressure_peak:
        peaks.pressure_peak, peaks.pressure_peak_time = report.p_max, t
    peaks.separation_least = min(peaks.separation_least, report.separation_min)
    peaks.tensile_clip_time += h * report.tensile_clip_share
