"""Mechanisms led through their cycle: what clearance takes is allowed with a warning, the rest is refused."""

import re

import numpy as np
import pytest
from tests.unit.mechanism.four_bar import JOINTS, four_bar

import tribodyn as td
from tribodyn.core.errors import InputError
from tribodyn.mechanism.builder.mechanism_builder import Mechanism
from tribodyn.mechanism.system import MechanismSystem


def said(mechanism: Mechanism) -> str:
    """Return what the check of a mechanism says."""
    return " ".join(MechanismSystem(mechanism.case()).check())


def pair_of_cranks(speed: str, real: bool = True) -> Mechanism:
    """Return a platform on two equal cranks that are driven both; their pins are real or ideal."""
    small = "1e-4, 1e-4, 1e-4 kg m^2"
    drawn = Mechanism("Platform", run={"duration": "50 ms"})
    for k, x in enumerate((0, 200)):
        drawn.body(f"crank-{k}", mass="0.3 kg", centre=f"{x}, 15, 0 mm", inertia=small)
        drawn.revolute(f"main-{k}", "ground", f"crank-{k}", point=f"{x}, 0, 0 mm", axis=[0, 0, 1])
    drawn.body("platform", mass="0.5 kg", centre="100, 30, 0 mm", inertia=small)
    for k, x in enumerate((0, 200)):
        drawn.revolute(f"pin-{k}", f"crank-{k}", "platform", point=f"{x}, 30, 0 mm", axis=[0, 0, 1])
        if real:
            sizes = {"radius": "6 mm", "radial": "50 um", "length": "20 mm", "axial": "50 um"}
            drawn.clearance(f"pin-{k}", **sizes)
    return drawn.drive("first", "main-0", speed="600 rpm").drive("second", "main-1", speed=speed)


@pytest.mark.parametrize("real", [(), ("top",), JOINTS], ids=["ideal", "one real", "all real"])
def test_a_crank_and_rocker_of_spatial_joints_is_right(real: tuple[str, ...]) -> None:
    assert "misfit" not in said(four_bar(real=real))


def test_an_axis_out_of_line_is_taken_by_clearance_with_a_warning() -> None:
    with pytest.raises(InputError, match="motor has nothing to drive"):
        said(four_bar(1e-3))
    found = re.search(r"share of clearance needed: top ([\d.]+) %", said(four_bar(1e-3, ("top",))))
    assert found is not None
    # The top turns its pin's end by up to 1 mrad, and by crank and rocker's bending path some way along.
    assert 1.0 < float(found[1]) < 100.0


def test_an_axis_too_far_out_of_line_is_refused() -> None:
    with pytest.raises(InputError, match="motor has nothing to drive"):
        said(four_bar(0.03, ("top",)))
    assert "needed: main" in said(four_bar(0.03, JOINTS))


def test_what_clearance_takes_runs_with_the_forces_of_its_inertia() -> None:
    result = td.simulate(four_bar(0.03, JOINTS).case())
    assert not result.attrs["failure"]
    assert "clearances must take a misfit" in str(result.attrs["warnings"])
    # Masses of 0.3 kg on 30 mm at 63 rad/s ask for 36 N each; levers multiply that.
    assert float(np.abs(result["reaction_force"]).max()) < 3000.0


def test_two_motors_that_agree_are_allowed_where_clearance_decides() -> None:
    assert "clearances must take a misfit" in said(pair_of_cranks("600 rpm"))
    for speed, real in (("600 rpm", False), ("500 rpm", True), ("-600 rpm", True)):
        with pytest.raises(InputError, match="drives first and second drive one freedom"):
            said(pair_of_cranks(speed, real))


def test_freedoms_that_drives_leave_do_not_lock_a_mechanism() -> None:
    # Two links hang between a driven crank and a fixed pivot: they fold and stretch as the crank turns.
    small = "1e-4, 1e-4, 1e-4 kg m^2"
    drawn = (
        Mechanism("Five-bar", run={"cycles": 2})
        .body("crank", mass="0.3 kg", centre="15, 0, 0 mm", inertia=small)
        .body("first", mass="0.3 kg", centre="50, -40, 0 mm", inertia=small)
        .body("second", mass="0.3 kg", centre="80, -80, 0 mm", inertia=small)
        .body("third", mass="0.3 kg", centre="110, -40, 0 mm", inertia=small)
        .revolute("main", "ground", "crank", point="0, 0, 0 mm", axis=[0, 0, 1])
        .revolute("a", "crank", "first", point="30, 0, 0 mm", axis=[0, 0, 1])
        .revolute("b", "first", "second", point="70, -80, 0 mm", axis=[0, 0, 1])
        .revolute("c", "second", "third", point="100, -80, 0 mm", axis=[0, 0, 1])
        .revolute("d", "third", "ground", point="125, 0, 0 mm", axis=[0, 0, 1])
        .drive("motor", "main", speed="600 rpm")
    )
    assert "degrees of freedom: 1 with ideal joints" in said(drawn)
