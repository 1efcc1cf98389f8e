"""Claims on what damping does for the mechanism: abstract, sections 2.1 and 5.3, conclusion (2)."""

import math
from typing import Final

import numpy as np
import xarray as xr

from tribodyn.papers.cheng_2022.claims.base import MANY_RUNS, NARROW, Claim, Finding, Trial
from tribodyn.papers.cheng_2022.claims.bounds import REVIEWED, above, below
from tribodyn.papers.cheng_2022.claims.forces import size
from tribodyn.papers.cheng_2022.undamped import TOLERANCES, undamped

#: Drag moments M_air that are tried [N m]; Table 3 has 0.84.
MOMENTS: Final = (0.30, 0.36, 0.42, 0.48, 0.54, 0.60, 0.72, 0.84, 1.00)
#: Friction of each formulation by default.
_FRICTION: Final = {"printed": "moment", "paper": "moment", "exact": "traction"}


def under_moment(trial: Trial, moment: float) -> xr.Dataset:
    """Return the damped mechanism under a drag moment [N m], from equilibrium past the first reversal."""
    changes = {"loads.air_moment": f"{moment:g} N m", "run.start": "equilibrium", "run.duration": "3.4 s"}
    return trial.runs.vsv(trial.formulation, NARROW, changes)


def ensures(trial: Trial) -> Finding:
    """Measure the number of drag moments at which the damped run leaves the contact law."""
    runs = {moment: under_moment(trial, moment) for moment in MOMENTS}
    ended = [f"{moment:.2f}" for moment, run in runs.items() if run.attrs["failure"]]
    through = [run for run in runs.values() if not run.attrs["failure"]]
    largest = max((_after_reversal(run, "c") for run in through), default=math.nan)
    said = f"ends at the first reversal for {', '.join(ended)} N m; " if ended else ""
    text = f"{said}{len(through)} of {len(MOMENTS)} runs go through"
    text += f", up to {largest:.0f} N" if through else ""
    return Finding(text, float(len(ended)))


def stable_as_published(trial: Trial) -> Finding:
    """Measure the number of clearances at which the damped run leaves the contact law, two cycles."""
    ended = [bool(run.attrs["failure"]) for run in trial.runs.every_clearance(trial.formulation)]
    return Finding(f"{sum(ended)} of {len(ended)} runs end early", float(sum(ended)))


def prevents_interference(trial: Trial) -> Finding:
    """Measure the rigid force after the first reversal without damping over that with it."""
    without = undamped(trial.runs, trial.formulation, _FRICTION[trial.formulation], TOLERANCES[0])
    damped, free = (_after_reversal(run, "k") for run in (trial.vsv(), without))
    return Finding(f"{damped:.3g} N with damping, {free:.3g} N without", free / damped)


def _after_reversal(run: xr.Dataset, part: str) -> float:
    """Return the largest force of the first 0.2 s after the first reversal [N]."""
    time = run["time"].values - float(run["reversal_time"].values[1])
    return float(np.max(size(run, part)[(time >= 0.0) & (time < 0.2)]))


_TERM: Final = (
    "the inertia force of the ring along Y follows e_y but not the turn of the vane by e_x, so that impacts "
    "can gain energy"
)

#: Claims on damping.
CLAIMS: Final = (
    Claim(
        "damping ensures stability, the paper's load", ("A3", "K4"),
        "the damping forces ensure the stability of the calculation; the loads of Table 3", "whole",
        below(1.0, "of 5 clearances", by="the paper", since=REVIEWED), stable_as_published,
        "as printed, A_12 and A_42 have m_2/2 and m_3/2 where the ring moves with m_3", formulations="all",
        leave=MANY_RUNS,
    ),
    Claim(
        "damping ensures stability, other loads", ("A3", "K4"),
        "the damping forces ensure the stability of the calculation; M_air from 0.3 to 1 N m", "whole",
        below(1.0, "of 9 runs", by="the paper", since=REVIEWED), ensures, _TERM, formulations="all",
        leave=MANY_RUNS,
    ),
    Claim(
        "damping prevents interference", ("C12", "K4"),
        "the damping forces play a role in preventing excessive interference", "impacts",
        above(1.0, "times", by="the paper", since=REVIEWED), prevents_interference,
    ),
    Claim(
        "surface contact more accurate", ("M1",),
        "contact over the surface is more accurate than at a point in conformal joints", "whole",
        above(0.0, by="the paper", since=REVIEWED),
        reason="neither the paper nor we have a measurement to compare with",
    ),
)  # fmt: skip
