"""Films as they are asked for: what is refused, and what does not depend on what was asked before."""

import itertools
import math
from dataclasses import replace

import numpy as np
import pytest

from tribodyn.core.errors import InputError
from tribodyn.kernels.film.data import NOT_STEADY, OUT_OF_RANGE
from tribodyn.kernels.film.wrench import film_wrench
from tribodyn.lubrication import BOUNDARIES, CAVITATION, Film, FilmGrid, Roughness, explain, film_state

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
