"""Where the manual says that the paper is wrong, in numbers: docs/theory/errata.md and energy.md."""

import math
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import simpson

from tribodyn.contact import RSDC, law, tabulate
from tribodyn.kernels.vsv import functions
from tribodyn.kernels.vsv.data import E_X, PHI_Y
from tribodyn.papers.cheng_2022.reduced.problem import vsv_data, vsv_memory
from tribodyn.papers.cheng_2022.reduced.reach import ideal_vane_angle

CRANK = np.radians([-16.0, -10.0, 5.0, 24.0])


@pytest.fixture(scope="module")
def lengths(make_vsv):
    return make_vsv().lengths


def drag_link(lengths, crank):
    """Return S_1, S_2 − S_1 in the crank's frame, θ_sz and θ_sx (near zero, as the paper has it), and θ_b."""
    vane = float(ideal_vane_angle(lengths, np.array([crank]))[0])
    ring = math.atan2(-lengths.l_4 * math.cos(vane), lengths.l_3)
    pivot = lengths.l_m * np.array([math.cos(lengths.gamma), 0.0, math.sin(lengths.gamma)])
    s_1 = pivot + lengths.l_1 * np.array([-math.sin(crank), 0.0, math.cos(crank)])
    arm = lengths.phi - ring
    s_2 = np.array(
        [lengths.l_3 * math.sin(arm), lengths.l_4 * (math.sin(vane) - 1.0), lengths.l_3 * math.cos(arm)]
    )
    along = s_2 - s_1
    x = along @ [math.cos(crank), 0.0, math.sin(crank)]
    z = along @ [-math.sin(crank), 0.0, math.cos(crank)]
    theta_sx = math.atan(along[1] / x)
    theta_sz = math.atan2(x / math.cos(theta_sx), z)
    return s_1, s_2, (x, along[1], z), theta_sz, theta_sx, ring


@pytest.mark.parametrize("crank", CRANK)
def test_eq_56_has_the_angle_of_the_pivot(lengths, crank):
    _, _, (x, _, _), theta_sz, theta_sx, ring = drag_link(lengths, crank)
    assert lengths.l_2 * math.sin(theta_sz) * math.cos(theta_sx) == pytest.approx(x, rel=1e-12)
    reach = lengths.l_3 * math.sin(crank - ring + lengths.phi)
    assert reach - lengths.l_m * math.cos(crank - lengths.gamma) == pytest.approx(x, rel=1e-12)
    # As printed the drag link would reach a tenth of a metre and more too far.
    assert 0.05 < abs(reach - lengths.l_m * math.cos(crank - lengths.phi) - x) < 0.25


def test_the_arcsine_of_eq_56_loses_the_quadrant(lengths):
    angles = np.degrees([abs(drag_link(lengths, crank)[3]) for crank in CRANK])
    assert angles[0] == pytest.approx(109.1, abs=0.1)
    assert angles[-1] == pytest.approx(51.8, abs=0.1)


@pytest.mark.parametrize("crank", CRANK)
def test_height_of_the_drag_link_s_centre(lengths, crank):
    s_1, s_2, _, theta_sz, theta_sx, _ = drag_link(lengths, crank)
    start = lengths.l_m * math.sin(lengths.gamma) + lengths.l_1 * math.cos(crank)
    start += 0.5 * lengths.l_2 * math.cos(theta_sz) * math.cos(crank)
    across = 0.5 * lengths.l_2 * math.sin(theta_sz) * math.sin(crank)
    centre = 0.5 * (s_1 + s_2)[2]
    assert start + across * math.cos(theta_sx) == pytest.approx(centre, rel=1e-12)
    # As printed, with its θ_sx near zero, millimetres off.
    assert abs(start - across - centre) > 5e-3


def test_inertia_moment_of_the_drag_link():
    # On a cone of half angle θ_sz, turned steadily: |n × n̈| = sin θ_sz cos θ_sz ω². Printed is θ_sz ω².
    theta, omega, step = math.radians(70.0), 1.3, 1e-3
    phase = omega * step * np.arange(-1, 2)
    n = np.stack(
        [math.sin(theta) * np.cos(phase), math.sin(theta) * np.sin(phase), np.full(3, math.cos(theta))]
    )
    bend = (n[:, 2] - 2.0 * n[:, 1] + n[:, 0]) / step**2
    size = np.linalg.norm(np.cross(n[:, 1], bend))
    # Second differences: 1e-6 of the size by their step, 1e-10 by rounding.
    assert size == pytest.approx(math.sin(theta) * math.cos(theta) * omega**2, rel=1e-5)
    assert theta * omega**2 > 3.0 * size


