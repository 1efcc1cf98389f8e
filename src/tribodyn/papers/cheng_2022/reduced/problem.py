"""The VSV mechanism as an initial value problem."""

import math
from typing import Final

import numpy as np

from mebdf.arrays import FloatArray
from mebdf.kernels.elementary import portable
from tribodyn.core.errors import InputError
from tribodyn.core.problem import CompiledFunctions, Problem
from tribodyn.core.quantities import names
from tribodyn.joints.bushing import new_memory
from tribodyn.kernels.actions import NONE, TIME
from tribodyn.kernels.jit import new_record
from tribodyn.kernels.joints.bushing import Collar, update_entry_velocity
from tribodyn.kernels.joints.bushing import Extremes as CollarExtremes
from tribodyn.kernels.joints.quantities import SHARP, STATES
from tribodyn.kernels.ledger import NO_SWING, new_books
from tribodyn.kernels.peaks import new_peaks
from tribodyn.kernels.vsv import data as layout
from tribodyn.kernels.vsv import functions
from tribodyn.kernels.vsv.closure import place
from tribodyn.kernels.vsv.data import Books, Scratch, VsvData, VsvMemory, new_mechanism
from tribodyn.kernels.vsv.quantities import FORCES, OBSERVED, WATCHED
from tribodyn.mechanisms.bushing import Carried
from tribodyn.mechanisms.shaft_loads import WAVE_STEPS, actions_of, shortest_wave
from tribodyn.mechanisms.signal_pieces import SignalList, pieces_of
from tribodyn.papers.cheng_2022.reduced.drives import run_segments
from tribodyn.papers.cheng_2022.reduced.equilibrium import equilibrium
from tribodyn.papers.cheng_2022.reduced.parameters import FORMULATIONS, CrankMotion, Vsv
from tribodyn.papers.cheng_2022.reduced.reach import ideal_table

STARTS: Final = ("equilibrium", "centred")

FUNCTIONS: Final = CompiledFunctions(**functions.FUNCTIONS)


def vsv_data(vsv: Vsv, wear: FloatArray | None = None, duration: float = math.inf) -> VsvData:
    """Return the data of the kernels.

    ``wear``: wear depth at the nodes [m]; ``duration``: length of the run [s]; the crank must reach no
    further than it takes it.
    """
    lengths, inertias, drive = vsv.lengths, vsv.inertias, vsv.drive
    ideal_first, ideal_inverse_step, ideal = ideal_table(lengths, *vsv.drive.crank_range(duration))
    mechanism = new_mechanism(
        exact=FORMULATIONS[vsv.formulation],
        l_1=lengths.l_1,
        l_2=lengths.l_2,
        l_3=lengths.l_3,
        l_4=lengths.l_4,
        pivot_x=lengths.l_m * portable.cos(lengths.gamma),
        pivot_z=lengths.l_m * portable.sin(lengths.gamma),
        ring_sin=portable.sin(lengths.phi),
        ring_cos=portable.cos(lengths.phi),
        half_length=0.5 * vsv.joint.geometry.length,
        vane_arm=vsv.vane_arm,
        m_1=inertias.m_1,
        m_2=inertias.m_2,
        m_3=inertias.m_3,
        m_v=inertias.m_v,
        crank_inertia=vsv.crank_inertia,
        link_inertia=vsv.link_inertia,
        ring_inertia=vsv.ring_inertia,
        inertia=_row_inertia(vsv),
        weight=_row_weight(vsv),
        vane_weight=inertias.m_v * vsv.gravity,
        start_angle=drive.start_angle if isinstance(drive, CrankMotion) else 0.0,
        speed_amplitude=drive.speed_amplitude if isinstance(drive, CrankMotion) else 0.0,
        angular_frequency=drive.angular_frequency if isinstance(drive, CrankMotion) else 1.0,
        tabulated=0.0 if drive.signal is None else 1.0,
        opening=NONE,
        air_force_x=vsv.air.force_x,
        air_force_y=vsv.air.force_y,
        air_moment=vsv.air.moment,
        switch_angle=vsv.air.switch_angle,
        switch_width=vsv.air.switch_width,
        ideal_first=ideal_first,
        ideal_inverse_step=ideal_inverse_step,
        ideal=ideal,
    )
    collar = new_record(Collar)
    collar.radius, collar.friction = vsv.collar_radius, vsv.collar_radius * vsv.joint.friction.coefficient
    signals = SignalList()
    if drive.signal is not None:
        signals.add(pieces_of(drive.signal))
    if vsv.opening is not None:
        mechanism.opening = signals.add(pieces_of(vsv.opening))
    actions = actions_of(signals, vsv.terms, run_segments(vsv, duration).segments)
    return VsvData(mechanism, vsv.joint.data(wear), collar, actions)


