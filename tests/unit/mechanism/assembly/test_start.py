"""Where a mechanism with clearance begins: shafts against their sockets, as loads and motion ask."""

import math

import numpy as np
import pytest
from tests.faults.mechanisms.impossible_mechanisms import twins
from tests.unit.mechanism.slider_crank import IDEAL, parsed

import tribodyn as td
from tribodyn.core.errors import Stopped
from tribodyn.core.problem import asked as asked_of
from tribodyn.mechanism.builder.mechanism_builder import Mechanism
from tribodyn.mechanism.system import MechanismSystem

DRIVEN = IDEAL.split("[pairs")[0] + '[drives.motor]\njoint = "main"\nspeed = "5000 rpm"\n'
WRIST = """
[joints.wrist.clearance]
radius = "9.5 mm"
radial = "20 um"
length = "20 mm"
friction_coefficient = 0.0
[run]
duration = "10 us"
"""


def force(result, joint: str) -> float:
    return float(np.linalg.norm(result["reaction_force"].sel(joint=joint).isel(time=0)))


def test_a_wrist_at_speed_begins_with_the_force_of_the_ideal_one() -> None:
    result = td.simulate(parsed(DRIVEN + WRIST))
    assert result.attrs["start"] == "equilibrium"
    # At dead centre, to the clearance over the length of the rod and what surfaces give way.
    assert force(result, "wrist") == pytest.approx(2718.7105, rel=1e-3)
    assert float(result["acceleration"].sel(body="slider", axis="x")[0]) == pytest.approx(-19419.36, rel=1e-3)


def test_a_chain_that_hangs_begins_at_rest() -> None:
    chain = Mechanism("Chain", gravity="0, 0, -9.81 m/s^2", run={"duration": "5 ms"})
    above = "ground"
    for k in range(3):
        name, height = f"link{k}", -100 * k
        centre, point = f"0, 0, {height - 50} mm", f"0, 0, {height} mm"
        chain.body(name, mass="1 kg", centre=centre, inertia="1e-3, 1e-3, 1e-3 kg m^2")
        chain.revolute(f"pin{k}", above, name, point=point, axis=[0, 1, 0])
        chain.clearance(f"pin{k}", radius="6 mm", radial="20 um", length="20 mm", axial="50 um")
        above = name
    result = td.simulate(chain.case())
    weights = 9.81 * np.array([3.0, 2.0, 1.0])
    assert [force(result, f"pin{k}") for k in range(3)] == pytest.approx(weights, rel=1e-6)
    # A weight of 1 kg falls 120 µm in that time; surfaces that balance move by no thousandth of σ.
    moved = result["position"].isel(time=-1) - result["position"].isel(time=0)
    assert float(abs(moved).max()) < 1e-9
    # What surfaces store is there from the first row on, and no energy is missed.
    stored = result["energy_stored"].values
    assert stored[0] == pytest.approx(stored[-1], rel=1e-6)
    assert "Energy" not in result.attrs["warnings"]


def test_what_cannot_move_misses_no_energy() -> None:
    frame = Mechanism("Frame", gravity="0, 0, -9.81 m/s^2", run={"duration": "5 ms"})
    for k, name in enumerate(("left", "right")):
        centre = f"{100 * k - 50}, 3, 7 mm"
        frame.body(name, mass="0.3 kg", centre=centre, inertia="1e-4, 1e-4, 1e-4 kg m^2")
        frame.spherical(f"foot-{name}", "ground", name, point=f"{200 * k - 100}, 11, 13 mm")
    frame.revolute("top", "left", "right", point="0, 5, 90 mm", axis=[0, 1, 0])
    result = td.simulate(frame.fixed("wall", "ground", "left", point="-50, 0, 0 mm").case())
    # What is left to balance is rounding: 1e-17 J, hundreds of times the largest term beside it.
    assert result.attrs["energy_residual"] < 1e-6
    assert "Energy" not in result.attrs["warnings"]


def test_friction_is_that_of_the_motion_that_begins() -> None:
    # A trunnion with clearance that a torque sets turning: friction acts against it from the first instant.
    drawn = Mechanism("Shaft", gravity="0, 0, -9.81 m/s^2", run={"duration": "1 us"})
    drawn.body("shaft", mass="1 kg", centre="0, 0, 0 mm", inertia="1e-3, 1e-3, 1e-3 kg m^2")
    drawn.cylindrical("bore", "ground", "shaft", point="0, 0, 0 mm", axis=[0, 1, 0])
    drawn.clearance("bore", radius="6 mm", radial="20 um", length="20 mm", friction_coefficient=0.2)
    drawn.drive("motor", "bore", torque="1 N m")
    place = td.simulate(drawn.case())["displacement"].isel(time=0).sel(joint="bore").values
    # Under a weight a turning shaft climbs the wall by the angle of friction.
    climbed = math.atan2(*sorted(abs(place[:2])))
    assert climbed == pytest.approx(math.atan(0.2), rel=1e-2)


