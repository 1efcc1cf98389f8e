"""Differential-algebraic problems of the IVP Test Set at every tolerance, beside Cash's own codes.

Problems, end points and published runs: ``benchmarks/solver/dae_problems.py``,
``benchmarks/solver/dae.py``. Rounding moves the digits at one tolerance; what is asked are means over the
tolerances and slopes through them.
"""

import sys
from functools import cache
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parents[2]))
from benchmarks.solver.dae import PROBLEMS, PUBLISHED, beside, solve

#: The car axis starts with multipliers of zero; its own are 5e-9 and 1e-9.
pytestmark = pytest.mark.filterwarnings("ignore:The values at t = 0 were not consistent")


#: Runs to a decade of tolerances. Lines through two of the transistor's give 0.8 to 2.4 times the published
#: decompositions, by rounding; lines through six give 1.1 to 1.3.
A_DECADE = dict.fromkeys(PUBLISHED, 2) | {"transistor": 6}


#: The transistor amplifier takes as long as the others together.
NAMES = [pytest.param(name, marks=pytest.mark.long) if name == "transistor" else name for name in PUBLISHED]


@cache
def found(name):
    return beside(name, A_DECADE[name])


@pytest.mark.long
def test_algebraic_values_beside_their_equations_hardly_ever_stop_a_run():
    # A step left them there by some tolerances in 6 of 25 runs, and none after it was short enough. Now 1 of
    # 401 runs fails at these tolerances; which of them, rounding decides.
    problem = PROBLEMS["transistor"]()
    runs = [solve(problem, 10.0**-exponent) for exponent in np.linspace(2.0, 3.0, 25)]
    assert sum(run["failed"] for run in runs) <= 1
    # A tolerance is of each step, and the amplifier amplifies: the least are 1.6 digits.
    assert min(run["digits"] for run in runs if not run["failed"]) > 1.0


@pytest.mark.parametrize("name", NAMES)
def test_no_tolerance_fails_and_digits_are_those_of_the_published_runs(name):
    runs = found(name)["runs"]
    assert [run["message"] for run in runs if run["failed"]] == []
    ours = np.array([run["digits"] for run in found(name)["at"]])
    theirs = np.array([row[3] for row in PUBLISHED[name]])
    # The least mean is that of Andrews' squeezer, 0.1 digits less at equal tolerances; ± 0.2 by rounding.
    assert np.mean(ours - theirs) > -0.5
    slope = np.polyfit(np.arange(len(runs)) / A_DECADE[name], [run["digits"] for run in runs], 1)[0]
    # A variable of index 3 gains 2/3 of a digit a decade where its errors are multiplied by h² ~ tol^(1/3).
    assert slope > 0.6


@pytest.mark.parametrize(
    "names",
    [pytest.param(PUBLISHED, marks=pytest.mark.long), [name for name in PUBLISHED if name != "transistor"]],
)
@pytest.mark.parametrize(("cost", "most"), [("steps", 1.2), ("rhs", 1.3), ("lu", 1.5)])
def test_costs_at_equal_digits(cost, most, names):
    # Steps, evaluations and decompositions over the published ones, geometric means over the tolerances. The
    # largest are 1.07 and 1.13 (Andrews' squeezer) and 1.31 (transistor); scatter over tolerances some 0.1.
    ratios = {name: found(name)["ratios"][cost] for name in names}
    assert max(ratios.values()) < most, ratios
    assert np.exp(np.mean(np.log(list(ratios.values())))) < (1.0 if cost != "lu" else 1.15), ratios


@pytest.mark.long
def test_andrews_squeezer_has_six_digits_at_the_tightest_tolerance():
    # Single runs have 5.8 to 7.3 digits; the mean of 25 is 6.48, with a standard deviation of 0.40.
    problem = PROBLEMS["Andrews' squeezer"]()
    assert np.mean([solve(problem, (1.0 + 0.01 * k) * 1e-10)["digits"] for k in range(10)]) > 6.0
