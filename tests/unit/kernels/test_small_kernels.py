"""Tables, matrices and peaks of kernels against closed forms and NumPy."""

from __future__ import annotations

import math

import numpy as np
import pytest

from mebdf.arrays import FloatArray
from tribodyn.contact import RSDC, SurfacePair, tabulate
from tribodyn.contact.contact_law import ContactLaw
from tribodyn.core.remembered import ContactTable
from tribodyn.kernels import dense
from tribodyn.kernels.ledger import NOW
from tribodyn.kernels.lookup import pressure_and_damping, stored_energy
from tribodyn.kernels.peaks import IMPACT, begin, new_peaks, note


class Cubic(ContactLaw):
    """A law that cubic interpolation and sixth-order differences reproduce."""

    name = "cubic"

    def stiffness_pressure(self, h_star: FloatArray) -> FloatArray:
        return (8.0 - h_star) ** 3

    def damping_pressure(self, h_star: FloatArray) -> FloatArray:
        return 2.0 * (8.0 - h_star) ** 2


@pytest.fixture(scope="module")
def cubic(table_1_pair: SurfacePair) -> ContactTable:
    return tabulate(Cubic(table_1_pair), onset=8.0)


@pytest.fixture(scope="module")
def table(table_1_pair: SurfacePair) -> ContactTable:
    return tabulate(RSDC(table_1_pair))


@pytest.mark.parametrize("h_star", [-4.0, -3.999, -1.2345, 0.0, 3.3, 6.9999])
def test_a_cubic_law_is_reproduced(cubic: ContactTable, h_star: float) -> None:
    x = 8.0 - h_star
    # Rounding: the slopes are differences of numbers of size x³ over a step of 1/128.
    expected = (x**3, -3.0 * x**2, 2.0 * x**2, -4.0 * x)
    assert pressure_and_damping(cubic, h_star) == pytest.approx(expected, rel=1e-10)
    assert stored_energy(cubic, h_star) == pytest.approx(x**4 / 4.0, rel=1e-11)


def test_slopes_are_those_of_the_interpolant(table: ContactTable) -> None:
    # The interpolant is a cubic on each interval, where a fourth-order difference is exact up to rounding.
    step, inside = 1.0 / table.inverse_step, 1e-3
    for h_star in -4.0 + step * (np.arange(7, 1500, 83) + 0.37):
        values = [np.array(pressure_and_damping(table, h_star + k * inside)) for k in (-2, -1, 1, 2)]
        difference = (values[0] - 8.0 * values[1] + 8.0 * values[2] - values[3]) / (12.0 * inside)
        p, dp, c, dc = pressure_and_damping(table, h_star)
        # Rounding of values of size p over 1e-3, and where the smoothed C fades out, of C itself.
        assert dp == pytest.approx(difference[0], abs=1e-12 * p / inside)
        assert dc == pytest.approx(difference[2], abs=1e-12 * c / inside)


def test_energy_slope_is_minus_the_pressure(table: ContactTable) -> None:
    rng = np.random.default_rng(1)
    for h_star in rng.uniform(-4.5, 4.0, 40):
        d = 1e-4
        slope = (stored_energy(table, h_star + d) - stored_energy(table, h_star - d)) / (2.0 * d)
        # d²/6 of the second derivative of P, which is below 30 P here, is 5e-8 P; rounding adds 1e-11 W/P.
        assert -slope == pytest.approx(pressure_and_damping(table, h_star)[0], rel=2e-7)


def test_values_and_slopes_join_at_nodes_and_at_the_lower_end(table: ContactTable) -> None:
    step = 1.0 / table.inverse_step
    for node in [-4.0, -4.0 + step, 0.0, 3.0, 4.0 - step]:
        below = pressure_and_damping(table, node - 1e-12)
        above = pressure_and_damping(table, node)
        assert below == pytest.approx(above, rel=1e-8)
        assert stored_energy(table, node - 1e-12) == pytest.approx(stored_energy(table, node), rel=1e-10)


def test_not_a_number_stays_not_a_number(table: ContactTable) -> None:
    p, _, c, _ = pressure_and_damping(table, math.nan)
    assert math.isnan(p)
    assert math.isnan(c)
    assert math.isnan(stored_energy(table, math.nan))


SIZES = [(3, 3, 3), (5, 8, 4), (8, 5, 4), (30, 36, 25), (4, 4, 0)]  #: Rows, columns and rank.
ROUNDING = 1e-13  #: A hundred roundings and more: sums of 36 products, some ten sweeps of rotations.


def matrix(m: int, n: int, rank: int) -> FloatArray:
    """Return a matrix of a rank."""
    chance = np.random.default_rng(m + n)
    return np.asarray(chance.normal(size=(m, rank)) @ chance.normal(size=(rank, n)))


