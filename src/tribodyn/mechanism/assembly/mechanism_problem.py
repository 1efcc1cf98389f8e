"""A mechanism as an initial value problem."""

import math
from dataclasses import replace
from typing import Final

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.core.problem import CompiledFunctions, LinearSolver, Problem
from tribodyn.joints.clearances import places
from tribodyn.kernels import dense
from tribodyn.kernels.joints.surface.memory import DEPTH, LARGEST, LEVER, RATE
from tribodyn.kernels.mechanism import functions, newton
from tribodyn.kernels.mechanism.blocks import BLOCK
from tribodyn.kernels.mechanism.data import CONTACT, N_STATES, ORIENTATION, TURNING, VELOCITY, MechanismData
from tribodyn.kernels.mechanism.observe import N_BODY, N_COUPLING, N_WHOLE
from tribodyn.mechanism.assembly.assembly import Assembly, memory_of
from tribodyn.mechanism.assembly.closing import SIZE, System
from tribodyn.mechanism.assembly.ordering import n_blocks
from tribodyn.mechanism.assembly.parts_by_number import Model
from tribodyn.mechanism.mechanism_case import MechanismCase
from tribodyn.mechanism.model.drives_and_loads import GIVEN
from tribodyn.mechanisms.bushing import Carried
from tribodyn.mechanisms.shaft_loads import WAVE_STEPS

FUNCTIONS: Final = CompiledFunctions(**functions.FUNCTIONS)
#: States of a body; the angular velocity is in its own axes.
STATES: Final = (
    *("x", "y", "z"),
    *("p_0", "p_1", "p_2", "p_3"),
    *("v_x", "v_y", "v_z"),
    *("omega_1", "omega_2", "omega_3"),
)

Tolerances = tuple[float, float, float, float]
#: Sliding speed over the slip velocity up to which friction at rest stretches: 98 % of its limit.
DEVELOPED: Final = 5.0
#: Largest order of MEBDF that is stable along the imaginary axis: beams swing fast, and hardly damped.
A_STABLE: Final = 4
_MOMENTS: Final = 32  #: Parts of a run, or of its first cycle, at whose ends drives are looked at.


def mechanism_problem(
    assembly: Assembly,
    *,
    duration: float,
    rtol: float,
    atol: Tolerances | None = None,
    state: FloatArray | None = None,
    carried: Carried | None = None,
    dense: bool = False,
) -> Problem:
    """Return the initial value problem of an assembled mechanism over ``duration`` [s].

    ``rtol`` holds for velocities; positions and orientations are kept to ``atol`` wherever in the drawing
    they are. These tolerances of positions [m], orientations [rad], velocities [m/s] and angular velocities
    [rad/s] follow by default from ``rtol``, :func:`length_scale` and the speed of the mechanism. It begins at
    ``state`` (13 n,), by default that of the assembly, whose shafts are in the middle, or continues what
    is carried. A ``dense`` Jacobian is a full matrix, as integrators other than ``mebdf`` need it.
    """
    data, n = assembly.data, len(assembly.model.bodies)
    begin = assembly.state if state is None else state
    start = (begin if carried is None else carried.state).copy()
    memory, kinks = memory_of(assembly, start), data.signals.kinks
    if carried is not None:
        memory.contact.entry_velocity[:] = carried.entry_velocity
    _let_rest(assembly.model, memory.contact.strains)
    # Of what is carried on, points that wear has taken out of contact forget.
    functions.touch(data, memory, 1.0 if carried is None else 0.0)
    laws = memory.now.couplings["law"]
    laws["anchor"], laws["elastic"], laws["stiffness"] = math.nan, 0.0, 0.0
    tolerances = rtol * _scales(assembly, duration) if atol is None else np.asarray(atol)
    return Problem(
        functions=replace(FUNCTIONS, jac=functions.jac) if dense else FUNCTIONS,
        data=data,
        memory=memory,
        y0=start,
        t_span=(0.0, duration),
        breakpoints=tuple(kinks[(kinks > 0.0) & (kinks < duration)].tolist()),
        atol=np.tile(np.repeat(tolerances, [3, 4, 3, 3]), n),
        relative=np.tile(np.repeat([0.0, 1.0], [VELOCITY, N_STATES - VELOCITY]), n),
        state_names=tuple(f"{name} of {body}" for body in assembly.model.bodies for name in STATES),
        n_observed=N_WHOLE + n * N_BODY + data.parts.couplings.size * N_COUPLING,
        field_shape=(data.contact.nodes.shape[1] + data.films.wear_node.size,),
        algebra=None if dense else _algebra(data),
        longest_step=_shortest_wave(assembly.model.case) / WAVE_STEPS,
        largest_order=A_STABLE if assembly.model.elastic else None,
    )


