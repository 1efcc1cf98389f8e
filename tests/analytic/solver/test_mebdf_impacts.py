"""A body dropped forty times on a stiff, damped contact, with flight between: never a wrong answer.

Flight is a parabola and contact a damped spring, so the solution is known piece by piece; the pieces meet
where the height is zero. In contact the speed turns within a fraction of a millisecond, so errors are
measured between curves: a small error of time is a small error, as one of height or speed is.
"""

from functools import cache

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq, minimize_scalar

from tribodyn.integrate import MEBDF

GRAVITY = 9.81
N_DROPS = 40
#: Error in units of rtol for each kink stepped over: the error test lets it leave up to 1 in the speed, and a
#: relative error of speed becomes twice as large an error of the time of the next landing.
PER_KINK = 2.0
HELD = 1.0  #: Error in units of rtol where the branch is held: each piece is smooth, and few steps long.
LENGTH, SPEED = 1e-3, 1e-2  #: What the tolerances are relative to, beside the values themselves [m, m/s].


def drops():
    """Yield height [m], frequency of the contact [rad/s], damping ratio and duration [s]."""
    random = np.random.default_rng(7)
    for _ in range(N_DROPS):
        height = 10.0 ** random.uniform(-2.0, 0.0)
        frequency = 10.0 ** random.uniform(3.0, 4.5)
        damping = random.uniform(0.02, 0.3)
        yield height, frequency, damping, fall(height) * random.uniform(1.2, 6.0)


def fall(height):
    return np.sqrt(2.0 * height / GRAVITY)


def flight(t, x, v):
    return x + v * t - 0.5 * GRAVITY * t**2, v - GRAVITY * t


def contact(t, x, v, frequency, damping):
    """Damped spring about its rest under gravity."""
    rest = -GRAVITY / frequency**2
    rate, omega = damping * frequency, frequency * np.sqrt(1.0 - damping**2)
    a, b = x - rest, (v + rate * (x - rest)) / omega
    cos, sin, decay = np.cos(omega * t), np.sin(omega * t), np.exp(-rate * t)
    position = rest + decay * (a * cos + b * sin)
    return position, decay * ((b * omega - rate * a) * cos - (a * omega + rate * b) * sin)


@cache
def reference(height, frequency, damping, end):
    """Return height and speed at the end, and the number of kinks before it, piece by piece."""
    t, x, v, kinks = 0.0, height, 0.0, 0
    while True:
        left = end - t
        if x > 0.0 or v > 0.0:
            landing = (v + np.sqrt(v * v + 2.0 * GRAVITY * x)) / GRAVITY
            if landing >= left:
                return np.array(flight(left, x, v)), kinks
            kinks += 1
            t, x, v = t + landing, 0.0, flight(landing, x, v)[1]
            continue
        # It leaves within half a period, or rests: then gravity holds the spring below zero.
        times = np.linspace(0.0, 2.0 * np.pi / frequency, 400)[1:]
        heights = contact(times, x, v, frequency, damping)[0]
        if not np.any(heights > 0.0) or times[np.argmax(heights > 0.0)] >= left:
            return np.array(contact(left, x, v, frequency, damping)), kinks
        last = np.argmax(heights > 0.0)
        first = times[last - 1] if last else 1e-9 / frequency
        leaving = brentq(
            lambda s, v=v: contact(s, 0.0, v, frequency, damping)[0], first, times[last], xtol=1e-16
        )
        kinks += 1
        t, x, v = t + leaving, 0.0, contact(leaving, 0.0, v, frequency, damping)[1]


def acceleration(y, touching, frequency, damping):
    if not touching:
        return -GRAVITY
    return -GRAVITY - frequency**2 * y[0] - 2.0 * damping * frequency * y[1]


def jacobian(touching, frequency, damping):
    spring = (-(frequency**2), -2.0 * damping * frequency) if touching else (0.0, 0.0)
    return np.array([[0.0, 1.0], spring])


def free(height, frequency, damping, end, rtol):
    """Integrate with the branch chosen by the state at each evaluation; return the end and the calls."""
    solution = solve_ivp(
        lambda t, y: [y[1], acceleration(y, y[0] < 0.0, frequency, damping)],
        (0.0, end),
        [height, 0.0],
        method=MEBDF,
        jac=lambda t, y: jacobian(y[0] < 0.0, frequency, damping),
        rtol=rtol,
        atol=[rtol * LENGTH, rtol * SPEED],
    )
    assert solution.success
    return solution.y[:, -1], solution.nfev


def frozen(height, frequency, damping, end, rtol):
    """Integrate with the branch held between located events."""
    t, y, touching, calls = 0.0, np.array([height, 0.0]), False, 0

    def crossing(t, y):
        return y[0]

    crossing.terminal = True
    while t < end:
        crossing.direction = 1.0 if touching else -1.0
        solution = solve_ivp(
            lambda t, y, touching=touching: [y[1], acceleration(y, touching, frequency, damping)],
            (t, end),
            y,
            method=MEBDF,
            jac=jacobian(touching, frequency, damping),
            rtol=rtol,
            atol=[rtol * LENGTH, rtol * SPEED],
            events=crossing,
        )
        assert solution.success
        calls += solution.nfev
        t, y = float(solution.t[-1]), solution.y[:, -1]
        if solution.status == 1:
            touching = not touching
            y[0] = 0.0
    return y, calls


def error(y, drop):
    """Return the distance from the exact curve, relative to height, speed and time of the fall."""
    height, _, _, end = drop
    size = np.array([height, np.sqrt(2.0 * GRAVITY * height)])

    def distance(shift):
        exact, _ = reference(*drop[:3], end + shift * fall(height))
        return max(abs(shift), np.max(np.abs(y - exact) / size))

    here = distance(0.0)
    shifted = minimize_scalar(distance, bounds=(-here, here), method="bounded", options={"xatol": 1e-12})
    return min(here, shifted.fun)


@pytest.mark.parametrize("rtol", [1e-3, pytest.param(1e-6, marks=pytest.mark.long)])
def test_no_drop_is_wrong_and_freezing_the_branch_saves_calls(rtol):
    chosen = list(drops())
    frees = [free(*drop, rtol) for drop in chosen]
    held = [frozen(*drop, rtol) for drop in chosen]
    kinks = np.array([reference(*drop)[1] for drop in chosen])
    for results, bound in ((frees, PER_KINK * kinks), (held, HELD)):
        errors = np.array([error(y, drop) for (y, _), drop in zip(results, chosen, strict=True)])
        assert np.all(errors < bound * rtol), errors / rtol
    ratios = [b / a for (_, a), (_, b) in zip(frees, held, strict=True)]
    assert np.exp(np.mean(np.log(ratios))) < 2.0 / 3.0
