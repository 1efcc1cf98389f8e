"""SciPy's own tests of its stiff solvers, with MEBDF in their place: sparse differences, events, ends.

Left out: complex states, which are refused; counts of Jacobians, which are MEBDF's own.
"""

from __future__ import annotations

import subprocess
import sys

SCRIPT = """
import inspect
import warnings
import scipy.integrate._ivp.tests.test_ivp as theirs
from mebdf import MEBDF

STIFF = ("Radau", "BDF", "LSODA")
solve = theirs.solve_ivp


def with_mebdf(fun, t_span, y0, method="RK45", **options):
    return solve(fun, t_span, y0, method=MEBDF if method in STIFF else method, **options)


theirs.solve_ivp = with_mebdf
for name in STIFF:
    setattr(theirs, name, MEBDF)
warnings.simplefilter("ignore")
GIVEN = {"num_parallel_threads": 1, "method": MEBDF}
for name in (
    "args array_rtol classes duplicate_timestamps empty events first_step inital_maxstep "
    "integration_sparse_difference max_step no_integration no_integration_class t_eval t_eval_dense_output "
    "t_eval_early_event tbound_respected_larger_interval tbound_respected_oscillator "
    "tbound_respected_small_interval zero_interval"
).split():
    if test := getattr(theirs, "test_" + name, None):
        test(**{key: GIVEN[key] for key in inspect.signature(test).parameters})
"""


def test_all_pass():
    ended = subprocess.run([sys.executable, "-c", SCRIPT], capture_output=True, text=True, check=False)
    assert ended.returncode == 0, ended.stderr
