"""Films against the tables of Butenschön (Karlsruhe 1976) for a full bearing, rotation and squeeze.

The tables were made with p = 0 on the line of maximum gap (`groove`), and reached us through the acceptance
test of a public multibody code, which asks for 3 % in the load. Here: load and squeeze 1 %, attitude 0.5°.
Errors found on 256 × 32: load 0.14 %, attitude 0.09°, side flow 0.45 %, squeeze 0.4 %.
"""

import math

import numpy as np
import pytest

from tribodyn.lubrication import Film, FilmGrid, FilmState, film_equilibrium, film_state

ETA, CLEARANCE, RADIUS, OMEGA = 0.01, 5e-6, 5e-3, 100.0
WIDTHS = (1.0, 0.5, 0.25)  #: B/D of the columns.

#: ε: So, β [°] and Q for each B/D.
ROTATION = {
    0.1: ((0.1196, 0.0368, 0.0098), (79.41, 81.767, 82.481), (0.1603, 0.0939, 0.0492)),
    0.2: ((0.2518, 0.0783, 0.0210), (73.858, 75.142, 75.287), (0.3196, 0.1878, 0.0984)),
    0.3: ((0.4091, 0.1304, 0.0354), (68.264, 68.493, 68.204), (0.4765, 0.2816, 0.1476)),
    0.4: ((0.6108, 0.2026, 0.0560), (62.571, 61.778, 61.208), (0.6318, 0.3755, 0.1968)),
    0.5: ((0.8903, 0.3124, 0.0888), (56.705, 54.993, 54.069), (0.7852, 0.4694, 0.2460)),
    0.6: ((1.3146, 0.4982, 0.1476), (50.536, 48.049, 46.825), (0.9374, 0.5634, 0.2953)),
    0.7: ((2.0432, 0.8595, 0.2708), (43.859, 40.803, 39.326), (1.0888, 0.6578, 0.3446)),
    0.8: ((3.5663, 1.7339, 0.6043), (36.235, 32.938, 31.249), (1.2392, 0.7529, 0.3940)),
    0.9: ((8.4352, 5.0881, 2.1595), (26.482, 23.566, 21.790), (1.3898, 0.8453, 0.4436)),
    0.95: ((18.7895, 13.3083, 6.9248), (19.450, 17.265, 15.632), (1.4655, 0.8984, 0.4687)),
}

#: ε (negative: moving away): So_V for each B/D.
SQUEEZE = {
    -0.95: (0.5177, 0.1372, 0.0351),
    -0.9: (0.5518, 0.1466, 0.0376),
    -0.8: (0.6293, 0.1685, 0.0432),
    -0.7: (0.7242, 0.1944, 0.0500),
    -0.6: (0.8342, 0.2265, 0.0583),
    -0.5: (0.9710, 0.2664, 0.0688),
    -0.4: (1.1391, 0.3164, 0.0820),
    -0.3: (1.3494, 0.3803, 0.0989),
    -0.2: (1.6134, 0.4632, 0.1212),
    -0.1: (1.9579, 0.5732, 0.1509),
    0.0: (2.4076, 0.7224, 0.1919),
    0.1: (3.0122, 0.9814, 0.2499),
    0.2: (3.8485, 1.2236, 0.3354),
    0.3: (5.0479, 1.6904, 0.4675),
    0.4: (6.8503, 2.4202, 0.6845),
    0.5: (9.7319, 3.6750, 1.0715),
    0.6: (14.769, 6.0649, 1.8455),
    0.7: (24.842, 11.373, 3.6891),
    0.8: (50.349, 26.676, 9.6161),
    0.9: (160.25, 104.75, 46.559),
    0.95: (490.18, 371.98, 205.15),
}

#: Entries left out, and what they probably should be: one digit off, in columns that agree to 0.1 %.
MISPRINTS = {(0.1, 0.5): 0.9314, (0.2, 0.5): 1.2336}


def film(width: float, boundary: str) -> Film:
    return Film(ETA, CLEARANCE, RADIUS, 2.0 * RADIUS * width, boundary=boundary, grid=FilmGrid(256, 32))


def rotation(eps: float, width: float, boundary: str) -> FilmState:
    return film_state(film(width, boundary), np.array([eps * CLEARANCE] + [0.0] * 7), omega=OMEGA)


def load_number(force: float, width: float, rate: float) -> float:
    """Return F ψ²/(B D η rate)."""
    return force * (CLEARANCE / RADIUS) ** 2 / ((2.0 * RADIUS) ** 2 * width * ETA * rate)


def squeeze_number(eps: float, width: float, boundary: str) -> float:
    speed = math.copysign(CLEARANCE, 1.0 if eps >= 0.0 else -1.0)
    state = np.array([abs(eps) * CLEARANCE, 0.0, 0.0, 0.0, speed, 0.0, 0.0, 0.0])
    return load_number(abs(film_state(film(width, boundary), state).force[0]), width, 1.0)


