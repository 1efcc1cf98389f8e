"""Where Appendix 2 of the source paper is wrong, each found anew: docs/theory/errata.md."""

import math
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from tests.literature.elimination import (
    MENDED,
    equations,
    height_of_link,
    instant,
    link_angles,
    link_moments,
    par_x2,
    ring_arms,
)

from tribodyn.kernels.vsv import data as layout
from tribodyn.kernels.vsv import functions
from tribodyn.mechanisms.catalogue import load_case
from tribodyn.papers.cheng_2022.reduced.problem import vsv_data, vsv_memory
from tribodyn.simulation import simulate

PAGE = Path(__file__).parents[2] / "docs" / "theory" / "errata.md"
CENTRED = np.zeros(8)


@pytest.fixture(scope="module")
def make_now(make_vsv):
    """Return a maker of instants of the mechanism in ``paper``, the trunnion centred."""
    vsv = make_vsv("paper")
    data = vsv_data(vsv)

    def make(t):
        return instant(vsv, data, vsv_memory(data), t, CENTRED)

    return make


def test_the_page_names_every_mended_entry():
    text = PAGE.read_text(encoding="utf-8")
    table = text.partition("## What `paper` mends of Eq. 46")[2].partition("\n## ")[0]
    named = [line.split("|")[1].strip(" `") for line in table.splitlines() if line.startswith("| `")]
    assert named == list(MENDED)


@pytest.mark.parametrize("t", [0.4, 2.0])
def test_a_12_and_a_42_have_the_mass_of_the_ring(make_now, t):
    # Eqs. 33, 39 and 43: the ring follows e_y with all of m_3. Printed are m_2/2 and m_3/2 in its place.
    now = make_now(t)
    a, _ = equations(now)
    m, x = now.vsv.inertias, now.vsv.lengths.l_4 * math.cos(now.v[0])
    loc_4 = 0.5
    assert a[0, 1] == pytest.approx(-(0.5 * m.m_2 * loc_4 + m.m_3 + m.m_v), rel=1e-12)
    assert a[3, 1] == pytest.approx(-x * (0.5 * m.m_2 * loc_4 + m.m_3), rel=1e-9)


def rod(angles, crank):
    """Return crank and drag link in motion: θ_sz, θ_sx (and θ_a) with two derivatives, as columns."""
    (z, x), (z_1, x_1), (z_2, x_2) = angles
    cz, sz, cx, sx = math.cos(z), math.sin(z), math.cos(x), math.sin(x)
    m = np.array([sz * cx, sz * sx, cz])
    along_z, along_x = np.array([cz * cx, cz * sx, -sz]), np.array([-sz * sx, sz * cx, 0.0])
    zz, zx, xx = -m, np.array([-cz * sx, cz * cx, 0.0]), np.array([-sz * cx, -sz * sx, 0.0])
    m_1 = along_z * z_1 + along_x * x_1
    m_2 = along_z * z_2 + along_x * x_2 + zz * z_1**2 + 2.0 * zx * z_1 * x_1 + xx * x_1**2
    a, a_1, a_2 = crank
    c, s = math.cos(a), math.sin(a)
    back = np.array([[c, 0.0, -s], [0.0, 1.0, 0.0], [s, 0.0, c]])
    turn = np.array([[-s, 0.0, -c], [0.0, 0.0, 0.0], [c, 0.0, -s]])
    bend = np.array([[-c, 0.0, s], [0.0, 0.0, 0.0], [-s, 0.0, -c]])
    n_1 = back @ m_1 + turn @ m * a_1
    n_2 = back @ m_2 + 2.0 * turn @ m_1 * a_1 + turn @ m * a_2 + bend @ m * a_1**2
    return SimpleNamespace(n=np.array([back @ m, n_1, n_2]), a=np.asarray(crank))


@pytest.fixture
def drawn(make_vsv):
    """Return six random motions of crank and drag link, with their angles."""
    random, found = np.random.default_rng(3), []
    for _ in range(6):
        angles = random.uniform(-1.0, 1.0, (3, 2)) + np.array([[1.2, 0.0], [0.0, 0.0], [0.0, 0.0]])
        now = rod(angles, random.uniform(-1.0, 1.0, 3))
        now.vsv = make_vsv("paper")
        found.append((now, angles))
    return found


def off(printed, right):
    """Return the largest error over the size of what is right."""
    return max(abs(one - two) / abs(two) for one, two in zip(printed, right, strict=True))


def test_acceleration_of_the_drag_link_along_x(drawn):
    l_1, half = drawn[0][0].vsv.lengths.l_1, 0.5 * drawn[0][0].vsv.lengths.l_2
    right = [
        -l_1 * (now.a[2] * math.cos(now.a[0]) - now.a[1] ** 2 * math.sin(now.a[0])) + half * now.n[2, 0]
        for now, _ in drawn
    ]
    assert off([par_x2(now, angles, mended=True) for now, angles in drawn], right) < 1e-12
    assert off([par_x2(now, angles, mended=False) for now, angles in drawn], right) > 5.0
    # The factor l_2/2 and the signs of the terms in l_1 alone do not mend it: sine and cosine are exchanged.
    signs = [
        par_x2(now, angles, mended=True)
        - l_1 * now.a[2] * (math.sin(now.a[0]) - math.cos(now.a[0]))
        - l_1 * now.a[1] ** 2 * (math.cos(now.a[0]) + math.sin(now.a[0]))
        for now, angles in drawn
    ]
    assert off(signs, right) > 1.0
    # Nor without the factor 2 of θ̇_sz θ̇_a cos θ_a sin θ_sz.
    single = [
        par_x2(now, angles, mended=True)
        - half * angles[1][0] * now.a[1] * math.cos(now.a[0]) * math.sin(angles[0][0])
        for now, angles in drawn
    ]
    assert off(single, right) > 0.05


