"""The journal against what can be worked out by hand: frequencies, symmetries, balances, limits."""

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import tribodyn as td
from tribodyn.core.arrays import FloatArray
from tribodyn.core.problem import Problem
from tribodyn.integrate import integrate
from tribodyn.joints.bushing import joint_jacobian, joint_wrench
from tribodyn.kernels.mechanism.data import TURNING
from tribodyn.mechanism.mechanism_variables import observed
from tribodyn.presets.journal.equilibrium import Loads, equilibrium
from tribodyn.presets.journal.results import named_as_printed
from tribodyn.presets.journal.system import journal_of, system_of

TIGHT = {
    "solver.rtol": 1e-8,
    "solver.atol.position": "1e-15 m",
    "solver.atol.tilt": "1e-13 rad",
    "solver.atol.velocity": "1e-11 m/s",
    "solver.atol.tilt_rate": "1e-9 rad/s",
}
MASS, TRANSVERSE, SPIN = 0.253, 5.41e-4, 4.55e-6
LOAD = (200.0, 100.0)
_NEWTONS = ("force_x", "force_y")


def make(
    name: str = "rsdc",
    *,
    load: tuple[float, ...] = LOAD,
    speed: float = 0.0,
    tilts: bool = False,
    oil: bool = False,
    coefficient: float = 0.0,
    spin: float = SPIN,
    **others: object,
) -> Any:
    """Return a case of the journal of section 4; keys of ``others`` have ``__`` for dots."""
    keys = dict(zip((*_NEWTONS, "moment_x", "moment_y"), load, strict=False))
    loads = {f"loads.{key}": f"{value!r} {'N' if key in _NEWTONS else 'N m'}" for key, value in keys.items()}
    return td.load_case("journal-oil" if oil else "journal-dry").replace(
        {
            "contact.law": name,
            "journal.speed": f"{speed!r} rad/s",
            "journal.tilt": tilts,
            "journal.spin_inertia": f"{spin!r} kg m^2",
            "joint.friction_coefficient": coefficient,
            **loads,
            **{key.replace("__", "."): value for key, value in others.items()},
        }
    )


def run(case: Any, duration: float, rows: int, *, problem: Problem | None = None) -> dict[str, FloatArray]:
    """Integrate and return observed columns and ``t``."""
    system = system_of(case)
    problem = system.problem(duration) if problem is None else problem
    solution = integrate(problem, output_times=np.linspace(0.0, duration, rows), rtol=case.solver.rtol)
    assert solution.complete, solution.failure
    found = observed(solution.rows, 1)
    printed = named_as_printed(found.couplings, tilts=case.journal.tilt)
    loads = found.couplings["joint_work"][:, len(system.case.joints) :].sum(axis=1)
    rates = found.couplings["relative_rate"][:, 0]
    return {"t": solution.t, **found.whole, **printed, "work_loads": loads, "rates": rates}


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
    journal = journal_of(case)
    attitude = equilibrium(journal).attitude
    data, state = journal.joint.data(), np.append(attitude, np.zeros(4))
    load, stiffness = joint_wrench(data, state)[:2] + LOAD, joint_jacobian(data, state)[:2, :2]
    radial, q = np.asarray(journal.loads.direction), attitude[:2]
    omega = math.sqrt(-float(radial @ stiffness @ radial) / MASS)
    assert np.abs(load).max() < 1e-6
    periods, rows = 20, 8001
    duration = periods * 2.0 * math.pi / omega
    # A hundredth of a nanometre: anharmonic by (5e-12 m over σ/3) squared, far below the tolerance.
    x, y = (q + 1e-11 * radial).tolist()
    begun = case.replace({"run.start_x": f"{x!r} m", "run.start_y": f"{y!r} m"})
    columns = run(begun, duration, rows)
    along = np.stack([columns["e_x"], columns["e_y"]], axis=1) @ radial - float(q @ radial)
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
    journal = journal_of(make(**options))
    before = equilibrium(journal).attitude[:2]
    after = equilibrium(replace(journal, loads=Loads(*(turn @ LOAD)))).attitude[:2]
    assert after == pytest.approx(turn @ before, abs=1e-12)


