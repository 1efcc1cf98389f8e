"""Films against closed forms: infinitely long and very short bearings, rotation and squeeze."""

import math

import numpy as np
import pytest

from mebdf.arrays import FloatArray
from tribodyn.lubrication import Film, FilmGrid, film_equilibrium, film_state

VISCOSITY, CLEARANCE, RADIUS, OMEGA = 0.01, 10e-6, 5e-3, 100.0
ECCENTRICITIES = (0.1, 0.5, 0.8)
RIGHT = 0.005  #: Half a per cent on 128 × 32; the errors found are a tenth of it or less but at ε = 0.8.


def film(slenderness: float, cavitation: str, theta: int = 128, z: int = 32) -> Film:
    """Return a film with length over diameter ``slenderness``."""
    length = 2.0 * RADIUS * slenderness
    return Film(VISCOSITY, CLEARANCE, RADIUS, length, cavitation=cavitation, grid=FilmGrid(theta, z))


def at(eccentricity: float, speed: float = 0.0) -> FloatArray:
    """Return a state displaced along X that moves there with ε̇ = ``speed``."""
    return np.array([eccentricity * CLEARANCE, 0.0, 0.0, 0.0, speed * CLEARANCE, 0.0, 0.0, 0.0])


def sommerfeld_number(force: float, length: float, rate: float) -> float:
    """Return F ψ²/(2 r L η rate)."""
    return force * (CLEARANCE / RADIUS) ** 2 / (2.0 * RADIUS * length * VISCOSITY * rate)


