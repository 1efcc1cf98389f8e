"""Derivatives of the film's wrench against central differences."""

import dataclasses

import numpy as np
import pytest

from mebdf.arrays import FloatArray
from tribodyn.kernels.film.data import CONVERGED
from tribodyn.kernels.film.wrench import film_wrench, film_wrench_and_jacobian
from tribodyn.lubrication import Film, FilmGrid, Roughness

OMEGA = 100.0
#: What each argument is measured by: c, c/(l_z/2), and speeds that make a film of the same strength.
SCALE = np.array([20e-6, 20e-6, 2e-3, 2e-3, 2e-4, 2e-4, 2e-2, 2e-2, 100.0])
STATES = {
    "level": [6e-6, 8e-6, 0.0, 0.0, 1e-4, -2e-4, 0.0, 0.0],
    "tilted": [6e-6, 8e-6, 3e-4, -2e-4, 1e-4, -2e-4, 0.01, -0.02],
    "mixed": [17e-6, -6e-6, 2e-4, 3e-4, 5e-5, 1e-4, 0.02, 0.01],
}
ROUGH = Roughness((1e-6, 0.5e-6), (3.0, 0.5))


def make(cavitation: str, boundary: str, roughness: Roughness) -> Film:
    return Film(
        0.01, 20e-6, 5e-3, 20e-3, roughness, cavitation=cavitation, boundary=boundary, grid=FilmGrid(48, 12)
    )


def differences(film: Film, wear: FloatArray | None, arguments: FloatArray, step: float) -> FloatArray:
    data, memory = film.data(wear), film.memory()
    columns = np.empty((5, 9))
    for k in range(9):
        sides = np.empty((2, 5))
        for side, sign in enumerate((1.0, -1.0)):
            moved = arguments.copy()
            moved[k] += sign * step * SCALE[k]
            assert film_wrench(data, memory, moved[:8].copy(), moved[8], sides[side]) == CONVERGED
        columns[:, k] = (sides[0] - sides[1]) / (2.0 * step)
    return columns


def check(film: Film, state: list[float], wear: FloatArray | None = None, omega: float = OMEGA) -> None:
    arguments = np.append(state, omega)
    out, jacobian = np.empty(5), np.empty((5, 9))
    status = film_wrench_and_jacobian(
        film.data(wear), film.memory(), arguments[:8].copy(), omega, out, jacobian
    )
    assert status == CONVERGED
    scaled = jacobian * SCALE
    # Steps of 1e-6 of the scale: truncation 1e-11, rounding 1e-15/1e-6, and rarely a node that changes sides.
    errors = np.abs(differences(film, wear, arguments, 1e-6) - scaled)
    assert (errors <= 1e-6 * np.abs(scaled).max(axis=1, keepdims=True)).all(), errors


@pytest.mark.parametrize("roughness", [Roughness(), ROUGH], ids=["smooth", "rough"])
@pytest.mark.parametrize("boundary", ["periodic", "groove"])
@pytest.mark.parametrize("cavitation", ["reynolds", "half-sommerfeld", "none"])
@pytest.mark.parametrize("state", STATES)
def test_wrench(state: str, cavitation: str, boundary: str, roughness: Roughness) -> None:
    offset = 0.9 if roughness is not ROUGH else 1.0  # smooth surfaces must not touch
    values = [offset * value if index < 2 else value for index, value in enumerate(STATES[state])]
    if state == "mixed" and roughness is not ROUGH:
        values[2] = values[3] = 1e-4
    check(make(cavitation, boundary, roughness), values)


def test_below_the_first_touch() -> None:
    """Part of the gap is below σ/2, where flow no longer follows it, and below 0."""
    film = make("reynolds", "periodic", ROUGH)
    check(film, [20.5e-6, 3e-6, 0.0, 0.0, 1e-4, 2e-4, 0.0, 0.0])
    check(film, [20.5e-6, 3e-6, 1e-4, 0.0, 1e-4, 2e-4, 0.01, 0.0])


@pytest.mark.parametrize("cavitation", ["reynolds", "half-sommerfeld"])
def test_wide_and_short(cavitation: str) -> None:
    """The cross-section of a tilted journal is an ellipse: second-order terms of the tilt are large here."""
    film = dataclasses.replace(make(cavitation, "periodic", Roughness()), radius=300e-3)
    check(film, [3e-6, 4e-6, 4e-4, -8e-4, 1e-4, -2e-4, 0.01, -0.02], omega=2.0)
    check(film, [6e-6, 8e-6, 0.0, 0.0, 1e-4, -2e-4, 0.0, 0.0], omega=2.0)


def test_in_a_worn_bushing() -> None:
    film = make("reynolds", "periodic", ROUGH)
    z, theta = np.meshgrid(film.z, film.theta, indexing="ij")
    wear = 2e-6 * (1.0 + np.cos(theta - 1.0)) * (1.0 + 40.0 * z)
    check(film, STATES["tilted"], wear)
    check(film, STATES["level"], wear)
    check(film, STATES["level"], wear[:, :1] * 0.0 + wear[film.grid.z // 2])


@pytest.mark.parametrize("omega", [100.0, -100.0])
@pytest.mark.parametrize(
    "state", [[6e-6, 8e-6, 0.0, 0.0], [1e-6, 2e-6, 9e-4, -6e-4], [12e-6, 12e-6, 1e-4, 0.0]]
)
def test_jfo_in_position_and_speed(state: list[float], omega: float) -> None:
    film = make("jfo", "groove", ROUGH)
    arguments = np.array([*state, 0.0, 0.0, 0.0, 0.0, omega])
    out, jacobian = np.empty(5), np.empty((5, 9))
    data, memory = film.data(), film.memory()
    assert film_wrench_and_jacobian(data, memory, arguments[:8].copy(), omega, out, jacobian) == CONVERGED
    assert not jacobian[:, 4:8].any()
    for k in (0, 1, 2, 3, 8):
        sides = np.empty((2, 5))
        for side, sign in enumerate((1.0, -1.0)):
            moved = arguments.copy()
            moved[k] += sign * 1e-6 * SCALE[k]
            assert film_wrench(data, memory, moved[:8].copy(), moved[8], sides[side]) == CONVERGED
        found = (sides[0] - sides[1]) / 2e-6
        size = np.abs(jacobian * SCALE).max(axis=1)
        np.testing.assert_allclose(found / size, jacobian[:, k] * SCALE[k] / size, atol=1e-6)


def test_damping_is_symmetric() -> None:
    """Squeeze damping of a smooth film at a given set of full nodes is symmetric and opposes motion."""
    out, jacobian = np.empty(5), np.empty((5, 9))
    film = make("reynolds", "periodic", Roughness())
    film_wrench_and_jacobian(film.data(), film.memory(), np.array(STATES["level"]), OMEGA, out, jacobian)
    # Pairs (F_x, ė_x), (F_y, ė_y), (M_x, φ̇_x), (M_y, φ̇_y): what does power.
    damping = -jacobian[:4, 4:8]
    np.testing.assert_allclose(damping, damping.T, atol=1e-12 * abs(damping).max())
    assert (np.linalg.eigvalsh(damping[:2, :2]) > 0.0).all()
    assert (np.linalg.eigvalsh(damping[2:, 2:]) > 0.0).all()
