"""The journal against what can be worked out by hand: frequencies, symmetries, balances, limits."""

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from tests.bushings import joint_jacobian
from tests.journals import BORE, journal, loads

from mebdf.arrays import FloatArray
from tribodyn.core.problem import Problem
from tribodyn.integrate import integrate
from tribodyn.joints.bushing import joint_wrench
from tribodyn.kernels.mechanism.data import TURNING
from tribodyn.mechanism.analyses.shaft_in_bore import equilibrium, journal_of
from tribodyn.mechanism.mechanism_variables import observed
from tribodyn.mechanism.system import MechanismSystem

TIGHT = {"solver.rtol": 1e-10}
MASS, TRANSVERSE, SPIN = 0.253, 5.41e-4, 4.55e-6
LOAD = (200.0, 100.0)


def make(
    name: str = "rsdc",
    *,
    load: tuple[float, float] = LOAD,
    moment: tuple[float, ...] = (),
    speed: float = 0.0,
    tilts: bool = False,
    oil: bool = False,
    coefficient: float = 0.0,
    spin: float = SPIN,
    **others: object,
) -> Any:
    """Return a case of the journal of section 4; keys of ``others`` have ``__`` for dots."""
    return journal(
        "journal-oil" if oil else "journal-dry",
        {
            "contact.law": name,
            "drives.motor.speed": f"{speed!r} rad/s",
            "bodies.journal.inertia": f"{TRANSVERSE!r}, {TRANSVERSE!r}, {spin!r} kg m^2",
            f"{BORE}.friction_coefficient": coefficient,
            **loads(load, moment),
            **{key.replace("__", "."): value for key, value in others.items()},
        },
        tilts=tilts,
    )


def run(case: Any, duration: float, rows: int, *, problem: Problem | None = None) -> dict[str, FloatArray]:
    """Integrate and return ``t``, observed columns of the whole, and those of the bearing."""
    problem = MechanismSystem(case).problem(duration) if problem is None else problem
    solution = integrate(problem, output_times=np.linspace(0.0, duration, rows), rtol=case.solver.rtol)
    assert solution.complete, solution.failure
    found = observed(solution.rows, 1)
    bearing = {name: values[:, 0] for name, values in found.couplings.items()}
    work = found.couplings["joint_work"][:, len(case.joints) :].sum(axis=1)
    return {"t": solution.t, **bearing, **found.whole, "work_loads": work}


def residual(columns: dict[str, FloatArray]) -> FloatArray:
    """Return what the energy balance misses [J]."""
    stored = columns["energy_kinetic"] + columns["energy_stored"]
    heats = columns["heat_damping"] + columns["heat_friction"] + columns["heat_film"]
    missed = stored - stored[0] + heats - columns["work_in"]
    return np.asarray(missed)


JOURNALS: dict[str, dict[str, Any]] = {
    "dry": {},
    "dry, turning, tilting": {"speed": 120.0, "tilts": True, "coefficient": 0.2, "spin": 3e-4},
    "oil": {"oil": True},
    "oil, turning, tilting": {"oil": True, "speed": 300.0, "tilts": True, "coefficient": 0.1, "spin": 3e-4},
}


def test_small_oscillation_has_the_frequency_of_the_linearised_stiffness() -> None:
    case = make("ke", **TIGHT)
    shaft = journal_of(case)
    q = equilibrium(shaft).centre
    data, state = shaft.joint.data(), np.append(q, np.zeros(6))
    load, stiffness = joint_wrench(data, state)[:2] + LOAD, joint_jacobian(data, state)[:2, :2]
    radial = shaft.direction
    omega = math.sqrt(-float(radial @ stiffness @ radial) / MASS)
    assert np.abs(load).max() < 1e-6
    periods, rows = 20, 8001
    duration = periods * 2.0 * math.pi / omega
    # A hundredth of a nanometre: anharmonic by (5e-12 m over σ/3) squared, far below the tolerance.
    problem = MechanismSystem(case).problem(duration)
    problem.y0[:2] = q + 1e-11 * radial
    columns = run(case, duration, rows, problem=replace(problem, atol=1e-5 * problem.atol))
    along = columns["displacement"][:, :2] @ radial - float(q @ radial)
    up = np.flatnonzero((along[:-1] < 0.0) & (along[1:] >= 0.0))
    crossings = columns["t"][up] - along[up] * np.diff(columns["t"])[up] / (along[up + 1] - along[up])
    assert crossings.size == periods
    found = 2.0 * math.pi * (periods - 1) / (crossings[-1] - crossings[0])
    assert found == pytest.approx(omega, rel=1e-4)


