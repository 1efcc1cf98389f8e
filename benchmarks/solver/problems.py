"""Stiff problems with known end points, as compiled functions that every solver is given.

End points: the IVP Test Set (Mazzia, Iavernaro and Magherini; R package deTestSet 1.1.7.4). ``VDP11`` is
Van der Pol's equation in the form of Hairer and Wanner over 11 units of time, with the end point of Cash's
runs. The pendulum has the form of index 0: the multiplier has the differential equation
λ' = −3v − 2λ(xu + yv), so the problem is ordinary and hardly stiff. Its end point comes from the quadrature
of t = ∫dw/√(1 − (1 − w²)²/4) over the angular speed w; the one that comes with Cash's runs is up to 9e-11
off. That of ``E5`` (up to t = 1e9) is SciPy's Radau at rtol 3e-13 and 1e-12, which agree, without y2, which
is y3 + y4. That of ``RING``, the ring modulator, is an MEBDF run at rtol 1e-12; CVODE at its tightest
agrees to 6 digits.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numba as nb
import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
RHS = nb.void(nb.float64, nb.float64[::1], nb.float64[::1])
JAC = nb.void(nb.float64, nb.float64[::1], nb.float64[:, ::1])


@dataclass(frozen=True)
class Benchmark:
    """A problem."""

    name: str  #: Short name.
    #: ``rhs(t, y, f)`` and ``jac(t, y, jacobian)`` fill their last argument.
    rhs: Callable[..., None]
    jac: Callable[..., None]
    y0: FloatArray  #: Initial state, shape (n,).
    t_end: float  #: End; the start is 0.
    end: FloatArray  #: Solution at the end, shape (n,).
    #: The absolute tolerance is rtol times this: a number, or shape (n,) where components are of very
    #: different size.
    scale: Any = 1.0

    @property
    def atol(self) -> FloatArray:
        """Absolute tolerance per unit of rtol, shape (n,)."""
        return np.broadcast_to(np.asarray(self.scale, dtype=np.float64), self.y0.shape).copy()

    def digits(self, y: FloatArray) -> float:
        """Return the number of correct digits of a solution at the end.

        The largest error of a component, relative to |y_i| + atol_i / rtol: what the tolerances ask for.
        """
        error = np.max(np.abs(y - self.end) / (np.abs(self.end) + self.atol))
        return float(-np.log10(max(error, 1.0e-16)))


@nb.njit(RHS, cache=True)
def _vdp_rhs(t, y, f):
    f[0] = y[1]
    f[1] = ((1.0 - y[0] * y[0]) * y[1] - y[0]) * 1.0e6


@nb.njit(JAC, cache=True)
def _vdp_jac(t, y, jacobian):
    jacobian[0, 0] = 0.0
    jacobian[0, 1] = 1.0
    jacobian[1, 0] = (-2.0 * y[0] * y[1] - 1.0) * 1.0e6
    jacobian[1, 1] = (1.0 - y[0] * y[0]) * 1.0e6


@nb.njit(RHS, cache=True)
def _vdp1000_rhs(t, y, f):
    f[0] = y[1]
    f[1] = 1.0e3 * (1.0 - y[0] * y[0]) * y[1] - y[0]


@nb.njit(JAC, cache=True)
def _vdp1000_jac(t, y, jacobian):
    jacobian[0, 0] = 0.0
    jacobian[0, 1] = 1.0
    jacobian[1, 0] = -2.0e3 * y[0] * y[1] - 1.0
    jacobian[1, 1] = 1.0e3 * (1.0 - y[0] * y[0])


@nb.njit(RHS, cache=True)
def _rober_rhs(t, y, f):
    f[0] = -0.04 * y[0] + 1.0e4 * y[1] * y[2]
    f[2] = 3.0e7 * y[1] * y[1]
    f[1] = -f[0] - f[2]


@nb.njit(JAC, cache=True)
def _rober_jac(t, y, jacobian):
    jacobian[0, 0] = -0.04
    jacobian[0, 1] = 1.0e4 * y[2]
    jacobian[0, 2] = 1.0e4 * y[1]
    jacobian[2, 0] = 0.0
    jacobian[2, 1] = 6.0e7 * y[1]
    jacobian[2, 2] = 0.0
    for j in range(3):
        jacobian[1, j] = -jacobian[0, j] - jacobian[2, j]


@nb.njit(RHS, cache=True)
def _orego_rhs(t, y, f):
    f[0] = 77.27 * (y[1] + y[0] * (1.0 - 8.375e-6 * y[0] - y[1]))
    f[1] = (y[2] - (1.0 + y[0]) * y[1]) / 77.27
    f[2] = 0.161 * (y[0] - y[2])


@nb.njit(JAC, cache=True)
def _orego_jac(t, y, jacobian):
    jacobian[0, 0] = 77.27 * (1.0 - 2.0 * 8.375e-6 * y[0] - y[1])
    jacobian[0, 1] = 77.27 * (1.0 - y[0])
    jacobian[0, 2] = 0.0
    jacobian[1, 0] = -y[1] / 77.27
    jacobian[1, 1] = -(1.0 + y[0]) / 77.27
    jacobian[1, 2] = 1.0 / 77.27
    jacobian[2, 0] = 0.161
    jacobian[2, 1] = 0.0
    jacobian[2, 2] = -0.161


@nb.njit(RHS, cache=True)
def _hires_rhs(t, y, f):
    f[0] = -1.71 * y[0] + 0.43 * y[1] + 8.32 * y[2] + 0.0007
    f[1] = 1.71 * y[0] - 8.75 * y[1]
    f[2] = -10.03 * y[2] + 0.43 * y[3] + 0.035 * y[4]
    f[3] = 8.32 * y[1] + 1.71 * y[2] - 1.12 * y[3]
    f[4] = -1.745 * y[4] + 0.43 * y[5] + 0.43 * y[6]
    f[5] = -280.0 * y[5] * y[7] + 0.69 * y[3] + 1.71 * y[4] - 0.43 * y[5] + 0.69 * y[6]
    f[6] = 280.0 * y[5] * y[7] - 1.81 * y[6]
    f[7] = -f[6]


@nb.njit(JAC, cache=True)
def _hires_jac(t, y, jacobian):
    jacobian[:, :] = 0.0
    jacobian[0, 0] = -1.71
    jacobian[0, 1] = 0.43
    jacobian[0, 2] = 8.32
    jacobian[1, 0] = 1.71
    jacobian[1, 1] = -8.75
    jacobian[2, 2] = -10.03
    jacobian[2, 3] = 0.43
    jacobian[2, 4] = 0.035
    jacobian[3, 1] = 8.32
    jacobian[3, 2] = 1.71
    jacobian[3, 3] = -1.12
    jacobian[4, 4] = -1.745
    jacobian[4, 5] = 0.43
    jacobian[4, 6] = 0.43
    jacobian[5, 3] = 0.69
    jacobian[5, 4] = 1.71
    jacobian[5, 5] = -280.0 * y[7] - 0.43
    jacobian[5, 6] = 0.69
    jacobian[5, 7] = -280.0 * y[5]
    jacobian[6, 5] = 280.0 * y[7]
    jacobian[6, 6] = -1.81
    jacobian[6, 7] = 280.0 * y[5]
    for j in range(8):
        jacobian[7, j] = -jacobian[6, j]


@nb.njit(RHS, cache=True)
def _e5_rhs(t, y, f):
    r_1 = 7.89e-10 * y[0]
    r_2 = 1.1e7 * y[0] * y[2]
    r_3 = 1.13e9 * y[1] * y[2]
    r_4 = 1.13e3 * y[3]
    f[0] = -r_1 - r_2
    f[1] = r_1 - r_3
    f[3] = r_2 - r_4
    f[2] = f[1] - f[3]


@nb.njit(JAC, cache=True)
def _e5_jac(t, y, jacobian):
    jacobian[:, :] = 0.0
    jacobian[0, 0] = -7.89e-10 - 1.1e7 * y[2]
    jacobian[0, 2] = -1.1e7 * y[0]
    jacobian[1, 0] = 7.89e-10
    jacobian[1, 1] = -1.13e9 * y[2]
    jacobian[1, 2] = -1.13e9 * y[1]
    jacobian[3, 0] = 1.1e7 * y[2]
    jacobian[3, 2] = 1.1e7 * y[0]
    jacobian[3, 3] = -1.13e3
    for j in range(4):
        jacobian[2, j] = jacobian[1, j] - jacobian[3, j]


_RATES = np.array(
    [
        *(0.35, 26.6, 1.23e4, 8.6e-4, 8.2e-4, 1.5e4, 1.3e-4, 2.4e4, 1.65e4, 9.0e3, 2.2e-2, 1.2e4, 1.88),
        *(1.63e4, 4.8e6, 3.5e-4, 1.75e-2, 1.0e8, 4.44e11, 1.24e3, 2.1, 5.78, 4.74e-2, 1.78e3, 3.12),
    ]
)
_FIRST = np.array([0, 1, 4, 6, 6, 6, 8, 8, 10, 10, 12, 9, 13, 0, 2, 3, 3, 15, 15, 16, 18, 18, 0, 0, 19])
_SECOND = np.array([-1, 3, 1, -1, -1, 5, -1, 5, 1, 0, -1, 1, -1, 5, -1, -1, -1, -1, -1, 5, -1, -1, 3, 18, -1])
#: POLLU: reaction i consumes species FIRST and SECOND and gives those of GIVES (−1: none).
_GIVES = np.array(
    [
        *([1, 2, -1], [0, -1, -1], [0, 5, -1], [4, 4, 7], [7, -1, -1], [4, 7, -1], [4, 7, 9]),
        *([10, -1, -1], [0, 9, 11], [12, -1, -1], [0, 10, -1], [0, 13, -1], [4, 6, -1], [14, -1, -1]),
        *([3, -1, -1], [15, -1, -1], [2, -1, -1], [5, 5, -1], [2, -1, -1], [4, 17, -1], [1, -1, -1]),
        *([0, 2, -1], [18, -1, -1], [19, -1, -1], [0, 18, -1]),
    ]
)


@nb.njit(RHS, cache=True)
def _pollu_rhs(t, y, f):
    f[:] = 0.0
    for r in range(25):
        rate = _RATES[r] * y[_FIRST[r]]
        if _SECOND[r] >= 0:
            rate *= y[_SECOND[r]]
            f[_SECOND[r]] -= rate
        f[_FIRST[r]] -= rate
        for k in range(3):
            if _GIVES[r, k] >= 0:
                f[_GIVES[r, k]] += rate


@nb.njit(JAC, cache=True)
def _pollu_jac(t, y, jacobian):
    jacobian[:, :] = 0.0
    for r in range(25):
        for which in range(2):
            by = _FIRST[r] if which == 0 else _SECOND[r]
            if by < 0:
                continue
            other = _SECOND[r] if which == 0 else _FIRST[r]
            slope = _RATES[r] * (y[other] if other >= 0 else 1.0)
            jacobian[_FIRST[r], by] -= slope
            if _SECOND[r] >= 0:
                jacobian[_SECOND[r], by] -= slope
            for k in range(3):
                if _GIVES[r, k] >= 0:
                    jacobian[_GIVES[r, k], by] += slope


_GAMMA, _DELTA = 40.67286402e-9, 17.7493332


@nb.njit(nb.void(nb.float64, nb.float64[::1], nb.float64[::1]), cache=True)
def _voltages(t, y, u):
    """Fill the voltages of the four diodes."""
    carrier = 2.0 * np.sin(20000.0 * np.pi * t)
    u[0] = y[2] - y[4] - y[6] - carrier
    u[1] = -y[3] + y[5] - y[6] - carrier
    u[2] = y[3] + y[4] + y[6] + carrier
    u[3] = -y[2] - y[5] + y[6] + carrier


@nb.njit(RHS, cache=True)
def _ring_rhs(t, y, f):
    q = np.empty(4)
    _voltages(t, y, q)
    for i in range(4):
        q[i] = _GAMMA * (np.exp(_DELTA * q[i]) - 1.0)
    signal = 0.5 * np.sin(2000.0 * np.pi * t)
    f[0] = (y[7] - 0.5 * y[9] + 0.5 * y[10] + y[13] - y[0] / 25000.0) / 1.6e-8
    f[1] = (y[8] - 0.5 * y[11] + 0.5 * y[12] + y[14] - y[1] / 25000.0) / 1.6e-8
    f[2] = (y[9] - q[0] + q[3]) / 2.0e-12
    f[3] = (-y[10] + q[1] - q[2]) / 2.0e-12
    f[4] = (y[11] + q[0] - q[2]) / 2.0e-12
    f[5] = (-y[12] - q[1] + q[3]) / 2.0e-12
    f[6] = (-y[6] / 50.0 + q[0] + q[1] - q[2] - q[3]) / 1.0e-8
    f[7] = -y[0] / 4.45
    f[8] = -y[1] / 4.45
    f[9] = (0.5 * y[0] - y[2] - 17.3 * y[9]) / 5.0e-4
    f[10] = (-0.5 * y[0] + y[3] - 17.3 * y[10]) / 5.0e-4
    f[11] = (0.5 * y[1] - y[4] - 17.3 * y[11]) / 5.0e-4
    f[12] = (-0.5 * y[1] + y[5] - 17.3 * y[12]) / 5.0e-4
    f[13] = (-y[0] + signal - (50.0 + 36.3) * y[13]) / 2.0e-3
    f[14] = (-y[1] - (600.0 + 36.3) * y[14]) / 2.0e-3


_DIODES = np.array([[2, 4, 6], [3, 5, 6], [3, 4, 6], [2, 5, 6]])
_SIGNS = np.array([[1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [1.0, 1.0, 1.0], [-1.0, -1.0, 1.0]])
_FEEDS = np.array([[2, 4, 6], [3, 5, 6], [3, 4, 6], [2, 5, 6]])
_FEED_SIGNS = np.array([[-1.0, 1.0, 1.0], [1.0, -1.0, 1.0], [-1.0, -1.0, -1.0], [1.0, 1.0, -1.0]])
_CAPACITY = np.array([0.0, 0.0, 2.0e-12, 2.0e-12, 2.0e-12, 2.0e-12, 1.0e-8])
_LINEAR_ROW = np.array(
    [
        *(0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 2, 3, 4, 5, 6, 7, 8, 9, 9, 9, 10, 10, 10),
        *(11, 11, 11, 12, 12, 12, 13, 13, 14, 14),
    ]
)
_LINEAR_COLUMN = np.array(
    [
        *(7, 9, 10, 13, 0, 8, 11, 12, 14, 1, 9, 10, 11, 12, 6, 0, 1, 0, 2, 9, 0, 3, 10),
        *(1, 4, 11, 1, 5, 12, 0, 13, 1, 14),
    ]
)
_LINEAR = np.array(
    [
        *(x / 1.6e-8 for x in (1.0, -0.5, 0.5, 1.0, -1.0 / 25000.0, 1.0, -0.5, 0.5, 1.0, -1.0 / 25000.0)),
        *(x / 2.0e-12 for x in (1.0, -1.0, 1.0, -1.0)),
        *(-1.0 / (50.0 * 1.0e-8), -1.0 / 4.45, -1.0 / 4.45),
        *(x / 5.0e-4 for x in (0.5, -1.0, -17.3, -0.5, 1.0, -17.3, 0.5, -1.0, -17.3, -0.5, 1.0, -17.3)),
        *(x / 2.0e-3 for x in (-1.0, -86.3, -1.0, -636.3)),
    ]
)


@nb.njit(JAC, cache=True)
def _ring_jac(t, y, jacobian):
    jacobian[:, :] = 0.0
    for i in range(_LINEAR.size):
        jacobian[_LINEAR_ROW[i], _LINEAR_COLUMN[i]] = _LINEAR[i]
    u = np.empty(4)
    _voltages(t, y, u)
    for d in range(4):
        slope = _GAMMA * _DELTA * np.exp(_DELTA * u[d])
        for i in range(3):
            row = _FEEDS[d, i]
            for j in range(3):
                jacobian[row, _DIODES[d, j]] += _FEED_SIGNS[d, i] * _SIGNS[d, j] * slope / _CAPACITY[row]


@nb.njit(RHS, cache=True)
def _pendulum_rhs(t, y, f):
    f[0] = y[2]
    f[1] = y[3]
    f[2] = -y[0] * y[4]
    f[3] = -y[1] * y[4] - 1.0
    f[4] = -3.0 * y[3] - 2.0 * y[4] * (y[0] * y[2] + y[1] * y[3])


@nb.njit(JAC, cache=True)
def _pendulum_jac(t, y, jacobian):
    jacobian[:, :] = 0.0
    jacobian[0, 2] = jacobian[1, 3] = 1.0
    jacobian[2, 0] = jacobian[3, 1] = -y[4]
    jacobian[2, 4] = -y[0]
    jacobian[3, 4] = -y[1]
    jacobian[4, 0] = -2.0 * y[4] * y[2]
    jacobian[4, 1] = -2.0 * y[4] * y[3]
    jacobian[4, 2] = -2.0 * y[4] * y[0]
    jacobian[4, 3] = -3.0 - 2.0 * y[4] * y[1]
    jacobian[4, 4] = -2.0 * (y[0] * y[2] + y[1] * y[3])


def _made(name, rhs, jac, y0, t_end, end, scale=1.0):
    arrays = (np.array(y0, dtype=np.float64), np.array(end, dtype=np.float64))
    return Benchmark(name, rhs, jac, arrays[0], float(t_end), arrays[1], scale)


def _sparse(n, **values):
    y = np.zeros(n)
    for name, value in values.items():
        y[int(name[1:]) - 1] = value
    return y


# fmt: off
_POLLU_END = [
    0.5646255480022769e-01, 0.1342484130422339, 0.4139734331099427e-08, 0.5523140207484359e-02,
    0.2018977262302196e-06, 0.1464541863493966e-06, 0.7784249118997964e-01, 0.3245075353396018,
    0.7494013383880406e-02, 0.1622293157301561e-07, 0.1135863833257075e-07, 0.2230505975721359e-02,
    0.2087162882798630e-03, 0.1396921016840158e-04, 0.8964884856898295e-02, 0.4352846369330103e-17,
    0.6899219696263405e-02, 0.1007803037365946e-03, 0.1772146513969984e-05, 0.5682943292316392e-04,
]
_HIRES_END = [
    0.7371312573325668e-3, 0.1442485726316185e-3, 0.5888729740967575e-4, 0.1175651343283149e-2,
    0.2386356198831331e-2, 0.6238968252742796e-2, 0.2849998395185769e-2, 0.2850001604814231e-2,
]
_RING_END = [
    -2.33905735835e-02, -7.36748548571e-03, 2.58295671003e-01, -4.06446572036e-01,
    -4.03945566425e-01, 2.60796676620e-01, 1.10676186118e-01, 2.93990434289e-07,
    -2.84002993144e-08, 7.26719826648e-04, 7.92948719609e-04, -7.25528349483e-04,
    -7.94140196775e-04, 7.08849541696e-05, 2.39005907517e-05,
]
# fmt: on

_PENDULUM_END = [
    *(0.8673486406004394, 0.4977010504796730),
    *(-0.0337480180609545, 0.0588130114652499, -0.4931031514390188),
]

#: All problems by name.
PROBLEMS = {
    problem.name: problem
    for problem in (
        _made("HIRES", _hires_rhs, _hires_jac, _sparse(8, y1=1.0, y8=0.0057), 321.8122, _HIRES_END, 1e-2),
        _made(
            "POLLU",
            _pollu_rhs,
            _pollu_jac,
            _sparse(20, y2=0.2, y4=0.04, y7=0.1, y8=0.3, y9=0.01, y17=0.007),
            60.0,
            _POLLU_END,
            1e-2,
        ),
        _made(
            "VDP",
            _vdp1000_rhs,
            _vdp1000_jac,
            [2.0, 0.0],
            2000.0,
            [0.1706167732170469e1, -0.8928097010248125e-3],
            [1.0, 1e-3],
        ),
        _made(
            "OREGO",
            _orego_rhs,
            _orego_jac,
            [1.0, 2.0, 3.0],
            360.0,
            [0.1000814870318523e1, 0.1228178521549917e4, 0.1320554942846706e3],
        ),
        _made(
            "ROBER",
            _rober_rhs,
            _rober_jac,
            [1.0, 0.0, 0.0],
            1e11,
            [0.2083340149701255e-7, 0.8333360770334713e-13, 0.9999999791665050],
            [1e-6, 1e-12, 1.0],
        ),
        _made("VDP11", _vdp_rhs, _vdp_jac, [2.0, 0.0], 11.0, [-1.590150544829062, 1.040279389212485]),
        _made("PENDULUM", _pendulum_rhs, _pendulum_jac, [1.0, 0.0, 0.0, 1.0, 1.0], 1.0, _PENDULUM_END),
        _made(
            "E5",
            _e5_rhs,
            _e5_jac,
            [1.76e-3, 0.0, 0.0, 0.0],
            1e9,
            [3.1317148329357e-14, 1.4840957952870e-16, 1.4840957948346e-16, 4.5243728279782e-26],
            [1e-6, 1e-14, 1e-18, 1e-16],
        ),
        _made("RING", _ring_rhs, _ring_jac, np.zeros(15), 1e-3, _RING_END, 1e-2),
    )
}
