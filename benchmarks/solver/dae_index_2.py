"""Problems of index 2 beside published runs: an elastic slider-crank, a stabilised car axis, a charge pump.

    python -m benchmarks.solver.dae_index_2

Equations and parameters: the IVP Test Set (Mazzia and Magherini 2008); the slider-crank is Simeon's (Math.
Modelling of Systems 2, 1995), the pump's transistor that of Günther, Denk and Feldmann (1995). End points and
published runs: MEBDFI of March and April 2000, in the repository fons/JavaOdeInt on GitHub; rtol = atol. The
pump is not among them.
"""

from __future__ import annotations

import warnings
from dataclasses import replace
from types import SimpleNamespace
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

from benchmarks.solver.dae import solve
from benchmarks.solver.dae_problems import DaeBenchmark, caraxis
from tribodyn.integrate import MEBDF

FloatArray = NDArray[np.float64]

# fmt: off
PUBLISHED: Final = (
    (75, 584, 12, -0.85), (146, 1100, 22, -0.03), (258, 1681, 29, -0.03), (1941, 10337, 155, -0.93),
    (3463, 15353, 160, 0.08), (4709, 23678, 334, 1.21), (6326, 27445, 274, 1.75), (8316, 37327, 410, 1.84),
)
# fmt: on
"""Slider-crank: steps, evaluations, LU decompositions and digits at tolerances 1e-2, 1e-3, …, 1e-9."""


def _rod() -> SimpleNamespace:
    """Return masses and lengths, and the matrices of the rod: two shapes of bending, two nodes along it."""
    length, width, density, stiffness = 0.30, 0.0080, 7870.0, 0.20e12
    mass, push, volume = density * width**2 * length, stiffness * width**2 / length, width**2 * length
    pi = 3.1415927
    m, k, b = np.zeros((4, 4)), np.zeros((4, 4)), np.zeros((4, 4))
    m[0, 0] = m[1, 1] = 0.5 * mass
    m[2:, 2:] = mass * np.array([[8.0, 1.0], [1.0, 2.0]])
    k[[0, 1], [0, 1]] = push * pi**4 * (width / length) ** 2 * np.array([1.0 / 24.0, 2.0 / 3.0])
    k[2:, 2:] = push * np.array([[16.0, -8.0], [-8.0, 7.0]]) / 3.0
    b[0, 2], b[0, 3] = -volume * 16.0 / pi**3, volume * (8.0 / pi**3 - 1.0 / pi)
    b[1, 3] = volume * 0.5 / pi
    return SimpleNamespace(
        m1=0.36, m2=0.151104, m3=0.075552, l1=0.15, l2=length, j1=0.002727, j2=0.0045339259, rho=density,
        omega=150.0, m=m, k=k, b=b - b.T,
        c1=volume * np.array([0.0, 0.0, 2.0 / 3.0, 1.0 / 6.0]),
        c2=volume * np.array([2.0 / pi, 0.0, 0.0, 0.0]),
        c12=length * volume * np.array([0.0, 0.0, 1.0 / 3.0, 1.0 / 6.0]),
        c21=length * volume * np.array([1.0 / pi, -0.5 / pi, 0.0, 0.0]),
    )  # fmt: skip


_R = _rod()


def _crank_inertia(y: Any) -> Any:
    """Return the mass matrix of crank, rod, slider and the rod's shapes, shape (7, 7)."""
    r, q = _R, y[3:7]
    s, c = np.sin(y[0] - y[1]), np.cos(y[0] - y[1])
    m = np.zeros((7, 7), dtype=y.dtype)
    m[0, 0], m[2, 2] = r.j1 + r.m2 * r.l1**2, r.m3
    m[0, 1] = 0.5 * r.l1 * r.l2 * r.m2 * c + r.rho * r.l1 * (s * (r.c2 @ q) + c * (r.c1 @ q))
    m[1, 1] = r.j2 + q @ r.m @ q + 2.0 * r.rho * (r.c12 @ q)
    m[0, 3:] = r.rho * r.l1 * (c * r.c2 - s * r.c1)
    m[1, 3:] = r.rho * (r.c21 + q @ r.b)
    m[3:, 3:] = r.m
    return _symmetric(m)


def _symmetric(m: Any) -> Any:
    """Copy the upper triangle to the lower one."""
    upper = np.triu(m, 1)
    return upper + upper.T + np.diag(np.diag(m))


