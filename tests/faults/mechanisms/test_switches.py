"""A solver never says success where it has run away: random switches, kinks and wrong Jacobians.

Their solutions are known in closed form.
Every scalar law moves one coordinate z from 1 or so at a rate of 1 or so; the case scales it and time by
powers of ten up to 10^±12 and mixes up to three of them by a rotation.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq
from scipy.sparse import eye_array, kron

from mebdf import MEBDF

#: Rate f(t, z), its derivative ∂f/∂z, start z(0) and solution z(t).
Law = tuple[Callable[[float, float], float], Callable[[float, float], float], float, Callable[[float], float]]


@dataclass(frozen=True)
class Case:
    """A problem for ``solve_ivp`` with its solution at the end and the largest of its norm on the way."""

    name: str
    fun: Callable[[float, Any], Any]
    t_end: float
    y0: Any
    end: Any
    size: float
    rtol: float
    atol: float
    options: dict[str, Any]


def _switch(rng: np.random.Generator) -> Law:
    """z' = b − a sgn(z − c): slides along c where |b| < a, else crosses it."""
    a, b, c, z0 = 10.0 ** rng.uniform(-1, 2), 10.0 ** rng.uniform(-1, 1), rng.choice([0.0, 0.3]), 1.0
    b *= rng.choice([-1.0, 0.0])
    reach = (z0 - c) / (a - b)
    after = min(b + a, 0.0)

    def solution(t: float) -> float:
        return z0 + (b - a) * t if t < reach else c + after * (t - reach)

    return lambda t, z: b - a * np.sign(z - c), lambda t, z: 0.0, z0, solution


def _smooth_switch(rng: np.random.Generator) -> Law:
    """z' = −a tanh((z − c)/w): sinh((z − c)/w) decays by exp(−a t/w)."""
    a, w, c, z0 = 10.0 ** rng.uniform(-1, 3), 10.0 ** rng.uniform(-13, 0), rng.choice([0.0, 0.3]), 1.0

    def solution(t: float) -> float:
        u = (z0 - c) / w
        log_sinh = (u + np.log1p(-np.exp(-2.0 * u)) - np.log(2.0)) - a * t / w
        rest = log_sinh + np.log(2.0) if log_sinh > 30.0 else np.arcsinh(np.exp(log_sinh))
        return c + w * float(rest)

    def slope(t: float, z: float) -> float:
        return -a / w / np.cosh(min(abs(z - c) / w, 300.0)) ** 2

    return lambda t, z: -a * np.tanh((z - c) / w), slope, z0, solution


def _clip(rng: np.random.Generator) -> Law:
    """z' = −a clip((z − c)/w, −1, 1): a straight line, then an exponential."""
    a, w, c, z0 = 10.0 ** rng.uniform(-1, 3), 10.0 ** rng.uniform(-13, -0.5), rng.choice([0.0, 0.3]), 1.0
    reach = (z0 - c - w) / a

    def solution(t: float) -> float:
        return z0 - a * t if t < reach else c + w * float(np.exp(-a * (t - reach) / w))

    def slope(t: float, z: float) -> float:
        return -a / w if abs(z - c) < w else 0.0

    return lambda t, z: -a * np.clip((z - c) / w, -1.0, 1.0), slope, z0, solution


def _stop(rng: np.random.Generator) -> Law:
    """z' = a − max(z − c, 0)/w: a straight line, then an exponential to c + a w."""
    a, w, c = 10.0 ** rng.uniform(-1, 2), 10.0 ** rng.uniform(-13, 0), rng.choice([1.0, 0.3])
    reach = c / a

    def solution(t: float) -> float:
        return a * t if t < reach else c - a * w * float(np.expm1(-(t - reach) / w))

    return lambda t, z: a - max(z - c, 0.0) / w, lambda t, z: -1.0 / w if z > c else 0.0, 0.0, solution


def _reversal(rng: np.random.Generator) -> Law:
    """z' = a sgn(t − s): the rate jumps in time."""
    a, s = 10.0 ** rng.uniform(-1, 2), rng.uniform(0.1, 0.9)
    return lambda t, z: a * np.sign(t - s), lambda t, z: 0.0, 1.0, lambda t: 1.0 + a * (abs(t - s) - s)


