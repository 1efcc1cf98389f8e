"""Claims on what causes what, sections 5.2 and 5.3: without a load the effect is measured again."""

from collections.abc import Mapping
from typing import Final

import numpy as np

from tribodyn.papers.cheng_2022.claims.base import Claim, Finding, Trial
from tribodyn.papers.cheng_2022.claims.bounds import REVIEWED, above, below
from tribodyn.papers.cheng_2022.claims.forces import size, time_share
from tribodyn.papers.cheng_2022.clearance import windows
from tribodyn.papers.cheng_2022.runs import forward, smooth

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
    shares = [
        _agreement(time_share(run, positive == cause)) for cause in (forward(run), run["F_airx"].values > 0.0)
    ]
    text = f"by the direction in {shares[0]:.3g} % of the time, by the sign of F_airx in {shares[1]:.3g} %"
    return Finding(text, shares[0] - shares[1])


def _agreement(share: float) -> float:
    """Return the share of times at which two signs are alike or opposite, whichever is larger [%]."""
    return float(np.maximum(share, 100.0 - share))


#: Claims on causes.
CLAIMS: Final = (
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
