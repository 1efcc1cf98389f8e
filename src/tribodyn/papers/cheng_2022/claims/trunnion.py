"""Claims on the vane, the forces and the attitude of the trunnion at 20 µm: sections 5.1 and 5.2."""

from __future__ import annotations

from typing import Final

import numpy as np
import xarray as xr

from tribodyn.core.arrays import FloatArray
from tribodyn.papers.cheng_2022.claims.base import Claim, Finding, share, truth
from tribodyn.papers.cheng_2022.runs import Runs, forward, smooth
from tribodyn.papers.cheng_2022.trunnion import CENTRES, CLEARANCE, centre, centre_velocity

_ZONE: Final = 0.05
"""Contact is where the pressure exceeds this share of its peak."""
_NEAR: Final = 15.0
"""Angles read off a figure are the same within this [deg]."""


def _run(runs: Runs, formulation: str, friction: float | None) -> xr.Dataset:
    changes = {} if friction is None else {"joint.friction_coefficient": friction}
    return runs.vsv(formulation, CLEARANCE, changes)


def vane_range(runs: Runs, formulation: str, friction: float | None) -> Finding:
    """Measure the range of the vane angle."""
    angle = np.degrees(_run(runs, formulation, friction)["theta_v_ideal"].values)
    low, high = float(angle.min()), float(angle.max())
    return truth(abs(low - 60.0) < 1.5 and abs(high - 120.0) < 1.5, f"{low:.1f}° to {high:.1f}°")


def sign_of_f_cx(runs: Runs, formulation: str, friction: float | None) -> Finding:
    """Measure how long F_cx has one sign forward and the other in reverse."""
    run = smooth(_run(runs, formulation, friction))
    agrees = (run["F_cx"].values > 0.0) == forward(run)
    return share(float(max(agrees.mean(), 1.0 - agrees.mean())), "one sign forward, the other in reverse")


def sign_of_f_cy(runs: Runs, formulation: str, friction: float | None) -> Finding:
    """Measure how long F_cy is negative."""
    run = smooth(_run(runs, formulation, friction))
    return share(float(np.mean(run["F_cy"].values < 0.0)), "negative")


def x_over_y(runs: Runs, formulation: str, friction: float | None) -> Finding:
    """Measure how long |F_cx| exceeds |F_cy|."""
    run = smooth(_run(runs, formulation, friction))
    return share(float(np.mean(np.abs(run["F_cx"].values) > np.abs(run["F_cy"].values))), "larger")


def rigid_dominates(runs: Runs, formulation: str, friction: float | None) -> Finding:
    """Measure how long the rigid part is larger than the damping part."""
    run = smooth(_run(runs, formulation, friction))
    rigid, damping = (np.hypot(run[f"F_{part}x"].values, run[f"F_{part}y"].values) for part in "kd")
    return share(float(np.mean(rigid > damping)), "rigid part larger")


def motion_in_x(runs: Runs, formulation: str, friction: float | None) -> Finding:
    """Measure how far the three centres go along X and along Y."""
    run = smooth(_run(runs, formulation, friction))
    paths = [centre(run, height) for _, height, *_ in CENTRES]
    along = [float(np.mean([np.ptp(path[axis]) for path in paths])) for axis in (0, 1)]
    return truth(
        along[0] > 1.5 * along[1],
        f"{along[0]:.3g} µm along X, {along[1]:.3g} µm along Y",
        partly=along[0] > along[1],
    )


def phi_x_positive(runs: Runs, formulation: str, friction: float | None) -> Finding:
    """Measure how long φ_x is positive."""
    run = smooth(_run(runs, formulation, friction))
    return share(float(np.mean(run["phi_x"].values > 0.0)), "positive")


def phi_y_alternates(runs: Runs, formulation: str, friction: float | None) -> Finding:
    """Measure the range of φ_y in each direction of motion."""
    run = smooth(_run(runs, formulation, friction))
    phi, ahead = run["phi_y"].values * 1e3, forward(run)
    ranges = [(phi[way].min(), phi[way].max()) for way in (ahead, ~ahead)]
    text = "; ".join(
        f"{low:+.2f} to {high:+.2f} mrad {way}"
        for (low, high), way in zip(ranges, ("forward", "in reverse"), strict=True)
    )
    both = bool(phi.min() < 0.0 < phi.max())
    return truth(all(low < 0.0 < high for low, high in ranges), text, partly=both)


