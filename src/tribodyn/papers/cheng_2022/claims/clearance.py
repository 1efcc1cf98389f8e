"""Claims on what the size of the clearance does to forces and attitude: section 5.3, Figs. 17 and 18."""

from itertools import combinations
from typing import Final

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from mebdf.arrays import FloatArray
from tribodyn.papers.cheng_2022.claims.attitude import tilt
from tribodyn.papers.cheng_2022.claims.base import (
    FIRST,
    MANY_RUNS,
    VARIED,
    Claim,
    Finding,
    Trial,
    above,
    below,
    least_growth,
    listed,
)
from tribodyn.papers.cheng_2022.claims.forces import size
from tribodyn.papers.cheng_2022.clearance import collision_speed, peaks
from tribodyn.papers.cheng_2022.runs import smooth

_NARROW: Final = 30e-6  #: Wider clearances are the paper's large ones, 35 and 40 µm [m].
#: Distance from 90° in time within which the load that changes sign there is the cause [s].
_SWITCH: Final = 0.1
#: Until after the first time that the vane passes 90°, with rows that resolve what rings there.
_FINE: Final = {"run.duration": "1.6 s", "run.output_interval": "0.5 ms"}


def forces_alike(trial: Trial) -> Finding:
    """Measure the spread of the mean contact force in smooth motion over the clearances."""
    force = np.array([size(smooth(run), "c").mean() for run in trial.every_clearance()])
    spread = 100.0 * float(np.ptp(force) / force.mean())
    return Finding(f"mean {listed(force, 'N')}: a spread of {spread:.2g} %", spread)


def _wide_over_narrow(trial: Trial, values: FloatArray) -> float:
    """Return the mean of values at the paper's large clearances over that at the others."""
    wide = np.array(trial.runs.clearances) > 1.01 * _NARROW
    return float(values[wide].mean() / values[~wide].mean())


def oscillation(trial: Trial) -> Finding:
    """Measure the ripple of the contact force in smooth motion at 35 and 40 µm over that below."""
    ripples = np.array([ripple(smooth(run)) for run in trial.every_clearance()])
    ratio = _wide_over_narrow(trial, ripples)
    return Finding(f"ripple {listed(ripples * 1e3, 'mN')}", ratio)


def ripple(run: xr.Dataset) -> float:
    """Return the median size of the second difference of the contact force on uniform rows [N]."""
    time = np.arange(run["time"].values[0], run["time"].values[-1], 5e-3)
    return float(np.median(np.abs(np.diff(np.interp(time, run["time"].values, size(run, "c")), 2))))


def damping_grows(trial: Trial) -> Finding:
    """Measure the growth of the largest damping force of the reversals with the clearance."""
    found = np.array([peaks(run, "d").max() for run in trial.every_clearance()])
    return Finding(f"peaks {listed(found, 'N')}", least_growth(found))


def collision_grows(trial: Trial) -> Finding:
    """Measure the growth of the largest speed after the reversals with the clearance."""
    found = np.array([collision_speed(run) for run in trial.every_clearance()])
    return Finding(f"up to {listed(found, 'mm/s')}", least_growth(found))


def damping_by_collision(trial: Trial) -> Finding:
    """Measure the exponent of the largest damping force over the speed of the collision, by clearance."""
    runs = trial.every_clearance()
    speed = np.log([collision_speed(run) for run in runs])
    exponent = float(np.polyfit(speed, np.log([peaks(run, "d").max() for run in runs]), 1)[0])
    return Finding(f"the force grows as the speed to the power {exponent:.2g}", exponent)


def speed_at_90(trial: Trial) -> Finding:
    """Measure the pairs of clearances of which the wider one has the faster trunnion near 90°."""
    found = np.array([_speed_near_90(run) for run in trial.every_clearance(_FINE)])
    pairs = [bool(wide > narrow) for narrow, wide in combinations(found, 2)]
    return Finding(listed(found, "mm/s"), 100.0 * float(np.mean(pairs)))


def _speed_near_90(run: xr.Dataset) -> float:
    """Return the largest speed of the centre near the instant at which the vane passes 90° [mm/s]."""
    speed = 1e3 * np.hypot(run["e_x_dot"].values, run["e_y_dot"].values)
    return float(speed[_is_near_90(run)].max())


def damping_at_90(trial: Trial) -> Finding:
    """Measure in how many pairs of clearances the wider one has the larger damping force near 90°."""
    found = np.array([size(run, "d")[_is_near_90(run)].max() for run in trial.every_clearance(_FINE)])
    pairs = [bool(wide > narrow) for narrow, wide in combinations(found, 2)]
    return Finding(listed(found * 1e3, "mN"), 100.0 * float(np.mean(pairs)))


