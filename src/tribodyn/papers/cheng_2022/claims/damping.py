"""Claims on the mechanism with and without damping: sections 1, 2.1 and 5.3, conclusions (1) and (2)."""

import math
from collections.abc import Mapping
from functools import partial
from typing import Final

import numpy as np
import xarray as xr

from tribodyn.papers.cheng_2022.claims.base import (
    MANY_RUNS,
    NARROW,
    REVIEWED,
    SLOW,
    VARIED,
    Claim,
    Finding,
    Trial,
    above,
    below,
)
from tribodyn.papers.cheng_2022.claims.forces import size
from tribodyn.papers.cheng_2022.undamped import THREE_CYCLES, TOLERANCES, undamped

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


#: The motion that is left is looked at in this time before the end, but after the reversal [s].
_LATE: Final = 0.2
_AT_REVERSAL: Final = 0.01  #: A run that ends this soon after the first reversal ends in its impact [s].
#: The paper's start: everything zero, and the trunnion falls through its clearance.
_FALL: Final = {"start": "centred", "duration": "20 ms", "impact_window": "20 ms"}


def _runs(trial: Trial, friction: str, start: Mapping[str, object] | None = None) -> list[xr.Dataset]:
    more = THREE_CYCLES if start is None else start
    return [undamped(trial.runs, trial.formulation, friction, rtol, more) for rtol in TOLERANCES]


def diverges(trial: Trial, friction: str, start: Mapping[str, object] | None = None) -> Finding:
    """Measure the number of tolerances at which the run leaves the range of the contact law."""
    runs = _runs(trial, friction, start)
    ends = [float(run.attrs["time_reached"]) for run in runs if run.attrs["failure"]]
    text = f"{len(ends)} of {len(runs)} tolerances leave the law"
    turn = 0.0 if start else float(runs[0].attrs["cycle_period"]) / 2.0
    if ends and max(ends) < turn + max(_AT_REVERSAL, 0.02 if start else 0.0):
        text += f", at {', '.join(f'{end:.4f}' for end in ends)} s"
    return Finding(text, float(len(ends)))


def oscillates(trial: Trial, friction: str) -> Finding:
    """Measure the swing of the contact force long after the reversal, the least of all tolerances."""
    swings = [_swing(run) for run in _runs(trial, friction)]
    return Finding(f"standard deviation at least {min(swings):.2g} % of the mean", min(swings))


def _swing(run: xr.Dataset) -> float:
    """Return standard deviation over mean of the contact force at the end of the run [%]."""
    time = run["time"].values
    turns = run["reversal_time"].values
    late = time >= max(time[-1] - _LATE, float(turns[turns < time[-1]][-1]))
    force = size(run, "c")[late]
    return float(100.0 * force.std() / force.mean())


_SENTENCES: Final = ("A1", "I1", "K1")
_MAKES_ENERGY: Final = (
    "the paper's equations make energy, printed or mended; with friction as a moment nothing takes the "
    "energy of an impact, in any equations, and where the run leaves the law is chance"
)
_ALL_END: Final = above(3.0, "of 4 tolerances", partly=0.0, by="the paper", since=VARIED)

#: Claims on what happens without damping.
UNDAMPED_CLAIMS: Final = (
    Claim(
        "undamped diverges, moment", _SENTENCES,
        "without damping the calculation does not converge, three cycles; friction as a moment", "whole",
        _ALL_END, partial(diverges, friction="moment"), _MAKES_ENERGY, formulations="all", leave=SLOW,
    ),
    Claim(
        "undamped diverges, traction", _SENTENCES,
        "without damping the calculation does not converge, three cycles; friction as a traction", "whole",
        _ALL_END, partial(diverges, friction="traction"), _MAKES_ENERGY, formulations="all", leave=SLOW,
    ),
    Claim(
        "undamped diverges at the start", _SENTENCES,
        "the same from the paper's start, all zero; friction as a moment, 20 ms", "whole",
        _ALL_END, partial(diverges, friction="moment", start=_FALL), _MAKES_ENERGY, formulations="all",
        leave=SLOW,
    ),
    Claim(
        "undamped oscillates, moment", _SENTENCES,
        "without damping the calculation oscillates; friction as a moment", "whole",
        above(10.0, "%", partly=1.0), partial(oscillates, friction="moment"), leave=SLOW,
    ),
    Claim(
        "undamped oscillates, traction", _SENTENCES,
        "without damping the calculation oscillates; friction as a traction", "whole",
        above(10.0, "%", partly=1.0), partial(oscillates, friction="traction"),
        "traction along the slip damps the rolling of the trunnion in its bushing", leave=SLOW,
    ),
)  # fmt: skip