def _stick_slip(rng: np.random.Generator) -> Law:
    """z' = A sin ωt − µ tanh(z/w), w so small that it is Coulomb's friction: sticks and slips."""
    omega, force, w = rng.uniform(1, 12), 10.0 ** rng.uniform(-0.5, 1.5), 10.0 ** rng.uniform(-16, -12)
    mu = force * rng.uniform(0.05, 1.1)

    def solution(t_end: float) -> float:
        return _slid(t_end, omega, force, mu)

    def slope(t: float, z: float) -> float:
        return -mu / w / np.cosh(min(abs(z) / w, 300.0)) ** 2

    return lambda t, z: force * np.sin(omega * t) - mu * np.tanh(z / w), slope, 0.0, solution


def _slid(t_end: float, omega: float, force: float, mu: float) -> float:
    """Return the speed under Coulomb's friction: at rest until |A sin ωt| > µ, and again later."""
    if mu >= force:
        return 0.0
    rise, t = np.arcsin(mu / force), 0.0
    while True:
        half = np.floor(omega * t / np.pi + 1e-12)
        if force * abs(np.sin(omega * t)) <= mu * (1.0 + 1e-12):
            half += omega * t > half * np.pi + rise * (1.0 + 1e-9)
            t = (half * np.pi + rise) / omega
        if t >= t_end:
            return 0.0
        direction = 1.0 if half % 2 == 0 else -1.0

        def speed(s: Any, start: float = t, direction: float = direction) -> Any:
            pushed = force / omega * (np.cos(omega * start) - np.cos(omega * s))
            return pushed - direction * mu * (s - start)

        later = t + np.arange(6, 4000) * (0.01 / omega)
        rests = np.flatnonzero(direction * speed(later) <= 0.0)
        if not rests.size or later[rests[0]] - 0.01 / omega >= t_end:
            return float(speed(t_end))
        t = brentq(speed, later[rests[0]] - 0.01 / omega, later[rests[0]], xtol=1e-15)
        if t >= t_end:
            return float(speed(t_end))


def _tracking(rng: np.random.Generator) -> Law:
    """z' = λ(z − cos ωt) − ω sin ωt: stiff and linear."""
    rate, omega, z0 = -(10.0 ** rng.uniform(-1, 4)), rng.uniform(0.5, 6), rng.choice([1.0, 2.0])

    def solution(t: float) -> float:
        return float(np.cos(omega * t) + (z0 - 1.0) * np.exp(rate * t))

    return (
        lambda t, z: rate * (z - np.cos(omega * t)) - omega * np.sin(omega * t),
        lambda t, z: rate,
        z0,
        solution,
    )


def _logistic(rng: np.random.Generator) -> Law:
    """z' = a z(1 − z): nonlinear and smooth."""
    a, z0 = 10.0 ** rng.uniform(0, 2), 10.0 ** rng.uniform(-2, 0.3)

    def solution(t: float) -> float:
        return 1.0 / (1.0 + (1.0 / z0 - 1.0) * float(np.exp(-a * t)))

    return lambda t, z: a * z * (1.0 - z), lambda t, z: a * (1.0 - 2.0 * z), z0, solution


SWITCHES = (_switch, _smooth_switch, _smooth_switch, _clip, _stop, _reversal, _stick_slip)
SMOOTH = (_tracking, _logistic)
SCALES = (("right", 1.0), ("sign", -1.0), ("zero", 0.0), ("large", 1e6), ("small", 1e-6))


def random_case(seed: int) -> Case:
    """Return a case; the same seed gives the same case."""
    rng = np.random.default_rng(seed)
    n = int(rng.choice([1, 1, 2, 3]))
    makers = [SWITCHES[rng.integers(len(SWITCHES))] for _ in range(n)]
    wrong = rng.random() < 0.6
    if wrong:
        makers = [(SMOOTH if rng.random() < 0.6 else SWITCHES)[rng.integers(2)] for _ in range(n)]
    laws = [make(rng) for make in makers]
    turn = np.linalg.qr(rng.normal(size=(n, n)))[0] if n > 1 else np.ones((1, 1))
    length, time = 10.0 ** rng.uniform(-12, 12, 2)
    rtol = 10.0 ** rng.uniform(-8, -2)

    def fun(t: float, y: Any) -> Any:
        z = turn.T @ y / length
        return (
            turn
            @ np.array([law[0](t / time, z_i) for law, z_i in zip(laws, z, strict=True)])
            * (length / time)
        )

    def jac(t: float, y: Any) -> Any:
        z = turn.T @ y / length
        slopes = [law[1](t / time, z_i) for law, z_i in zip(laws, z, strict=True)]
        return turn @ np.diag(slopes) @ turn.T / time

    y0 = turn @ np.array([law[2] for law in laws]) * length
    options, kind = _jacobian(rng, jac, y0) if wrong or rng.random() < 0.3 else ({}, "differences")
    path = [np.linalg.norm([law[3](t) for law in laws]) for t in np.linspace(0.0, 1.0, 33)]
    return Case(
        name=f"{'+'.join(make.__name__[1:] for make in makers)}, Jacobian {kind}",
        fun=fun, t_end=time, y0=y0, end=turn @ np.array([law[3](1.0) for law in laws]) * length,
        size=float(max(path)) * length, rtol=rtol, atol=rtol * length * 10.0 ** rng.uniform(-4, 0),
        options=options,
    )  # fmt: skip


