"""Cavitation as a complementarity problem, mass balance, and the sign of the shear flow."""

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.sparse import csr_matrix, diags
from scipy.sparse.linalg import spsolve

from mebdf.arrays import FloatArray
from tribodyn.kernels.film.data import FilmMemory
from tribodyn.kernels.film.report import pressure_unit
from tribodyn.lubrication import Film, FilmGrid, Roughness, film_state
from tribodyn.lubrication.factors import shear_factor

OMEGA = 100.0
TILTED = np.array([6e-6, 8e-6, 3e-4, -2e-4, 1e-4, -2e-4, 0.01, -0.02])
ROUGH = Roughness((1e-6, 0.5e-6), (3.0, 0.5))


def make(cavitation: str, boundary: str, roughness: Roughness = ROUGH) -> Film:
    return Film(
        0.01, 20e-6, 5e-3, 20e-3, roughness, cavitation=cavitation, boundary=boundary, grid=FilmGrid(48, 12)
    )


def balance(memory: FilmMemory) -> tuple[csr_matrix, FloatArray]:
    """Return matrix and source of all cells, node (i, j) at i m + j, assembled anew from the conductances."""
    cells, k_z = memory.fields.cells, memory.fields.z_faces["k_z"]
    k_theta, source = cells["k_theta"], cells["source"]
    n, m = source.shape
    number = np.arange(n * m).reshape(n, m)
    along = np.concatenate([number.ravel(), number[:, :-1].ravel()])
    towards = np.concatenate([np.roll(number, -1, axis=0).ravel(), number[:, 1:].ravel()])
    weights = np.concatenate([k_theta.ravel(), k_z[:, 1:-1].ravel()])
    links = csr_matrix((weights, (along, towards)), shape=(n * m, n * m))
    links = links + links.T
    ends = np.zeros((n, m))
    ends[:, 0] += k_z[:, 0]
    ends[:, -1] += k_z[:, -1]
    return diags(np.asarray(links.sum(axis=1)).ravel() + ends.ravel()) - links, source.ravel()


def test_reynolds_solves_the_complementarity_problem() -> None:
    film = make("reynolds", "periodic")
    memory = film.memory()
    film_state(film, TILTED, omega=OMEGA, memory=memory)
    matrix, source = balance(memory)
    p = memory.pressure.ravel()
    residual = matrix @ p - source
    # To rounding of a solve whose condition is about n²: 1e-12 of the largest.
    assert p.min() >= -1e-12 * p.max()
    assert residual.min() >= -1e-12 * abs(source).max()
    assert abs(p * residual).max() <= 1e-12 * p.max() * abs(source).max()
    assert 0.2 < np.mean(p > 0.0) < 0.8


def test_full_film_is_that_of_a_general_solver() -> None:
    film = make("none", "periodic")
    memory = film.memory()
    state = film_state(film, TILTED, omega=OMEGA, memory=memory)
    matrix, source = balance(memory)
    expected = spsolve(matrix.tocsc(), source).reshape(memory.pressure.shape)
    unit = pressure_unit(film.data())
    np.testing.assert_allclose(
        state.pressure[1:-1].T, unit * expected, atol=1e-11 * unit * abs(expected).max()
    )


STEADY = {
    "offset": [6e-6, 8e-6, 0.0, 0.0],
    "high": [12e-6, 12e-6, 1e-4, -0.6e-4],
    "tilted": [1e-6, 2e-6, 9e-4, -6e-4],
}