def test_a_shaft_that_nothing_holds_starts_in_the_middle_and_says_so() -> None:
    drawn = Mechanism("Drop", gravity="0, 0, -9.81 m/s^2", run={"duration": "1 ms"})
    drawn.body("shaft", mass="1 kg", centre="0, 0, 0 mm", inertia="1e-3, 1e-3, 1e-3 kg m^2")
    drawn.revolute("bore", "ground", "shaft", point="0, 0, 0 mm", axis=[0, 0, 1])
    drawn.clearance("bore", radius="6 mm", radial="20 um", length="20 mm", axial_lower="50 um")
    result = td.simulate(drawn.case())
    assert result.attrs["start"] == "centred"
    assert "nothing holds along its axis" in str(result.attrs["warnings"])


def test_the_vane_with_clearance_in_every_joint_begins_in_equilibrium() -> None:
    # Its stiffness is singular but for the springs under the nodes: singular values have to be exact.
    assert MechanismSystem(td.load_case("vsv-joints")).start() is not None


@pytest.mark.parametrize("length", ["6 mm", "12 mm"])
def test_a_shaft_that_tilts_in_a_short_bore_begins_in_equilibrium(length: str) -> None:
    # Tilted by twice the clearance over the length its end face is further away than the clearance.
    system = MechanismSystem(td.load_case("vsv-free", {"joints.trunnion.clearance.length": length}))
    assert system.start() is not None


def test_who_asks_for_the_middle_gets_it() -> None:
    system = MechanismSystem(parsed(DRIVEN + WRIST + 'start = "centred"\n'))
    assert system.start() is None
    np.testing.assert_array_equal(system.problem(1e-3).y0, system.assembly.state)


def test_loads_that_balance_beyond_the_contact_law_are_no_equilibrium() -> None:
    # A star in whose faces, 0.35 mm deep in each other, 134 MN balance. Its loads are a few newtons.
    _, _, star = twins(1618, 4e-3)
    result = td.simulate(star.case())
    assert not result.attrs["failure"]
    assert float(abs(result["reaction_force"]).max()) < 1e3


def test_the_search_can_be_stopped_and_takes_up_no_memory_of_it() -> None:
    case, asked = td.load_case("vsv-joints"), []

    def at_the_third() -> bool:
        asked.append(None)
        return len(asked) == 3

    system = MechanismSystem(case)
    with asked_of(at_the_third), pytest.raises(Stopped):
        system.start()
    assert len(asked) == 3
    whole = system.start()
    np.testing.assert_array_equal(whole, MechanismSystem(case).start())


def test_a_run_that_is_stopped_before_it_begins_says_so() -> None:
    with pytest.raises(Stopped, match="nothing was saved"):
        td.simulate(td.load_case("four-bar"), stop=lambda: True)


SHAPES = {
    "cylinder": 'radius = "9.5 mm"\nradial = "20 um"\nlength = "20 mm"',
    "faces": 'radius = "9.5 mm"\nradial = "20 um"\nlength = "20 mm"\naxial = "50 um"',
    "piston": 'radius = "9.5 mm"\nradial = "20 um"\nlength = "30 mm"\npin_length = "20 mm"',
    "sphere": 'radius = "9.5 mm"\nradial = "20 um"',
    "ball": 'radius = "9.5 mm"\nradial = "20 um"',
}
WRIST_JOINT = 'type = "revolute"\nbetween = ["rod", "slider"]'
TYPES = {"faces": "revolute", "sphere": "spherical", "ball": "pin-slot"}


@pytest.mark.parametrize(
    "between", ['["rod", "slider"]', pytest.param('["slider", "rod"]', marks=pytest.mark.long)]
)
@pytest.mark.parametrize("socket", ["rod", "slider"])
@pytest.mark.parametrize("shape", SHAPES)
def test_a_start_is_in_equilibrium_whichever_body_carries_the_bore(shape, socket, between):
    # At dead centre the rod turns at 218 rad/s and its angular acceleration is zero. A pin
    # that is displaced by 20 um and at rest in the axes of the wrong body approaches its bore at 4 mm/s.
    drawn = DRIVEN.replace(WRIST_JOINT, f'type = "{TYPES.get(shape, "cylindrical")}"\nbetween = {between}')
    case = parsed(
        f'{drawn}\n[joints.wrist.clearance]\n{SHAPES[shape]}\nsocket = "{socket}"\n'
        'friction_coefficient = 0.0\nnodes_around = 48\nnodes_along = 6\n[run]\nduration = "1 us"\n'
    )
    result = td.simulate(case)
    assert result.attrs["start"] == "equilibrium"
    first = result["angular_acceleration"].isel(time=0).sel(body="rod")
    assert float(abs(first).max()) < 5.0