def _jacobian(rng: np.random.Generator, jac: Callable[..., Any], y0: Any) -> tuple[dict[str, Any], str]:
    """Return a Jacobian as given to the solver: right, wrong by a factor, or that of the start for ever."""
    if rng.random() < 0.2:
        return {"jac": jac(0.0, y0)}, "stale"
    kind, factor = SCALES[rng.integers(len(SCALES))]
    return {"jac": lambda t, y: factor * jac(t, y)}, kind


class TooManyError(Exception):
    """More evaluations than a case is worth."""


def error_of(case: Case, most: int, method: Any = MEBDF) -> float | None:
    """Return the error at the end in units of the tolerance; ``None`` where no success was claimed."""
    calls = 0

    def fun(t, y):
        nonlocal calls
        calls += 1
        if calls > most:
            raise TooManyError
        return case.fun(t, y)

    try:
        solution = solve_ivp(
            fun, (0.0, case.t_end), case.y0, method=method, rtol=case.rtol, atol=case.atol, **case.options
        )
    except TooManyError:
        return None
    if not solution.success:
        return None
    return float(np.linalg.norm(solution.y[:, -1] - case.end) / (case.atol + case.rtol * case.size))


def is_wrong(error: float | None) -> bool:
    return error is not None and not error <= 100.0


def is_seen_by_another(case: Case) -> bool:
    """Tell whether BDF or Radau comes to the solution: what is short beside the steps none may sample."""
    errors = [error_of(case, 60_000, method) for method in ("BDF", "Radau")]
    return any(error is not None and not is_wrong(error) for error in errors)


def assert_honest(seeds: Sequence[int], most: int, ended: float) -> None:
    found = [(error_of(case := random_case(seed), most), seed, case) for seed in seeds]
    claimed = [row for row in found if row[0] is not None]
    assert [row[:2] for row in claimed if is_wrong(row[0]) and is_seen_by_another(row[2])] == []
    assert len(claimed) >= ended * len(seeds)


#: A slip so short beside the steps at rest that it begins and ends between their stages.
BETWEEN_STEPS = (1530, 2822, 3310, 7025)


@pytest.mark.parametrize(
    "seed", [pytest.param(seed, marks=pytest.mark.long) if seed != 1530 else seed for seed in BETWEEN_STEPS]
)
@pytest.mark.filterwarnings("ignore::RuntimeWarning")
def test_a_slip_between_two_steps_takes_shorter_steps(seed):
    case = random_case(seed)
    assert_honest([seed], 3000, 0.0)  # where it misses the slip, BDF and Radau do, too
    assert not is_wrong(
        error_of(replace(case, options={**case.options, "max_step": case.t_end / 200}), 20_000)
    )


@pytest.mark.filterwarnings("ignore::RuntimeWarning")
def test_no_success_far_from_the_solution():
    assert_honest(range(40), 600, 0.3)


#: By what the Jacobian is wrong; the worst are those beside which a correction is small, but not tiny.
TOO_LARGE_BY = (1e1, 1e2, 1e3, 1e4, 1e6, 1e8, 1e12)


