"""Claims on the vane and on the motion of the trunnion at 20 µm: sections 5.1 and 5.2, Figs. 11, 13, 14."""

from __future__ import annotations

from typing import Final

import numpy as np
import xarray as xr

from tribodyn.core.arrays import FloatArray
from tribodyn.papers.cheng_2022.claims.base import Claim, Finding, Trial
from tribodyn.papers.cheng_2022.claims.bounds import above, below
from tribodyn.papers.cheng_2022.impacts import windows
from tribodyn.papers.cheng_2022.runs import forward, smooth
from tribodyn.papers.cheng_2022.trunnion import CENTRES, centre, centre_velocity

_RANGE: Final = (60.0, 120.0)
"""Range of the vane in the paper [deg]."""


def vane_range(trial: Trial) -> Finding:
    """Measure how far the ends of the vane's range are from the paper's."""
    angle = np.degrees(trial.vsv()["theta_v_ideal"].values)
    ends = (float(angle.min()), float(angle.max()))
    off = max(abs(ours - theirs) for ours, theirs in zip(ends, _RANGE, strict=True))
    return Finding(f"{ends[0]:.1f}° to {ends[1]:.1f}°", off)


def motion_in_x(trial: Trial) -> Finding:
    """Measure how much further the three centres go along X than along Y."""
    run = smooth(trial.vsv())
    paths = [centre(run, height) for _, height, *_ in CENTRES]
    x, y = (float(np.mean([np.ptp(path[axis]) for path in paths])) for axis in (0, 1))
    return Finding(f"{x:.3g} µm along X, {y:.3g} µm along Y", x / y)


def tilt_exists(trial: Trial) -> Finding:
    """Measure the least tilt from the first reversal on, impacts included, over the mean of smooth motion."""
    run = trial.vsv()
    moving = run.sel(time=run["time"].values > 0.5 * float(run.attrs["cycle_period"]))
    least, mean = float(tilt(moving).min()), float(tilt(smooth(run)).mean())
    text = f"{least:.2g} mrad at the least, {mean:.3g} mrad in the mean of smooth motion"
    return Finding(text, 100.0 * least / mean)


def tilt(run: xr.Dataset) -> FloatArray:
    """Return the size of the tilt [mrad]."""
    return np.asarray(1e3 * np.hypot(run["phi_x"].values, run["phi_y"].values))


def phi_x_positive(trial: Trial) -> Finding:
    """Measure the least φ_x in smooth motion."""
    least = 1e3 * float(smooth(trial.vsv())["phi_x"].values.min())
    return Finding(f"at least {least:.3g} mrad in smooth motion", least)


def phi_y_alternates(trial: Trial) -> Finding:
    """Measure the range of φ_y: how far the less reached sign is reached."""
    run = smooth(trial.vsv())
    phi, ahead = run["phi_y"].values * 1e3, forward(run)
    text = "; ".join(
        f"{phi[way].min():+.2f} to {phi[way].max():+.2f} mrad {name}"
        for way, name in ((ahead, "forward"), (~ahead, "in reverse"))
    )
    return Finding(text, float(min(-phi.min(), phi.max())))


def velocities_jump(trial: Trial) -> Finding:
    """Measure the largest speed of the centres in the impacts over that in smooth motion."""
    run = trial.vsv()
    fast = max(_fastest(rows) for rows in windows(run))
    slow = _fastest(smooth(run))
    return Finding(f"{fast:.3g} mm/s after reversals, {slow:.3g} mm/s in smooth motion", fast / slow)


def _fastest(run: xr.Dataset) -> float:
    return max(float(np.hypot(*centre_velocity(run, height)).max()) for _, height, *_ in CENTRES)


def _impact_velocities(trial: Trial, axis: int) -> tuple[list[FloatArray], FloatArray]:
    """Return velocities of top, middle and bottom in the impacts [mm/s], and the weight of each row [s]."""
    rows = windows(trial.vsv())
    weight = np.concatenate([np.gradient(part["time"].values) for part in rows])
    return [
        np.concatenate([centre_velocity(part, height)[axis] for part in rows]) for _, height, *_ in CENTRES
    ], weight


def _mean(values: FloatArray, weight: FloatArray) -> float:
    return float(np.average(values, weights=weight))


def apart(trial: Trial, axis: int) -> Finding:
    """Measure the difference of top and bottom velocity over that of the middle, root mean square."""
    (top, middle, bottom), weight = _impact_velocities(trial, axis)
    share = 100.0 * np.sqrt(_mean((top - bottom) ** 2, weight) / _mean(middle**2, weight))
    return Finding(f"top and bottom differ by {share:.3g} % of the middle, root mean square", float(share))


def x_velocities_agree(trial: Trial) -> Finding:
    """Measure how far apart the X velocities of top and bottom are in the impacts."""
    return apart(trial, 0)


def y_velocities_differ(trial: Trial) -> Finding:
    """Measure how far apart the Y velocities of top and bottom are in the impacts."""
    return apart(trial, 1)


def y_velocities_opposite(trial: Trial) -> Finding:
    """Measure the correlation of the Y velocities of top and bottom in the impacts."""
    (top, _, bottom), weight = _impact_velocities(trial, 1)
    alike = _mean(top * bottom, weight) / np.sqrt(_mean(top**2, weight) * _mean(bottom**2, weight))
    return Finding(f"they go together with a correlation of {alike:+.2f} (−1 is opposite)", float(alike))


_LEVER: Final = (
    "the lever moment that the paper's printed rows leave out tilts the trunnion about Y and presses its two "
    "ends on opposite sides"
)

CLAIMS: Final = (
    Claim(
        "vane range", "5.1, Fig. 11", "the vane turns from 60° to 120°",
        below(1.5, "° off", partly=3.0), vane_range,
    ),
    Claim(
        "motion along X", "5.2, Fig. 13", "the centres deviate more along X than along Y",
        above(1.0, "times", by="the paper"), motion_in_x,
    ),
    Claim(
        "tilt exists", "5.2, Fig. 13", "a tilt angle always exists in the whole movement",
        above(10.0, "% of the mean", partly=0.0), tilt_exists,
        "with the lever moment φ_y changes its sign at each reversal, and the tilt passes by zero",
    ),
    Claim(
        "velocities jump", "5.2, Fig. 14", "velocities rise suddenly at reversals and are small otherwise",
        above(10.0, "times", partly=2.0), velocities_jump,
    ),
    Claim(
        "X velocities agree", "5.2, Fig. 14 (a)",
        "the X velocities of the three centres are approximate in value and consistent in direction",
        below(25.0, "%", partly=50.0), x_velocities_agree, _LEVER,
    ),
    Claim(
        "Y velocities differ", "5.2, Fig. 14 (b)",
        "the Y velocities of the three centres differ obviously",
        above(25.0, "%", partly=10.0), y_velocities_differ,
    ),
    Claim(
        "Y velocities opposite", "5.2, Fig. 14 (b)",
        "the Y velocities of top and bottom are opposite",
        below(0.0, "", by="the paper"), y_velocities_opposite,
        "the trunnion crosses its clearance as a whole; it rocks only by what its ends differ",
    ),
    Claim(
        "φ_x positive", "5.3, Fig. 18", "φ_x is always positive",
        above(0.0, "mrad", by="the paper"), phi_x_positive,
    ),
    Claim(
        "φ_y alternates", "5.3, Fig. 18", "φ_y is alternating positive and negative",
        above(0.0, "mrad to either side", by="the paper"), phi_y_alternates,
    ),
)  # fmt: skip
"""Claims on motion."""