@pytest.mark.parametrize(
    "options", [{}, {"oil": True, "speed": 80.0, "coefficient": 0.1}], ids=["dry", "oil"]
)
def test_a_turned_load_turns_the_equilibrium(options: dict[str, Any]) -> None:
    # By a multiple of the spacing of both grids, so that nothing but the load is turned.
    angle = 2.0 * math.pi * 7 / 96
    turn = np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
    shaft, speed = journal_of(make(**options)), options.get("speed", 0.0)
    before = equilibrium(shaft, speed=speed).centre
    turned = replace(shaft, load=tuple((turn @ LOAD).tolist()))
    after = equilibrium(turned, speed=speed).centre
    assert after == pytest.approx(turn @ before, abs=1e-12)


# By a right angle the integrator does the same work: rounding remains, which impacts magnify. Over 40
# neighbouring tolerances it stays below 4e-15 m in the first half millisecond, and reaches 4e-9 m in all. By
# another angle its error weighs X and Y otherwise, steps differ, and with them the instants of entry.
@pytest.mark.parametrize(("nodes", "at_first", "apart"), [(24, 1e-13, 2e-8), (7, 2e-7, 2e-7)])
def test_a_turned_load_turns_the_motion(nodes: int, at_first: float, apart: float) -> None:
    angle = 2.0 * math.pi * nodes / 96
    turn = np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
    paths = []
    for load in (LOAD, (turn @ LOAD).tolist()):
        paths.append(run(make(load=load), 2e-3, 101)["displacement"][:, :2].T)
    missed = np.abs(paths[1] - turn @ paths[0]).max(axis=0)
    assert missed[:25].max() < at_first
    assert missed.max() < apart


def test_a_spinning_journal_precesses_as_a_free_gyroscope() -> None:
    speed, spin, rate = 2000.0, 3e-4, 0.02
    case = make(load=(0.0, 0.0), speed=speed, tilts=True, spin=spin, **TIGHT)
    problem = MechanismSystem(case).problem(4e-3)
    problem.y0[TURNING] = rate
    columns = run(case, 4e-3, 41, problem=problem)
    # J φ̈_x = J_z ω φ̇_y, J φ̈_y = −J_z ω φ̇_x: the rates turn in a circle at J_z ω/J.
    phase = spin * speed / TRANSVERSE * columns["t"]
    # Of a leaning axis the rotation about it has parts across the bushing.
    lean = np.stack([columns["tilt_y"], -columns["tilt_x"]], axis=1)
    across = columns["relative_rate"][:, :2] - columns["relative_rate"][:, 2:] * lean
    assert across[:, 0] == pytest.approx(rate * np.cos(phase), abs=1e-5 * rate)
    assert across[:, 1] == pytest.approx(rate * np.sin(phase), abs=1e-5 * rate)


@pytest.mark.parametrize("options", JOURNALS.values(), ids=JOURNALS)
def test_the_energy_balance_closes_and_heats_only_grow(options: dict[str, Any]) -> None:
    duration = 12e-3 if "oil" in options else 3e-3
    columns = run(make(moment=(0.1, 0.05) if options.get("tilts") else (), **options), duration, 301)
    scale = np.abs(columns["work_loads"]).max()
    assert np.abs(residual(columns)).max() < 1e-3 * scale
    for heat in (columns[f"heat_{name}"] for name in ("damping", "friction", "film")):
        # Damping gives some of its work back only where the clip of tensile pressure allows it: never.
        assert np.diff(heat).min() >= -1e-6 * scale


def test_a_coarse_fixed_step_makes_energy() -> None:
    """What the paper's Fig. 8 shows for the undamped law is the integrator's doing."""
    problem = MechanismSystem(make("ke")).problem(1.0)
    y, rate, step = problem.y0.copy(), np.empty(problem.y0.size), 2e-6
    deepest = 0.0
    for k in range(500):
        problem.functions.rhs(k * step, y, problem.data, problem.memory, rate)
        y += step * rate
        deepest = max(deepest, float(np.hypot(y[0], y[1])))
    assert deepest > 20e-6  # beyond the clearance; a converged run peaks at 18.376 µm
