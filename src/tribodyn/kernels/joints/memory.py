"""What a joint remembers: where contact began, how it slid, its extremes; and what it works with."""

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
from tribodyn.kernels.joints.quantities import Extremes, Report

Scratch: Final = record_type(
    ("pose", Pose),
    ("wrench", "f8", (N_WRENCH,)),
    ("jacobian", "f8", (N_WRENCH, N_MOTION)),
    ("gradient", "f8", (5, 9)),
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
    extremes
        Over all accepted steps, see ``kernels/joints/quantities.py``.
    scratch
        See :data:`Scratch`.
    """

    entry_velocity: FloatArray
    sliding_load: FloatArray
    sliding: FloatArray
    pieces: IntArray
    extremes: Record
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
    extremes = new_record(Extremes)
    extremes.separation_least = clearance
    return JointMemory(
        entry_velocity=np.zeros(field_shape),
        sliding_load=np.zeros(field_shape),
        sliding=np.zeros(rows * columns),
        pieces=np.zeros((2 * rows + rows * columns // PART + 3, 3), dtype=np.int64),
        extremes=extremes,
        scratch=new_record(Scratch),
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
    watched.contact_force = math.hypot(report.F_cx, report.F_cy)
    watched.rigid_force = math.hypot(report.F_kx, report.F_ky)
    watched.damping_force = math.hypot(report.F_cx - report.F_kx, report.F_cy - report.F_ky)
    watched.pressure = report.p_max
    watched.eccentricity = math.hypot(y[0], y[1])
    watched.tilt = math.hypot(y[2], y[3])
