"""Velocities at the start, and mechanisms led through their cycle: what clearance takes, what is refused."""

import re

import numpy as np
import pytest
from tests.unit.mechanism.four_bar import JOINTS, four_bar

import tribodyn as td
from tribodyn.core.errors import InputError
from tribodyn.mechanism.assembly.assembly import Assembly, assemble
from tribodyn.mechanism.assembly.parts_by_number import model_of
from tribodyn.mechanism.builder.mechanism_builder import Mechanism
from tribodyn.mechanism.mechanism_case import MechanismCase
from tribodyn.mechanism.system import MechanismSystem


def velocities(assembly: Assembly) -> np.ndarray:
    return assembly.state.reshape(-1, 13)[:, 7:]


def assembled(case: MechanismCase) -> Assembly:
    found = assemble(model_of(case))
    found.require_sound()
    return found


def driven_pendulum(real: bool) -> MechanismCase:
    """Return a pendulum that turns about a pin, which may have clearance."""
    drawn = Mechanism("Pendulum", run={"duration": "1 ms", "start": "centred"})
    drawn.body("bob", mass="1 kg", centre="100, 0, 0 mm", inertia="1e-3, 1e-3, 1e-3 kg m^2")
    drawn.revolute("pivot", "ground", "bob", point="0, 0, 0 mm", axis=[0, 1, 0])
    if real:
        drawn.clearance("pivot", radius="6 mm", radial="20 um", length="20 mm", axial="50 um")
    return drawn.drive("motor", "pivot", speed="30 rad/s").case()


def ideal(case: MechanismCase) -> MechanismCase:
    real = [name for name, joint in case.joints.items() if joint.real is not None]
    return case.replace({f"joints.{name}.clearance.ideal": True for name in real})


@pytest.mark.parametrize("name", ["slider-crank", "four-bar"])
def test_bodies_begin_with_the_velocities_of_the_ideal_counterpart(name: str) -> None:
    case = td.load_case(name)
    expected = velocities(assembled(ideal(case)))
    assert np.abs(expected).max() > 10.0
    np.testing.assert_allclose(velocities(assembled(case)), expected, atol=1e-12 * np.abs(expected).max())


def test_a_chain_without_loops_does_so_too() -> None:
    # The freed body would turn about its mass centre, its pin moving at 3 m/s.
    found = velocities(assembled(driven_pendulum(real=True)))
    np.testing.assert_allclose(found, velocities(assembled(driven_pendulum(real=False))), atol=1e-13)
    np.testing.assert_allclose(found, [[0, 0, -3, 0, 30, 0]], atol=1e-13)


def test_a_pin_in_the_middle_of_its_clearance_is_at_rest_against_the_bore() -> None:
    changes = {"run.start": "centred", "run.duration": "60 us", "run.output_interval": "0.1 us"}
    result = td.simulate(td.load_case("slider-crank").replace(changes))
    assert not result.attrs["failure"]
    # The ideal slider has 19419 m/s² there: the play of 20 um, less some roughness, takes 45 us. A slider at
    # rest beside a rod that passes at 13 m/s would touch after 2 us and leave the range of the contact law.
    touching = np.abs(result["reaction_force"].sel(joint="wrist")).max("axis").values > 1.0
    assert 35e-6 < float(result["time"][np.argmax(touching)]) < 46e-6


@pytest.mark.parametrize("start", ["centred", "equilibrium"])
def test_a_drive_keeps_its_speed_where_clearances_take_a_misfit(start: str) -> None:
    # The crank's axis is out of line by 0.1 mrad: ideal joints would be locked.
    case = td.load_case("slider-crank").replace({"joints.main.axis": [0.0, 1e-4, 1.0], "run.start": start})
    system = MechanismSystem(case)
    assert "clearances must take a misfit" in str(system.check())
    assembly, begin = system.assembly, system.start()
    v = (assembly.state if begin is None else begin).reshape(-1, 13)[:, 7:]
    names = assembly.model.bodies
    crank, rod, slider = (v[names.index(name)] for name in ("crank", "rod", "slider"))
    assert crank[5] == pytest.approx(523.5988, rel=1e-6)
    pin = rod[:3] + np.cross(rod[3:], [0.06, 0.0, 0.0])
    # What the play has to take at 170 mm from the axis: 524 rad/s times 0.1 mrad times that.
    assert np.linalg.norm(pin - slider[:3]) < 8.91e-3


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