@pytest.mark.parametrize("column", range(3))
@pytest.mark.parametrize("eps", ROTATION)
def test_rotation(eps: float, column: int) -> None:
    load, angle, flow = (row[column] for row in ROTATION[eps])
    state = rotation(eps, WIDTHS[column], "groove")
    assert load_number(math.hypot(*state.force), WIDTHS[column], OMEGA) == pytest.approx(load, rel=0.01)
    assert math.degrees(state.attitude_angle) == pytest.approx(angle, abs=0.5)
    assert state.leakage / (RADIUS**2 * CLEARANCE * OMEGA) == pytest.approx(flow, rel=0.01)


@pytest.mark.parametrize("column", range(3))
@pytest.mark.parametrize("eps", ROTATION)
def test_the_table_read_from_load_to_eccentricity(eps: float, column: int) -> None:
    load, angle, flow = (row[column] for row in ROTATION[eps])
    bearing = film(WIDTHS[column], "groove")
    force = load / load_number(1.0, WIDTHS[column], OMEGA)
    found = film_equilibrium(bearing, (0.6 * force, -0.8 * force), omega=OMEGA)
    assert found.sommerfeld_number == pytest.approx(load, rel=1e-12)
    assert found.eccentricity_ratio == pytest.approx(eps, rel=0.01)
    assert found.least_film == pytest.approx((1.0 - eps) * CLEARANCE, rel=0.01)
    assert math.degrees(found.attitude_angle) == pytest.approx(angle, abs=0.5)
    assert found.state.leakage / (RADIUS**2 * CLEARANCE * OMEGA) == pytest.approx(flow, rel=0.01)
    friction = math.pi / (math.sqrt(1.0 - eps**2) * load) + 0.5 * eps * math.sin(math.radians(angle))
    assert found.friction_coefficient * RADIUS / CLEARANCE == pytest.approx(friction, rel=0.01)


@pytest.mark.parametrize("column", range(3))
@pytest.mark.parametrize("eps", ROTATION)
def test_friction_of_the_table(eps: float, column: int) -> None:
    """The check that goes with the tables: µ/ψ = π/(√(1 − ε²) So) + ε sin β/2."""
    state = rotation(eps, WIDTHS[column], "groove")
    force = math.hypot(*state.force)
    number = load_number(force, WIDTHS[column], OMEGA)
    expected = math.pi / (math.sqrt(1.0 - eps**2) * number) + 0.5 * eps * math.sin(state.attitude_angle)
    # From our own load and angle: only the quadrature remains, worst where h is thin.
    assert -state.torque / (CLEARANCE * force) == pytest.approx(expected, rel=1e-3)


@pytest.mark.parametrize("column", range(3))
@pytest.mark.parametrize("eps", SQUEEZE)
def test_squeeze(eps: float, column: int) -> None:
    width = WIDTHS[column]
    # Moving away the oil is pressed where the gap is widest: p = 0 there would take half of the film, and the
    # table shows that it was not imposed. Approaching, both boundaries give the same.
    found = squeeze_number(eps, width, "periodic" if eps < 0.0 else "groove")
    if (eps, width) in MISPRINTS:
        assert found == pytest.approx(MISPRINTS[eps, width], rel=2e-3)
    else:
        assert found == pytest.approx(SQUEEZE[eps][column], rel=0.01)


def test_approaching_squeeze_does_not_know_the_groove() -> None:
    assert squeeze_number(0.5, 0.5, "groove") == pytest.approx(squeeze_number(0.5, 0.5, "periodic"), rel=1e-9)


def test_without_a_groove_a_light_film_stands_elsewhere() -> None:
    """The periodic film may press upstream of the widest gap, which the tables forbid: 4.5° at small ε."""
    excess = {
        (eps, width): math.degrees(rotation(eps, width, "periodic").attitude_angle) - ROTATION[eps][1][column]
        for eps in (0.1, 0.5, 0.95)
        for column, width in enumerate(WIDTHS)
    }
    assert 4.0 < excess[0.1, 1.0] < 5.0
    assert excess[0.95, 1.0] < 0.2
    for width in WIDTHS:
        assert excess[0.1, width] > excess[0.5, width] > excess[0.95, width] > -0.02


@pytest.mark.parametrize(
    ("width", "turned", "flows"),
    [(1.0, 4.4, (0.07, 0.14)), (0.5, 1.3, (0.02, 0.03)), (0.25, 0.3, (0.005, 0.005))],
)
def test_the_default_boundary_differs_from_the_tables_as_the_manual_says(width, turned, flows):
    column = WIDTHS.index(width)
    turns, flow, loads = [], [], []
    for eps, row in ROTATION.items():
        load, angle, side = (values[column] for values in row)
        state = rotation(eps, width, "periodic")
        turns.append(math.degrees(state.attitude_angle) - angle)
        flow.append(state.leakage / (RADIUS**2 * CLEARANCE * OMEGA) / side - 1.0)
        loads.append(load_number(math.hypot(*state.force), width, OMEGA) / load - 1.0)
    assert max(turns) == pytest.approx(turned, abs=0.05)
    assert max(turns[7:]) < 0.6, "from an eccentricity of 0.8"
    assert max(map(abs, loads)) < 0.0205
    # Printed with one digit; the tables have four, and one of their columns is off by 0.5 % at 0.9.
    assert (flow[0], max(flow)) == pytest.approx(flows, abs=0.006)
