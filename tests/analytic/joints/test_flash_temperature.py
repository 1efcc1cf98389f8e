"""The flash temperature against limits of heat conduction and Jaeger's integral of a moving source."""

import math

import numpy as np
import pytest

import tribodyn as td
from tribodyn.contact.surface_pair import Conductor, flash_temperature, resistance

BODY = Conductor(conductivity=45.0, diffusivity=12e-6)
RADIUS = 5e-6


def jaeger(peclet: float) -> float:
    """Return the largest k ΔT/(q a) of a round source that moves with V a/(2 κ) = ``peclet``.

    Polar coordinates about each place of the diameter; φ is counted from where the source has been, and
    ∫ exp(-Pe r (1 - cos φ)) dr over the chord is taken in closed form.
    """
    phi = np.linspace(0.0, math.pi, 4001)
    lag = peclet * (1.0 - np.cos(phi))
    rises = []
    for x in np.linspace(-0.999, 0.999, 401):
        chord = x * np.cos(phi) + np.sqrt(1.0 - (x * np.sin(phi)) ** 2)
        small = lag * chord < 1e-8
        along = np.where(small, chord, -np.expm1(-lag * chord) / np.where(small, 1.0, lag))
        rises.append(np.trapezoid(along, phi) / math.pi)
    return max(rises)


@pytest.mark.parametrize("peclet", [0.01, 0.3, 1.0, 3.0, 10.0, 100.0])
def test_it_is_near_jaegers_integral(peclet: float) -> None:
    speed = 2.0 * BODY.diffusivity * peclet / RADIUS
    found = resistance(BODY, RADIUS, speed) * BODY.conductivity / RADIUS
    # Measured: 2.2 % at 1, less elsewhere.
    assert found == pytest.approx(jaeger(peclet), rel=0.03)


def test_both_limits() -> None:
    # At rest q a/k; fast, a surface heated for 2 a/V.
    assert resistance(BODY, RADIUS, 0.0) == RADIUS / BODY.conductivity
    speed = 1e9
    fast = 2.0 / BODY.conductivity * math.sqrt(BODY.diffusivity * 2.0 * RADIUS / speed / math.pi)
    assert resistance(BODY, RADIUS, speed) == pytest.approx(fast, rel=1e-3)


def test_a_run_tells_it_where_conductors_are_known() -> None:
    known = {
        "surfaces.trunnion.conductivity": "18 W/(m K)",
        "surfaces.trunnion.diffusivity": "5 mm^2/s",
        "surfaces.bushing.conductivity": "0.35 W/(m K)",
    }
    case = td.load_case("vsv").replace(known | {"run.duration": "0.1 s"})
    assert "flash_temperature" not in td.simulate(case).attrs
    run = td.simulate(case.replace({"surfaces.bushing.diffusivity": "0.2 mm^2/s"}))
    # A vane slides at millimetres a second: under a kelvin, above what a smooth surface would have.
    assert 1e-6 < run.attrs["flash_temperature"] < 1.0


def test_a_turning_journal_tells_it() -> None:
    known = {
        "surfaces.trunnion.conductivity": "18 W/(m K)",
        "surfaces.trunnion.diffusivity": "5 mm^2/s",
        "surfaces.bushing.conductivity": "0.35 W/(m K)",
        "surfaces.bushing.diffusivity": "0.2 mm^2/s",
        "drives.motor.speed": "100 rad/s",
        "joints.bearing.clearance.friction_coefficient": 0.1,
        "run.start": "equilibrium",
        "run.duration": "1 ms",
    }
    run = td.simulate(td.load_case("journal-dry").replace(known))
    flash = float(run["flash_temperature"].values[0])
    # At most μ H V a/k, of spots that carry the hardness, at rest on the better conductor, of some um.
    assert 0.0 < flash < 0.1 * 492e6 * 0.6 * 20e-6 / 18.0
    slower = td.simulate(td.load_case("journal-dry").replace(known | {"drives.motor.speed": "50 rad/s"}))
    # At these speeds heat is conducted as at rest, in proportion to the speed.
    assert slower["flash_temperature"].values[0] == pytest.approx(0.5 * flash, rel=0.1)


def test_heat_takes_the_better_way() -> None:
    insulator = Conductor(1e-9, 1e-7)
    alone = 1e6 * resistance(BODY, RADIUS, 2.0)
    assert flash_temperature(1e6, RADIUS, 2.0, insulator, BODY) == pytest.approx(alone, rel=1e-9)
    # Two equal bodies at rest take half each.
    assert flash_temperature(1e6, RADIUS, 0.0, BODY, BODY) == pytest.approx(0.5e6 * RADIUS / 45.0, rel=1e-12)
