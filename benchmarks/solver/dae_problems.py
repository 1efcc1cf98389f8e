"""Differential-algebraic problems M y' = f(t, y) with known end points: mechanisms and a circuit.

Equations and parameters: the IVP Test Set (Mazzia and Magherini 2008; pendulum: Hairer and Wanner II, VII.1).
End points: deTestSet 1.1.7.4; the pendulum's is that of ``benchmarks/solver/problems.py``. Functions take
real and complex states, so that Jacobians are exact: differences along the imaginary axis.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from types import SimpleNamespace
from typing import Any

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
TINY = 1e-30


@dataclass(frozen=True)
class DaeBenchmark:
    """A problem."""

    name: str  #: Short name.
    fun: Callable[[float, Any], Any]  #: ``fun(t, y)``, real or complex.
    mass: FloatArray  #: Mass matrix, shape (n, n).
    index: tuple[int, ...]  #: Index of each variable, shape (n,).
    #: Start, end of time and solution there.
    y0: FloatArray
    t_end: float
    end: FloatArray
    compared: int  #: Number of first components that digits are counted of.
    #: Whether errors count relative to the value alone, as in the IVP Test Set, or to |y| + 1.
    relative: bool = True

    def jac(self, t: float, y: FloatArray) -> FloatArray:
        """Return the exact Jacobian, shape (n, n)."""
        n = y.size
        columns = [self.fun(t, y + 1j * TINY * unit).imag / TINY for unit in np.eye(n)]
        return np.array(columns).T

    def digits(self, y: FloatArray) -> float:
        """Return the number of correct digits at the end; where they are relative, of what is not zero."""
        y, end = y[: self.compared], self.end[: self.compared]
        size = np.abs(end) + (0.0 if self.relative else 1.0)
        errors = np.abs(y - end)[size > 0.0] / size[size > 0.0]
        return float(-np.log10(max(np.max(errors), 1e-16)))


def pendulum(index: int) -> DaeBenchmark:
    """Return the pendulum with its constraint differentiated until the index is 3, 2 or 1."""
    level = 3 - index

    def fun(t: float, y: Any) -> Any:
        f = np.empty_like(y)
        f[0], f[1], f[2], f[3] = y[2], y[3], -y[0] * y[4], -y[1] * y[4] - 1.0
        if level == 0:
            f[4] = y[0] ** 2 + y[1] ** 2 - 1.0
        elif level == 1:
            f[4] = y[0] * y[2] + y[1] * y[3]
        else:
            f[4] = y[2] ** 2 + y[3] ** 2 - y[4] * (y[0] ** 2 + y[1] ** 2) - y[1]
        return f

    indices = {3: (1, 1, 2, 2, 3), 2: (1, 1, 1, 1, 2), 1: (1, 1, 1, 1, 1)}[index]
    end = [
        *(0.8673486406004394, 0.4977010504796730),
        *(-0.0337480180609545, 0.0588130114652499, -0.4931031514390188),
    ]
    mass = np.diag([1.0, 1.0, 1.0, 1.0, 0.0])
    start = np.array([1.0, 0.0, 0.0, 1.0, 1.0])
    return DaeBenchmark(
        f"pendulum, index {index}", fun, mass, indices, start, 1.0, np.array(end), 5, relative=False
    )


def _transistor(t: float, y: Any) -> Any:
    supply, gain, resistance = 6.0, 0.99, 9000.0
    signal = 0.1 * np.sin(200.0 * np.pi * t)
    first = 1e-6 * (np.exp((y[1] - y[2]) / 0.026) - 1.0)
    second = 1e-6 * (np.exp((y[4] - y[5]) / 0.026) - 1.0)
    f = np.empty_like(y)
    f[0] = (y[0] - signal) / 1000.0
    f[1] = (2.0 * y[1] - supply) / resistance + (1.0 - gain) * first
    f[2] = y[2] / resistance - first
    f[3] = (y[3] - supply) / resistance + gain * first
    f[4] = (2.0 * y[4] - supply) / resistance + (1.0 - gain) * second
    f[5] = y[5] / resistance - second
    f[6] = (y[6] - supply) / resistance + gain * second
    f[7] = y[7] / resistance
    return f


def transistor() -> DaeBenchmark:
    """Return the transistor amplifier, whose singular mass matrix has no row of zeros."""
    mass = np.zeros((8, 8))
    for (i, j), capacity in {(0, 1): 1e-6, (3, 4): 3e-6, (6, 7): 5e-6}.items():
        mass[[i, j], [i, j]] = -capacity
        mass[[i, j], [j, i]] = capacity
    mass[2, 2], mass[5, 5] = -2e-6, -4e-6
    end = [
        *(-0.5562145012262709e-2, 0.3006522471903042e1, 0.2849958788608128e1, 0.2926422536206241e1),
        *(0.2704617865010554e1, 0.2761837778393145e1, 0.4770927631616772e1, 0.1236995868091548e1),
    ]
    start = np.array([0.0, 3.0, 3.0, 6.0, 3.0, 3.0, 6.0, 0.0])
    return DaeBenchmark("transistor", _transistor, mass, (1,) * 8, start, 0.2, np.array(end), 8)


def _caraxis(t: float, y: Any) -> Any:
    weight = 10.0 * 1e-2**2 / 2.0
    yb = 0.1 * np.sin(10.0 * t)
    xb = np.sqrt(1.0 - yb * yb)
    xl, yl, xr, yr = y[0], y[1], y[2], y[3]
    left = (0.5 - np.sqrt(xl * xl + yl * yl)) / np.sqrt(xl * xl + yl * yl)
    length = np.sqrt((xr - xb) ** 2 + (yr - yb) ** 2)
    right = (0.5 - length) / length
    f = np.empty_like(y)
    f[:4] = y[4:8]
    f[4] = left * xl + y[8] * xb + 2.0 * y[9] * (xl - xr)
    f[5] = left * yl + y[8] * yb + 2.0 * y[9] * (yl - yr) - weight
    f[6] = right * (xr - xb) - 2.0 * y[9] * (xl - xr)
    f[7] = right * (yr - yb) - 2.0 * y[9] * (yl - yr) - weight
    f[8] = xb * xl + yb * yl
    f[9] = (xl - xr) ** 2 + (yl - yr) ** 2 - 1.0
    return f


def caraxis() -> DaeBenchmark:
    """Return the car axis at index 3."""
    mass = np.diag([*[1.0] * 4, *[10.0 * 1e-2**2 / 2.0] * 4, 0.0, 0.0])
    end = [
        *(0.493455784275402809122e-1, 0.496989460230171153861, 0.104174252488542151681e1),
        *(0.373911027265361256927, -0.770583684040972357970e-1, 0.744686658723778553466e-2),
        *(0.175568157537232222276e-1, 0.770341043779251976443, -0.473688659084893324729e-2),
        -0.110468033125734368808e-2,
    ]
    start = np.array([0.0, 0.5, 1.0, 0.5, -0.5, 0.0, -0.5, 0.0, 0.0, 0.0])
    return DaeBenchmark(
        "car axis", _caraxis, mass, (1,) * 4 + (2,) * 4 + (3, 3), start, 3.0, np.array(end), 10
    )


#: Andrews' squeezer: masses, points, inertias and lengths under their usual names.
_A = SimpleNamespace(
    m1=0.04325, m2=0.00365, m3=0.02373, m4=0.00706, m5=0.0705, m6=0.00706, m7=0.05498,
    xa=-0.06934, ya=-0.00227, xb=-0.03635, yb=0.03273, xc=0.014, yc=0.072, c0=4530.0,
    i1=2.194e-6, i2=4.41e-7, i3=5.255e-6, i4=5.667e-7, i5=1.169e-5, i6=5.667e-7, i7=1.912e-5,
    d=28e-3, da=115e-4, e=2e-2, ea=1421e-5, rr=7e-3, ra=92e-5, l0=7785e-5,
    ss=35e-3, sa=1874e-5, sb=1043e-5, sc=18e-3, sd=2e-2, ta=2308e-5, tb=916e-5,
    u=4e-2, ua=1228e-5, ub=449e-5, zf=2e-2, zt=4e-2, fa=1421e-5, moment=33e-3,
)  # fmt: skip


def _inertia(y: Any) -> Any:
    """Return the mass matrix of the seven bodies, shape (7, 7)."""
    a = _A
    coth, siph, siom = np.cos(y[1]), np.sin(y[3]), np.sin(y[5])
    e, z = a.e - a.ea, a.zf - a.fa
    m = np.zeros((7, 7), dtype=y.dtype)
    m[0, 0] = a.m1 * a.ra**2 + a.m2 * (a.rr**2 - 2.0 * a.da * a.rr * coth + a.da**2) + a.i1 + a.i2
    m[1, 0] = m[0, 1] = a.m2 * (a.da**2 - a.da * a.rr * coth) + a.i2
    m[1, 1] = a.m2 * a.da**2 + a.i2
    m[2, 2] = a.m3 * (a.sa**2 + a.sb**2) + a.i3
    m[3, 3] = a.m4 * e**2 + a.i4
    m[4, 3] = m[3, 4] = a.m4 * (e**2 + a.zt * e * siph) + a.i4
    m[4, 4] = a.m4 * (a.zt**2 + 2.0 * a.zt * e * siph + e**2) + a.m5 * (a.ta**2 + a.tb**2) + a.i4 + a.i5
    m[5, 5] = a.m6 * z**2 + a.i6
    m[6, 5] = m[5, 6] = a.m6 * (z**2 - a.u * z * siom) + a.i6
    m[6, 6] = a.m6 * (z**2 - 2.0 * a.u * z * siom + a.u**2) + a.m7 * (a.ua**2 + a.ub**2) + a.i6 + a.i7
    return m


def _forces(y: Any) -> Any:
    """Return the forces on the seven bodies: drive, inertia of rotation, spring; shape (7,)."""
    a = _A
    bep, thp, php, dep, omp, epp = y[7], y[8], y[10], y[11], y[12], y[13]
    siga, coga = np.sin(y[2]), np.cos(y[2])
    e, z = a.e - a.ea, a.zf - a.fa
    x = a.sd * coga + a.sc * siga + a.xb - a.xc
    v = a.sd * siga - a.sc * coga + a.yb - a.yc
    length = np.sqrt(x * x + v * v)
    pull = -a.c0 * (length - a.l0) / length
    f = np.zeros(7, dtype=y.dtype)
    f[0] = a.moment - a.m2 * a.da * a.rr * thp * (thp + 2.0 * bep) * np.sin(y[1])
    f[1] = a.m2 * a.da * a.rr * bep**2 * np.sin(y[1])
    f[2] = pull * (x * (a.sc * coga - a.sd * siga) + v * (a.sd * coga + a.sc * siga))
    f[3] = a.m4 * a.zt * e * dep**2 * np.cos(y[3])
    f[4] = -a.m4 * a.zt * e * php * (php + 2.0 * dep) * np.cos(y[3])
    f[5] = -a.m6 * a.u * z * epp**2 * np.cos(y[5])
    f[6] = a.m6 * a.u * z * omp * (omp + 2.0 * epp) * np.cos(y[5])
    return f


def _loops(y: Any) -> tuple[Any, Any]:
    """Return the six closing conditions, and their slopes over the seven angles, shape (6, 7)."""
    a = _A
    sib, cob = np.sin(y[0]), np.cos(y[0])
    sibt, cobt = np.sin(y[0] + y[1]), np.cos(y[0] + y[1])
    sipd, copd = np.sin(y[3] + y[4]), np.cos(y[3] + y[4])
    sioe, cooe = np.sin(y[5] + y[6]), np.cos(y[5] + y[6])
    right, up = a.rr * cob - a.d * cobt, a.rr * sib - a.d * sibt
    g = np.array(
        [
            right - a.ss * np.sin(y[2]) - a.xb,
            up + a.ss * np.cos(y[2]) - a.yb,
            right - a.e * sipd - a.zt * np.cos(y[4]) - a.xa,
            up + a.e * copd - a.zt * np.sin(y[4]) - a.ya,
            right - a.zf * cooe - a.u * np.sin(y[6]) - a.xa,
            up - a.zf * sioe + a.u * np.cos(y[6]) - a.ya,
        ]
    )
    slopes = np.zeros((6, 7), dtype=y.dtype)
    slopes[::2, 0] = -a.rr * sib + a.d * sibt
    slopes[::2, 1] = a.d * sibt
    slopes[1::2, 0] = a.rr * cob - a.d * cobt
    slopes[1::2, 1] = -a.d * cobt
    slopes[0, 2], slopes[1, 2] = -a.ss * np.cos(y[2]), -a.ss * np.sin(y[2])
    slopes[2, 3], slopes[3, 3] = -a.e * copd, -a.e * sipd
    slopes[2, 4], slopes[3, 4] = -a.e * copd + a.zt * np.sin(y[4]), -a.e * sipd - a.zt * np.cos(y[4])
    slopes[4, 5], slopes[5, 5] = a.zf * sioe, -a.zf * cooe
    slopes[4, 6], slopes[5, 6] = a.zf * sioe - a.u * np.cos(y[6]), -a.zf * cooe - a.u * np.sin(y[6])
    return g, slopes


def _andrews(t: float, y: Any) -> Any:
    g, slopes = _loops(y)
    balance = _inertia(y) @ y[14:21] - _forces(y) + slopes.T @ y[21:]
    return np.concatenate((y[7:21], balance, g))


def andrews() -> DaeBenchmark:
    """Return Andrews' squeezer: angles, speeds, accelerations and six multipliers, at index 3."""
    beta, phi = -0.0617138900142764496358948458001, 0.222668390165885884674473185609
    start = np.zeros(27)
    start[[0, 2, 3]] = beta, 0.455279819163070380255912382449, phi
    start[4:7] = 0.487364979543842550225598953530, -phi, 1.23054744454982119249735015568
    start[14:16] = 14222.4439199541138705911625887, -10666.8329399655854029433719415
    start[21:23] = 98.5668703962410896057654982170, -6.12268834425566265503114393122
    end = [
        *(0.1581077119629904e2, -0.1575637105984298e2, 0.4082224013073101e-1, -0.5347301163226948e0),
        *(0.5244099658805304e0, 0.5347301163226948e0, 0.1048080741042263e1, 0.1139920302151208e4),
        *(-0.1424379294994111e4, 0.1103291221937134e2, 0.1929337464421385e2, 0.5735699284790808e0),
        *(-0.1929337464421385e2, 0.3231791658026955e0, -0.2463176316945196e5, 0.5185037701610329e5),
        *(0.3241025686413781e6, 0.5667493645176213e6, 0.1674362929479361e5, -0.5667493645176222e6),
        *(0.9826520791458422e4, 0.1991753333731910e3, -0.2975531228015052e2, 0.2306654119098399e2),
        *(0.3145271365475927e2, 0.2264249232082739e2, 0.1161740700019673e2),
    ]
    mass = np.diag([1.0] * 14 + [0.0] * 13)
    index = (1,) * 7 + (2,) * 7 + (3,) * 13
    return DaeBenchmark("Andrews' squeezer", _andrews, mass, index, start, 0.03, np.array(end), 7)
