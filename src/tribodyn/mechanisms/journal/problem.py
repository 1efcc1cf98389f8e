"""The journal as an initial value problem."""

from __future__ import annotations

from typing import Final

import numpy as np

from tribodyn.core.arrays import FloatArray
from tribodyn.core.errors import InputError
from tribodyn.core.problem import CompiledFunctions, Problem
from tribodyn.kernels.bushing.joint import update_entry_velocity
from tribodyn.kernels.bushing.names import STATES
from tribodyn.kernels.bushing.report import N_REPORT
from tribodyn.kernels.journal import functions
from tribodyn.kernels.journal.data import JournalData, JournalMemory, Scratch
from tribodyn.kernels.journal.equations import spread
from tribodyn.kernels.journal.ledger import LEAST_SEPARATION, N_EXTREMES, N_INTEGRALS
from tribodyn.kernels.journal.observe import OBSERVED, observe
from tribodyn.mechanisms.journal.parameters import Journal

FUNCTIONS: Final = CompiledFunctions(
    rhs=functions.rhs,
    jac=functions.jac,
    enter=functions.enter,
    advance=functions.advance,
    accept=functions.accept,
    observe=observe,
    picture=functions.picture,
)


def journal_data(journal: Journal) -> JournalData:
    """Return what the kernels read."""
    joint, loads = journal.joint, journal.loads
    return JournalData(
        inertia=np.repeat([float(journal.mass), float(journal.transverse_inertia)], 2),
        spin_inertia=float(journal.spin_inertia),
        load=np.array([loads.force_x, loads.force_y, loads.moment_x, loads.moment_y], dtype=np.float64),
        speed=float(journal.speed),
        sign=-float(np.sign(journal.speed)),
        deepest=float(joint.table.h_first * joint.roughness),
        joint=joint.data(),
        film=None if journal.film is None else journal.film.data(),
    )


def journal_memory(journal: Journal, data: JournalData) -> JournalMemory:
    """Return an empty memory: no contact, no work done yet."""
    scratch = Scratch(
        state=np.zeros(8),
        total=np.zeros(4),
        wrench=np.zeros(5),
        wrench_jacobian=np.zeros((5, 9)),
        gradient=np.zeros((3, 5)),
        film=np.zeros(5),
        film_jacobian=np.zeros((5, 9)),
        film_status=np.zeros(1),
        report=np.zeros(N_REPORT),
        rates=np.zeros(N_INTEGRALS),
        rest=np.zeros(8),
    )
    extremes = np.zeros(N_EXTREMES)
    extremes[LEAST_SEPARATION] = data.joint.clearance
    return JournalMemory(
        entry_velocity=np.zeros(data.joint.wear.shape),
        last_time=np.zeros(1),
        integrals=np.zeros(N_INTEGRALS),
        rates=np.zeros(N_INTEGRALS),
        extremes=extremes,
        beyond=np.zeros(1),
        film=None if journal.film is None else journal.film.memory(),
        scratch=scratch,
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
    data = journal_data(journal)
    memory = journal_memory(journal, data)
    n = journal.freedoms
    y0 = np.zeros(2 * n)
    if start is not None:
        y0[:n] = start[:n]
    _check_inside(journal, y0)
    spread(y0, memory.scratch.state)
    update_entry_velocity(data.joint, memory.scratch.state, memory.entry_velocity, 1.0)
    position, tilt, velocity, tilt_rate = atol
    tolerances = np.array([position, position, tilt, tilt, velocity, velocity, tilt_rate, tilt_rate])
    kept = [*range(n), *range(4, 4 + n)]
    return Problem(
        functions=FUNCTIONS,
        data=data,
        memory=memory,
        y0=y0,
        t_span=(0.0, duration),
        breakpoints=(),
        atol=tolerances[kept],
        state_names=tuple(STATES[k] for k in kept),
        n_observed=len(OBSERVED),
        field_shape=(1, *data.joint.wear.shape),
    )


def _check_inside(journal: Journal, y0: FloatArray) -> None:
    """Refuse a start at which the mean planes of journal and bushing overlap."""
    e = float(np.hypot(y0[0], y0[1]))
    clearance = journal.joint.geometry.clearance
    if e >= clearance:
        raise InputError(
            f"the journal would start {e * 1e6:.4g} um off the axis, outside the bushing: the clearance is "
            f"{clearance * 1e6:.4g} um",
            key="run.start_x",
        )
