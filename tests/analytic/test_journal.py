"""The journal against what can be worked out by hand: frequencies, symmetries, balances, limits."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from tribodyn.contact import SurfacePair, law, tabulate
from tribodyn.core.arrays import FloatArray
from tribodyn.core.problem import Problem
from tribodyn.integrate import integrate
from tribodyn.joints import BushingJoint
from tribodyn.kernels.journal.functions import jac, rhs, static_residual
from tribodyn.kernels.journal.quantities import OBSERVED
from tribodyn.lubrication import Film, FilmGrid, Roughness
from tribodyn.mechanisms.journal.equilibrium import equilibrium
from tribodyn.mechanisms.journal.parameters import Journal, Loads
from tribodyn.mechanisms.journal.problem import journal_data, journal_memory, journal_problem

ATOL = (1e-11, 1e-9, 1e-7, 1e-5)
TIGHT = (1e-15, 1e-13, 1e-11, 1e-9)
MASS, TRANSVERSE, SPIN = 0.253, 5.41e-4, 4.55e-6
LOAD = (200.0, 100.0)
FILM = Film(0.01, 20e-6, 6e-3, 20e-3, Roughness((0.392e-6, 1.586e-6)), grid=FilmGrid(96, 16))

MakeJournal = Callable[..., Journal]


@pytest.fixture(scope="module")
def make_journal(make_joint: Callable[..., BushingJoint], table_1_pair: SurfacePair) -> MakeJournal:
    """Return a maker of the journal of section 4."""
    tables = {name: tabulate(law(name, table_1_pair)) for name in ("rsdc", "ke")}

    def make(
        name: str = "rsdc",
        *,
        load: tuple[float, ...] = LOAD,
        speed: float = 0.0,
        tilts: bool = False,
        film: Film | None = None,
        coefficient: float = 0.0,
        spin: float = SPIN,
    ) -> Journal:
        joint = make_joint(coefficient=coefficient, table=tables[name])
        return Journal(MASS, TRANSVERSE, spin, tilts, speed, Loads(*load), joint, film)

    return make


def run(problem: Problem, duration: float, rows: int, **options: object) -> dict[str, FloatArray]:
    """Integrate and return observed columns and ``t``."""
    solution = integrate(problem, output_times=np.linspace(0.0, duration, rows), **options)
    assert solution.complete, solution.failure
    return {"t": solution.t, **{name: solution.rows[:, k] for k, name in enumerate(OBSERVED)}}


def residual(columns: dict[str, FloatArray]) -> FloatArray:
    """Return what the energy ledger misses [J]."""
    stored = columns["energy_kinetic"] + columns["energy_contact"]
    heats = columns["heat_damping"] - columns["work_friction"] - columns["work_film"]
    missed = stored - stored[0] + heats - columns["work_loads"] - columns["work_drive"]
    return np.asarray(missed)


JOURNALS = {
    "dry": {},
    "dry, turning, tilting": {"speed": 120.0, "tilts": True, "coefficient": 0.2, "spin": 3e-4},
    "oil": {"film": FILM},
    "oil, turning, tilting": {"film": FILM, "speed": 300.0, "tilts": True, "coefficient": 0.1, "spin": 3e-4},
}


@pytest.mark.parametrize("options", JOURNALS.values(), ids=JOURNALS)
def test_jacobian_is_the_derivative_of_the_rate(
    make_journal: MakeJournal, options: dict[str, object]
) -> None:
    journal = make_journal(**options)
    data = journal_data(journal)
    memory = journal_memory(journal, data)
    memory.joint.entry_velocity[:] = 0.05  # every node remembers: the law is smooth in the state
    n = journal.freedoms
    y = np.array([13.1e-6, 6.3e-6, 2e-5, -3e-5, 2e-3, 1.5e-3, 1e-2, 2e-2])[[*range(n), *range(4, 4 + n)]]
    steps = np.array([1e-10, 1e-10, 1e-8, 1e-8, 1e-7, 1e-7, 1e-6, 1e-6])[[*range(n), *range(4, 4 + n)]]
    f, jacobian = np.empty(2 * n), np.empty((2 * n, 2 * n))
    jac(0.0, y, data, memory, f, jacobian)
    for k, step in enumerate(steps):
        ahead, behind = np.empty(2 * n), np.empty(2 * n)
        shift = step * np.eye(2 * n)[k]
        rhs(0.0, y + shift, data, memory, ahead)
        rhs(0.0, y - shift, data, memory, behind)
        difference = (ahead - behind) / (2.0 * step)
        # Central differences of steps this small are good to some 1e-5 of the largest entry of the column.
        assert jacobian[:, k] == pytest.approx(difference, rel=1e-4, abs=2e-5 * np.abs(difference).max())


def test_small_oscillation_has_the_frequency_of_the_linearised_stiffness(make_journal: MakeJournal) -> None:
    journal = make_journal("ke")
    data = journal_data(journal)
    memory = journal_memory(journal, data)
    q = equilibrium(journal).attitude[:2]
    load, stiffness = np.empty(2), np.empty((2, 2))
    static_residual(q, data, memory, load, stiffness)
    radial = np.asarray(journal.loads.direction)
    omega = math.sqrt(-float(radial @ stiffness @ radial) / MASS)
    assert np.abs(load).max() < 1e-6
    periods, rows = 20, 8001
    duration = periods * 2.0 * math.pi / omega
    # A hundredth of a nanometre: anharmonic by (5e-12 m over σ/3) squared, far below the tolerance.
    problem = journal_problem(journal, duration=duration, start=q + 1e-11 * radial, atol=TIGHT)
    columns = run(problem, duration, rows, rtol=1e-8)
    along = np.stack([columns["e_x"], columns["e_y"]], axis=1) @ radial - float(q @ radial)
    up = np.flatnonzero((along[:-1] < 0.0) & (along[1:] >= 0.0))
    crossings = columns["t"][up] - along[up] * np.diff(columns["t"])[up] / (along[up + 1] - along[up])
    assert crossings.size == periods
    found = 2.0 * math.pi * (periods - 1) / (crossings[-1] - crossings[0])
    assert found == pytest.approx(omega, rel=1e-4)


@pytest.mark.parametrize(
    "options", [{}, {"film": FILM, "speed": 80.0, "coefficient": 0.1}], ids=["dry", "oil"]
)
def test_a_turned_load_turns_the_equilibrium(make_journal: MakeJournal, options: dict[str, object]) -> None:
    # By a multiple of the spacing of both grids, so that nothing but the load is turned.
    angle = 2.0 * math.pi * 7 / 96
    turn = np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
    before = equilibrium(make_journal(**options)).attitude[:2]
    after = equilibrium(make_journal(load=tuple(turn @ LOAD), **options)).attitude[:2]
    assert after == pytest.approx(turn @ before, abs=1e-12)


# By a right angle the integrator does the same work: rounding, grown in impacts, remains; 1.1e-11 is the most
# of ten neighbouring tolerances. By another angle its error weighs X and Y otherwise, steps differ, and with
# them the instants of entry.
@pytest.mark.parametrize(("nodes", "apart"), [(24, 1e-10), (7, 2e-7)])
def test_a_turned_load_turns_the_motion(make_journal: MakeJournal, nodes: int, apart: float) -> None:
    angle = 2.0 * math.pi * nodes / 96
    turn = np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
    paths = []
    for load in (LOAD, tuple(turn @ LOAD)):
        columns = run(journal_problem(make_journal(load=load), duration=2e-3, atol=ATOL), 2e-3, 101)
        paths.append(np.stack([columns["e_x"], columns["e_y"]]))
    assert np.abs(paths[1] - turn @ paths[0]).max() < apart


def test_a_spinning_journal_precesses_as_a_free_gyroscope(make_journal: MakeJournal) -> None:
    speed, spin = 2000.0, 3e-4
    journal = make_journal(load=(0.0, 0.0), speed=speed, tilts=True, spin=spin)
    problem = journal_problem(journal, duration=4e-3, atol=TIGHT)
    rate = 0.02
    problem.y0[6] = rate
    columns = run(problem, 4e-3, 41, rtol=1e-8)
    # J φ̈_x = J_z ω φ̇_y, J φ̈_y = −J_z ω φ̇_x: the rates turn in a circle at J_z ω/J.
    phase = spin * speed / TRANSVERSE * columns["t"]
    assert columns["phi_x_dot"] == pytest.approx(rate * np.cos(phase), abs=1e-5 * rate)
    assert columns["phi_y_dot"] == pytest.approx(-rate * np.sin(phase), abs=1e-5 * rate)


def test_moments_of_the_load_tilt_the_journal_to_their_side(make_journal: MakeJournal) -> None:
    for load, index in (((*LOAD, 0.3, 0.0), 2), ((*LOAD, 0.0, 0.3), 3)):
        tilted = equilibrium(make_journal(load=load, tilts=True))
        assert tilted.attitude[index] > 1e-5
        assert tilted.contact[:4] == pytest.approx(-np.array(load), abs=1e-6)


@pytest.mark.parametrize("options", JOURNALS.values(), ids=JOURNALS)
def test_the_ledger_closes_and_heats_only_grow(make_journal: MakeJournal, options: dict[str, object]) -> None:
    journal = replace(make_journal(**options), loads=Loads(*LOAD, 0.1, -0.05))
    duration = 12e-3 if journal.film else 3e-3
    columns = run(journal_problem(journal, duration=duration, atol=ATOL), duration, 301, rtol=1e-5)
    scale = np.abs(columns["work_loads"]).max()
    assert np.abs(residual(columns)).max() < 1e-3 * scale
    for heat in (columns["heat_damping"], -columns["work_friction"], -columns["work_film"]):
        # Damping gives some of its work back only where the clip of tensile pressure allows it: never.
        assert np.diff(heat).min() >= -1e-6 * scale


def test_a_coarse_fixed_step_makes_energy(make_journal: MakeJournal) -> None:
    """What the paper's Fig. 8 shows for the undamped law is the integrator's doing."""
    problem = journal_problem(make_journal("ke"), duration=1.0, atol=ATOL)
    y, rate, step = problem.y0.copy(), np.empty(4), 2e-6
    deepest = 0.0
    for k in range(500):
        problem.functions.rhs(k * step, y, problem.data, problem.memory, rate)
        y += step * rate
        deepest = max(deepest, float(np.hypot(y[0], y[1])))
    assert deepest > 20e-6  # beyond the clearance; a converged run peaks at 18.376 µm
