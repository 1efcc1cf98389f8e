"""Claims on the forces at the trunnion at 20 µm: section 5.2, Fig. 12, and what causes them."""

from collections.abc import Mapping
from functools import partial
from typing import Final

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from mebdf.arrays import FloatArray
from tribodyn.papers.cheng_2022.claims.base import (
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
from tribodyn.papers.cheng_2022.clearance import damping_along_rigid, peaks, windows
from tribodyn.papers.cheng_2022.runs import forward, is_smooth, smooth

_STEP: Final = 5e-3  #: Time between the instants at which two cycles are compared [s].
_TOUCH: Final = 1e-3  #: Contact forces below this are none [N].


def size(run: xr.Dataset, part: str) -> FloatArray:
    """Return the size of the contact (``c``), rigid (``k``) or damping (``d``) force [N]."""
    return np.asarray(np.hypot(run[f"F_{part}x"].values, run[f"F_{part}y"].values))


def periodic(trial: Trial) -> Finding:
    """Measure the difference of the forces of two cycles over their size, root mean square."""
    run = trial.vsv()
    period, time = float(run.attrs["cycle_period"]), run["time"].values
    first = np.arange(0.0, period, _STEP)
    first = first[is_smooth(run, first)]
    apart, whole = 0.0, 0.0
    for axis in "xy":
        force = run[f"F_c{axis}"].values
        one, two = np.interp(first, time, force), np.interp(first + period, time, force)
        apart, whole = apart + float(np.mean((one - two) ** 2)), whole + float(np.mean(one**2))
    value = 100.0 * float(np.sqrt(apart / whole))
    return Finding(f"the two cycles differ by {value:.2g} %, root mean square", value)


def sign_of_f_cx(trial: Trial) -> Finding:
    """Measure the least F_cx along the sign that it has in its direction."""
    run = smooth(trial.vsv())
    ahead = np.where(forward(run), 1.0, -1.0) * run["F_cx"].values
    way = 1.0 if ahead.mean() > 0.0 else -1.0
    least = float((way * ahead).min())
    return Finding(f"at least {least:.3g} N", least)


def sign_of_f_cy(trial: Trial, domain: Domain) -> Finding:
    """Measure the share of the time in which F_cy is negative."""
    run = trial.part(domain)
    share = time_share(run, run["F_cy"].values < 0.0)
    return Finding(f"negative in {share:.3g} %", share)


def time_share(run: xr.Dataset, holds: NDArray[np.bool_]) -> float:
    """Return the share of the time of a run in which something holds [%]."""
    weight = weights(run["time"].values)
    return float(100.0 * weight[holds].sum() / weight.sum())


def x_over_y(trial: Trial, domain: Domain) -> Finding:
    """Measure the least |F_cx| over |F_cy|, where there is contact."""
    run = trial.part(domain)
    x, y = (np.abs(run[f"F_c{axis}"].values) for axis in "xy")
    least = _least_ratio(x, y)
    return Finding(f"at least {least:.3g} times", least)


def _least_ratio(above: FloatArray, below: FloatArray) -> float:
    """Return the least ratio of two sizes of forces [N], where there is contact."""
    touching = above + below > _TOUCH
    return float(1.0 / np.max(below[touching] / np.maximum(above[touching], 1e-9)))


def rigid_dominates(trial: Trial, domain: Domain) -> Finding:
    """Measure the least rigid force over the damping force, where there is contact."""
    run = trial.part(domain)
    least = _least_ratio(size(run, "k"), size(run, "d"))
    return Finding(f"at least {least:.3g} times the damping force", least)


def separates(trial: Trial) -> Finding:
    """Measure the least contact force after each reversal over the mean of smooth motion."""
    run = trial.vsv()
    mean = float(size(smooth(run), "c").mean())
    least = [100.0 * float(size(rows, "c").min()) / mean for rows in windows(run)]
    return Finding(f"falls to {listed(np.array(least), '%')} of the mean at the reversals", max(least))


def sides_change(trial: Trial) -> Finding:
    """Measure the angle between the mean contact forces of both directions."""
    run = smooth(trial.vsv())
    ahead = forward(run)
    there, back = (
        np.array([run[f"F_c{axis}"].values[way].mean() for axis in "xy"]) for way in (ahead, ~ahead)
    )
    angle = float(np.degrees(np.arccos(there @ back / (np.hypot(*there) * np.hypot(*back)))))
    return Finding(f"{angle:.3g}° apart", angle)


def stable_at_reversals(trial: Trial) -> Finding:
    """Measure the largest contact force of the impacts over the mean of smooth motion."""
    run = trial.vsv()
    force, rigid, damping = (float(peaks(run, part).max()) for part in "ckd")
    mean = float(size(smooth(run), "c").mean())
    text = f"{force:.3g} N (rigid {rigid:.3g}, damping {damping:.3g}) against {mean:.3g} N in smooth motion"
    return Finding(text, force / mean)


def damping_changes_sign(trial: Trial) -> Finding:
    """Measure the damping force on separation over that on approach, the least of all reversals."""
    extremes = damping_along_rigid(trial.vsv())
    text = ", ".join(f"{most:+.3g} and {least:+.3g}" for most, least in extremes)
    return Finding(f"{text} N at the reversals", float(min(-least / most for most, least in extremes)))


_ALWAYS: Final = "in the impacts the force takes every direction"

#: Claims on forces.
CLAIMS: Final = (
    Claim(
        "forces periodic", ("F1",), "F_cx and F_cy are periodic during the two cycles", "smooth motion",
        below(5.0, "%", partly=20.0), periodic,
    ),
    Claim(
        "F_cx changes sign", ("F1",), "F_cx changes its sign with the direction", "smooth motion",
        above(0.0, "N", by="the paper"), sign_of_f_cx,
    ),
    Claim(
        "F_cy negative", ("F1",), "F_cy is almost always negative", "smooth motion",
        above(95.0, "%", partly=50.0, origin=100.0), partial(sign_of_f_cy, domain="smooth motion"),
        "it is positive for some tenths of a second after each reversal to forward motion", margin=True,
    ),
    Claim(
        "F_cy negative, whole", ("F1",), "F_cy is almost always negative", "whole",
        above(95.0, "%", partly=50.0, origin=100.0, since=REVIEWED), partial(sign_of_f_cy, domain="whole"),
        "it is positive for some tenths of a second after each reversal to forward motion", margin=True,
    ),
    Claim(
        "F_cx larger", ("F2",), "F_cx is always larger than F_cy", "smooth motion",
        above(1.0, "times", by="the paper"), partial(x_over_y, domain="smooth motion"), margin=True,
    ),
    Claim(
        "F_cx larger, whole", ("F2",), "F_cx is always larger than F_cy", "whole",
        above(1.0, "times", by="the paper", since=REVIEWED), partial(x_over_y, domain="whole"), _ALWAYS,
        margin=True,
    ),
    Claim(
        "rigid dominates", ("F3",), "the rigid forces are dominant", "smooth motion",
        above(1.0, "times", by="the paper"), partial(rigid_dominates, domain="smooth motion"),
    ),
    Claim(
        "rigid dominates, whole", ("F3",), "the rigid forces are dominant", "whole",
        above(1.0, "times", by="the paper", since=REVIEWED), partial(rigid_dominates, domain="whole"),
        "at first touch nearly all of the force is damping",
    ),
    Claim(
        "stable at reversals", ("F5", "K4"),
        "rigid and damping forces compensate each other at reversals, so that the contact forces are stable",
        "impacts", below(2.0, "times", partly=5.0), stable_at_reversals,
        "damping adds to the rigid force on approach and takes from it on separation only",
    ),
    Claim(
        "surfaces separate", ("C6",), "at a reversal the surfaces separate and collide again", "impacts",
        below(1.0, "% of the mean", partly=10.0, since=REVIEWED), separates,
    ),
    Claim(
        "contact changes sides", ("C6",), "the contact area changes with the direction", "smooth motion",
        above(90.0, "°", partly=30.0, origin=180.0, since=VARIED), sides_change,
    ),
    Claim(
        "damping changes sign", ("C13", "C14"),
        "in the collision damping turns from positive to negative as the surfaces separate", "impacts",
        above(0.1, "times"), damping_changes_sign,
    ),
)  # fmt: skip


_NO_F_AIRY: Final[Mapping[str, object]] = {"loads.air_force_y": "0 N"}
NO_M_AIR: Final[Mapping[str, object]] = {"loads.air_moment": "0 N m", "run.start": "equilibrium"}
#: An effect that is less than half without a load is caused by it.
CAUSE: Final = below(0.5, "times", partly=0.9, since=REVIEWED)


def f_cy_by_f_airy(trial: Trial) -> Finding:
    """Measure the mean F_cy without F_airy over that with it."""
    return _mean_without(trial, "F_cy", "N", 1.0)


def phi_x_by_f_airy(trial: Trial) -> Finding:
    """Measure the mean φ_x without F_airy over that with it."""
    return _mean_without(trial, "phi_x", "mrad", 1e3)


def _mean_without(trial: Trial, name: str, unit: str, scale: float) -> Finding:
    loaded, free = (
        scale * float(trial.part("smooth motion", more)[name].mean()) for more in ({}, _NO_F_AIRY)
    )
    return Finding(f"{loaded:.3g} {unit} with F_airy, {free:.3g} {unit} without", abs(free / loaded))


def impact_by_m_air(trial: Trial) -> Finding:
    """Measure the largest contact force after the reversals without M_air over that with it."""
    loaded, free = (
        max(float(size(rows, "c").max()) for rows in windows(trial.vsv(more=more))) for more in ({}, NO_M_AIR)
    )
    return Finding(f"{loaded:.3g} N with M_air, {free:.3g} N without", free / loaded)


def rises_in_collision(trial: Trial) -> Finding:
    """Measure the largest rigid or damping force of the impacts over that of smooth motion."""
    run = trial.vsv()
    quiet = smooth(run)
    ratios = [
        max(float(size(rows, part).max()) for rows in windows(run)) / float(size(quiet, part).max())
        for part in "kd"
    ]
    return Finding(f"rigid {ratios[0]:.3g} times, damping {ratios[1]:.3g} times", min(ratios))


def phi_y_by_adjustment(trial: Trial) -> Finding:
    """Measure the time with the sign of φ_y that of the direction, less that with the sign of F_airx."""
    run = smooth(trial.vsv())
    positive = run["phi_y"].values > 0.0
    causes = (forward(run), run["F_airx"].values > 0.0)
    shares = [max(alike, 100.0 - alike) for alike in (time_share(run, positive == cause) for cause in causes)]
    text = f"by the direction in {shares[0]:.3g} % of the time, by the sign of F_airx in {shares[1]:.3g} %"
    return Finding(text, shares[0] - shares[1])


#: Claims on causes.
CAUSE_CLAIMS: Final = (
    Claim(
        "F_cy by F_airy", ("F1",), "F_cy is negative due to the effect of F_airy", "smooth motion",
        CAUSE, f_cy_by_f_airy,
    ),
    Claim(
        "tilt by F_airy", ("T2", "T3", "T6", "D4"), "F_airy makes the trunnion deflect around the X-axis",
        "smooth motion", CAUSE, phi_x_by_f_airy,
    ),
    Claim(
        "impact by M_air", ("F4",), "the reversal of M_air causes the fluctuation of the forces", "impacts",
        CAUSE, impact_by_m_air,
    ),
    Claim(
        "forces rise in the collision", ("C7", "C11"),
        "damping and rigid forces increase suddenly in the collision", "impacts",
        above(2.0, "times", partly=1.0, since=REVIEWED), rises_in_collision,
    ),
    Claim(
        "φ_y by adjustment", ("D4",), "φ_y alternates, which is the effect of mechanism adjustment",
        "smooth motion", above(0.0, "points", by="the paper", since=REVIEWED), phi_y_by_adjustment,
        "without the lever moment φ_y follows F_airx, which changes its sign at θ_v = 90°",
    ),
)  # fmt: skip
