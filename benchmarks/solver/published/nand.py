"""NAND gate of the IVP Test Set: two enhancement transistors and a depletion transistor, F(t, y, y') = 0.

Voltages of 14 nodes, in ns, kOhm and pF. C(y) y' = f(t, y): capacities depend on the voltages. Two pulses
drive it; where they kink (every 5 ns) the integration begins anew. End point: PSIDE at a tolerance of 1e-16,
as published with the set.
"""

from __future__ import annotations

import numba as nb
import numpy as np

R_S, R_D, R_BULK = 4.0, 4.0, 10.0
C_GATE, C_BULK, C_NODE = 0.6e-4, 2.4e-5, 0.5e-4
SUPPLY, BULK = 5.0, -2.5
LEAK, THERMAL, SHORTENING, BARRIER = 1e-14, 25.85, 0.02, 0.87
DEPLETION = (-2.43, 0.2, 1.28, 5.35e-4, 5.35e-4)
#: Threshold, body factor, surface potential, gain forward and backward; the last one as the set has it.
ENHANCEMENT = (0.2, 0.035, 1.01, 1.748e-3, 1.748e-4)

END = 80.0
KINKS = np.arange(5.0, END, 5.0)
Y0 = np.array([5.0, 5.0, BULK, BULK, 5.0, 3.62385, 5.0, BULK, BULK, 3.62385, 0.0, 3.62385, BULK, BULK])
# fmt: off
Y_END = np.array([
    4.971088699385777, 4.999752103929311, -2.499998781491227, -2.499999999999975, 4.970837023296724,
    -0.2091214032073855, 4.970593243278363, -2.500077409198803, -2.499998781491227, -0.2090289583878100,
    -2.399999999966269e-4, -0.2091214032073855, -2.499999999999991, -2.500077409198803,
])
# fmt: on


@nb.njit
def _pulse(t, delay, high, period):
    """Return a pulse with flanks of 5 ns, and its rate."""
    s = t % period - delay
    if s <= 0.0 or s > 10.0 + high:
        return 0.0, 0.0
    if s <= 5.0:
        return s, 1.0
    return (5.0, 0.0) if s <= 5.0 + high else (10.0 + high - s, -1.0)


@nb.njit
def _channel(kind, drain, gate, bulk, backward):
    """Return the current of a channel for voltages against its source; ``drain`` is positive."""
    threshold = kind[0] + kind[1] * (np.sqrt(kind[2] - bulk) - np.sqrt(kind[2]))
    gain, over = kind[4] if backward else kind[3], gate - threshold
    if over <= 0.0:
        return 0.0
    square = over * over if over <= drain else drain * (2.0 * over - drain)
    return gain * square * (1.0 + SHORTENING * drain)


@nb.njit
def _transistor(kind, drain, gate, bulk, gate_drain, bulk_drain):
    """Return the current from source to drain, Shichman and Hodges."""
    if drain >= 0.0:
        return -_channel(kind, drain, gate, bulk, False)
    return _channel(kind, -drain, gate_drain, bulk_drain, True)


@nb.njit
def _junction(v):
    return -LEAK * (np.exp(v / THERMAL) - 1.0) if v <= 0.0 else 0.0


@nb.njit
def _capacity(v):
    return C_BULK / np.sqrt(1.0 - v / BARRIER) if v <= 0.0 else C_BULK * (1.0 + v / (2.0 * BARRIER))


@nb.njit
def residual(t, y, slope):
    """Return F, shape (14,)."""
    f = np.zeros(14)
    in_1, rate_1 = _pulse(t, 5.0, 5.0, 20.0)
    in_2, rate_2 = _pulse(t, 15.0, 15.0, 40.0)
    # Each transistor: source, drain, bulk beside the source, bulk beside the drain; the nodes outside.
    for k in range(3):
        source, drain, bulk_s, bulk_d = (
            (0, 1, 2, 3) if k == 0 else (5, 6, 7, 8) if k == 1 else (10, 11, 12, 13)
        )
        low = y[4] if k == 0 else y[9] if k == 1 else 0.0
        high = SUPPLY if k == 0 else y[4] if k == 1 else y[9]
        gate = y[4] if k == 0 else in_1 if k == 1 else in_2
        gate_rate = slope[4] if k == 0 else rate_1 if k == 1 else rate_2
        low_rate = slope[4] if k == 0 else slope[9] if k == 1 else 0.0
        high_rate = 0.0 if k == 0 else slope[4] if k == 1 else slope[9]
        kind = DEPLETION if k == 0 else ENHANCEMENT
        at_source, at_drain = y[bulk_s] - low, y[bulk_d] - high
        current = _transistor(
            kind, y[drain] - y[source], gate - y[source], at_source, gate - y[drain], at_drain
        )
        charging_s = C_GATE * (slope[source] - gate_rate)
        charging_d = C_GATE * (slope[drain] - gate_rate)
        into_s = _capacity(at_source) * (slope[bulk_s] - low_rate)
        into_d = _capacity(at_drain) * (slope[bulk_d] - high_rate)
        f[source] = charging_s + (y[source] - low) / R_S + current
        f[drain] = charging_d + (y[drain] - high) / R_D - current
        f[bulk_s] = into_s + (y[bulk_s] - BULK) / R_BULK - _junction(at_source)
        f[bulk_d] = into_d + (y[bulk_d] - BULK) / R_BULK - _junction(at_drain)
        # The node at the lower end and the one at the upper end of the transistor.
        if k < 2:
            node = 4 if k == 0 else 9
            f[node] += (low - y[source]) / R_S - into_s + _junction(at_source)
        if k > 0:
            node = 4 if k == 1 else 9
            f[node] += (high - y[drain]) / R_D - into_d + _junction(at_drain)
        if k == 0:
            f[4] -= charging_s + charging_d
    f[4] += C_NODE * slope[4]
    f[9] += C_NODE * slope[9]
    return f
