"""Stiff problems of the IVP Test Set: solved at every tolerance, with the digits asked for.

Problems and end points: ``benchmarks/problems.py``.
"""

from __future__ import annotations

import sys
from functools import cache
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parents[2]))
from benchmarks.mebdf_native import mebdf
from benchmarks.problems import PROBLEMS

EXPONENTS = np.arange(3, 11)
SMALL = [name for name in PROBLEMS if name not in ("RING", "VDP11")]
REFERENCE = {"E5": 8.5, "RING": 9.0}
"""Digits of end points that are known less well than the others."""


@cache
def digits(name):
    runs = [mebdf(PROBLEMS[name], 10.0**-exponent) for exponent in EXPONENTS.tolist()]
    assert not any(run["failed"] for run in runs)
    return np.array([run["digits"] for run in runs])


@pytest.mark.parametrize("name", SMALL)
def test_digits_are_within_a_decade_of_the_tolerance(name):
    wanted = np.minimum(EXPONENTS - 1.0, REFERENCE.get(name, 16.0))
    assert np.all(digits(name) >= wanted), digits(name) - EXPONENTS


@pytest.mark.parametrize("name", SMALL)
def test_digits_grow_with_the_tolerance(name):
    found = np.minimum(digits(name), REFERENCE.get(name, 16.0))
    # A lucky run may have more digits than the next tighter one needs.
    assert np.all(np.diff(found) > -1.0), found
    assert np.polyfit(EXPONENTS, found, 1)[0] > 0.6
