"""What must not matter to a run: how often it is done, how often it is looked at, how lengths are spelled."""

from __future__ import annotations

import numpy as np
import pytest

from tribodyn.cases import load_case
from tribodyn.simulation import simulate

BRIEF = {"run.duration": "0.2 s", "run.output_interval": "5 ms"}
"""The start and what follows it: contact, friction and memory are at work."""
ATTITUDE = ("e_x", "e_y", "phi_x", "phi_y", "e_x_dot", "e_y_dot", "phi_x_dot", "phi_y_dot")


def run(**changes):
    dotted = {path.replace("__", "."): value for path, value in changes.items()}
    return simulate(load_case("vsv").replace(BRIEF | dotted))


@pytest.fixture(scope="module")
def base():
    return run()


def test_the_same_case_gives_the_same_bits(base):
    again = run()
    for name in base.variables:
        np.testing.assert_array_equal(base[name].values, again[name].values, err_msg=name)


def test_the_output_interval_does_not_change_the_solution(base):
    often = run(run__output_interval="1 ms").sel(time=base["time"], method="nearest")
    for name in (*ATTITUDE, "F_cx", "F_cy", "p_max"):
        # Rows are read from the steps, which know nothing of them; times of rows differ by rounding.
        np.testing.assert_allclose(often[name].values, base[name].values, rtol=1e-9, atol=0.0, err_msg=name)


def test_units_do_not_matter(base):
    spelled = run(
        joint__clearance="0.02 mm",
        mechanism__lever_length="5 cm",
        drive__start_angle=f"{float(np.radians(-16.0))} rad",
        surfaces__bushing__young_modulus="7170 N/mm^2",
        loads__air_moment="84 N cm",
    )
    quiet = base["time"].values > 0.1
    for name in ("e_x", "e_y", "phi_x", "phi_y", "F_cx", "theta_v"):
        scale = np.abs(base[name].values).max()
        # Parameters differ in their last bits, and steps may fall otherwise: within the tolerance of the run.
        difference = np.abs(spelled[name].values - base[name].values)[quiet].max()
        assert difference < 1e-4 * scale, name


def test_the_path_integrals_do_not_depend_on_the_rows(base):
    often = run(run__output_interval="1 ms")
    for name in ("energy_damping", "energy_friction", "energy_drive"):
        assert often[name].values[-1] == pytest.approx(base[name].values[-1], rel=1e-5)
