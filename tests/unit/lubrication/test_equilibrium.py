"""A film alone under a load: what balances, what turns, and what is refused."""

import math
from dataclasses import replace

import numpy as np
import pytest

from tribodyn.core.errors import InputError
from tribodyn.lubrication import Film, FilmGrid, Roughness, film_equilibrium, film_state

BEARING = Film(0.01, 20e-6, 6e-3, 20e-3, grid=FilmGrid(96, 16))
ROUGH = replace(BEARING, roughness=Roughness((0.392e-6, 1.586e-6)))
KINDS = [
    BEARING,
    ROUGH,
    replace(BEARING, boundary="groove"),
    replace(BEARING, boundary="groove", cavitation="jfo"),
    replace(ROUGH, boundary="groove", cavitation="jfo"),  # has no answer as far as it is looked for
    replace(BEARING, cavitation="half-sommerfeld"),
    replace(BEARING, cavitation="none"),
]


@pytest.mark.parametrize(
    "film", KINDS, ids=lambda film: f"{film.cavitation}, {film.roughness.combined:.1g} m"
)
@pytest.mark.parametrize("size", [1e-3, 1.0, 100.0, 500.0])
def test_film_and_load_balance(film: Film, size: float) -> None:
    load = (0.28 * size, -0.96 * size)
    found = film_equilibrium(film, load, omega=100.0)
    # Evaluated anew, with a memory of its own: forces are good to the rounding of e/c.
    alone = film_state(film, np.append(found.position, np.zeros(6)), omega=100.0)
    assert alone.force == pytest.approx((-load[0], -load[1]), abs=1e-8 * size)
    assert found.attitude_angle == pytest.approx(alone.attitude_angle, abs=1e-8)


def test_more_load_presses_closer_and_more_speed_lifts() -> None:
    found = [film_equilibrium(ROUGH, (w, 0.0), omega=100.0) for w in (1.0, 10.0, 100.0, 1e3, 1e4)]
    assert np.all(np.diff([point.least_film for point in found]) < 0.0)
    assert film_equilibrium(ROUGH, (100.0, 0.0), omega=200.0).least_film > found[2].least_film


def test_the_sommerfeld_number_alone_decides() -> None:
    one = film_equilibrium(BEARING, (100.0, 0.0), omega=100.0)
    other = film_equilibrium(replace(BEARING, viscosity=0.03), (600.0, 0.0), omega=200.0)
    assert other.sommerfeld_number == pytest.approx(one.sommerfeld_number, rel=1e-12)
    assert other.position == pytest.approx(one.position, rel=1e-9)


def test_turning_the_other_way_mirrors() -> None:
    # The load along X, an axis of the grid's mirror.
    forth, back = (film_equilibrium(BEARING, (100.0, 0.0), omega=omega) for omega in (100.0, -100.0))
    assert back.position == pytest.approx(forth.position * [1.0, -1.0], rel=1e-9)
    assert back.attitude_angle == pytest.approx(-forth.attitude_angle, rel=1e-9)
    assert back.friction_coefficient == pytest.approx(forth.friction_coefficient, rel=1e-9)
    assert back.state.leakage == pytest.approx(forth.state.leakage, rel=1e-9)


def test_a_journal_turns_with_its_load() -> None:
    # A right angle is a whole number of cells.
    one = film_equilibrium(BEARING, (60.0, 80.0), omega=100.0)
    turned = film_equilibrium(BEARING, (-80.0, 60.0), omega=100.0)
    assert turned.position == pytest.approx([-one.position[1], one.position[0]], rel=1e-9)


def test_the_numbers_are_those_of_their_definitions() -> None:
    found = film_equilibrium(BEARING, (60.0, -80.0), omega=100.0)
    assert found.eccentricity == pytest.approx(math.hypot(*found.position))
    assert found.least_film == pytest.approx(20e-6 * (1.0 - found.eccentricity_ratio))
    # From the load to the line of centres, in the direction in which the journal turns.
    angle = math.atan2(found.position[1], found.position[0]) - math.atan2(-80.0, 60.0)
    assert found.attitude_angle == pytest.approx(angle)
    assert found.sommerfeld_number == pytest.approx(
        100.0 * (20e-6 / 6e-3) ** 2 / (12e-3 * 20e-3 * 0.01 * 100.0)
    )
    assert found.friction_coefficient == pytest.approx(-found.state.torque / (6e-3 * 100.0))


@pytest.mark.parametrize("load", [(0.0, 0.0), (math.nan, 1.0), (math.inf, 0.0)])
def test_a_load_that_is_none_is_refused(load: tuple[float, float]) -> None:
    with pytest.raises(InputError, match="load"):
        film_equilibrium(BEARING, load, omega=100.0)


@pytest.mark.parametrize("omega", [0.0, math.nan, math.inf])
def test_a_journal_that_does_not_turn_is_refused(omega: float) -> None:
    with pytest.raises(InputError, match="rotation"):
        film_equilibrium(BEARING, (100.0, 0.0), omega=omega)


def test_more_than_a_rough_film_carries_is_refused() -> None:
    # Roughness keeps oil flowing between touching surfaces: pressure, and with it the load, is bounded.
    assert film_equilibrium(ROUGH, (1e4, 0.0), omega=100.0).least_film < 0.0
    with pytest.raises(InputError, match="more than this film carries alone"):
        film_equilibrium(ROUGH, (1e5, 0.0), omega=100.0)


def test_a_film_thinner_than_its_grid_shows_is_refused_and_finer_cells_help() -> None:
    with pytest.raises(InputError, match="96 x 16 cells") as refusal:
        film_equilibrium(BEARING, (1e4, 0.0), omega=100.0)
    assert refusal.value.key == "film.grid"
    finer = [
        film_equilibrium(replace(BEARING, grid=FilmGrid(theta, 16)), (1e4, 0.0), omega=100.0).least_film
        for theta in (192, 384)
    ]
    assert finer[0] == pytest.approx(finer[1], rel=0.04)