def _crank_forces(y: Any) -> Any:
    """Return forces of inertia and elasticity, shape (7,)."""
    r, q, u = _R, y[3:7], y[10:14]
    s, c, v1, v2 = np.sin(y[0] - y[1]), np.cos(y[0] - y[1]), y[7], y[8]
    rigid, bent = 0.5 * r.l1 * r.l2 * r.m2 * s, s * (r.c1 @ q) - c * (r.c2 @ q)
    f = np.zeros(7, dtype=y.dtype)
    f[0] = -rigid * v2**2 - r.rho * r.l1 * (bent * v2**2 + 2.0 * v2 * (c * (r.c1 @ u) + s * (r.c2 @ u)))
    f[1] = rigid * v1**2 + r.rho * r.l1 * bent * v1**2 - r.rho * (u @ r.b @ u)
    f[1] -= 2.0 * v2 * (r.rho * (r.c12 @ u) + u @ r.m @ q)
    f[3:] = v2**2 * (r.m @ q + r.rho * r.c12) - r.k @ q
    f[3:] += r.rho * (r.l1 * v1**2 * (c * r.c1 + s * r.c2) + 2.0 * v2 * (r.b @ u))
    return f


def _crank(t: float, y: Any) -> Any:
    r, s1, c1, s2, c2 = _R, np.sin(y[0]), np.cos(y[0]), np.sin(y[1]), np.cos(y[1])
    slopes = np.zeros((3, 7), dtype=y.dtype)
    slopes[0, [0, 1, 6]] = r.l1 * c1, (r.l2 + y[6]) * c2, s2
    slopes[1, [0, 1, 2, 6]] = r.l1 * s1, (r.l2 + y[6]) * s2, 1.0, -c2
    slopes[2, 0] = 1.0
    balance = _crank_inertia(y) @ y[14:21] - _crank_forces(y) + slopes.T @ y[21:]
    speeds = slopes @ y[7:14] - np.array([0.0, 0.0, r.omega])
    return np.concatenate((y[7:21], balance, speeds))


def slider_crank() -> DaeBenchmark:
    """Return the elastic slider-crank with its constraints on velocities.

    Digits count for all components, as in the published runs. The end is that of the R package deTestSet
    (1.1.7.4). Beside the underlying ordinary differential equation with DOP853 at 1e-13 its accelerations
    have four digits and more, the rest seven to thirteen; the end of the published drivers has 1.9. The
    published speed of the rod, −74.9957670, fulfils its constraint to nine digits only.
    """
    stretch = 0.169327969e-4
    turning = -_R.l1 * _R.omega / (_R.l2 + stretch)
    start = [
        *(0.0, 0.0, 0.450016933, 0.0, 0.0, 0.103339863e-4, stretch),
        *(150.0, turning, -0.268938672e-5, 0.444896105, 0.463434311e-2, -0.178591076e-5, -0.268938672e-5),
        *(0.0, -1.344541576008661e-3, -5.062194923138079e3, -6.833142732779555e-5, 1.449382650173157e-8),
        *(-4.268463211410861, 2.098334687947376e-1),
        *(-6.397251492537153e-8, 3.824589508329281e2, -4.376060460948886e-9),
    ]
    end = [
        *(0.1500000000000104e2, -0.3311734988256260, 0.1697373328427860, 0.1893192899613509e-3),
        *(0.2375751249879174e-4, -0.5323896770569702e-5, -0.8363313279112129e-5),
        *(150.0, 60.25346755138369, -8.753116326670527, -0.3005541400289738e-1, -0.5500431812571696e-2),
        *(0.4974111734266989e-3, 0.1105560003626645e-2),
        *(0.0, 6488.737541276957, 2167.938629509884, 33.91137060286523, 0.1715134772216488),
        *(-1.422449408912512, 1.003946428124810),
        *(-62.32935833287916, -163.7920993367306, 25.29857947066878),
    ]
    mass = np.diag([1.0] * 14 + [0.0] * 10)
    index = (1,) * 14 + (2,) * 10
    return DaeBenchmark("slider-crank", _crank, mass, index, np.array(start), 0.1, np.array(end), 24)


def stabilised_caraxis() -> DaeBenchmark:
    """Return the car axis with constraints on positions and velocities: two more multipliers, index 2."""
    axis = caraxis()

    def fun(t: float, y: Any) -> Any:
        yb, yb_rate = 0.1 * np.sin(10.0 * t), np.cos(10.0 * t)
        xb = np.sqrt(1.0 - yb * yb)
        xb_rate = -yb * yb_rate / xb
        x, v = y[:4], y[4:8]
        apart, rate = x[:2] - x[2:], v[:2] - v[2:]
        f = np.empty_like(y)
        f[:10] = axis.fun(t, y[:10])
        f[:2] += y[10] * np.array([xb, yb]) + 2.0 * y[11] * apart
        f[2:4] -= 2.0 * y[11] * apart
        f[10] = xb_rate * x[0] + yb_rate * x[1] + xb * v[0] + yb * v[1]
        f[11] = 2.0 * (apart @ rate)
        return f

    return replace(
        axis,
        name="car axis, index 2",
        fun=fun,
        mass=np.diag(np.append(np.diag(axis.mass), [0.0, 0.0])),
        index=(1,) * 8 + (2,) * 4,
        y0=np.append(axis.y0, [0.0, 0.0]),
        end=np.append(axis.end, [0.0, 0.0]),
    )


