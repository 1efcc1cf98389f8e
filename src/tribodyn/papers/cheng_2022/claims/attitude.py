"""Claims on the vane and on the motion of the trunnion at 20 µm: sections 5.1 and 5.2, Figs. 11, 13, 14."""

from collections.abc import Callable, Mapping
from functools import partial
from typing import Final

import numpy as np
import xarray as xr

from mebdf.arrays import FloatArray
from tribodyn.papers.cheng_2022.claims.base import (
    FIRST,
    REVIEWED,
    VARIED,
    Claim,
    Domain,
    Finding,
    Trial,
    above,
    below,
    listed,
    weights,
)
from tribodyn.papers.cheng_2022.clearance import HARDEST, windows
from tribodyn.papers.cheng_2022.runs import forward, smooth
from tribodyn.papers.cheng_2022.trunnion import CENTRES, centre, centre_velocity

_RANGE: Final = (60.0, 120.0)  #: Range of the vane in the paper [deg].
_NO_LOADS: Final[Mapping[str, object]] = {
    "loads.air_force_x": "0 N",
    "loads.air_force_y": "0 N",
    "loads.air_moment": "0 N m",
    "run.start": "equilibrium",
}
#: Times after a reversal over which velocities are compared [s]: the paper names none.
WINDOWS: Final = (5e-3, 20e-3, HARDEST)


def vane_range(trial: Trial) -> Finding:
    """Measure the distance of the ends of the vane's range from the paper's."""
    angle = np.degrees(trial.vsv()["theta_v_ideal"].values)
    ends = (float(angle.min()), float(angle.max()))
    off = max(abs(ours - theirs) for ours, theirs in zip(ends, _RANGE, strict=True))
    return Finding(f"{ends[0]:.1f}° to {ends[1]:.1f}°", off)


def motion_in_x(trial: Trial) -> Finding:
    """Measure the mean range of the three centres along X over that along Y."""
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


def phi_x_positive(trial: Trial, domain: Domain) -> Finding:
    """Measure the least φ_x."""
    least = 1e3 * float(trial.part(domain)["phi_x"].values.min())
    return Finding(f"at least {least:.3g} mrad", least)


def phi_y_alternates(trial: Trial) -> Finding:
    """Measure the largest φ_y to the side that it reaches less."""
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


def _velocities(
    trial: Trial, axis: int, domain: Domain, window: float, more: Mapping[str, object] | None = None
) -> tuple[list[FloatArray], FloatArray]:
    """Return velocities of top, middle and bottom [mm/s], and the weight of each sample [s]."""
    run = trial.vsv(more=more)
    parts = [smooth(run)] if domain == "smooth motion" else windows(run, window)
    weight = np.concatenate([weights(part["time"].values) for part in parts])
    return [
        np.concatenate([centre_velocity(part, height)[axis] for part in parts]) for _, height, *_ in CENTRES
    ], weight


def _mean(values: FloatArray, weight: FloatArray) -> float:
    return float(np.average(values, weights=weight))


def _apart(trial: Trial, axis: int, window: float, more: Mapping[str, object] | None = None) -> float:
    (top, middle, bottom), weight = _velocities(trial, axis, "impacts", window, more)
    return float(100.0 * np.sqrt(_mean((top - bottom) ** 2, weight) / _mean(middle**2, weight)))


def x_velocities_agree(trial: Trial) -> Finding:
    """Measure the difference of top and bottom X velocity over that of the middle, at most."""
    return _over_windows(trial, 0, max)


def x_velocities_by_adjustment(trial: Trial) -> Finding:
    """Measure the difference of top and bottom X velocity over that of the middle, at most, without loads."""
    return _over_windows(trial, 0, max, _NO_LOADS)


def y_velocities_differ(trial: Trial) -> Finding:
    """Measure the difference of top and bottom Y velocity over that of the middle, at least."""
    return _over_windows(trial, 1, min)


