"""Range of the mechanism: the vane angle of the ideal mechanism over the crank angle."""

import math
from functools import lru_cache
from typing import Final

import numpy as np

from mebdf.arrays import FloatArray
from mebdf.kernels.elementary import portable
from tribodyn.core.errors import InputError
from tribodyn.core.quantities import Record
from tribodyn.core.splines import bisected, spline
from tribodyn.kernels.vsv.closure import closure_residual, crank_end
from tribodyn.kernels.vsv.data import N_IDEAL
from tribodyn.papers.cheng_2022.reduced.parameters import Lengths

_SCAN: Final = 1441
_BLOCK: Final = 32
_BISECTIONS: Final = 50  #: From the spacing of the scan to below rounding.
#: Depth to which the closure falls between the assemblies, over its height elsewhere, when they meet: 2°.
_MEETING: Final = 1.0e-4


def closure(lengths: Lengths, theta_a: FloatArray, theta_v: FloatArray) -> FloatArray:
    """Return |S1S2|² − l_2² [m²] of the ideal mechanism, Eqs. 12 to 18; arguments broadcast [rad]."""
    return _closure(lengths, *_crank_end(lengths, theta_a), theta_v)


def _crank_end(lengths: Lengths, theta_a: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return x and z of S1 [m]."""
    s1_x = lengths.l_m * portable.cos(lengths.gamma) - lengths.l_1 * portable.sin(theta_a)
    s1_z = lengths.l_m * portable.sin(lengths.gamma) + lengths.l_1 * portable.cos(theta_a)
    return s1_x, s1_z


def _ring_end(lengths: Lengths, theta_v: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return x, y and z of S2 [m]; the ring's arm is at φ − θ_b, tan θ_b = −l_4 cos θ_v / l_3."""
    arm = lengths.l_4 * portable.cos(theta_v)
    scale = lengths.l_3 / np.sqrt(lengths.l_3**2 + arm**2)
    sine, cosine = portable.sin(lengths.phi), portable.cos(lengths.phi)
    s2_x = scale * (lengths.l_3 * sine + arm * cosine)
    return s2_x, lengths.l_4 * (portable.sin(theta_v) - 1.0), scale * (lengths.l_3 * cosine - arm * sine)


def _closure(lengths: Lengths, s1_x: FloatArray, s1_z: FloatArray, theta_v: FloatArray) -> FloatArray:
    """Return the closure [m²] with S1 given."""
    x, y, z = _ring_end(lengths, theta_v)
    return np.asarray((x - s1_x) ** 2 + y**2 + (z - s1_z) ** 2 - lengths.l_2 * lengths.l_2)


def sense(lengths: Lengths) -> float:
    """Return the sign of the slope of the closure over θ_v in the assembly taken, ±1.

    Of the two assemblies this is the one with the larger sin θ_v, as seen with the end of the crank on the
    pivot's side of the ring's arm. The slope keeps its sign until the assemblies merge, so that one motion
    never mixes them, and changes it with x → −x, as it must. Derived in the theory manual.
    """
    return 1.0 if portable.cos(lengths.gamma + lengths.phi) >= 0.0 else -1.0


def ideal_vane_angle(lengths: Lengths, theta_a: FloatArray) -> FloatArray:
    """Return θ_v [rad] of the assembly that :func:`sense` gives; NaN where the loop cannot close.

    ``theta_a``: crank angles [rad], shape (n,).
    """
    sign, s1 = sense(lengths), _crank_end(lengths, theta_a)
    low, high = _brackets(lengths, sign, s1)
    for _ in range(_BISECTIONS):
        middle = 0.5 * (low + high)
        above = sign * _closure(lengths, *s1, middle) > 0.0
        high = np.where(above, middle, high)
        low = np.where(above, low, middle)
    return np.asarray(0.5 * (low + high))


# Asked for the same snapshots of every case of a sweep.
@lru_cache(maxsize=64)
def ideal_at(lengths: Lengths, theta_a: tuple[float, ...]) -> tuple[float, ...]:
    """Return θ_v [rad] at crank angles [rad], see :func:`ideal_vane_angle`."""
    return tuple(ideal_vane_angle(lengths, np.array(theta_a)).tolist())


def _brackets(lengths: Lengths, sign: float, s1: tuple[FloatArray, FloatArray]) -> FloatArray:
    """Return between which θ_v [rad] of a scan the closure rises through zero, shape (2, n), or NaN."""
    scan = np.linspace(-math.pi / 2.0, 3.0 * math.pi / 2.0, _SCAN)
    x, y, z = _ring_end(lengths, scan)
    own, weight = x**2 + y**2 + z**2 - lengths.l_2 * lengths.l_2, portable.sin(0.5 * (scan[:-1] + scan[1:]))
    found = []
    # In blocks whose arrays stay in the cache of the processor.
    for block in np.array_split(np.column_stack(s1), s1[0].size // _BLOCK + 1):
        s1_x, s1_z = block[:, :1], block[:, 1:]
        above = sign * (own + (s1_x**2 + s1_z**2) - 2.0 * (s1_x * x + s1_z * z)) > 0.0
        crossing = ~above[:, :-1] & above[:, 1:]
        first = np.argmax(np.where(crossing, weight, -math.inf), axis=1)
        found.append(np.where(crossing.any(axis=1), [scan[first], scan[first + 1]], np.nan))
    return np.concatenate(found, axis=1)


def reachable(lengths: Lengths, first: float, last: float) -> tuple[float, float] | None:
    """Return the first and last crank angle [rad] around the given range where the loop closes.

    None where it closes nowhere in a full turn around it.
    """
    middle = 0.5 * (first + last)
    angles = np.linspace(middle - math.pi, middle + math.pi, 2881)
    closes = np.isfinite(ideal_vane_angle(lengths, angles))
    if not closes.any():
        return None
    nearest = int(np.argmin(np.where(closes, np.abs(angles - middle), np.inf)))
    breaks = np.flatnonzero(~closes)
    low = breaks[breaks < nearest].max(initial=-1) + 1
    high = breaks[breaks > nearest].min(initial=angles.size) - 1
    return float(angles[low]), float(angles[high])


# Asked for every case of a sweep, most of which share lengths and drive.
@lru_cache(maxsize=64)
def check_reach(lengths: Lengths, first: float, last: float) -> None:
    """Refuse a drive that takes the crank beyond its reach.

    ``first``, ``last``: smallest and largest crank angle of the drive [rad]. Raises InputError if the loop
    does not close all the way.
    """
    if np.isfinite(ideal_vane_angle(lengths, np.linspace(first, last, 721))).all():
        return
    limits = reachable(lengths, first, last)
    if limits is None:
        reason = "with these lengths the mechanism cannot be assembled at any crank angle"
    else:
        low, high = (math.degrees(angle) for angle in limits)
        reason = (
            f"the crank would turn from {math.degrees(first):.4g}° to {math.degrees(last):.4g}°, "
            f"but the mechanism reaches only from {low:.4g}° to {high:.4g}°"
        )
    raise InputError(reason, key="drive.start_angle")


# Asked for every cycle of a wear campaign.
@lru_cache(maxsize=64)
def ideal_table(lengths: Lengths, first: float, last: float) -> tuple[float, float, FloatArray]:
    """Return first angle, nodes per radian and (θ_v, step dθ_v/dθ_a), shape (n, 2), over a crank range."""
    check_reach(lengths, first, last)
    angles = np.linspace(first, last, N_IDEAL + 1)
    theta_v = np.unwrap(ideal_vane_angle(lengths, angles))
    step = (last - first) / N_IDEAL
    slope = spline(angles, theta_v).derivative(angles)
    return first, 1.0 / step, np.column_stack([theta_v, step * slope])


def crank_lever(lengths: Lengths, theta_a: FloatArray) -> FloatArray:
    """Return S1S2 · ∂S1/∂θ_a [m²] of the ideal mechanism: zero where the crank can move without the vane."""
    theta_b = portable.atan2(-lengths.l_4 * portable.cos(ideal_vane_angle(lengths, theta_a)), lengths.l_3)
    d_x = lengths.l_3 * portable.sin(lengths.phi - theta_b) - lengths.l_m * portable.cos(lengths.gamma)
    d_z = lengths.l_3 * portable.cos(lengths.phi - theta_b) - lengths.l_m * portable.sin(lengths.gamma)
    # From the pivot instead of S1: the crank itself is across its own derivative.
    return np.asarray(-lengths.l_1 * (d_x * portable.cos(theta_a) + d_z * portable.sin(theta_a)))


@lru_cache(maxsize=64)
def dead_centres(lengths: Lengths, first: float, last: float) -> tuple[float, ...]:
    """Return the crank angles [rad] inside a crank range at which the vane of the ideal mechanism turns back.

    ``lengths``: the mechanism, which reaches all of the range; ``first``, ``last``: smallest and largest
    crank angle [rad].
    """
    angles = np.linspace(first, last, N_IDEAL + 1)
    forward = crank_lever(lengths, angles) > 0.0
    turns = np.flatnonzero(forward[1:] != forward[:-1])

    def lever(angle: float) -> float:
        return float(crank_lever(lengths, np.array([angle]))[0])

    return tuple(bisected(lever, float(angles[k]), float(angles[k + 1]), 1e-12) for k in turns)


def at_limit(mechanism: Record, theta_a: float, y: FloatArray) -> bool:
    """Tell whether the assemblies meet, or nearly, with the trunnion where it is: beyond, nothing closes.

    ``theta_a``, ``y``: crank angle [rad] and state, shape (8,).
    """
    s1 = crank_end(mechanism, theta_a)
    place = (float(y[0]), float(y[1]), portable.tan(y[2]), portable.tan(y[3]))
    turn = np.linspace(0.0, 2.0 * math.pi, 2 * _SCAN)
    sines, cosines = portable.sin(turn), portable.cos(turn)
    missing = [
        closure_residual(mechanism, *s1, *place, sine, cosine)[0]
        for sine, cosine in zip(sines, cosines, strict=True)
    ]
    return bool(-min(missing) < _MEETING * max(missing))