def test_work_that_counts_twice(table_1_pair):
    pair = RSDC(table_1_pair)
    h = np.array([1.0])
    elastic, plastic = (float(work[0]) for work in pair.works(h))
    # P_k has each part once: its work from far apart is its integral.
    grid = np.linspace(1.0, 8.0, 2001)
    once = float(simpson(pair.stiffness_pressure(grid), x=grid))
    assert (elastic + plastic) / once == pytest.approx(1.956, abs=5e-4)
    twice = elastic + plastic - once
    # All of what counts twice recovered, or all of it lost.
    assert math.sqrt(elastic / once) == pytest.approx(0.98, abs=5e-3)
    assert math.sqrt((elastic - twice) / once) == pytest.approx(0.01, abs=5e-3)


@pytest.mark.parametrize("harder", [1.0, 2.0, 4.0])
def test_restitution_says_nothing_of_the_surface(table_1_pair, harder):
    pair = replace(table_1_pair, hardness=harder * table_1_pair.hardness)
    assert RSDC(pair).meant_restitution(np.array([2.0]))[0] == pytest.approx(math.sqrt(0.5), abs=0.021)


def test_numbers_of_the_tables(make_vsv, table_1_pair):
    m, of = make_vsv().inertias, make_vsv().lengths
    for mass, length, inertia in ((m.m_1, of.l_1, m.J_1), (m.m_2, of.l_2, m.J_2), (m.m_v, of.l_v, m.J_v)):
        assert f"{mass * length**2 / 3.0:.2e}" == f"{inertia:.2e}"
    assert f"{2.0 * m.m_3 * of.l_3**2 / 3.0:.2e}" == "7.19e-02"
    assert f"{m.J_3:.2e}" == "7.20e-02"
    # A Vickers number is a force in kgf over an area in mm²: 65 HV are 637 MPa.
    assert 65.0 * 9.80665e6 / table_1_pair.hardness == pytest.approx(637.0 / 492.0, rel=1e-3)


@pytest.fixture(scope="module")
def conservative(make_vsv, table_1_pair):
    """Return a maker of the mechanism with neither friction nor damping, and its memory."""

    def make(formulation):
        table = tabulate(law("ke", table_1_pair))
        vsv = make_vsv(formulation, friction="moment", coefficient=0.0, table=table)
        data = vsv_data(vsv)
        return data, vsv_memory(data)

    return make


def accelerations_by_force(data, memory):
    """Return A of q̈ = A F with the trunnion centred at t = 0, lengths in units of 10 mm for the tilts."""
    f = np.empty(8)
    functions.rhs(0.0, np.zeros(8), data, memory, f)
    mass, test = memory.scratch.mass[1:5], memory.scratch.test[E_X : PHI_Y + 1, 1:5]
    scale = np.array([1.0, 1.0, 0.01, 0.01])
    return scale[:, None] * np.linalg.solve(mass, test.T) * scale


def test_only_exact_comes_from_a_virtual_work(conservative):
    exact = accelerations_by_force(*conservative("exact"))
    assert_allclose(exact, exact.T, rtol=0.0, atol=1e-12 * np.abs(exact).max())


@pytest.mark.parametrize(
    ("formulation", "x_by_y", "y_by_x"), [("paper", -3.24, 0.11), ("printed", -5.88, 0.15)]
)
def test_equations_that_come_from_no_virtual_work(conservative, formulation, x_by_y, y_by_x):
    found = accelerations_by_force(*conservative(formulation))
    assert found[0, 1] == pytest.approx(x_by_y, abs=0.005)
    assert found[1, 0] == pytest.approx(y_by_x, abs=0.005)


def growths(data, memory, n=400):
    """Return how fast the undamped motion grows [1/s] from attitudes in contact drawn at random."""
    random, f, jacobian = np.random.default_rng(1), np.empty(8), np.empty((8, 8))
    found = []
    for _ in range(n):
        y = np.zeros(8)
        y[2:4] = 1.5e-3 * random.uniform(-1.0, 1.0, 2) * random.uniform()
        angle = random.uniform(0.0, 2.0 * math.pi)
        distance = data.joint.clearance + random.uniform(-2.0, 1.0) * data.joint.roughness
        y[:2] = distance * math.cos(angle), distance * math.sin(angle)
        functions.jac(0.0, y, data, memory, f, jacobian)
        found.append(float(np.linalg.eigvals(jacobian).real.max()))
    return np.array(found)


@pytest.mark.parametrize("formulation", ["paper", "printed"])
def test_equations_that_make_energy(conservative, formulation):
    # Frequencies are some 1e4 1/s: a growth of 1 1/s is rounding, one of 1e4 1/s is not.
    assert growths(*conservative("exact")).max() < 1.0
    found = growths(*conservative(formulation))
    assert found.max() > 1e4
    assert np.mean(found > 1.0) == pytest.approx(
        {"paper": 1.0 / 7.0, "printed": 1.0 / 10.0}[formulation], abs=0.02
    )
