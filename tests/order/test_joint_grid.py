"""Convergence of joints and films over their grids."""

import itertools
import math

import numpy as np
import pytest

import tribodyn as td
from tribodyn.core.quantities import names
from tribodyn.joints.bushing import joint_wrench
from tribodyn.kernels.joints.quantities import STATES
from tribodyn.lubrication import Film, FilmGrid, Roughness, film_state
from tribodyn.mechanisms.bushing import grid_of

FINEST = (384, 96)
AGREE = 1e-3  #: What is asked of the default grid in smooth motion, of the force and of the moment.
LOADED = 1.0  #: Force [N] from which a relative error means anything; the smooth motion has 13 to 30 N.
SETTLED = 0.3  #: Time after a reversal at which the ringing is over [s].


@pytest.fixture(scope="module", params=[20e-6, 40e-6], ids=["20um", "40um"])
def errors(request, vsv_run, make_joint):
    """Return errors of force and moment over the grid, which instants are settled, the default grid."""
    clearance = request.param
    run = vsv_run("exact", clearance)
    early = np.arange(np.searchsorted(run["t"], np.pi), np.searchsorted(run["t"], np.pi + SETTLED))
    rows = np.union1d(np.arange(0, run["t"].size - 1, 20), early)
    settled = np.mod(run["t"][rows], np.pi) > SETTLED
    states = np.column_stack([run[name] for name in names(STATES)])[rows]

    def wrenches(grid):
        data = make_joint(clearance, grid=grid).data()
        pairs = zip(states, run["omega_v"][rows], strict=True)
        return np.array([joint_wrench(data, y, omega=omega) for y, omega in pairs])

    exact = wrenches(FINEST)
    force, moment = np.hypot(*exact[:, :2].T), np.hypot(*exact[:, 2:4].T)
    loaded = force > LOADED
    assert np.count_nonzero(settled & loaded) > 50
    assert np.count_nonzero(~settled & loaded) > 50

    def error(grid, which):
        off = (wrenches(grid) - exact)[loaded & which]
        of_force = np.hypot(*off[:, :2].T) / force[loaded & which]
        of_moment = np.hypot(*off[:, 2:4].T) / moment[loaded & which]
        return np.maximum(of_force, of_moment)

    default = grid_of(td.load_case("vsv").replace({"joint.clearance": f"{clearance} m"}))
    return error, settled, default


def test_default_grid_in_smooth_motion(errors):
    # Measured: 3e-6 at 20 µm, 7e-6 at 40 µm.
    error, settled, default = errors
    assert error(default, settled).max() < 0.1 * AGREE


def test_default_grid_in_impacts(errors):
    # Nineteen instants in twenty of the 0.3 s after a reversal; the rest are isolated, up to 2 %.
    error, settled, default = errors
    impacts = error(default, ~settled)
    assert np.quantile(impacts, 0.5) < AGREE
    assert np.quantile(impacts, 0.95) < 5.0 * AGREE


def test_axial_convergence(errors):
    # Gauss rows: each four more gain a factor, until the error of the 20 µm case is nothing.
    error, settled, _ = errors
    steps = [error((96, n), settled).max() for n in (8, 12, 16)]
    assert steps[0] > 5.0 * steps[1] > 25.0 * steps[2]


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
