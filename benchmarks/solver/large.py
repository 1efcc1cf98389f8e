"""Large systems: sparse ones beside SciPy's BDF, dense ones without a Jacobian beside CVODE.

OPENBLAS_NUM_THREADS=1 python -m benchmarks.solver.large

Times of the processor count what more threads of BLAS only wait.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from contextlib import suppress
from multiprocessing import get_context
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import psutil
from numpy.typing import NDArray
from scipy.fft import dst
from scipy.integrate import solve_ivp
from scipy.sparse import csc_array, diags_array, eye_array, kron

from tribodyn.integrate import MEBDF

FloatArray = NDArray[np.float64]
EXACT = {"rtol": 1e-8, "atol": 1e-10}
MOST = 5000  #: Calls of a right-hand side after which a run is given up.


class GaveUpError(Exception):
    """A run made too many calls."""


class Large(NamedTuple):
    """A system of many equations."""

    name: str
    fun: Callable[[float, FloatArray], FloatArray]
    y0: FloatArray
    t_end: float
    pattern: Any
    exact: FloatArray | None = None  #: The end, where it is known in closed form.


def second_differences(n: int) -> Any:
    """Return the matrix of second differences between walls at zero."""
    return csc_array(diags_array([np.ones(n - 1), np.full(n, -2.0), np.ones(n - 1)], offsets=[-1, 0, 1]))


def without_zeros(pattern: Any) -> Any:
    """Return a pattern without the zeros that products store: they would cost BDF evaluations."""
    pattern = csc_array(pattern)
    pattern.eliminate_zeros()
    return pattern


def brusselator(n: int, square: bool) -> Large:
    """Return two species, one after the other at each point of a line or a square."""
    m = round(np.sqrt(n / 2)) if square else n // 2
    line = second_differences(m)
    if square:
        diffusion = 0.002 * m**2 * (kron(line, eye_array(m)) + kron(eye_array(m), line)).tocsr()
    else:
        diffusion = 0.02 * (m + 1) ** 2 * line.tocsr()
    rest = np.array([1.0, 3.0])

    def fun(t: float, y: FloatArray) -> FloatArray:
        u, v = y[0::2], y[1::2]
        f = np.empty_like(y)
        f[0::2] = 1.0 + u * u * v - 4.0 * u + diffusion @ (u - rest[0])
        f[1::2] = 3.0 * u - u * u * v + diffusion @ (v - rest[1])
        return f

    points = diffusion.shape[0]
    y0 = np.tile(rest, points)
    y0[0::2] += np.sin(2.0 * np.pi * np.arange(1, points + 1) / (points + 1))
    pattern = kron(diffusion != 0, eye_array(2)) + kron(eye_array(points), np.ones((2, 2)))
    name = f"Brusselator, {'square' if square else 'line'}, {2 * points}"
    return Large(name, fun, y0, 10.0, without_zeros(pattern))


def heat(n: int) -> Large:
    """Return heat conduction along a bar with a reaction."""
    matrix = (n + 1) ** 2 / np.pi**2 * second_differences(n)

    def fun(t: float, y: FloatArray) -> FloatArray:
        f: FloatArray = matrix @ y + 50.0 * y * (1.0 - y)
        return f

    return Large(f"heat, {n}", fun, 0.1 * np.sin(np.pi * np.arange(1, n + 1) / (n + 1)), 1.0, matrix)


def beam(n: int) -> Large:
    """Return a beam on two supports with internal damping, set moving by a load: deflections and speeds.

    The lowest mode has the frequency 1, the highest that of the number of points squared.
    """
    m = n // 2
    fourth = (m + 1) ** 4 / np.pi**4 * (second_differences(m) @ second_differences(m))

    def fun(t: float, y: FloatArray) -> FloatArray:
        u, v = y[0::2], y[1::2]
        f = np.empty_like(y)
        f[0::2] = v
        f[1::2] = np.sin(FREQUENCY * t) - fourth @ (u + DAMPING * v)
        return f

    pattern = kron(fourth != 0, [[0.0, 0.0], [1.0, 1.0]]) + kron(eye_array(m), [[0.0, 1.0], [0.0, 0.0]])
    return Large(f"beam, {n}", fun, np.zeros(2 * m), 10.0, without_zeros(pattern), beam_at(10.0, m))


FREQUENCY, DAMPING = 0.7, 0.05  #: Of the beam's load, and what its speed counts beside its deflection.


def beam_at(t: float, m: int) -> FloatArray:
    """Return deflections and speeds of :func:`beam` by its modes, q'' + c q' + k q = b sin ωt from rest."""
    number = np.arange(1, m + 1)
    k = ((m + 1) / np.pi) ** 4 * (2.0 * np.sin(0.5 * np.pi * number / (m + 1))) ** 4
    c, load, w = DAMPING * k, dst(np.ones(m), type=1) / (m + 1), FREQUENCY
    beside = (k - w * w) ** 2 + (c * w) ** 2
    of_sin, of_cos = load * (k - w * w) / beside, -load * c * w / beside
    fast = 0.5 * (-c - np.sqrt(c * c - 4.0 * k + 0.0j))
    slow = k / fast
    first = (of_cos * fast - of_sin * w) / (slow - fast)
    second = -of_cos - first
    q = of_sin * np.sin(w * t) + of_cos * np.cos(w * t) + first * np.exp(slow * t) + second * np.exp(fast * t)
    v = w * (of_sin * np.cos(w * t) - of_cos * np.sin(w * t))
    v = v + slow * first * np.exp(slow * t) + fast * second * np.exp(fast * t)
    y = np.empty(2 * m)
    y[0::2], y[1::2] = 0.5 * dst(q.real, type=1), 0.5 * dst(v.real, type=1)
    return y


