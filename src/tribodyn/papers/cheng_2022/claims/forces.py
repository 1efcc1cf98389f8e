"""Claims on the forces at the trunnion at 20 µm: section 5.2, Fig. 12."""

from functools import partial
from typing import Final

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from tribodyn.core.arrays import FloatArray
from tribodyn.papers.cheng_2022.claims.base import Claim, Domain, Finding, Trial, listed, weights
from tribodyn.papers.cheng_2022.claims.bounds import REVIEWED, VARIED, above, below
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