def _over_windows(
    trial: Trial, axis: int, worst: Callable[[FloatArray], float], more: Mapping[str, object] | None = None
) -> Finding:
    shares = np.array([_apart(trial, axis, window, more) for window in WINDOWS])
    times = ", ".join(f"{window * 1e3:g}" for window in WINDOWS)
    return Finding(f"{listed(shares, '%')} root mean square in {times} ms", float(worst(shares)))


def y_velocities_opposite(trial: Trial, domain: Domain) -> Finding:
    """Measure the correlation of the Y velocities of top and bottom, −1 where they are opposite."""
    (top, _, bottom), weight = _velocities(trial, 1, domain, HARDEST)
    alike = _mean(top * bottom, weight) / np.sqrt(_mean(top**2, weight) * _mean(bottom**2, weight))
    return Finding(f"correlation {alike:+.2f}", float(alike))


_LEVER: Final = (
    "the lever moment that the paper's printed rows leave out tilts the trunnion about Y and presses its two "
    "ends on opposite sides"
)
_CROSSES: Final = "the trunnion crosses its clearance as a whole; it rocks only by what its ends differ"

#: Claims on motion.
CLAIMS: Final = (
    Claim(
        "vane range", ("V1",), "the vane turns from 60° to 120°", "whole",
        below(1.5, "° off", partly=3.0, since=FIRST), vane_range,
    ),
    Claim(
        "motion along X", ("T1", "T3"), "the centres deviate more along X than along Y", "smooth motion",
        above(1.0, "times", by="the paper"), motion_in_x,
    ),
    Claim(
        "tilt exists", ("T2",), "a tilt angle always exists in the whole movement", "whole",
        above(10.0, "% of the mean", partly=0.0), tilt_exists,
        "with the lever moment φ_y changes its sign at each reversal, and the tilt passes by zero",
        margin=True,
    ),
    Claim(
        "velocities jump", ("T4",), "velocities rise suddenly at reversals and are small otherwise",
        "impacts", above(10.0, "times", partly=2.0, since=FIRST), velocities_jump,
    ),
    Claim(
        "X velocities agree", ("T5",),
        "the X velocities of the three centres are approximate in value and consistent in direction",
        "impacts", below(25.0, "%", partly=50.0), x_velocities_agree, _LEVER,
    ),
    Claim(
        "X velocities by adjustment", ("T5",),
        "they agree because of the adjustment: without any load of the flow they agree, too", "impacts",
        below(25.0, "%", partly=50.0, since=VARIED), x_velocities_by_adjustment, _LEVER,
    ),
    Claim(
        "Y velocities differ", ("T6",), "the Y velocities of the three centres differ obviously",
        "impacts", above(25.0, "%", partly=10.0), y_velocities_differ, "it depends on the window",
        margin=True,
    ),
    Claim(
        "Y velocities opposite, impacts", ("T6",), "the Y velocities of top and bottom are opposite",
        "impacts", below(0.0, by="the paper"), partial(y_velocities_opposite, domain="impacts"), _CROSSES,
        margin=True,
    ),
    Claim(
        "Y velocities opposite, smooth motion", ("T6",), "the Y velocities of top and bottom are opposite",
        "smooth motion", below(0.0, by="the paper", since=REVIEWED),
        partial(y_velocities_opposite, domain="smooth motion"), _CROSSES, margin=True,
    ),
    Claim(
        "φ_x positive", ("D4",), "φ_x is always positive", "smooth motion",
        above(0.0, "mrad", by="the paper"), partial(phi_x_positive, domain="smooth motion"), margin=True,
    ),
    Claim(
        "φ_x positive, whole", ("D4",), "φ_x is always positive", "whole",
        above(0.0, "mrad", by="the paper", since=REVIEWED), partial(phi_x_positive, domain="whole"),
        "in the impacts the trunnion rocks", margin=True,
    ),
    Claim(
        "φ_y alternates", ("D4",), "φ_y is alternating positive and negative", "smooth motion",
        above(0.0, "mrad to either side", by="the paper"), phi_y_alternates,
    ),
)  # fmt: skip