def _let_rest(model: Model, strains: FloatArray) -> None:
    """Fill the constants of friction that holds at rest for all surfaces (n_surfaces, n), where it does."""
    friction, clearances = model.case.friction, tuple(model.clearances.values())
    if not friction.rest or model.case.run.analysis != "dynamic":
        return
    for strain, place in zip(strains, places(clearances), strict=True):
        surface, clearance = place.surface, clearances[place.joint]
        strain[RATE] = clearance.slip_velocity * DEVELOPED / friction.presliding
        strain[DEPTH] = np.mean(np.sum(surface.normal * surface.position, axis=1))
        strain[LEVER] = math.sqrt(np.mean(np.sum(surface.position**2, axis=1)))
        strain[LARGEST] = friction.presliding


def _shortest_wave(case: MechanismCase) -> float:
    """Return the shortest period of a sinusoidal drive or load [s]; infinite without one."""
    signals = [drive.signal for drive in case.drives.values()]
    periods = [signal.period for signal in signals]
    periods += [signal.period for load in case.loads.values() for signal in load.given.values()]
    return min((period for period in periods if period), default=math.inf)


def _algebra(data: MechanismData) -> LinearSolver:
    """Return the linear algebra of the problem's iteration matrix."""
    n, private = data.parts.bodies.size, int(data.parts.constants.n_entries)
    state = N_STATES * np.arange(n)[:, None]
    rows = np.array([VELOCITY, VELOCITY + 1, VELOCITY + 2, TURNING, TURNING + 1, TURNING + 2])
    n_numbers = n_blocks(data.newton) + int(data.parts.constants.n_work)
    return LinearSolver(
        places=np.ascontiguousarray(
            [(state + np.repeat(rows, 3)).ravel(), (state + np.tile(np.arange(ORIENTATION), 6)).ravel()]
        ),
        factorise=newton.factorise,
        solve=newton.solve,
        n_factors=1 + private + 9 * n + BLOCK * n_numbers,
        n_entries=newton.N_PLACES * n + private,
    )


def length_scale(assembly: Assembly) -> float:
    """Return the length that positions are resolved against [m].

    The smallest clearance as drawn; without any the presliding of friction, or a tenth of the mechanism.
    """
    friction = assembly.model.case.friction
    clearances = [real.shape.clearance for real in assembly.model.clearances.values()]
    return min(clearances, default=friction.presliding if friction.rest else 0.1 * SIZE)


def least_energy(assembly: Assembly, forces: FloatArray, rtol: float) -> float:
    """Return the work of the largest force over the way to which positions are resolved [J].

    Where nothing moves there is no more to balance than that.
    """
    return float(np.max(np.abs(forces), initial=0.0)) * rtol * length_scale(assembly)


def _scales(assembly: Assembly, duration: float) -> FloatArray:
    """Return the scales of positions, orientations, velocities and angular velocities, shape (4,)."""
    size, length = SIZE, length_scale(assembly)
    state, slowest = assembly.state.reshape(-1, N_STATES), size / duration
    falling = float(np.sqrt(dense.norm(assembly.model.case.gravity) * size))
    speed = max(fastest(state[:, VELOCITY:], size), falling, slowest)
    # What friction holds at rest begins to slide slowly, whatever drives give.
    if speed == slowest and not assembly.model.case.friction.rest:
        speed = max(speed, _driven(assembly, duration, size))
    return np.array([length, length / size, 0.1 * speed, 0.1 * speed / size])


def fastest(velocities: FloatArray, size: float) -> float:
    """Return the largest speed of bodies [m/s], from velocities and angular velocities, shape (..., 6)."""
    speed, turning = np.max(
        np.linalg.norm(velocities.reshape(-1, 2, 3), axis=2), axis=0, initial=0.0
    ).tolist()
    return float(max(speed, size * turning))


def _driven(assembly: Assembly, duration: float, size: float) -> float:
    """Return the largest speed that drives give the bodies [m/s].

    Ideal joints take it to all bodies where these start. A force moves the mass of all over the size, and no
    farther than that in a period.
    """
    model, speed, case = assembly.model, 0.0, assembly.model.case
    system = System(model.counterpart, data=assembly.ideal_data)
    system.adopt(assembly.state)
    system.set_rank(assembly.ideal_rank if model.has_loops else len(system.rows))
    moments = np.linspace(0.0, min(duration, case.period or duration), _MOMENTS + 1)
    for system.t in moments.tolist():
        system.move_with_drives(1.0)
        speed = max(speed, fastest(np.hstack([system.now.bodies.v, system.now.bodies.w])[:-1], size))
    mass = sum(body.mass for body in case.bodies.values())
    for drive in case.drives.values():
        coordinate, level = GIVEN[drive.gives]
        signal = drive.signal.over_run(duration)
        arm = size if coordinate == "angle" else 1.0
        force = max(abs(signal.at(t)) for t in moments.tolist()) / arm if level == 2 else 0.0
        farthest = 2.0 * math.pi * size / drive.period if drive.period else math.inf
        speed = max(speed, min(math.sqrt(force / mass * size), farthest))
    return speed


def stored_energy(problem: Problem) -> float:
    """Return the energy stored in the joints with clearance of a mechanism at the start of a problem [J]."""
    data, memory = problem.data, problem.memory
    functions.enter(problem.t_span[0], problem.y0.copy(), data, memory)
    return float(np.sum(memory.now.couplings.stored[data.parts.couplings.force == CONTACT]))
