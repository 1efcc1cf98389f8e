"""Springs in results."""

import numpy as np
import pytest

import tribodyn as td
from tribodyn.mechanisms.results import summarise
from tribodyn.results.reading import column


@pytest.mark.parametrize("ends", [("ground", "mass"), ("mass", "ground")])
def test_a_spring_reports_force_length_and_energy(ends: tuple[str, str]) -> None:
    # A mass of 2 kg, 10 mm off its rest, on 200 N/m in a guide: a swing of 10 rad/s with 1 N s/m of damping.
    points = {"ground": "0, 0, 0 mm", "mass": "110, 0, 0 mm"}
    drawn = td.Mechanism("Swing", run={"duration": "0.3 s"})
    drawn.body("mass", mass="2 kg", centre="110, 0, 0 mm", inertia="1e-3, 1e-3, 1e-3 kg m^2")
    drawn.prismatic("guide", "ground", "mass", point="110, 0, 0 mm", axis=[1, 0, 0])
    keys = {"stiffness": "200 N/m", "damping": "1 N s/m", "length": "100 mm"}
    drawn.spring("coil", *ends, first_point=points[ends[0]], second_point=points[ends[1]], **keys)
    result = td.simulate(drawn)
    length, speed = 0.11 + column(result, "position")[:, 0, 0] - 0.11, column(result, "velocity")[:, 0, 0]
    np.testing.assert_allclose(column(result, "spring_length")[:, 0], length, atol=1e-12)
    force = -200.0 * (length - 0.1) - speed
    np.testing.assert_allclose(column(result, "spring_force")[:, 0], force, atol=1e-9)
    np.testing.assert_allclose(
        column(result, "spring_energy")[:, 0], column(result, "energy_stored"), atol=1e-6
    )
    numbers = summarise(result)
    assert numbers["spring_pull_max_N_coil"] == pytest.approx(2.0, rel=1e-3)
    assert numbers["spring_length_max_mm_coil"] == pytest.approx(110.0)
    assert numbers["spring_energy_max_J_coil"] == pytest.approx(0.01)
    assert numbers["spring_push_max_N_coil"] == pytest.approx(force.max())
