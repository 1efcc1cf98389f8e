"""The thin elastic layer against layers of any thickness, and in a bushing and a run.

It runs the solver of the script that draws the figure of the manual.
"""

import dataclasses
import importlib.util
import math
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest
from scipy.integrate import quad

import tribodyn as td
from tribodyn.contact import Liner, law
from tribodyn.joints import contact_table
from tribodyn.joints.bushing import joint_wrench

SCRIPT = Path(__file__).parents[3] / "docs" / "plots" / "liner.py"


@pytest.fixture(scope="module")
def reference() -> ModuleType:
    spec = importlib.util.spec_from_file_location("liner", SCRIPT)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def of_layer(reference, ratio, poisson):
    """Return peak pressure and half width over those of the thin layer under the same load."""
    depth = 0.5e-4
    thickness = math.sqrt(2.0 * depth) / ratio
    exact = reference.press(depth, thickness, poisson)
    half_width, peak = reference.of_thin_layer(exact.load, thickness, poisson)
    return exact.pressure.max() / peak, np.abs(exact.x[exact.pressure > 0.0]).max() / half_width


def test_the_reference_is_a_half_space_where_the_layer_is_thick(reference):
    """Johnson (1985), section 4.2: line contact, W = π E a²/(4 (1 − ν²) R), p₀ = 2W/πa."""
    depth, poisson = 0.5e-4, 0.34
    found = reference.press(depth, 1.0, poisson)
    half_width = np.abs(found.x[found.pressure > 0.0]).max()
    # The edge lies between two points of the grid, 1 % of a.
    assert found.load == pytest.approx(math.pi * half_width**2 / (4.0 * (1.0 - poisson**2)), rel=0.03)
    assert found.pressure.max() == pytest.approx(2.0 * found.load / (math.pi * half_width), rel=0.02)


@pytest.mark.parametrize(
    ("ratio", "poisson"), [(10.0, 0.34), (5.0, 0.34), (10.0, 0.45), (5.0, 0.45), (15.0, 0.48)]
)
def test_a_thin_layer_errs_as_it_says(reference, ratio, poisson):
    peak, _ = of_layer(reference, ratio, poisson)
    said = Liner(1.0, 1.0, poisson).error(ratio)
    assert 0.0 < said < 0.1
    # The next order again is the square of this one; the grid adds 0.2 %.
    assert 1.0 - peak == pytest.approx(said, abs=2.0 * said**2 + 2e-3)


def test_a_contact_as_wide_as_the_sleeve_is_thick_is_still_close(reference):
    peak, half_width = of_layer(reference, 1.0, 0.34)
    # What the manual says of polyimide: pressure within 3 %, width within 12 %.
    assert peak == pytest.approx(1.0, abs=0.03)
    assert half_width == pytest.approx(1.0, abs=0.12)


def test_a_bushing_of_rigid_asperities_is_a_bed_of_springs(make_joint, table_1_pair):
    """F = k_w r_b l ∫(e cos θ − c) cos θ dθ over the arc that is pressed."""
    liner = Liner(1e-3, 7.17e9, 0.34)
    hard = law("linear", table_1_pair, penalty_stiffness=1e3 * liner.stiffness)
    joint = make_joint(grid=(384, 16), coefficient=0.0)
    table = contact_table("surface", hard, joint.geometry, onset=4.0, smoothing_width=1.0, liner=liner)
    data = dataclasses.replace(joint, table=table).data()
    clearance, eccentricity = joint.geometry.clearance, 2.5 * joint.geometry.clearance
    half_arc = math.acos(clearance / eccentricity)
    arc = quad(lambda a: (eccentricity * math.cos(a) - clearance) * math.cos(a), -half_arc, half_arc)[0]
    force = liner.stiffness * joint.geometry.bore_radius * joint.geometry.length * arc
    found = joint_wrench(data, np.array([eccentricity, *np.zeros(7)]))
    # The springs of the asperities round their corner over a tenth of σ: 0.3 µm of 30.
    assert -found[0] == pytest.approx(force, rel=1e-2)


@pytest.mark.parametrize("kind", ["vsv", "journal-dry"])
def test_the_energy_balance_closes_with_a_liner(kind):
    key = "joint.liner" if kind == "vsv" else "joints.bearing.clearance.liner"
    case = td.load_case(kind).replace({f"{key}.thickness": "1 mm"})
    run = td.simulate(case.replace({"run.cycles": 0.6}) if kind == "vsv" else case)
    # As without: the tolerance of a run's own check.
    assert abs(run.attrs["energy_residual"]) < 1e-3
