"""Problems of index 2 whose published runs are poor or failed: elastic slider-crank, car axis, charge pump.

Means over tolerances: rounding moves the digits at one of them.
"""

import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parents[2]))
from benchmarks.solver import dae
from benchmarks.solver.dae_index_2 import PUBLISHED, pump, slider_crank, stabilised_caraxis

#: The car axis starts with multipliers of zero; its own are 5e-9 and 1e-9.
pytestmark = pytest.mark.filterwarnings("ignore:The values at t = 0 were not consistent")


def test_the_elastic_slider_crank_has_the_published_digits_for_the_published_work():
    runs = [dae.solve(slider_crank(), 10.0**-exponent) for exponent in (2, 3, 4)]
    assert [run["message"] for run in runs if run["failed"]] == []
    digits, evaluations = np.mean([[run["digits"], np.log(run["rhs"])] for run in runs], axis=0)
    theirs = np.mean([[row[3], np.log(row[1])] for row in PUBLISHED[:3]], axis=0)
    assert digits > theirs[0] - 0.5  # of single runs 0.3
    assert evaluations < theirs[1] + 0.3


@pytest.mark.long
def test_the_elastic_slider_crank_is_resolved_for_less_than_the_published_work():
    # The rod's vibration of 24,600 rad/s is within this tolerance; with larger ones digits are chance. Single
    # runs scatter by 0.3 digits, from 1.46 to 2.44 within a tenth of a decade of it on three processors.
    runs = [dae.solve(slider_crank(), factor * 1e-8) for factor in (0.9, 0.96, 1.04, 1.1)]
    steps, evaluations, _, digits = PUBLISHED[6]
    assert np.mean([run["digits"] for run in runs]) > digits - 0.25
    assert np.mean([run["rhs"] for run in runs]) < evaluations  # by a fifth or more
    assert np.mean([run["steps"] for run in runs]) < 1.1 * steps  # 0.88 to 0.98


def test_the_stabilised_car_axis_has_more_digits_than_the_published_runs_at_index_3():
    runs = [dae.solve(stabilised_caraxis(), 10.0**-exponent) for exponent in (3, 5, 7)]
    theirs = [dae.PUBLISHED["car axis"][exponent - 2][3] for exponent in (3, 5, 7)]
    assert [run["message"] for run in runs if run["failed"]] == []
    # By 1.5 here: the constraints on velocities hold, too.
    assert np.mean([run["digits"] for run in runs]) > np.mean(theirs) + 0.5


@pytest.mark.parametrize("exponent", [2, 4, 6])
def test_the_charge_pump_is_passed_from_kink_to_kink(exponent):
    run = pump(10.0**-exponent)
    assert not run["failed"], run["message"]
    assert run["digits"] > exponent
