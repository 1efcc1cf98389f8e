"""Films converge with the square of the cell."""

import itertools
import math

import numpy as np
import pytest

from tribodyn.lubrication import Film, FilmGrid, Roughness, film_state

GRIDS = (32, 64, 128)


def orders(values: list[float], exact: float) -> list[float]:
    errors = [abs(value - exact) for value in values]
    return [math.log2(coarse / fine) for coarse, fine in itertools.pairwise(errors)]


@pytest.mark.parametrize("speed", [0.0, 1.0], ids=["rotation", "squeeze"])
def test_long_film(speed: float) -> None:
    """Against Sommerfeld's closed form and that of the squeeze, at ε = 0.6."""
    eps, clearance, radius, omega = 0.6, 10e-6, 5e-3, 0.0 if speed else 100.0
    state = np.array([eps * clearance, 0.0, 0.0, 0.0, speed * clearance, 0.0, 0.0, 0.0])
    found = []
    for theta in GRIDS:
        film = Film(0.01, clearance, radius, 32.0 * radius, cavitation="none", grid=FilmGrid(theta, 64))
        row = film_state(film, state, omega=omega).pressure[32]
        wave = np.cos(film.theta) if speed else np.sin(film.theta)
        force = abs(row @ wave) * 2.0 * math.pi / theta * radius
        found.append(force * (clearance / radius) ** 2 / (2.0 * radius * 0.01 * (omega or speed)))
    exact = 6.0 * math.pi / (1.0 - eps**2) ** 1.5
    if not speed:
        exact = 6.0 * math.pi * eps / ((2.0 + eps**2) * math.sqrt(1.0 - eps**2))
    for order in orders(found, exact):
        assert order == pytest.approx(2.0, abs=0.15)


@pytest.mark.parametrize("cavitation", ["reynolds", "half-sommerfeld", "none"])
def test_rough_tilted_film(cavitation: str) -> None:
    """Against the finest of four grids; the edge of the film moves by cells, so single steps scatter."""
    state = np.array([6e-6, 8e-6, 3e-4, -2e-4, 1e-4, -2e-4, 0.01, -0.02])
    found = []
    for size in (16, 32, 64, 160):
        film = Film(
            *(0.01, 20e-6, 5e-3, 20e-3),
            roughness=Roughness((1e-6, 0.5e-6), (3.0, 0.5)),
            cavitation=cavitation,
            grid=FilmGrid(size, size // 2),
        )
        result = film_state(film, state, omega=100.0)
        found.append([*result.force, *result.moment, result.torque, result.leakage])
    values = np.array(found)
    errors = np.abs(values[:-1] - values[-1]) / np.abs(values[-1])
    # Over two halvings the error falls by 16 at second order; 10 leaves room for the scatter.
    assert np.linalg.norm(errors[0]) > 10.0 * np.linalg.norm(errors[2])