def jumps_at_reversals(runs: Runs, formulation: str, friction: float | None) -> Finding:
    """Measure the largest speed of the centres near reversals and elsewhere."""
    whole = _run(runs, formulation, friction)
    quiet = smooth(whole)
    fast, slow = (
        max(float(np.abs(centre_velocity(run, height)[0]).max()) for _, height, *_ in CENTRES)
        for run in (whole, quiet)
    )
    return truth(fast > 10.0 * slow, f"{fast:.3g} mm/s after reversals, {slow:.3g} mm/s elsewhere")


def zone(run: xr.Dataset, direction: float) -> FloatArray:
    """Return the angles [deg] in contact in the pictures of one direction, pressure above 5 % of its peak."""
    pictures = run["pressure"].values[run["snapshot_direction"].values == direction]
    touched = [(one > _ZONE * one.max()).any(axis=1) for one in pictures]
    angle = np.degrees(run["theta"].values)
    return np.concatenate([angle[where] for where in touched])


def _between(
    runs: Runs, formulation: str, friction: float | None, way: float, ends: tuple[float, float]
) -> Finding:
    run = _run(runs, formulation, friction)
    middle = 0.5 * (ends[0] + ends[1])
    angles = (zone(run, way) - middle + 180.0) % 360.0 - 180.0 + middle
    first, last = float(angles.min()), float(angles.max())
    off = max(abs(first - ends[0]), abs(last - ends[1]))
    text = f"{first % 360.0:.0f}° to {last % 360.0:.0f}°"
    return truth(off <= _NEAR, text, partly=off <= 2.0 * _NEAR)


def zone_forward(runs: Runs, formulation: str, friction: float | None) -> Finding:
    """Measure where contact is in forward motion."""
    return _between(runs, formulation, friction, 1.0, (-60.0, 45.0))


def zone_reverse(runs: Runs, formulation: str, friction: float | None) -> Finding:
    """Measure where contact is in reverse motion."""
    return _between(runs, formulation, friction, -1.0, (135.0, 225.0))


def at_the_edges(runs: Runs, formulation: str, friction: float | None) -> Finding:
    """Measure the pressure in the middle half of the bushing against that at the edges."""
    run = _run(runs, formulation, friction)
    pressure, z = run["pressure"].values, run["z"].values
    inner = float(pressure[:, :, np.abs(z) < 0.25 * np.ptp(z)].max() / pressure.max())
    return truth(inner < _ZONE, f"the middle half carries up to {100.0 * inner:.2g} % of the peak pressure")


_LEVER: Final = (
    "the lever moment that the paper's printed rows leave out tilts the trunnion about Y and presses its two "
    "ends on opposite sides"
)

CLAIMS: Final = (
    Claim("vane range", "5.1, Fig. 11", "the vane turns from 60° to 120°", vane_range),
    Claim("F_cx changes sign", "5.2, Fig. 12", "F_cx changes its sign with the direction", sign_of_f_cx),
    Claim(
        "F_cy negative", "5.2, Fig. 12", "F_cy is almost always negative", sign_of_f_cy,
        "it is positive for some tenths of a second after each reversal to forward motion",
    ),
    Claim("F_cx larger", "5.2, Fig. 12", "F_cx is always larger than F_cy", x_over_y),
    Claim("rigid dominates", "5.2, Fig. 12", "the rigid forces are dominant", rigid_dominates),
    Claim("motion along X", "5.2, Fig. 13", "the centres move more along X than along Y", motion_in_x),
    Claim("φ_x positive", "5.2, Fig. 18", "φ_x is always positive", phi_x_positive),
    Claim(
        "φ_y alternates", "5.3, Fig. 18", "φ_y alternates between positive and negative",
        phi_y_alternates, _LEVER,
    ),
    Claim(
        "velocities jump", "5.2, Fig. 14", "velocities rise suddenly at reversals and are small otherwise",
        jumps_at_reversals,
    ),
    Claim("zone forward", "5.2, Fig. 15", "forward contact lies at 300° to 45°", zone_forward, _LEVER),
    Claim("zone reverse", "5.2, Fig. 15", "reverse contact lies at 135° to 225°", zone_reverse, _LEVER),
    Claim("contact at the edges", "5.2, Fig. 15", "contact is concentrated at the edges", at_the_edges),
)  # fmt: skip
"""Claims at the paper's first clearance."""