def _row_inertia(vsv: Vsv) -> FloatArray:
    """Return the mass or moment of inertia of each row of the motion table."""
    inertia = np.zeros(layout.N_ROWS)
    inertia[layout.THETA_A] = vsv.crank_inertia
    inertia[layout.THETA_B] = vsv.ring_inertia
    inertia[layout.THETA_V] = vsv.inertias.J_vz
    inertia[[layout.O1_X, layout.O1_Z]] = vsv.inertias.m_1
    inertia[layout.O2_X : layout.O2_Z + 1] = vsv.inertias.m_2
    inertia[layout.N_X : layout.N_Z + 1] = vsv.link_inertia
    inertia[layout.O3_X : layout.O3_Z + 1] = vsv.inertias.m_3
    inertia[[layout.OV_X, layout.OV_Y]] = vsv.inertias.m_v
    inertia[[layout.PHI_X, layout.PHI_Y]] = vsv.vane_inertia
    return inertia


def _row_weight(vsv: Vsv) -> FloatArray:
    """Return the gravity load of each row of the motion table [N]."""
    weight = np.zeros(layout.N_ROWS)
    weight[layout.O1_Z] = -vsv.inertias.m_1 * vsv.gravity
    weight[layout.O2_Z] = -vsv.inertias.m_2 * vsv.gravity
    weight[layout.O3_Z] = -vsv.inertias.m_3 * vsv.gravity
    return weight


def vsv_memory(data: VsvData, *, reversals: int = 0, impact_time: float = 0.0) -> VsvMemory:
    """Return an empty memory: no contact, no work done yet, direction forward.

    ``data``: from :func:`vsv_data`; ``reversals``: how many reversals the run has; ``impact_time``: how long
    impacts last after each [s].
    """
    return VsvMemory(
        joint=new_memory(data.joint),
        collar=new_record(CollarExtremes),
        segment=data.actions.segments[0].copy(),
        regime=np.array([1.0, 0.0, 0.0]),
        peaks=new_peaks(len(WATCHED), sharp=SHARP, reversals=reversals, impact_time=impact_time),
        books=new_books(Books, _swing_of(data)),
        scratch=new_record(Scratch),
    )


def _swing_of(data: VsvData) -> int:
    """Return the number of the forces among which there are loads that change with time."""
    terms, all_signals = data.actions.terms, data.actions.signals
    swings = False
    for signal in all_signals.signals[terms.signals[(terms.signals != NONE) & (terms.over == TIME)]]:
        pieces = all_signals.pieces[signal.first : signal.first + signal.n]
        swings = swings or signal.sine[0] != 0.0 or bool(np.any(pieces.c[:, 1:]))
    return names(FORCES).index("work_clearance_loads") if swings else NO_SWING


def initial_state(data: VsvData, memory: VsvMemory, start: str) -> FloatArray:
    """Return the state at t = 0, shape (8,).

    ``start``: ``centred``: everything zero. ``equilibrium``: the kinetostatic attitude at 0⁺ with friction
    fully sliding in the direction of the motion about to begin.
    """
    if start not in STARTS:
        raise InputError(f"given {start!r}; allowed: {', '.join(STARTS)}", key="run.start")
    y0 = np.zeros(8)
    if start == "equilibrium":
        y0[:4] = equilibrium(data, memory, 0.0, direction=float(data.actions.segments[0].direction))
    return y0


def vsv_problem(
    vsv: Vsv,
    *,
    duration: float,
    start: str,
    atol: tuple[float, float, float, float],
    wear: FloatArray | None = None,
    carried: Carried | None = None,
) -> Problem:
    """Return the initial value problem of the mechanism.

    ``duration``: simulated time [s]; ``start``: ``centred`` or ``equilibrium``; ``atol``: absolute tolerances
    of e [m], φ [rad], ė [m/s], φ̇ [rad/s]; ``wear``: wear depth at the nodes [m]; ``carried``: where to
    continue from, at the beginning of a drive cycle, instead of ``start``.
    """
    data = vsv_data(vsv, wear, duration)
    events = run_segments(vsv, duration)
    memory = vsv_memory(data, reversals=events.turns.size, impact_time=vsv.drive.impact_time)
    if carried is None:
        y0 = initial_state(data, memory, start)
    else:
        y0 = carried.state.copy()
        memory.joint.entry_velocity[:] = carried.entry_velocity
    place(data, 0.0, y0, 0.0, 0.0, memory)
    # Of what is carried on, points that wear has taken out of contact forget.
    at_start = 1.0 if carried is None else 0.0
    update_entry_velocity(data.joint, memory.joint, memory.joint.scratch.pose, at_start)
    return Problem(
        functions=FUNCTIONS,
        data=data,
        memory=memory,
        y0=y0,
        t_span=(0.0, duration),
        breakpoints=tuple(events.breaks.tolist()),
        atol=np.repeat(np.asarray(atol, dtype=np.float64), 2),
        state_names=names(STATES),
        n_observed=len(OBSERVED),
        field_shape=(1, *data.joint.wear.shape),
        longest_step=shortest_wave(vsv.terms) / WAVE_STEPS,
    )