def solve(
    problem: Large, method: Any, tolerance: float, reference: FloatArray, **options: Any
) -> dict[str, Any]:
    """Return digits, NaN after ``MOST`` calls, calls of the right-hand side and time of the processor [s]."""
    calls = 0

    def counted(t: float, y: FloatArray) -> FloatArray:
        nonlocal calls
        calls += 1
        if calls > MOST:
            raise GaveUpError
        return problem.fun(t, y)

    begin = time.process_time()
    limits = {"rtol": tolerance, "atol": 0.01 * tolerance}
    end = np.full(problem.y0.size, np.nan)
    with suppress(GaveUpError):
        end = solve_ivp(counted, (0.0, problem.t_end), problem.y0, method=method, **limits, **options).y[
            :, -1
        ]
    seconds = time.process_time() - begin
    return {"digits": digits(end, reference), "calls": calls, "seconds": seconds}


def digits(y: FloatArray, reference: FloatArray) -> float:
    """Return the number of correct digits, relative to |y| + 1."""
    return float(-np.log10(np.max(np.abs(y - reference) / (1.0 + np.abs(reference)))))


def with_cvode(problem: Large, tolerance: float, reference: FloatArray) -> dict[str, Any]:
    """Run CVODE with a dense Jacobian by differences."""
    from sksundae.cvode import CVODE

    calls = 0

    def counted(t: float, y: FloatArray, f: FloatArray) -> None:
        nonlocal calls
        calls += 1
        f[:] = problem.fun(t, y)

    solver = CVODE(counted, rtol=tolerance, atol=0.01 * tolerance, method="BDF", max_num_steps=100_000)
    begin = time.process_time()
    found = np.asarray(solver.solve(np.array([0.0, problem.t_end]), problem.y0).y)[-1]
    seconds = time.process_time() - begin
    return {"digits": digits(found, reference), "calls": calls, "seconds": seconds}


def tell(name: str, tolerance: float, runs: dict[str, dict[str, Any]]) -> None:
    """Print runs side by side."""
    texts = [
        f"{who} {run['digits']:5.1f} digits {run['calls']:6d} calls {run['seconds']:7.3f} s"
        for who, run in runs.items()
    ]
    print(f"{name:26s} {tolerance:.0e}", *texts, sep="  ", flush=True)


def peak(n: int) -> float:
    """Return the most memory that the Brusselator of ``n`` equations on a line takes of a process [MB]."""
    problem, few = brusselator(n, False), brusselator(100, False)
    solve(few, MEBDF, 1e-3, few.y0, jac_sparsity=few.pattern)
    before = psutil.Process().memory_info().rss
    Path("/proc/self/clear_refs").write_text("5", encoding="ascii")
    solve(problem, MEBDF, 1e-3, problem.y0, jac_sparsity=problem.pattern)
    lines = Path("/proc/self/status").read_text(encoding="ascii").splitlines()
    most = next(int(line.split()[1]) for line in lines if line.startswith("VmHWM"))
    return most / 1024.0 - before / 1024.0**2


def run(quick: bool = False) -> None:
    """Print what all problems took; ``quick``: up to a thousand equations."""
    sizes = (1000,) if quick else (1000, 10_000)
    sparse = [
        make(n)
        for make in (lambda n: brusselator(n, False), lambda n: brusselator(n, True), heat)
        for n in sizes
    ]
    # More points are beyond the 16 digits: their rounding moves the lowest mode by more than a thousandth.
    sparse.append(beam(1000))
    for problem in sparse:
        given = {"jac_sparsity": problem.pattern}
        reference = problem.exact
        if reference is None:
            span = (0.0, problem.t_end)
            reference = solve_ivp(problem.fun, span, problem.y0, method=MEBDF, **EXACT, **given).y[:, -1]
        for tolerance in (1e-3, 1e-5):
            runs = {name: solve(problem, name, tolerance, reference, **given) for name in ("BDF",)}
            tell(
                problem.name,
                tolerance,
                {**runs, "MEBDF": solve(problem, MEBDF, tolerance, reference, **given)},
            )
    for problem in (brusselator(100, False), heat(100)):
        reference = solve_ivp(problem.fun, (0.0, problem.t_end), problem.y0, method="Radau", **EXACT).y[:, -1]
        for tolerance in (1e-3, 1e-5, 1e-7):
            theirs = with_cvode(problem, tolerance, reference)
            tell(
                problem.name,
                tolerance,
                {"CVODE": theirs, "MEBDF": solve(problem, MEBDF, tolerance, reference)},
            )
    for n in () if quick else (10_000, 20_000, 40_000, 80_000):
        with get_context("spawn").Pool(1) as process:
            print(f"memory of {n} equations on a line: {process.apply(peak, (n,)):.0f} MB")


if __name__ == "__main__":
    run()
