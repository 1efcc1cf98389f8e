"""The journal as an initial value problem."""

from __future__ import annotations

import math
from typing import Final

import numpy as np

from mebdf.kernels.elementary import portable
from tribodyn.core.arrays import FloatArray
from tribodyn.core.errors import InputError
from tribodyn.core.problem import CompiledFunctions, Problem
from tribodyn.core.quantities import names
from tribodyn.core.signals import constant
from tribodyn.joints.bushing import new_memory
from tribodyn.kernels.arrays import new_record
from tribodyn.kernels.joints.bushing import update_entry_velocity
from tribodyn.kernels.joints.quantities import STATES
from tribodyn.kernels.journal import functions
from tribodyn.kernels.journal.data import (
    N_COORDINATES,
    Constants,
    Course,
    JournalData,
    JournalMemory,
    Scratch,
)
from tribodyn.kernels.journal.equations import place
from tribodyn.kernels.journal.observe import observe
from tribodyn.kernels.journal.quantities import FORCES, OBSERVED, WATCHED, Counts
from tribodyn.kernels.ledger import new_books
from tribodyn.kernels.peaks import new_peaks
from tribodyn.mechanisms.actions import actions_of
from tribodyn.mechanisms.journal.course import course
from tribodyn.mechanisms.journal.parameters import Journal
from tribodyn.mechanisms.signals import SignalList, integral_of, pieces_of

FUNCTIONS: Final = CompiledFunctions(
    rhs=functions.rhs,
    jac=functions.jac,
    enter=functions.enter,
    advance=functions.advance,
    accept=functions.accept,
    observe=observe,
    picture=functions.picture,
)


def journal_data(journal: Journal, duration: float = math.inf) -> JournalData:
    """Return what the kernels read in a run of ``duration`` [s]; in one without end kinks are passed over."""
    joint, loads = journal.joint, journal.loads
    constants = new_record(Constants)
    constants.inertia[:] = np.repeat([journal.mass, journal.transverse_inertia], 2)
    constants.spin_inertia = journal.spin_inertia
    constants.load[:] = loads.force_x, loads.force_y, loads.moment_x, loads.moment_y
    constants.slip_velocity = journal.slip_velocity
    constants.deepest = joint.table.h_first * joint.roughness
    speed = pieces_of(constant(journal.speed) if journal.spin is None else journal.spin)
    signals = SignalList()
    signals.add(integral_of(speed))
    signals.add(speed)
    actions = actions_of(signals, journal.terms, course(journal, duration))
    return JournalData(
        constants, joint.data(), None if journal.film is None else journal.film.data(), actions
    )


def journal_memory(journal: Journal, data: JournalData) -> JournalMemory:
    """Return an empty memory: no contact, no work done yet."""
    return JournalMemory(
        joint=new_memory(data.joint),
        books=new_books(0, len(FORCES), N_COORDINATES),
        peaks=new_peaks(len(WATCHED)),
        counts=new_record(Counts),
        course=new_record(Course),
        segment=data.actions.segments[0].copy(),
        film=None if journal.film is None else journal.film.memory(),
        scratch=new_record(Scratch),
    )


def journal_problem(
    journal: Journal,
    *,
    duration: float,
    start: FloatArray | None = None,
    atol: tuple[float, float, float, float],
) -> Problem:
    """Return the initial value problem of a journal that starts at rest.

    Parameters
    ----------
    journal
        The journal.
    duration
        Simulated time [s].
    start
        Attitude (e_x, e_y[, φ_x, φ_y]) at the start [m, rad], shape (2,) or (4,); centred by default.
    atol
        Absolute tolerances of e [m], φ [rad], ė [m/s], φ̇ [rad/s].

    Raises
    ------
    InputError
        If the journal does not start inside the bushing.
    """
    data = journal_data(journal, duration)
    memory = journal_memory(journal, data)
    n = journal.freedoms
    y0 = np.zeros(2 * n)
    if start is not None:
        y0[:n] = start[:n]
    _check_inside(journal, y0)
    place(data, 0.0, y0, memory)
    update_entry_velocity(data.joint, memory.joint, memory.joint.scratch.pose, 1.0)
    position, tilt, velocity, tilt_rate = atol
    tolerances = np.array([position, position, tilt, tilt, velocity, velocity, tilt_rate, tilt_rate])
    kept = [*range(n), *range(4, 4 + n)]
    return Problem(
        functions=FUNCTIONS,
        data=data,
        memory=memory,
        y0=y0,
        t_span=(0.0, duration),
        breakpoints=tuple(data.actions.segments.begin[1:].tolist()),
        atol=tolerances[kept],
        state_names=tuple(names(STATES)[k] for k in kept),
        n_observed=len(OBSERVED),
        field_shape=(1, *data.joint.wear.shape),
    )


def _check_inside(journal: Journal, y0: FloatArray) -> None:
    """Refuse a start at which the mean planes of journal and bushing overlap."""
    e = float(portable.hypot(y0[0], y0[1]))
    clearance = journal.joint.geometry.clearance
    if e >= clearance:
        raise InputError(
            f"the journal would start {e * 1e6:.4g} um off the axis, outside the bushing: the clearance is "
            f"{clearance * 1e6:.4g} um",
            key="run.start_x",
        )