def _charges(gate: Any, source: Any, drain: Any) -> tuple[Any, Any, Any]:
    """Return the charges on gate, source and drain of the transistor from voltages against the bulk."""
    threshold, gamma, phi, capacity = 0.20, 0.0350, 1.010, 4.0e-12
    other, one = sorted((gate - source, gate - drain), key=np.real)
    back = phi - (one - gate)
    flat = threshold - gamma * np.sqrt(phi) - phi
    opens = threshold + gamma * (np.sqrt(back) - np.sqrt(phi))
    if np.real(gate) <= flat:
        return capacity * (gate - flat), 0.0, 0.0
    if np.real(one - opens) <= 0.0:
        return capacity * gamma * (np.sqrt(0.25 * gamma**2 + gate - flat) - 0.5 * gamma), 0.0, 0.0
    high, low = one - opens, max(other - opens, 0.0 * opens, key=np.real)
    channel = low + high - low * high / (low + high)
    side = -capacity / 3.0 * channel
    return capacity * (2.0 / 3.0 * channel + gamma * np.sqrt(back)), side, side


PERIOD, RISES, HIGH, FALLS = 120e-9, 50e-9, 60e-9, 110e-9  #: Of the voltage that drives the pump [s].


def _pump(t: float, y: Any) -> Any:
    phase = np.fmod(t, PERIOD)
    driven = 20.0 * np.interp(phase, [RISES, HIGH, FALLS, PERIOD], [0.0, 1.0, 1.0, 0.0])
    gate, source, drain = _charges(y[5], y[6], y[7])
    return np.array(
        [
            *(-y[8], 0.0, 0.0, driven - y[5], y[0] - gate, y[1] - 1.60e-12 * y[6]),
            *(y[2] - source, y[3] - 0.40e-12 * y[7], y[4] - drain),
        ]
    )


def charge_pump() -> DaeBenchmark:
    """Return the charge pump over ten periods.

    Charges and voltages follow the driving voltage without memory; digits are those of the first charge.
    """
    mass = np.zeros((9, 9))
    mass[0, 0] = mass[1, 1] = mass[1, 2] = mass[2, 3] = mass[2, 4] = 1.0
    start, end = np.zeros(9), np.zeros(9)
    start[0], end[0] = _charges(0.0, 0.0, 0.0)[0], 0.1262800429876759e-12
    return DaeBenchmark("charge pump", _pump, mass, (1,) * 8 + (2,), start, 10.0 * PERIOD, end, 1)


def pump(tolerance: float) -> dict[str, Any]:
    """Run the charge pump with breakpoints where its voltage kinks.

    Tolerances are those of the IVP Test Set: charges a million times tighter, the current free.
    """
    problem = charge_pump()
    kinks = [k * PERIOD + at for k in range(10) for at in (0.0, RISES, HIGH, FALLS)]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # the current jumps at kinks, which is told
        found = solve_ivp(
            problem.fun, (0.0, problem.t_end), problem.y0, method=MEBDF, jac=problem.jac, mass=problem.mass,
            index=problem.index, breakpoints=kinks, rtol=np.array([tolerance] * 8 + [1e3]),
            atol=np.array([1e-6 * tolerance] * 5 + [tolerance] * 3 + [1e3]),
        )  # fmt: skip
    return {
        "failed": not found.success, "message": found.message, "digits": problem.digits(found.y[:, -1]),
        "steps": found.t.size - 1, "rhs": found.nfev, "lu": found.nlu,
    }  # fmt: skip


def run(quick: bool = False) -> dict[str, list[dict[str, Any]]]:
    """Print and return what all problems took; ``quick``: at tolerances down to 1e-4."""
    exponents = range(2, 5 if quick else 11)
    found: dict[str, list[dict[str, Any]]] = {}
    for problem in (slider_crank(), stabilised_caraxis()):
        found[problem.name] = [solve(problem, 10.0**-exponent) for exponent in exponents]
    found["charge pump"] = [pump(10.0**-exponent) for exponent in exponents]
    for name, runs in found.items():
        print(name)
        for exponent, ours in zip(exponents, runs, strict=True):
            theirs = PUBLISHED[exponent - 2] if name == "slider-crank" and exponent < 10 else ""
            numbers = f"{ours['steps']:6d} {ours['rhs']:6d} {ours['lu']:6d} {ours['digits']:6.2f}"
            print(f"  1e-{exponent:02d} {numbers}  {theirs}  {ours['message'] if ours['failed'] else ''}")
    return found


if __name__ == "__main__":
    run()
