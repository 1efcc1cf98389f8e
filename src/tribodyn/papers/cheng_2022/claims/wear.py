"""Claims on wear: section 5.3, Fig. 19."""

from collections.abc import Callable
from typing import Final

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.papers.cheng_2022.claims.base import (
    FIRST,
    MANY_RUNS,
    NARROW,
    Claim,
    Finding,
    Trial,
    above,
    below,
    least_growth,
    listed,
    near,
)
from tribodyn.papers.cheng_2022.clearance import CYCLES, worn
from tribodyn.papers.cheng_2022.runs import CLEARANCES
from tribodyn.results.dataset import WEAR_SCATTER, json_attribute

_WIDE: Final = CLEARANCES[-1]
_LAST: Final = CYCLES[-1]
_NANOMETRE: Final = 1e-9
_INSIDE: Final = 0.5e-3  #: Distance from the edge at which the ratio is given as well [m].


def _depth(trial: Trial, clearance: float, cycles: int = _LAST) -> FloatArray:
    """Return the wear depth [nm] over angle and height."""
    run = trial.whole(worn(trial.runs, trial.formulation, clearance, cycles))
    return np.asarray(run["wear_depth"].values / _NANOMETRE)


def _of_equal_parts(trial: Trial) -> str:
    """Return the interval of the depths of equal parts, in words."""
    run = worn(trial.runs, trial.formulation, NARROW, _LAST)
    low, high = (json_attribute(run, name, {}).get("", 1.0) for name in WEAR_SCATTER)
    return f" (equal parts: {low:.2g} to {high:.2g} times)"


def depth_at_40(trial: Trial) -> Finding:
    """Measure the largest depth at 40 µm after 400 cycles."""
    deepest = float(_depth(trial, _WIDE).max())
    return Finding(f"{deepest:.3g} nm" + _of_equal_parts(trial), deepest)


def ratio_to_20(trial: Trial) -> Finding:
    """Measure the depth at 40 µm over that at 20 µm, on the edge; half a millimetre from it beside."""
    wide, narrow = (profile(trial, clearance) for clearance in (_WIDE, NARROW))
    edge, inside = (wide(at) / narrow(at) for at in (0.0, _INSIDE))
    return Finding(f"{edge:.3g} times on the edge, {inside:.3g} times half a millimetre from it", edge)


def profile(trial: Trial, clearance: float) -> Callable[[float], float]:
    """Return the depth of the more worn end over the distance from its edge [m]; its logarithm is smooth."""
    run = trial.whole(worn(trial.runs, trial.formulation, clearance, _LAST))
    deepest, z = run["wear_depth"].values.max(axis=0), run["z"].values
    away = z[-1] - z if deepest[-1] >= deepest[0] else z - z[0]
    order = np.argsort(away)
    depth = np.maximum(deepest[order], np.finfo(float).tiny)
    return lambda at: float(np.exp(np.interp(at, away[order], np.log(depth))))


def grows_with_cycles(trial: Trial) -> Finding:
    """Measure the growth of the depth over 100 to 400 cycles at 20 µm."""
    depths = np.array([_depth(trial, NARROW, cycles).max() for cycles in CYCLES])
    return Finding(listed(depths, "nm") + _of_equal_parts(trial), least_growth(depths))


def grows_with_clearance(trial: Trial) -> Finding:
    """Measure the growth of the depth after 400 cycles with the clearance."""
    depths = np.array([_depth(trial, clearance).max() for clearance in trial.runs.clearances])
    return Finding(listed(depths, "nm") + _of_equal_parts(trial), least_growth(depths))


def at_the_edges(trial: Trial) -> Finding:
    """Measure the depth in the middle half against the largest, at the narrowest clearance."""
    run = trial.whole(worn(trial.runs, trial.formulation, NARROW, _LAST))
    depth, z = run["wear_depth"].values, run["z"].values
    inner = 100.0 * float(depth[:, np.abs(z) < 0.25 * np.ptp(z)].max() / depth.max())
    return Finding(f"the middle half is worn to {inner:.2g} % of the largest depth", inner)


def both_edges(trial: Trial) -> Finding:
    """Measure the depth of the shallower edge against the deeper one, at the narrowest clearance."""
    bottom, top = (float(_depth(trial, NARROW)[:, edge].max()) for edge in (0, -1))
    text = f"top {top:.3g} nm, bottom {bottom:.3g} nm"
    return Finding(text, 100.0 * min(top, bottom) / max(top, bottom))


_PRESSURE: Final = "the edge pressure is several times higher with the lever moment that the paper leaves out"
_DIVISOR: Final = "the wear rate is divided by the bare number 65, which no equation allows"

#: Claims on wear.
CLAIMS: Final = (
    Claim(
        "wear at the edges", ("W1", "A2", "K3"), "wear is concentrated on the edge of the bushing", "whole",
        below(5.0, "%", partly=20.0, since=FIRST), at_the_edges, leave=MANY_RUNS,
    ),
    Claim(
        "both edges wear", ("W1",), "the trunnion keeps in contact with its top and bottom", "whole",
        above(10.0, "% of the deeper", partly=0.0), both_edges, leave=MANY_RUNS,
    ),
    Claim(
        "wear grows with cycles", ("W1",), "wear deepens with the cycles, 100 to 400", "whole",
        above(0.0, "% a step", by="the paper"), grows_with_cycles, leave=MANY_RUNS,
    ),
    Claim(
        "wear grows with clearance", ("W2", "A4", "K6"), "wear becomes more serious with the clearance",
        "whole", above(0.0, "% a step", by="the paper"), grows_with_clearance, leave=MANY_RUNS,
    ),
    Claim(
        "wear depth, 40 µm", ("W3",), "2e-4 µm at 40 µm after 400 cycles", "whole",
        near(0.2, "nm"), depth_at_40, _PRESSURE, _DIVISOR, leave=MANY_RUNS,
    ),
    Claim(
        "wear ratio", ("W3",), "at 40 µm 1.85 times the depth at 20 µm", "whole",
        near(1.85, "times"), ratio_to_20,
        "the paper does not say how near to the edge its grid ends", leave=MANY_RUNS,
    ),
)  # fmt: skip