@pytest.mark.parametrize("omega", [OMEGA, -OMEGA])
@pytest.mark.parametrize("state", STEADY)
def test_jfo_conserves_mass(state: str, omega: float) -> None:
    film = make("jfo", "groove")
    memory = film.memory()
    film_state(film, np.append(STEADY[state], np.zeros(4)), omega=omega, memory=memory)
    p, fill, fields = memory.pressure, memory.fill, memory.fields
    d_zeta = film.length / (film.grid.z * film.radius)
    upstream = fill if omega > 0.0 else np.roll(fill, -1, axis=0)
    cells = fields.cells
    across = omega * d_zeta * cells["wedge"] * upstream - cells["k_theta"] * (np.roll(p, -1, axis=0) - p)
    padded = np.pad(p, ((0, 0), (1, 1)))
    up = -fields.z_faces["k_z"] * np.diff(padded, axis=1)
    supplied = (across[0] - across[-1]).sum() + (up[0, -1] - up[0, 0])
    lost = up[1:, -1].sum() - up[1:, 0].sum()
    carried = abs(across).sum(axis=1).max()
    # From groove to ends, and in every cell: 1e-8 asked for, rounding found.
    assert abs(across[0].sum() - across[-1].sum() - lost) < 1e-12 * carried
    missed = (across - np.roll(across, 1, axis=0) + up[:, 1:] - up[:, :-1])[1:]
    assert abs(missed).max() < 1e-12 * carried
    assert supplied > 0.0
    # What makes it a solution: full where it presses, never more than full.
    assert p.min() >= -1e-12 * p.max()
    assert fill.max() <= 1.0 + 1e-12
    assert fill.min() > 0.0
    assert abs(p * (1.0 - fill)).max() == 0.0


@pytest.mark.parametrize("state", ["offset", "high"])
def test_jfo_and_reynolds_agree_without_reformation(state: str) -> None:
    y = np.append(STEADY[state], np.zeros(4))
    one = film_state(make("jfo", "groove"), y, omega=OMEGA)
    other = film_state(make("reynolds", "groove"), y, omega=OMEGA)
    np.testing.assert_allclose(one.pressure, other.pressure, atol=1e-10 * other.pressure.max())
    assert abs(one.torque) < abs(other.torque)  # the cavitated part is only partly wetted


def test_jfo_and_reynolds_differ_where_the_film_forms_again() -> None:
    y = np.append(STEADY["tilted"], np.zeros(4))
    jfo, reynolds = make("jfo", "groove"), make("reynolds", "groove")
    memory = jfo.memory()
    one = film_state(jfo, y, omega=OMEGA, memory=memory)
    other = film_state(reynolds, y, omega=OMEGA)
    full = memory.active[1:].astype(bool)
    assert (full[1:] & ~full[:-1]).any()  # full again behind cavitation
    assert abs(one.pressure - other.pressure).max() > 0.05 * other.pressure.max()


def test_moving_roughness_carries_oil_along() -> None:
    """The sign of the shear flow, from the flow between a smooth wall and transverse ridges that move.

    In the frame of the ridges the gap is steady and the wall moves at −U: with no mean pressure gradient the
    flow is −(U/2)⟨h⁻²⟩/⟨h⁻³⟩, in the frame of the wall U h more. That is (U/2)(h + σ φ_s).
    """
    for separation in (6.0, 10.0):
        amplitude = np.sqrt(2.0) / separation  # ridges of unit rms in units of h

        def mean(power: int, amplitude: float = amplitude) -> float:
            value = quad(lambda x: (1.0 + amplitude * np.cos(x)) ** power, 0.0, np.pi, epsabs=1e-12)[0]
            return float(value) / np.pi

        carried = separation * (1.0 - mean(-2) / mean(-3))
        assert carried > 0.0
        # Patir and Cheng's γ = 1/9 is close to ridges, but random ones, in a fit: same sign, same size.
        assert shear_factor(np.array(separation), 1 / 9) == pytest.approx(carried, rel=0.6)


@pytest.mark.parametrize(("rms", "sign"), [((1e-6, 0.0), 1.0), ((0.0, 1e-6), -1.0)])
def test_rough_journal_is_surface_one(rms: tuple[float, float], sign: float) -> None:
    """A rough journal drags more oil where the gap is narrow: a stronger wedge the other way round."""
    film = make("none", "periodic", Roughness(rms))
    memory = film.memory()
    film_state(film, np.array([8e-6] + [0.0] * 7), omega=OMEGA, memory=memory)
    theta = film.theta + np.pi / film.grid.theta
    gap = 20e-6 + 8e-6 * np.cos(theta)
    # h > 3σ everywhere, so that h_T = h: what is left of the wedge is σ φ_s.
    shear = memory.fields.cells["wedge"][:, 0] * 20e-6 - gap
    np.testing.assert_allclose(shear, sign * 1e-6 * shear_factor(gap / 1e-6, 1.0), atol=1e-6 * 1e-6)
