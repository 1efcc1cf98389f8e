"""Random switches, kinks and wrong Jacobians whose solutions are known in closed form.

Every scalar law moves one coordinate z from 1 or so at a rate of 1 or so; the case scales it and time by powers of ten
up to 10^±12 and mixes up to three of them by a rotation.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.optimize import brentq

Law = tuple[Callable[[float, float], float], Callable[[float, float], float], float, Callable[[float], float]]
"""Rate f(t, z), its derivative ∂f/∂z, start z(0) and solution z(t)."""


@dataclass(frozen=True)
class Case:
    """A problem for ``solve_ivp`` with its solution at the end and the largest value of its norm on the way."""

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
    """z' = A sin ωt − µ tanh(z/w), w so small that it is Coulomb's friction: sticks, slips, may stick again."""
    omega, force, w = rng.uniform(1, 12), 10.0 ** rng.uniform(-0.5, 1.5), 10.0 ** rng.uniform(-16, -12)
    mu = force * rng.uniform(0.05, 1.1)

    def solution(t_end: float) -> float:
        t, z = 0.0, 0.0
        while True:
            # Sticks until |A sin ωt| > µ, then slips in that direction until z is zero again.
            if mu >= force:
                return 0.0
            phase = omega * t
            if force * abs(np.sin(phase)) <= mu * (1.0 + 1e-12):
                rise = np.arcsin(mu / force)
                turns = np.floor(phase / np.pi)
                t = (
                    (turns * np.pi + rise) / omega
                    if phase <= turns * np.pi + rise * (1 + 1e-12)
                    else ((turns + 1) * np.pi + rise) / omega
                )
            if t >= t_end:
                return 0.0
            middle = omega * t + 1e-9
            sign = 1.0 if np.sin(middle) > 0.0 else -1.0
            start = t

            def moved(s: float, start: float = start, sign: float = sign) -> float:
                return force / omega * (np.cos(omega * start) - np.cos(omega * s)) - sign * mu * (s - start)

            grid = start + np.arange(1, 4000) * (0.01 / omega)
            back = np.nonzero(sign * np.array([moved(s) for s in grid]) <= 0.0)[0]
            back = back[back > 5]
            if not back.size or grid[back[0] - 1] >= t_end:
                return moved(t_end)
            t = brentq(moved, grid[back[0] - 1], grid[back[0]], xtol=1e-15)
            if t >= t_end:
                return moved(t_end)

    def slope(t: float, z: float) -> float:
        return -mu / w / np.cosh(min(abs(z) / w, 300.0)) ** 2

    return lambda t, z: force * np.sin(omega * t) - mu * np.tanh(z / w), slope, 0.0, solution


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