def middle(pressure: FloatArray) -> FloatArray:
    """Return force per length (F_x, F_y) [N/m] of the middle row: that of an infinitely long film."""
    row = pressure[pressure.shape[0] // 2]
    theta = 2.0 * np.pi * np.arange(row.size) / row.size
    return 2.0 * np.pi / row.size * RADIUS * np.array([row @ np.cos(theta), row @ np.sin(theta)])


def long_film(eps: float, cavitation: str, speed: float = 0.0, theta: int = 128) -> FloatArray:
    # The ends die out like exp(−z/r): L/D = 16 leaves e^−16 in the middle. z needs no accuracy there.
    omega = 0.0 if speed else OMEGA
    return middle(film_state(film(16.0, cavitation, theta, 64), at(eps, speed), omega=omega).pressure)


@pytest.mark.parametrize("eps", ECCENTRICITIES)
def test_long_bearing_of_sommerfeld(eps: float) -> None:
    force = long_film(eps, "none")
    expected = 6.0 * math.pi * eps / ((2.0 + eps**2) * math.sqrt(1.0 - eps**2))
    assert abs(sommerfeld_number(float(np.hypot(*force)), 1.0, OMEGA) / expected - 1.0) < RIGHT
    assert abs(force[0]) < 1e-6 * abs(force[1])  # the full film pushes across the line of centres
    assert force[1] > 0.0  # a journal that turns along θ is pushed along it


@pytest.mark.parametrize("eps", ECCENTRICITIES)
def test_long_bearing_with_half_the_film(eps: float) -> None:
    force = long_film(eps, "half-sommerfeld")
    expected = 3.0 * eps * math.sqrt(math.pi**2 - eps**2 * (math.pi**2 - 4.0))
    expected /= (2.0 + eps**2) * (1.0 - eps**2)
    assert sommerfeld_number(float(np.hypot(*force)), 1.0, OMEGA) == pytest.approx(expected, rel=RIGHT)


@pytest.mark.parametrize("eps", ECCENTRICITIES)
def test_long_squeeze_film(eps: float) -> None:
    force = long_film(eps, "none", speed=1.0)
    # h³ p' = 12 η r² c ε̇ sin θ, and ∮ sin²θ/(1 + ε cos θ)³ dθ = π/(1 − ε²)^1.5.
    expected = 6.0 * math.pi / (1.0 - eps**2) ** 1.5
    assert sommerfeld_number(-force[0], 1.0, 1.0) == pytest.approx(expected, rel=RIGHT)


#: L/D of a short bearing; the circumferential flow it neglects is of the order of (L/D)² = 2.4e-4.
SHORT = 1.0 / 64.0


@pytest.mark.parametrize("eps", ECCENTRICITIES)
def test_short_bearing_of_ocvirk(eps: float) -> None:
    short = film(SHORT, "half-sommerfeld")
    force = film_state(short, at(eps), omega=OMEGA).force
    expected = SHORT**2 * eps / (2.0 * (1.0 - eps**2) ** 2)
    expected *= math.sqrt(16.0 * eps**2 + math.pi**2 * (1.0 - eps**2))
    assert sommerfeld_number(math.hypot(*force), short.length, OMEGA) == pytest.approx(expected, rel=RIGHT)


@pytest.mark.parametrize("eps", ECCENTRICITIES)
def test_the_load_of_ocvirk_leads_back_to_the_eccentricity(eps: float) -> None:
    short = film(SHORT, "half-sommerfeld")
    number = SHORT**2 * eps / (2.0 * (1.0 - eps**2) ** 2)
    number *= math.sqrt(16.0 * eps**2 + math.pi**2 * (1.0 - eps**2))
    load = number / sommerfeld_number(1.0, short.length, OMEGA)
    found = film_equilibrium(short, (0.0, -load), omega=OMEGA)
    assert found.eccentricity_ratio == pytest.approx(eps, rel=RIGHT)
    assert found.attitude_angle == pytest.approx(
        math.atan(math.pi * math.sqrt(1.0 - eps**2) / (4.0 * eps)), abs=4e-3
    )
    # The pressure is a parabola in z and h³ leaves its slope: ω r c l ε/2 goes out at each end.
    assert found.state.leakage == pytest.approx(OMEGA * RADIUS * CLEARANCE * short.length * eps, rel=RIGHT)


@pytest.mark.parametrize("eps", ECCENTRICITIES)
def test_short_squeeze_film(eps: float) -> None:
    short = film(SHORT, "none")
    force = film_state(short, at(eps, speed=1.0)).force
    # p = 6 η ḣ (z² − L²/4)/h³, and ∮ cos²θ/(1 + ε cos θ)³ dθ = π (1 + 2 ε²)/(1 − ε²)^2.5.
    expected = 2.0 * math.pi * SHORT**2 * (1.0 + 2.0 * eps**2) / (1.0 - eps**2) ** 2.5
    assert sommerfeld_number(-force[0], short.length, 1.0) == pytest.approx(expected, rel=RIGHT)


@pytest.mark.parametrize("eps", ECCENTRICITIES)
def test_friction_of_the_full_film(eps: float) -> None:
    """Petroff's torque 2π η ω r³ L/(c √(1 − ε²)) and half the moment of the load about the bushing."""
    full = film(1.0, "none")
    state = film_state(full, at(eps), omega=OMEGA)
    petroff = 2.0 * math.pi * VISCOSITY * OMEGA * RADIUS**3 * full.length / CLEARANCE
    expected = -petroff / math.sqrt(1.0 - eps**2) - 0.5 * eps * CLEARANCE * state.force[1]
    # Sums over equal steps of periodic functions: exact to rounding, but sin at faces for nodes costs Δθ²/24.
    assert state.torque == pytest.approx(expected, rel=2e-4)


def mobility_sums(eps: float, angle: float) -> FloatArray:
    """Return ∫ cos(φ − α) (cos φ, sin φ)/(1 − ε cos φ)³ dφ over the half of a film that is pressed."""
    nodes, weights = np.polynomial.legendre.leggauss(200)
    phi = angle + 0.5 * math.pi * nodes
    part = 0.5 * math.pi * weights * np.cos(phi - angle) / (1.0 - eps * np.cos(phi)) ** 3
    return np.array([part @ np.cos(phi), part @ np.sin(phi)])


def moving(eps: float, velocity: FloatArray) -> FloatArray:
    """Return a state displaced along X that moves with a velocity (2,) [c/s]."""
    state = at(eps)
    state[4:6] = CLEARANCE * velocity
    return state


@pytest.mark.parametrize("eps", ECCENTRICITIES)
def test_mobility_of_a_short_bearing(eps: float) -> None:
    """Booker's mobility by its inverse: force over velocity in any direction; closed forms in three.

    J. F. Booker, Dynamically loaded journal bearings: mobility method of solution, J. Basic Eng. 87 (1965).
    """
    root = math.sqrt(1.0 - eps**2)
    towards, away = ((3.0 * e * root + (1.0 + 2.0 * e**2) * math.acos(-e)) / root**5 for e in (eps, -eps))
    across = [2.0 * eps / root**4, 0.5 * math.pi / root**3]
    for angle, wanted in ((0.0, [towards, 0.0]), (math.pi, [-away, 0.0]), (0.5 * math.pi, across)):
        assert mobility_sums(eps, angle) == pytest.approx(wanted, rel=1e-9, abs=1e-9)
    oil = film(SHORT, "half-sommerfeld")
    unit = VISCOSITY * RADIUS * oil.length**3 / CLEARANCE**2
    for angle in np.radians([0.0, 30.0, 75.0, 90.0, 140.0, 180.0, 250.0]).tolist():
        direction = np.array([math.cos(angle), math.sin(angle)])
        force = np.array(film_state(oil, moving(eps, 3.0 * direction)).force)
        wanted = -3.0 * unit * mobility_sums(eps, angle)
        assert np.abs(force - wanted).max() < 2.0 * RIGHT * np.linalg.norm(wanted), angle
        # A journal that turns with ω in a bearing at rest moves as one that does not, seen from ω/2.
        swept = 3.0 * direction + np.array([0.0, 0.5 * OMEGA * eps])
        turned = np.array(film_state(oil, moving(eps, swept), omega=OMEGA).force)
        assert np.abs(turned - force).max() < 2.0 * RIGHT * np.linalg.norm(force), angle


@pytest.mark.parametrize("eps", ECCENTRICITIES)
def test_short_bearing_attitude(eps: float) -> None:
    angle = film_state(film(SHORT, "half-sommerfeld"), at(eps), omega=OMEGA).attitude_angle
    expected = math.atan(math.pi * math.sqrt(1.0 - eps**2) / (4.0 * eps))
    assert angle == pytest.approx(expected, abs=2e-3)  # half a per cent of the force, turned


def test_reynolds_film_of_a_short_bearing_is_half_a_film() -> None:
    """Where z-flow governs, cavitation follows the sign of the source: all conditions agree."""
    one = film_state(film(SHORT, "reynolds"), at(0.5), omega=OMEGA).force
    other = film_state(film(SHORT, "half-sommerfeld"), at(0.5), omega=OMEGA).force
    np.testing.assert_allclose(one, other, rtol=2e-3)
