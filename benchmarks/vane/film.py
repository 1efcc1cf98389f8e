"""The structured film solver against a general sparse one: same equations, same answer, time of a call.

python -m benchmarks.vane.film

A call gives the wrench with its 45 derivatives on 128 × 32 cells, for a journal on a small orbit. The general
solver is handed the conductances and sources for nothing; it builds its matrix, finds the same cavitated
nodes from the same first guess with SuperLU, and solves for as many adjoints. Times are of the thread,
medians over the orbit, so that a busy machine counts little.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csc_matrix, csr_matrix, diags
from scipy.sparse.linalg import splu

from tribodyn.kernels.film.adjoint import force_scale
from tribodyn.kernels.film.data import FilmFields
from tribodyn.kernels.film.wrench import film_wrench_and_jacobian
from tribodyn.lubrication import Film, FilmGrid, Roughness

FloatArray = NDArray[np.float64]

LEVEL = np.array([6e-6, 8e-6, 0.0, 0.0, 1e-4, -2e-4, 0.0, 0.0])
TILTED = np.array([6e-6, 8e-6, 3e-4, -2e-4, 1e-4, -2e-4, 0.01, -0.02])
OMEGA = 100.0
POINTS = 60
LIMITS = {"no tilt": 1.0, "tilt": 4.0}  #: Milliseconds asked for.


@dataclass
class General:
    """The same film with general sparse matrices and no structure."""

    fields: FilmFields  #: Conductances and sources of all cells.
    loads: FloatArray  #: Derivatives of the wrench by the pressure, shape (cells, 5).
    active: NDArray[np.bool_]  #: Cells with a full film.

    def matrix(self) -> csc_matrix:
        """Return the matrix of all cells."""
        k_theta, k_z = self.fields.cells["k_theta"], self.fields.z_faces["k_z"]
        n, m = k_theta.shape
        number = np.arange(n * m).reshape(n, m)
        rows = np.concatenate([number.ravel(), number[:, :-1].ravel()])
        columns = np.concatenate([np.roll(number, -1, axis=0).ravel(), number[:, 1:].ravel()])
        weights = np.concatenate([k_theta.ravel(), k_z[:, 1:-1].ravel()])
        links = csr_matrix((weights, (rows, columns)), (n * m, n * m))
        centre = k_theta + np.roll(k_theta, 1, axis=0) + k_z[:, 1:] + k_z[:, :-1]
        return csc_matrix(diags(centre.ravel()) - links - links.T)

    def solve(self) -> tuple[FloatArray, FloatArray]:
        """Return the pressure and the adjoints."""
        matrix, source = self.matrix(), self.fields.cells["source"].ravel()
        while True:
            full = np.flatnonzero(self.active)
            factors = splu(matrix[full][:, full], permc_spec="MMD_AT_PLUS_A")
            pressure = np.zeros(source.size)
            pressure[full] = factors.solve(source[full])
            residual = matrix @ pressure - source
            leaves = self.active & (pressure < -1e-13 * abs(pressure).max())
            returns = ~self.active & (residual < -1e-13 * abs(source).max())
            if not (leaves.any() or returns.any()):
                return pressure, factors.solve(self.loads[full])
            self.active = (self.active & ~leaves) | returns


def loads_of(film: Film) -> FloatArray:
    """Return the derivatives of force and moment by the pressure, and a fifth right-hand side, (cells, 5)."""
    z = film.z[1:-1]
    c, s = np.cos(film.theta)[:, None], np.sin(film.theta)[:, None]
    columns = [c + 0 * z, s + 0 * z, -s * z, -c * z, c * s + 0 * z]
    return np.stack([column.ravel() for column in columns], axis=1)


def orbit(state: FloatArray, points: int) -> list[FloatArray]:
    """Return states on a small orbit: steps as a time integration takes them."""
    turns = np.linspace(0.0, 2.0 * np.pi, points)
    return [state * (1.0 + 0.02 * np.sin(turn + np.arange(8.0))) for turn in turns]


def milliseconds(call: Callable[[], object]) -> float:
    """Return the time of the thread for one call [ms]."""
    begin = time.thread_time()
    call()
    return 1e3 * (time.thread_time() - begin)


def compare(state: FloatArray, points: int) -> tuple[float, float, float]:
    """Return median times [ms], structured and general, and the largest difference of forces."""
    film = Film(0.01, 20e-6, 5e-3, 20e-3, Roughness((1e-6, 1e-6)), grid=FilmGrid(128, 32))
    data, memory, whole = film.data(), film.memory(), film.memory()
    out, again, jacobian = np.empty(5), np.empty(5), np.empty((5, 9))
    loads = loads_of(film)
    ours, theirs, difference = [], [], 0.0
    film_wrench_and_jacobian(data, memory, state, OMEGA, out, jacobian)
    active = memory.active.ravel() == 1
    for y in orbit(state, points):
        ours.append(milliseconds(lambda y=y: film_wrench_and_jacobian(data, memory, y, OMEGA, out, jacobian)))
        # A tilt of 1e-13 makes the film assemble its whole length, as the general solver must.
        film_wrench_and_jacobian(data, whole, y + np.eye(8)[2] * 1e-13, OMEGA, again, jacobian)
        general = General(whole.fields, loads, active)
        found: list[tuple[FloatArray, FloatArray]] = []
        theirs.append(milliseconds(lambda found=found, general=general: found.append(general.solve())))
        active = general.active
        force = force_scale(data) * loads[:, :2].T @ found[0][0]
        difference = max(difference, float(abs(force - out[:2]).max() / abs(out[:2]).max()))
    return float(np.median(ours)), float(np.median(theirs)), difference


def run(quick: bool = False) -> dict[str, Any]:
    """Measure, print and return; ``quick``: at a few points of the orbit."""
    found = {}
    print("one film evaluation with derivatives, 128 x 32, warm start, one thread")
    print(f"{'':8s} {'ours [ms]':>10s} {'limit':>6s} {'SuperLU [ms]':>13s} {'ratio':>6s} {'difference':>11s}")
    for name, state in (("no tilt", LEVEL), ("tilt", TILTED)):
        ours, theirs, difference = compare(state, 3 if quick else POINTS)
        ratio = theirs / ours
        found[name] = {"ours [ms]": ours, "SuperLU [ms]": theirs, "ratio": ratio, "difference": difference}
        figures = f"{ours:10.2f} {LIMITS[name]:6.1f} {theirs:13.2f} {ratio:6.1f} {difference:11.1e}"
        print(f"{name:8s} {figures}")
    return found


if __name__ == "__main__":
    run()
