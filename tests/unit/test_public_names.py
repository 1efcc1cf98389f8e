"""The names at the top of the package."""

from __future__ import annotations

import subprocess
import sys

import numpy as np
from scipy.integrate import OdeSolver, solve_ivp

import tribodyn as td


def test_importing_what_stands_behind_a_public_function_does_not_shadow_it() -> None:
    code = (
        "import tribodyn.simulation, tribodyn.cases, tribodyn as td; "
        "assert callable(td.simulate) and callable(td.load_case)"
    )
    subprocess.run([sys.executable, "-c", code], check=True)


def test_simulating_in_a_script_imports_nothing_that_draws_or_writes() -> None:
    names = {"matplotlib", "netCDF4"}
    code = f"import sys, tribodyn as td; td.simulate, td.read; print(*{names} & sys.modules.keys())"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "\n"


def test_a_contact_law_is_a_pressure_over_a_gap_in_metres() -> None:
    pressure = td.contact.law("rsdc", td.load_case("vsv")).pressure(
        np.array([[0.0, 1.634e-6], [3.268e-6, 1.0]])
    )
    # The project's check values, given to four digits at whole multiples of sigma, itself to four digits.
    np.testing.assert_allclose(pressure[0], [518.2e6, 98.78e6], rtol=1e-3)
    assert pressure[1, 1] == 0.0


def test_the_integrator_is_one_of_scipys() -> None:
    assert issubclass(td.integrate.MEBDF, OdeSolver)
    decay = solve_ivp(lambda t, y: -y, (0.0, 1.0), [1.0], method=td.integrate.MEBDF, rtol=1e-8, atol=1e-10)
    assert decay.success
    np.testing.assert_allclose(decay.y[0, -1], np.exp(-1.0), rtol=1e-6)
