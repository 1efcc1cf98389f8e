"""Calls of the MEBDF over those of BDF and CVODE at equal digits, on random problems it was not tuned to.

    python -m benchmarks.solver.held_out

writes ``docs/_static/mebdf_held_out.csv``: geometric means by family. Calls are all those of the right-hand
side, with those for differences. Ends are those of Radau at 1e-12. A problem counts at the digits that all
solvers have reached.
"""

from __future__ import annotations

import csv
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any, Final

import numpy as np
from scipy.integrate import solve_ivp

from benchmarks.solver.published.__main__ import solve
from benchmarks.solver.published.definitions import Published

TARGET: Final = Path(__file__).parents[2] / "docs" / "_static" / "mebdf_held_out.csv"
SOLVERS: Final = ("MEBDF", "BDF", "CVODE")
DIGITS: Final = (4.0, 6.0)
TOLERANCES: Final = 10.0 ** -np.arange(2.0, 9.1, 0.5)
SEEDS: Final = 10  #: Problems of each family.

Rng = np.random.Generator
Problem = tuple[Callable[[float, Any], Any], Any, float]  #: Right-hand side, start and end.


def _oscillator(rng: Rng) -> Problem:
    mu = 10.0 ** rng.uniform(0, 4)
    return (
        lambda t, y: np.array([y[1], mu * (1 - y[0] ** 2) * y[1] - y[0]]),
        [2.0, 0.0],
        mu * rng.uniform(0.5, 3),
    )


def _nerve(rng: Rng) -> Problem:
    slow, pulse = 10.0 ** rng.uniform(-3, -1), rng.uniform(0.4, 1.0)
    return (
        lambda t, y: np.array([(y[0] - y[0] ** 3 / 3 - y[1] + pulse) / slow, y[0] + 0.7 - 0.8 * y[1]]),
        [-1.0, 1.0], rng.uniform(2, 8),
    )  # fmt: skip


def _flame(rng: Rng) -> Problem:
    small = 10.0 ** rng.uniform(-4, -1.5)
    return lambda t, y: y**2 - y**3, [small], rng.uniform(1.05, 2.0) / small


def _followed(rng: Rng) -> Problem:
    n = int(rng.integers(2, 6))
    rates, turn = 10.0 ** rng.uniform(0, 6, n), np.linalg.qr(rng.normal(size=(n, n)))[0]

    def fun(t, y):
        away = turn.T @ y - np.cos(t)
        return turn @ (-rates * (away + away**3) - np.sin(t))

    return fun, turn @ np.full(n, 1.3), rng.uniform(1, 10)


def _linear(rng: Rng) -> Problem:
    n = int(rng.integers(1, 4))
    rates, speeds = 10.0 ** rng.uniform(-1, 4, n), rng.uniform(0, 3, n)
    blocks = np.kron(np.diag(rates), [[-1, 0], [0, -1]]) + np.kron(np.diag(speeds), [[0, 1], [-1, 0]])
    basis = np.linalg.qr(rng.normal(size=(2 * n, 2 * n)))[0] + 0.3 * rng.normal(size=(2 * n, 2 * n)) / n
    matrix, force = basis @ blocks @ np.linalg.inv(basis), rng.normal(size=2 * n)
    return lambda t, y: matrix @ y + force * np.sin(t), rng.normal(size=2 * n), rng.uniform(2, 20)


def _kinetics(rng: Rng) -> Problem:
    n, m = int(rng.integers(3, 8)), int(rng.integers(4, 12))
    sides, rates = rng.integers(0, n, (m, 4)), 10.0 ** rng.uniform(-2, 5, (m, 2))
    change = np.zeros((n, m))
    for sign, k in zip((-1, -1, 1, 1), range(4), strict=True):
        np.add.at(change, (sides[:, k], np.arange(m)), sign)

    def fun(t, y):
        ahead, back = y[sides[:, 0]] * y[sides[:, 1]], y[sides[:, 2]] * y[sides[:, 3]]
        return change @ (rates[:, 0] * ahead - rates[:, 1] * back)

    return fun, rng.uniform(0, 1, n), 10.0 ** rng.uniform(-1, 2)


def _brusselator(rng: Rng) -> Problem:
    n, spread = 12, 10.0 ** rng.uniform(-2, 0)
    a, b, spots = 1.0, rng.uniform(1.5, 3.5), np.linspace(0, 1, 14)[1:-1]

    def fun(t, y):
        u, v = y[:n], y[n:]
        wide = np.concatenate(([a], u, [a])), np.concatenate(([b / a], v, [b / a]))
        ahead = a + u * u * v - (b + 1) * u
        return np.concatenate((ahead, b * u - u * u * v)) + spread * 169 * np.concatenate(
            [np.diff(level, 2) for level in wide]
        )

    return fun, np.append(a + np.sin(2 * np.pi * spots), np.full(n, b / a)), rng.uniform(4, 12)


def _switch(rng: Rng) -> Problem:
    width, friction = 10.0 ** rng.uniform(-4, -1), rng.uniform(0.3, 1.5)
    return (
        lambda t, y: np.array([y[1], np.sin(t) - friction * np.tanh(y[1] / width) - 0.2 * y[0]]),
        [1.0, 0.5], rng.uniform(4, 15),
    )  # fmt: skip


FAMILIES: Final = (_oscillator, _nerve, _flame, _followed, _linear, _kinetics, _brusselator, _switch)


def calls(problem: Published, solver: str, tolerances: Any) -> list[float]:
    """Return the logarithms of calls for the digits, NaN where they are not reached."""
    found = np.array([solve(problem, solver, rtol) for rtol in tolerances])
    found = found[np.isfinite(found[:, 0])]
    reached = np.maximum.accumulate(found[:, 0]) if len(found) else np.zeros(0)
    return [
        np.interp(digits, reached, np.log(found[:, 1])) if len(found) and reached[-1] >= digits else np.nan
        for digits in DIGITS
    ]


def run(quick: bool = False) -> dict[str, Any]:
    """Print, write and return means by family; ``quick``: one problem of one family, not written."""
    rows: dict[str, Any] = {}
    for family in FAMILIES[: 1 if quick else None]:
        costs = []
        for seed in range(1 if quick else SEEDS):
            fun, y0, t_end = family(np.random.default_rng([911, seed]))
            tight = {"rtol": 1e-8 if quick else 1e-12, "atol": 1e-14}
            end = solve_ivp(fun, (0.0, t_end), y0, method="Radau", **tight).y[:, -1]
            problem = Published(fun, np.array(y0, dtype=float), t_end, np.arange(len(y0)), end)
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                costs.append([calls(problem, solver, TOLERANCES[:: 6 if quick else 1]) for solver in SOLVERS])
        rows[family.__name__[1:]] = np.array(costs)
    rows["all"] = np.concatenate(list(rows.values()))
    table = [["family", "problems", *(f"over {s} at {d:g}" for s in SOLVERS[1:] for d in DIGITS)]]
    for name, costs in rows.items():
        ratios = np.exp(np.nanmean(costs[:, :1] - costs[:, 1:], axis=0)).ravel()
        table.append([name, str(len(costs)), *(f"{ratio:.3f}" for ratio in ratios)])
        print(*table[-1], flush=True)
    if not quick:
        with TARGET.open("w", encoding="utf-8", newline="") as file:
            csv.writer(file, lineterminator="\n").writerows(table)
    return rows


if __name__ == "__main__":
    run()