def largest_error(seed: int, most: int, copies: int = 1) -> float:
    """Return the largest error at any accepted step, in units of the tolerance, with a Jacobian too large.

    ``copies`` of the equations beside each other make a large system with a sparse Jacobian.
    """
    rng = np.random.default_rng(10**6 + seed)
    n, factor = int(rng.choice([1, 1, 2, 3])), TOO_LARGE_BY[seed % len(TOO_LARGE_BY)]
    laws = [((SMOOTH if rng.random() < 0.75 else SWITCHES[1:4:2])[rng.integers(2)])(rng) for _ in range(n)]
    turn = np.linalg.qr(rng.normal(size=(n, n)))[0] if n > 1 else np.ones((1, 1))
    t_end, rtol = 10.0 ** rng.uniform(-5, 0), 10.0 ** rng.uniform(-8, -2)
    atol = rtol * 10.0 ** rng.uniform(-4, 0)
    size = max(np.linalg.norm([law[3](t) for law in laws]) for t in np.linspace(0.0, t_end, 9))

    def rates(t, y):
        return turn @ np.array([law[0](t, z) for law, z in zip(laws, turn.T @ y, strict=True)])

    def slopes(t, y):
        diagonal = [law[1](t, z) for law, z in zip(laws, turn.T @ y, strict=True)]
        return factor * turn @ np.diag(diagonal) @ turn.T

    def fun(t, y):
        return np.tile(rates(t, y[:n]), copies)

    def jac(t, y):
        matrix = slopes(t, y[:n])
        return matrix if copies == 1 else kron(eye_array(copies), matrix)

    y0 = np.tile(turn @ np.array([law[2] for law in laws]), copies)
    solver, worst = MEBDF(fun, 0.0, y0, t_end, rtol=rtol, atol=atol, jac=jac), 0.0
    while solver.status == "running" and solver.nfev < most:
        solver.step()
        exact = turn @ np.array([law[3](solver.t) for law in laws])
        worst = max(worst, float(np.linalg.norm(solver.y[:n] - exact) / (atol + rtol * size)))
    return worst


HIDDEN = (81, 165, 333, 374, 599)  #: Where errors stay hidden longest.


@pytest.fixture
def _undoubted(monkeypatch):
    """Have nobody compare the Jacobian with the rates, as compiled mechanisms and large systems have it."""
    monkeypatch.setattr("mebdf.jacobian.CheckedJacobian", lambda given, *others: given)


@pytest.mark.usefixtures("_undoubted")
@pytest.mark.parametrize("copies", [1, 70])
def test_the_core_itself_lets_no_error_through(copies):
    # At most 20 were found, and up to 219 before residuals were summed up.
    assert max(largest_error(seed, 200, copies) for seed in HIDDEN) <= 100.0


@pytest.mark.parametrize("rate", [1e6, 1e10, 1e14])
def test_rounding_of_a_stiff_equation_is_no_failure(rate):
    solution = solve_ivp(
        lambda t, y: -rate * (y - np.cos(t)) - np.sin(t),
        (0.0, 10.0), [1.0], method=MEBDF, rtol=1e-8, atol=1e-11, jac=[[-rate]],
    )  # fmt: skip
    assert solution.success
    assert abs(solution.y[0, -1] - np.cos(10.0)) < 1e-8
    assert solution.nfev < 800


@pytest.mark.parametrize("width", [1e-6, 1e-8, 1e-10])
@pytest.mark.parametrize("rate", [10.0, 1000.0])
@pytest.mark.parametrize("rtol", [1e-2, 1e-3, 1e-6])
def test_a_smooth_switch_holds_however_narrow(rtol, rate, width):
    solution = solve_ivp(lambda t, y: -rate * np.tanh(y / width), (0.0, 1.0), [1.0], method=MEBDF, rtol=rtol)
    assert solution.success
    assert abs(solution.y[0, -1]) < 1e-6
    assert solution.nfev < 2000


#: A Jacobian so large by mistake that its rounding of y would explain the residual.
BELOW_ROUNDING = (820, 1130, 1856)


#: A Jacobian differenced across a jump whose corrections are not tiny, only small beside the residual.
MODERATE = (2110, 3638, 6713)


NARROW = (6129, 6849)  #: A Jacobian that is right, on the flank of a switch narrower than the tolerance.


#: A Jacobian so large by mistake that what is lost in the first steps shows only if the end is reached.
TOO_LARGE = (3298, 3311, 6633, 9848)


#: A Jacobian differenced across a jump that leads to a smaller residual on its other side, and no further.
HALFWAY = (8555,)


MIXED = (110, 131, 292, 373, 895, 934, 8070, 8356, 8485)


@pytest.mark.filterwarnings("ignore::RuntimeWarning")
def test_no_success_where_the_error_hides_best():
    assert_honest(BELOW_ROUNDING + MODERATE + NARROW + TOO_LARGE + HALFWAY + MIXED, 3000, 0.0)


@pytest.mark.long(minutes=0.8)
@pytest.mark.usefixtures("_undoubted")
def test_two_thousand_jacobians_that_are_too_large():
    errors = {seed: largest_error(seed, 1500) for seed in range(2000)}
    assert {seed: error for seed, error in errors.items() if not error <= 100.0} == {}


@pytest.mark.long
@pytest.mark.filterwarnings("ignore::RuntimeWarning")
def test_ten_thousand_switches_and_wrong_jacobians():
    assert_honest(range(10_000), 3000, 0.45)
