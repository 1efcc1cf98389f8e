"""The oil film by itself, and in balance with a load."""

import itertools
import math
from dataclasses import replace

import numpy as np
import pytest

from tribodyn.core.errors import InputError
from tribodyn.kernels.film.data import NOT_STEADY, OUT_OF_RANGE
from tribodyn.kernels.film.wrench import film_wrench
from tribodyn.lubrication import (
    BOUNDARIES,
    CAVITATION,
    Film,
    FilmGrid,
    Roughness,
    explain,
    film_equilibrium,
    film_state,
)

FILM = Film(viscosity=0.01, clearance=20e-6, radius=5e-3, length=20e-3, grid=FilmGrid(48, 12))
STATE = np.array([6e-6, 8e-6, 3e-4, -2e-4, 1e-4, -2e-4, 0.01, -0.02])


@pytest.mark.parametrize(
    ("change", "key"),
    [
        ({"viscosity": 0.0}, "film.viscosity"),
        ({"viscosity": math.nan}, "film.viscosity"),
        ({"clearance": -1e-6}, "film.clearance"),
        ({"cavitation": "gumbel"}, "film.cavitation"),
        ({"boundary": "open"}, "film.boundary"),
        ({"cavitation": "jfo"}, "film.cavitation"),
    ],
)
def test_what_cannot_be_a_film_is_refused(change: dict[str, object], key: str) -> None:
    with pytest.raises(InputError) as caught:
        replace(FILM, **change)
    assert caught.value.key == key


@pytest.mark.parametrize("grid", [(6, 12), (48, 11), (48, 2)])
def test_grids_that_hold_no_film_are_refused(grid: tuple[int, int]) -> None:
    with pytest.raises(InputError, match="cells"):
        FilmGrid(*grid)


def test_wear_needs_the_shape_of_the_film_and_a_resting_grid() -> None:
    with pytest.raises(InputError, match="shape"):
        FILM.data(np.zeros((3, 3)))
    with pytest.raises(InputError, match="periodic"):
        replace(FILM, boundary="groove").data(np.ones(FILM.field_shape) * 1e-6)


@pytest.mark.parametrize("roughness", [Roughness(), Roughness((1e-6, 1e-6))], ids=["smooth", "rough"])
def test_journal_outside_the_bushing_is_an_error(roughness: Roughness) -> None:
    film = replace(FILM, roughness=roughness)
    outside = np.array([30e-6, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0])
    with pytest.raises(InputError, match="outside"):
        film_state(film, outside, omega=1.0)


def test_rough_film_reaches_four_sigma_below_contact() -> None:
    sigma = 1e-6
    film = replace(FILM, roughness=Roughness((sigma, 0.0)))
    data, memory, out = film.data(), film.memory(), np.empty(5)
    state = np.zeros(8)
    for below, expected in ((3.99, 0), (4.01, OUT_OF_RANGE)):
        state[0] = FILM.clearance + below * sigma
        assert film_wrench(data, memory, state, 100.0, out) == expected
        assert np.isfinite(out).all() == (expected == 0)


def test_state_that_is_no_number_is_out_of_range() -> None:
    out, memory = np.empty(5), FILM.memory()
    for k in range(4):
        state = np.zeros(8)
        state[k] = math.nan
        assert film_wrench(FILM.data(), memory, state, 100.0, out) == OUT_OF_RANGE
    # The memory is not spoilt.
    assert film_state(FILM, STATE, memory=memory).force == pytest.approx(
        film_state(FILM, STATE).force, rel=1e-10
    )


def test_jfo_is_for_steady_films() -> None:
    film = replace(FILM, cavitation="jfo", boundary="groove")
    assert film_wrench(film.data(), film.memory(), STATE, 100.0, np.empty(5)) == NOT_STEADY
    assert film_wrench(film.data(), film.memory(), np.zeros(8), 0.0, np.empty(5)) == NOT_STEADY
    assert "steady" in explain(NOT_STEADY)


@pytest.mark.parametrize("tilted", [False, True])
def test_result_does_not_depend_on_what_was_evaluated_before(tilted: bool) -> None:
    state = STATE.copy()
    if not tilted:
        state[[2, 3, 6, 7]] = 0.0
    fresh = film_state(FILM, state, omega=100.0)
    memory = FILM.memory()
    film_state(FILM, -STATE, omega=-300.0, memory=memory)
    used = film_state(FILM, state, omega=100.0, memory=memory)
    # The set of cavitated nodes is found exactly: only rounding may differ.
    np.testing.assert_allclose(used.pressure, fresh.pressure, rtol=0.0, atol=1e-12 * fresh.pressure.max())
    np.testing.assert_allclose(
        used.jacobian, fresh.jacobian, rtol=1e-9, atol=1e-9 * abs(fresh.jacobian).max()
    )


def test_half_the_film_is_enough_without_tilt() -> None:
    state = STATE.copy()
    state[[2, 3, 6, 7]] = 0.0
    nearly = state.copy()
    nearly[2] = 1e-12  # forces the whole film to be solved; changes the gap by 1e-14 m
    half, whole = film_state(FILM, state, omega=100.0), film_state(FILM, nearly, omega=100.0)
    np.testing.assert_allclose(half.pressure, whole.pressure, atol=1e-8 * whole.pressure.max())
    np.testing.assert_allclose(
        half.jacobian, whole.jacobian, rtol=1e-6, atol=1e-7 * abs(whole.jacobian).max()
    )
    assert half.torque == pytest.approx(whole.torque, rel=1e-8)
    assert half.leakage == pytest.approx(whole.leakage, rel=1e-7)


@pytest.mark.parametrize(
    ("cavitation", "boundary"),
    [pair for pair in itertools.product(CAVITATION, BOUNDARIES) if pair != ("jfo", "periodic")],
)
def test_turning_everything_turns_the_force(cavitation: str, boundary: str) -> None:
    film = replace(FILM, cavitation=cavitation, boundary=boundary)
    steady = STATE * ([1.0] * 4 + [0.0] * 4)
    # A right angle is a whole number of cells: the grid is the same. x-components: (e_x, φ_y), (F_x, M_y).
    turned = steady[[1, 0, 3, 2, 5, 4, 7, 6]] * [-1, 1, 1, -1, -1, 1, 1, -1]
    one, other = film_state(film, steady, omega=100.0), film_state(film, turned, omega=100.0)
    np.testing.assert_allclose(other.force, [-one.force[1], one.force[0]], rtol=1e-6)  # tan φ against φ: 1e-8
    np.testing.assert_allclose(other.moment, [one.moment[1], -one.moment[0]], rtol=1e-6)
    assert other.torque == pytest.approx(one.torque, rel=1e-9)


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


def test_negative_roughness_is_refused() -> None:
    with pytest.raises(InputError, match="rms"):
        Roughness((1e-6, -1e-6))


def test_nothing_moves_nothing_presses() -> None:
    assert film_state(FILM, STATE * ([1] * 4 + [0] * 4)).force == (0.0, 0.0)
