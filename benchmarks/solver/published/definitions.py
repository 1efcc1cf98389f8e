"""Plate, beam, medical Akzo Nobel problem and points on a sphere, from the definitions of the published sets.

Hairer and Wanner, Solving Ordinary Differential Equations II, IV.10; Test Set for IVP Solvers (Mazzia and
Magherini). End values are published, at the components named, or Radau's (plate, medical Akzo Nobel).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import Any

import numba as nb
import numpy as np
from scipy.integrate import solve_ivp


@dataclass(frozen=True)
class Published:
    """A problem M y' = f(t, y), with the end values that are known of it and options of the MEBDF."""

    fun: Callable[..., Any]
    y0: Any
    t_end: float
    known: Any
    end: Any
    options: dict[str, Any] = field(default_factory=dict)
    start: float = 0.0
    unit: float = 1.0  #: Absolute tolerance over the relative one.

    def digits(self, y: Any) -> float:
        """Return the correct digits of a solution at the end, mixed absolute and relative."""
        error = np.max(np.abs(y[self.known] - self.end) / (1.0 + np.abs(self.end)))
        return float(-np.log10(max(error, 1e-16)))


@nb.njit
def _plate(t, y):
    """Return the rates of 8 x 5 points of a plate that two wheels cross: deflections, then speeds."""
    f, bent = np.zeros(80), np.zeros((2, 7, 10))
    h = 2.0 / 9.0
    for i in range(40):
        bent[0, i // 8 + 1, i % 8 + 1] = y[i]
    for level in range(2):  # the Laplacian twice; it and the deflection vanish at the edges
        for i in range(40):
            r, c = i // 8 + 1, i % 8 + 1
            u = bent[level]
            value = (u[r - 1, c] + u[r + 1, c] + u[r, c - 1] + u[r, c + 1] - 4.0 * u[r, c]) / h**2
            if level == 0:
                bent[1, r, c] = value
            else:
                load = 0.0
                if r in (2, 4):
                    x = c * h
                    load = 200.0 * (np.exp(-5.0 * (t - x - 2.0) ** 2) + np.exp(-5.0 * (t - x - 5.0) ** 2))
                f[i], f[40 + i] = y[40 + i], load - 1000.0 * y[40 + i] - 100.0 * value
    return f


def plate() -> Published:
    """Return the plate, linear and stiff, with 80 equations."""
    y0 = np.zeros(80)
    exact = solve_ivp(_plate, (0.0, 7.0), y0, method="Radau", rtol=1e-11, atol=1e-13).y[:, -1]
    return Published(_plate, y0, 7.0, np.arange(80), exact)


@nb.njit
def _beam(t, y):
    """Return the rates of the angles of a clamped beam of 40 pieces, and of their speeds."""
    n = 40
    angle, speed = y[:n], y[n:]
    v, w, diagonal = np.empty(n), np.empty(n), np.full(n, 2.0)
    diagonal[0], diagonal[n - 1] = 1.0, 3.0
    force = 1.5 * np.sin(t) ** 2 if t <= np.pi else 0.0
    cosine, sine = np.cos(angle[1:] - angle[:-1]), np.sin(angle[1:] - angle[:-1])
    for k in range(n):
        before = angle[k - 1] if k > 0 else -angle[0]
        after = angle[k + 1] if k < n - 1 else angle[k]
        v[k] = n**4 * (before - 2.0 * angle[k] + after) + n**2 * force * (np.cos(angle[k]) + np.sin(angle[k]))
    for k in range(n):
        w[k] = speed[k] ** 2
        if k > 0:
            w[k] -= sine[k - 1] * v[k - 1]
        if k < n - 1:
            w[k] += sine[k] * v[k + 1]
    pivot = diagonal.copy()
    for k in range(n - 2, -1, -1):  # C w = D v + speeds squared, from the free end
        share = -cosine[k] / pivot[k + 1]
        w[k] -= share * w[k + 1]
        pivot[k] += share * cosine[k]
    w[0] /= pivot[0]
    for k in range(1, n):
        w[k] = (w[k] + cosine[k - 1] * w[k - 1]) / pivot[k]
    f = np.empty(2 * n)
    for k in range(n):
        u = diagonal[k] * v[k]
        if k > 0:
            u -= cosine[k - 1] * v[k - 1] + sine[k - 1] * w[k - 1]
        if k < n - 1:
            u += sine[k] * w[k + 1] - cosine[k] * v[k + 1]
        f[k], f[n + k] = speed[k], u
    return f


def beam(**options: int) -> Published:
    """Return the beam, which oscillates at up to 6400 rad/s: 80 equations."""
    end = [-0.005792366591285007, -0.1767201761075488, 0.03747362681329794, 1.186724615113034]
    return Published(_beam, np.zeros(80), 5.0, [0, 39, 40, 79], np.array(end), options)


@nb.njit
def _akzo(t, y):
    """Return the rates of antibody and tissue at 200 places, mapped from a half line."""
    n, f = 200, np.empty(400)
    for j in range(n):
        back = (j + 1.0) / n - 1.0
        first, second = 2.0 * back**3 / 16.0, back**4 / 16.0
        u, v = y[2 * j], y[2 * j + 1]
        left = y[2 * j - 2] if j > 0 else (2.0 if t <= 5.0 else 0.0)
        right = y[2 * j + 2] if j < n - 1 else u
        diffusion = first * (right - left) * n / 2.0 + second * (left - 2.0 * u + right) * n**2
        f[2 * j], f[2 * j + 1] = diffusion - 100.0 * u * v, -100.0 * u * v
    return f


def medical_akzo() -> Published:
    """Return the medical Akzo Nobel problem, with 400 equations."""
    y, pattern = np.tile([0.0, 1.0], 200), np.tri(400, k=2) * np.tri(400, k=2).T
    options = {"lband": 2, "uband": 2, "breakpoints": [5.0]}
    problem = Published(_akzo, y, 20.0, np.arange(400), y, options)
    for span in ((0.0, 5.0), (np.nextafter(5.0, 6.0), 20.0)):
        found = solve_ivp(_akzo, span, y, method="Radau", rtol=1e-10, atol=1e-15, jac_sparsity=pattern)
        y = found.y[:, -1]
    return replace(problem, end=y)


@nb.njit
def _fekete(t, y):
    n = y.size // 8
    p, q = y[: 3 * n].reshape((n, 3)), y[3 * n : 6 * n].reshape((n, 3))
    f = np.zeros(8 * n)
    for i in range(n):
        force = 2.0 * y[6 * n + i] * p[i] - 0.5 * q[i]
        for j in range(n):
            if j != i:
                away = p[i] - p[j]
                force += away / np.sum(away * away)
        f[3 * i : 3 * i + 3] = q[i] + 2.0 * y[7 * n + i] * p[i]
        f[3 * n + 3 * i : 3 * n + 3 * i + 3] = force
        f[6 * n + i], f[7 * n + i] = np.sum(p[i] * p[i]) - 1.0, 2.0 * np.sum(p[i] * q[i])
    return f


def fekete(n: int = 20) -> Published:
    """Return points that repel each other on a sphere, index 2, with 8 n equations.

    The published set has 20 points, in four rings; other numbers begin on a spiral. At the end all are at
    rest, and the multipliers of the constraints are (1 - n)/4: what is published of the set is that number.
    """
    if n == 20:
        rings = (
            (3, 3 / 8, 1 / 13, 1),
            (7, 1 / 8, 1 / 29, 1),
            (6, -2 / 15, 1 / 7, 1),
            (4, -3 / 10, 1 / 17, 0),
        )
        at = [(2 * np.pi * (k + s) / m + np.pi * a, np.pi * b) for m, b, a, s in rings for k in range(m)]
        around, up = np.array(at).T
    else:
        around, up = (
            np.arange(n) * np.pi * (3.0 - np.sqrt(5.0)),
            np.arcsin(1.0 - (2.0 * np.arange(n) + 1.0) / n),
        )
    places = np.stack((np.cos(around) * np.cos(up), np.sin(around) * np.cos(up), np.sin(up)), axis=1)
    y0 = np.concatenate((places.ravel(), np.zeros(5 * n)))
    forces = _fekete(0.0, y0)[3 * n : 6 * n].reshape(n, 3)
    y0[6 * n : 7 * n] = -0.5 * np.sum(places * forces, axis=1)
    mass = np.append(np.ones(6 * n), np.zeros(2 * n))
    options = {"mass": mass, "index": np.append(np.ones(6 * n, dtype=int), np.full(2 * n, 2))}
    known = np.arange(6 * n, 7 * n)
    return Published(_fekete, y0, 1000.0, known, np.full(n, (1.0 - n) / 4.0), options)


_FROM = np.array([1, 2, 2, 3, 3, 4, 5, 6, 7, 7, 8, 8, 9, 11, 11, 12, 12, 13])
_TO = np.array([2, 3, 6, 4, 5, 5, 10, 5, 4, 8, 5, 10, 8, 9, 12, 7, 8, 11])
#: Pipes by their ends, and where the pressure of each node stands behind those of nodes 5 and 8.
_PLACES = np.array([0, 2, 3, 4, 5, 0, 6, 7, 1, 8, 9, 10, 11, 12])


@nb.njit
def _tubes(t, y):
    """Return the equations of 18 pipes between 13 nodes: flows, friction, pressures."""
    f, area = np.zeros(49), np.pi / 4.0
    hours = t / 3600.0
    inflow = 1.0 - np.cos(np.exp(-hours) - 1.0)
    f[36 + _PLACES[1]] += inflow / 200.0
    f[36 + _PLACES[13]] += inflow / 80.0
    f[36 + _PLACES[10]] -= hours**2 * (3.0 * hours**2 - 92.0 * hours + 720.0) / 1e6
    for k in range(18):
        flow, friction, root = y[k], y[18 + k], np.sqrt(y[18 + k])
        begin, end = 36 + _PLACES[_FROM[k]], 36 + _PLACES[_TO[k]]
        reynolds = abs(flow) / (1.31e-6 * area)
        f[18 + k] = 1.0 / root - 1.74 + 2.0 * np.log10(4e-4 + 18.7 / (max(reynolds, 2300.0) * root))
        loss = friction * 1e6 * flow**2 / area**2 if reynolds > 2300.0 else 32.0 * 1.31e-3 * 1e3 * flow / area
        f[k] = y[begin] - y[end] - loss
        f[begin] -= flow
        f[end] += flow
    return f


def water_tube() -> Published:
    """Return the network of water pipes, index 2, with 49 equations."""
    y0 = np.concatenate((np.zeros(18), np.full(18, 0.047519404529185289807), np.full(13, 109800.0)))
    mass = np.zeros(49)
    mass[:18], mass[36:38] = 1e6 / (np.pi / 4.0), 200.0 / 9800.0
    index = np.ones(49, dtype=int)
    index[38:] = 2
    known, end = (
        [0, 17, 24, 36, 37, 48],
        [
            *(0.002298488296477430, 0.005746220741193575, 0.04311196778792902),
            *(111126.8591478108, 111127.0045592387, 111129.8338971779),
        ],
    )
    return Published(_tubes, y0, 17.0 * 3600.0, known, np.array(end), {"mass": mass, "index": index})