def _is_near_90(run: xr.Dataset) -> NDArray[np.bool_]:
    time, angle = run["time"].values, run["theta_v_ideal"].values
    passed = time[int(np.argmax(angle > 0.5 * np.pi))]
    return np.asarray(np.abs(time - passed) < _SWITCH)


def rigid_smaller(trial: Trial) -> Finding:
    """Measure the largest rigid force of the reversals at 35 and 40 µm over that below."""
    found = np.array([peaks(run, "k").max() for run in trial.every_clearance()])
    return Finding(f"peaks {listed(found, 'N')}", _wide_over_narrow(trial, found))


def _grows(trial: Trial, names: dict[str, tuple[str, float]], unit: str) -> Finding:
    """Measure the least growth of the mean size of variables in smooth motion with the clearance."""
    means: dict[str, FloatArray] = {
        shown: scale * np.array([np.abs(smooth(run)[name].values).mean() for run in trial.every_clearance()])
        for name, (shown, scale) in names.items()
    }
    text = "; ".join(f"|{shown}| {listed(values, unit)}" for shown, values in means.items())
    return Finding(text, min(least_growth(values) for values in means.values()))


def deviation_grows(trial: Trial) -> Finding:
    """Measure the growth of |e_x| and |e_y|."""
    return _grows(trial, {"e_x": ("e_x", 1e6), "e_y": ("e_y", 1e6)}, "µm")


def deflection_grows(trial: Trial) -> Finding:
    """Measure the growth of the tilt."""
    found = np.array([tilt(smooth(run)).mean() for run in trial.every_clearance()])
    return Finding(listed(found, "mrad"), least_growth(found))


#: Claims on the effect of the clearance.
CLAIMS: Final = (
    Claim(
        "forces alike", ("C8",), "the contact forces are almost equal for all clearances", "smooth motion",
        below(5.0, "%", partly=20.0, since=FIRST), forces_alike, leave=MANY_RUNS,
    ),
    Claim(
        "oscillation above 30 µm", ("C8", "K5"),
        "above 30 µm slight oscillations also occur in the continuous motion", "smooth motion",
        above(1.5, "times", partly=1.0, since=FIRST), oscillation,
        "what rings after a reversal lasts longer in a wide clearance with traction, not with the moment",
        leave=MANY_RUNS,
    ),
    Claim(
        "collision velocity grows", ("C9", "D2"),
        "the velocity of the collision grows with the clearance", "impacts",
        above(0.0, "% a step", by="the paper"), collision_grows, leave=MANY_RUNS,
    ),
    Claim(
        "damping force grows", ("C9", "D2", "A3", "K5"), "the damping force grows with the clearance",
        "impacts", above(6.0, "% a step", partly=0.0), damping_grows,
        "peaks repeat within some 6 %, which is the bound", leave=MANY_RUNS,
    ),
    Claim(
        "damping by contact velocity", ("C9",),
        "the damping force depends strongly on the initial contact velocity", "impacts",
        above(0.5, partly=0.1, since=VARIED), damping_by_collision, leave=MANY_RUNS,
    ),
    Claim(
        "speed at 90°", ("C10",),
        "where F_airx changes its sign the relative motion is faster with a large clearance",
        "smooth motion", above(90.0, "% of pairs", partly=50.0, origin=100.0, since=VARIED), speed_at_90,
        leave=MANY_RUNS,
    ),
    Claim(
        "damping at 90°", ("C10",),
        "where F_airx changes its sign the damping force is higher with a large clearance", "smooth motion",
        above(90.0, "% of pairs", partly=50.0, origin=100.0), damping_at_90,
        "it is a thousandth of the contact force, of the size of what rings beside it", leave=MANY_RUNS,
    ),
    Claim(
        "rigid force smaller", ("C15", "A3", "K5"),
        "at 35 and 40 µm the rigid forces of the collision are smaller", "impacts",
        below(1.0, "times", by="the paper"), rigid_smaller,
        "the trunnion arrives faster in a wide clearance and goes deeper", leave=MANY_RUNS,
    ),
    Claim(
        "deviation grows", ("D1",), "e_x and e_y increase with the clearance", "smooth motion",
        above(0.0, "% a step", by="the paper"), deviation_grows, leave=MANY_RUNS,
    ),
    Claim(
        "deflection grows", ("D3",), "the larger the clearance, the larger the deflection", "smooth motion",
        above(0.0, "% a step", by="the paper"), deflection_grows, leave=MANY_RUNS,
    ),
)  # fmt: skip
