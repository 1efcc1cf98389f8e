"""Claims on the forces at the trunnion at 20 µm: section 5.2, Fig. 12."""

from __future__ import annotations

from typing import Final

import numpy as np
import xarray as xr

from tribodyn.core.arrays import FloatArray
from tribodyn.papers.cheng_2022.claims.base import Claim, Finding, Trial
from tribodyn.papers.cheng_2022.claims.bounds import above, below
from tribodyn.papers.cheng_2022.impacts import damping_along_rigid, peaks
from tribodyn.papers.cheng_2022.runs import forward, is_smooth, smooth

_STEP: Final = 5e-3
"""Time between the instants at which two cycles are compared [s]."""


def size(run: xr.Dataset, part: str) -> FloatArray:
    """Return the size of the contact (``c``), rigid (``k``) or damping (``d``) force [N]."""
    return np.asarray(np.hypot(run[f"F_{part}x"].values, run[f"F_{part}y"].values))


def periodic(trial: Trial) -> Finding:
    """Measure how far the forces of two cycles are apart in smooth motion."""
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
    """Measure the least F_cx in its direction: positive forward, negative in reverse."""
    run = smooth(trial.vsv())
    ahead = np.where(forward(run), 1.0, -1.0) * run["F_cx"].values
    way = 1.0 if ahead.mean() > 0.0 else -1.0
    least = float((way * ahead).min())
    return Finding(f"at least {least:.3g} N with one sign forward and the other in reverse", least)


def sign_of_f_cy(trial: Trial) -> Finding:
    """Measure how long F_cy is negative."""
    run = smooth(trial.vsv())
    share = 100.0 * float(np.mean(run["F_cy"].values < 0.0))
    return Finding(f"negative in {share:.3g} % of the smooth motion", share)


def x_over_y(trial: Trial) -> Finding:
    """Measure the least |F_cx| over |F_cy|."""
    run = smooth(trial.vsv())
    least = float(np.min(np.abs(run["F_cx"].values) / np.abs(run["F_cy"].values)))
    return Finding(f"at least {least:.3g} times in smooth motion", least)


def rigid_dominates(trial: Trial) -> Finding:
    """Measure the least rigid over damping force."""
    run = smooth(trial.vsv())
    least = float(np.min(size(run, "k") / size(run, "d")))
    return Finding(f"at least {least:.3g} times the damping force in smooth motion", least)


def stable_at_reversals(trial: Trial) -> Finding:
    """Measure the contact force in the impacts over that of smooth motion."""
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


CLAIMS: Final = (
    Claim(
        "forces periodic", "5.2, Fig. 12", "F_cx and F_cy are periodic during the two cycles",
        below(5.0, "%", partly=20.0), periodic,
    ),
    Claim(
        "F_cx changes sign", "5.2, Fig. 12", "F_cx changes its sign with the direction",
        above(0.0, "N", by="the paper"), sign_of_f_cx,
    ),
    Claim(
        "F_cy negative", "5.2, Fig. 12", "F_cy is almost always negative",
        above(95.0, "%", partly=50.0), sign_of_f_cy,
        "it is positive for some tenths of a second after each reversal to forward motion",
    ),
    Claim(
        "F_cx larger", "5.2, Fig. 12", "F_cx is always larger than F_cy",
        above(1.0, "times", by="the paper"), x_over_y,
    ),
    Claim(
        "rigid dominates", "5.2, Fig. 12", "the rigid forces are dominant",
        above(1.0, "times", by="the paper"), rigid_dominates,
    ),
    Claim(
        "stable at reversals", "5.2, Fig. 12; 6 (2)",
        "rigid and damping forces compensate each other at reversals, so that the contact forces are stable",
        below(2.0, "times", partly=5.0), stable_at_reversals,
        "damping adds to the rigid force on approach and takes from it on separation only",
    ),
    Claim(
        "damping changes sign", "5.3, Fig. 17",
        "in the collision damping turns from positive to negative as the surfaces separate",
        above(0.1, "times"), damping_changes_sign,
    ),
)  # fmt: skip
"""Claims on forces."""