@pytest.mark.parametrize(("m", "n", "rank"), SIZES)
def test_singular_values(m: int, n: int, rank: int) -> None:
    a = matrix(m, n, rank)
    u, values, v = dense.svd(a)
    size = max(values[0], 1.0)
    k = min(m, n)
    assert (u.shape, values.shape, v.shape) == ((m, k), (k,), (n, n))
    assert values == pytest.approx(np.linalg.svd(a, compute_uv=False), abs=ROUNDING * size)
    assert (u * values) @ v[:k] == pytest.approx(a, abs=ROUNDING * size)
    assert v @ v.T == pytest.approx(np.eye(n), abs=ROUNDING)
    assert u[:, :rank].T @ u[:, :rank] == pytest.approx(np.eye(rank), abs=ROUNDING)
    assert a @ v[rank:].T == pytest.approx(0.0, abs=ROUNDING * size)


@pytest.mark.parametrize(("m", "n", "rank"), SIZES[:-1])
def test_least_squares(m: int, n: int, rank: int) -> None:
    a, b = matrix(m, n, rank), np.arange(1.0, m + 1.0)
    assert dense.lstsq(a, b) == pytest.approx(np.linalg.lstsq(a, b)[0], rel=1e-9, abs=1e-9)


def test_solutions_and_inverses() -> None:
    a = matrix(6, 6, 6)
    for right in (np.arange(6.0), np.arange(12.0).reshape(6, 2)):
        assert a @ dense.solve(a, right) == pytest.approx(right, abs=1e-10)
    assert a @ dense.inverse(a) == pytest.approx(np.eye(6), abs=1e-10)
    assert not np.isfinite(dense.solve(np.zeros((2, 2)), np.ones(2))).any()


def of_columns(a: FloatArray) -> FloatArray:
    """Return a matrix that is kept column by column and cannot be written to."""
    columns = np.asfortranarray(a)
    columns.flags.writeable = False
    return columns


def test_how_a_matrix_lies_in_memory_changes_no_bit() -> None:
    a = matrix(4, 4, 4)
    b = a @ a.T + np.eye(4)
    for function in (dense.inverse, dense.svd, dense.eigh, dense.cholesky, lambda m: dense.product(m, m)):
        np.testing.assert_array_equal(np.vstack(function(of_columns(b))), np.vstack(function(b)))
    for rows, columns in zip(dense.triangle(a, 4, 0.0), dense.triangle(of_columns(a), 4, 0.0), strict=True):
        np.testing.assert_array_equal(rows, columns)
    normals, across = dense.triangle(a, 4, 0.0)[2], np.asfortranarray(b)
    dense.reflect(of_columns(normals), across)
    dense.reflect(normals, b)
    np.testing.assert_array_equal(across, b)


def noted(times, values, *, begins=(0.0,), impact_time=1.0):
    """Return books of one quantity that were told the values at the times."""
    peaks = new_peaks(1, reversals=len(begins) - 1, impact_time=impact_time)
    for t, value in zip(times, values, strict=True):
        peaks.values[NOW] = value
        begin(peaks, t) if t in begins else note(peaks, t)
    return peaks


def test_a_parabola_is_found_between_equal_steps():
    t = np.arange(0.0, 1.01, 0.1)
    peaks = noted(t, 5.0 - 20.0 * (t - 0.33) ** 2)
    assert peaks.largest[0, IMPACT, 0] == pytest.approx(5.0)
    assert peaks.when[0, IMPACT, 0] == pytest.approx(0.33)


def test_the_top_of_an_impact_is_missed_by_a_tenth_of_what_steps_alone_miss():
    """Eight steps in an impact of a half sine, wherever they fall."""
    for shift in np.linspace(0.0, 1.0, 11):
        t = (np.arange(12) + shift) / 8.0
        force = np.maximum(np.sin(np.pi * (t - 0.125)), 0.0)
        peaks = noted(np.append(0.0, t + 1e-3), np.append(0.0, force), impact_time=10.0)
        alone = 1.0 - force.max()
        # The fourth derivative of the sine over steps of an eighth leaves 0.2 %.
        assert abs(1.0 - peaks.largest[0, IMPACT, 0]) < 0.1 * alone + 2e-3


def test_stretches_and_their_parts_are_kept_apart():
    t = np.arange(600) / 100.0
    since = np.mod(t, 3.0)
    values = np.where(t < 3.0, 7.0, 9.0) * np.exp(-200.0 * (since - 0.5) ** 2) + since
    peaks = noted(t, values, begins=(0.0, 3.0))
    # The bells stand on a slope of 1, and the second stretch begins where the first ends.
    assert peaks.largest[:, :, 0] == pytest.approx(np.array([[7.5, 2.99], [9.5, 2.99]]), abs=0.02)
    assert peaks.when[:, IMPACT, 0] == pytest.approx([0.5, 3.5], abs=0.01)
