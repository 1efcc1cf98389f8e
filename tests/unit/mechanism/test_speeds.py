"""Velocities at the start: joints with clearance move as the ideal joints that hold the same."""

import numpy as np
import pytest

import tribodyn as td
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