def test_acceleration_of_the_drag_link_along_z(drawn):
    right = [height_of_link(now, angles, mended=True) for now, angles in drawn]
    assert off([height_of_link(now, angles, mended=False) for now, angles in drawn], right) > 0.1


def ratios(angle, crank):
    """Return printed over true M_2xi, M_2yi and M_2zi for a small θ_sz; Eq. 30 is about −Y."""
    (z, x), (z_1, x_1), (z_2, x_2) = angles = np.array([[angle, 0.7], [0.3, -0.4], [0.5, 0.9]])
    now = rod(angles, crank)
    right = np.cross(now.n[0], now.n[2]) * [-1.0, 1.0, -1.0]
    swing, cone = 2.0 * z_1 * x_1 + x_2 * z, z_2 - z * x_1**2
    both, bent = z_1 + crank[1], z_2 + crank[2]
    printed = [
        -(swing * math.cos(x) + cone * math.sin(x)),
        -(swing * math.sin(x) - cone * math.cos(x)),
        -(
            (2.0 * both * x_1 + bent * x) * math.cos(z + crank[0])
            + (x_2 - x * both**2) * math.sin(z + crank[0])
        ),
    ]
    return np.array(printed) / right


def test_inertia_moments_of_the_drag_link_for_a_small_angle():
    # M_2xi has the opposite sign, M_2yi is right, with the crank at rest at θ_a = 0.
    still = ratios(1e-5, (0.0, 0.0, 0.0))
    assert still[:2] == pytest.approx([-1.0, 1.0], rel=1e-3)
    # With the crank in motion M_2yi is not; M_2zi has θ_sx as its radius, which θ_sz does not make small.
    assert abs(ratios(1e-5, (0.3, 0.4, 0.2))[1] - 1.0) > 0.05
    assert [abs(ratios(angle, (0.0, 0.0, 0.0))[2]) > 1e-2 / angle for angle in (1e-3, 1e-4)] == [True, True]


def test_m_2yi_of_the_mechanism(make_now):
    found = []
    for t in np.linspace(0.2, 3.0, 8):
        now = make_now(t)
        right, printed = (link_moments(now, link_angles(now), mended)[0] for mended in (True, False))
        found.append(abs(printed / right - 1.0))
    assert np.median(found) > 0.3


@pytest.mark.parametrize(
    ("crank", "ring", "link"),
    [(-16.0, (-0.02, 0.58), (-0.02, 0.29)), (0.228, (0.0, 0.0), None), (24.0, (0.01, -0.56), (0.02, -0.28))],
)
def test_what_follows_e_x_by_the_closure(make_vsv, crank, ring, link):
    # Appendix 2 has e_x/2 in x_O2 and x_O3 and nothing in y_O3.
    vsv = make_vsv("exact")
    data = vsv_data(vsv)
    memory = vsv_memory(data)
    t = math.acos(1.0 - (crank + 16.0) / 20.0)
    functions.rhs(t, CENTRED, data, memory, np.empty(8))
    by_e_x = memory.scratch.motion[:, 1 + 0]
    assert by_e_x[[layout.O3_X, layout.O3_Y]] == pytest.approx(ring, abs=0.006)
    assert abs(by_e_x[layout.O2_X]) < 0.05
    if link is not None:
        assert by_e_x[layout.O2_Y] == pytest.approx(link[1], abs=0.006)


def test_where_the_lever_meets_the_ring(make_now):
    # Part 3 has S_3 at l_3 from the axis; the ball slides along the pin to l_3 + h_2.
    out = []
    for t in np.linspace(0.0, math.pi, 50):
        now = make_now(t)
        s_3, b = ring_arms(now, True)[2], ring_arms(now, True)[1]
        out.append(np.hypot(*(s_3 - b)) - now.vsv.lengths.l_3)
    assert max(out) == pytest.approx(0.79e-3, abs=0.01e-3)


def test_the_angles_of_eq_56_jump_as_printed(make_now):
    reach = []
    for t in np.linspace(0.0, math.pi, 9):
        now = make_now(t)
        of = now.vsv.lengths
        along = of.l_3 * math.sin(now.a[0] - now.b[0] + of.phi)
        reach.append([along - of.l_m * math.cos(now.a[0] - angle) for angle in (of.phi, of.gamma)])
    printed, right = np.sign(reach).T
    # Where the denominator passes zero its arctangent goes from -90° to 90°.
    assert set(printed) == {-1.0, 1.0}
    assert set(right) == {-1.0}


def test_inertia_of_the_ring(make_vsv):
    # Two arms of mass m_3 together have m_3 l_3²/3 about B. Printed is twice that: either m_3 is one arm.
    m, of = make_vsv().inertias, make_vsv().lengths
    assert m.J_3 / (m.m_3 * of.l_3**2 / 3.0) == pytest.approx(2.0, abs=0.005)


def test_the_boundary_of_eq_52_would_leave_no_film():
    # p_o = 0 "for z in (0, l_z)" is everywhere between the ends; at the ends alone the film carries.
    run = simulate(load_case("journal-oil").replace({"run.duration": "1 ms"}))
    film = np.linalg.norm(run["film_force"].values[:, 0], axis=1)
    assert film.max() > 0.5 * math.hypot(200.0, 100.0)


def test_the_lower_limit_of_eq_8_leaves_out_the_contact_of_this_mechanism(vsv_run):
    # Counted from where the mean planes meet, δ is below zero in all of the smooth motion.
    run = vsv_run("paper")
    quiet = np.mod(run["t"], math.pi) > 0.31
    assert (run["separation_min"][quiet] > 0.0).all()