# By a right angle the integrator does the same work: rounding remains, which impacts magnify. Over 40
# neighbouring tolerances it stays below 4e-15 m in the first half millisecond, and reaches 4e-9 m in all. By
# another angle its error weighs X and Y otherwise, steps differ, and with them the instants of entry.
@pytest.mark.parametrize(("nodes", "at_first", "apart"), [(24, 1e-13, 2e-8), (7, 2e-7, 2e-7)])
def test_a_turned_load_turns_the_motion(nodes: int, at_first: float, apart: float) -> None:
    angle = 2.0 * math.pi * nodes / 96
    turn = np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
    paths = []
    for load in (LOAD, tuple((turn @ LOAD).tolist())):
        columns = run(make(load=load), 2e-3, 101)
        paths.append(np.stack([columns["e_x"], columns["e_y"]]))
    missed = np.abs(paths[1] - turn @ paths[0]).max(axis=0)
    assert missed[:25].max() < at_first
    assert missed.max() < apart


def test_a_spinning_journal_precesses_as_a_free_gyroscope() -> None:
    speed, spin, rate = 2000.0, 3e-4, 0.02
    case = make(load=(0.0, 0.0), speed=speed, tilts=True, spin=spin, **TIGHT)
    problem = system_of(case).problem(4e-3)
    problem.y0[TURNING] = rate
    columns = run(case, 4e-3, 41, problem=problem)
    # J φ̈_x = J_z ω φ̇_y, J φ̈_y = −J_z ω φ̇_x: the rates turn in a circle at J_z ω/J.
    phase = spin * speed / TRANSVERSE * columns["t"]
    # Of a leaning axis the rotation about it has parts across the bushing.
    across = columns["rates"][:, :2] - columns["rates"][:, 2:] * np.tan(
        np.stack([-columns["phi_y"], -columns["phi_x"]], axis=1) * [1.0, 1.0]
    )
    assert across[:, 0] == pytest.approx(rate * np.cos(phase), abs=1e-5 * rate)
    assert across[:, 1] == pytest.approx(rate * np.sin(phase), abs=1e-5 * rate)


def test_moments_of_the_load_tilt_the_journal_to_their_side() -> None:
    journal = journal_of(make(tilts=True))
    for load, index in (((*LOAD, 0.3, 0.0), 2), ((*LOAD, 0.0, 0.3), 3)):
        tilted = equilibrium(replace(journal, loads=Loads(*load)))
        assert tilted.attitude[index] > 1e-5
        assert tilted.contact[:4] == pytest.approx(-np.array(load), abs=1e-6)


@pytest.mark.parametrize("options", JOURNALS.values(), ids=JOURNALS)
def test_the_energy_balance_closes_and_heats_only_grow(options: dict[str, Any]) -> None:
    duration = 12e-3 if "oil" in options else 3e-3
    columns = run(make(load=(*LOAD, 0.1, -0.05), **options), duration, 301)
    scale = np.abs(columns["work_loads"]).max()
    assert np.abs(residual(columns)).max() < 1e-3 * scale
    for heat in (columns[f"heat_{name}"] for name in ("damping", "friction", "film")):
        # Damping gives some of its work back only where the clip of tensile pressure allows it: never.
        assert np.diff(heat).min() >= -1e-6 * scale


def test_a_coarse_fixed_step_makes_energy() -> None:
    """What the paper's Fig. 8 shows for the undamped law is the integrator's doing."""
    problem = system_of(make("ke")).problem(1.0)
    y, rate, step = problem.y0.copy(), np.empty(problem.y0.size), 2e-6
    deepest = 0.0
    for k in range(500):
        problem.functions.rhs(k * step, y, problem.data, problem.memory, rate)
        y += step * rate
        deepest = max(deepest, float(np.hypot(y[0], y[1])))
    assert deepest > 20e-6  # beyond the clearance; a converged run peaks at 18.376 µm
