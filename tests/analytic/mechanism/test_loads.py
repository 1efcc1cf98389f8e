"""Each kind of load against a closed form, in all mechanisms, and the power that it puts in."""

from typing import Any

import numpy as np
import pytest
import xarray as xr

import tribodyn as td
from tribodyn.core.errors import InputError
from tribodyn.mechanisms.catalogue import parse_case

CLOSE = 1e-8  #: Motions at a relative tolerance of 1e-10 against closed forms.
SAME = 1e-9  #: Power of a load by hand against the rate of the kinetic energy, at output times.
INERTIA, MASS, RADIUS = 0.02, 2.0, 0.25


def disc(loads: str, speed: str = "", duration: str = "0.5 s") -> Any:
    """Return a disc that turns freely about Z, and a block that slides freely along X."""
    start = f'start_speed = "{speed}"' if speed else ""
    return parse_case(
        f"""
case = "mechanism"
run = {{ duration = "{duration}", output_interval = "20 ms" }}
solver.rtol = 1e-10
[bodies]
disc = {{ mass = "1 kg", centre = "0, 0, 0 m", inertia = "0.02, 0.02, {INERTIA} kg m^2" }}
block = {{ mass = "{MASS} kg", centre = "0, 0, 1 m", inertia = "0.02, 0.02, 0.02 kg m^2" }}
[joints.pivot]
type = "revolute"
between = ["ground", "disc"]
point = "0, 0, 0 m"
axis = [0, 0, 1]
{start}
[joints.rail]
type = "prismatic"
between = ["ground", "block"]
point = "0, 0, 1 m"
axis = [1, 0, 0]
start_velocity = "0.8 m/s"
{loads}
""",
        "test",
    )


def turned(result: xr.Dataset) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Return times, angle, speed and acceleration of the disc."""
    assert not result.attrs["failure"], result.attrs["failure"]
    of_disc = result.sel(body="disc", axis="z")
    angle = result.joint_angle.sel(joint="pivot").values
    speed, rate = of_disc.angular_velocity.values, of_disc.angular_acceleration.values
    return result.time.values, angle, speed, rate


def slid(result: xr.Dataset) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return times, velocity and acceleration of the block."""
    of_block = result.sel(body="block", axis="x")
    return result.time.values, of_block.velocity.values, of_block.acceleration.values


def same_power(torque: np.ndarray, speed: np.ndarray, rate: np.ndarray, inertia: float) -> None:
    """Check that the power of a torque (or force) is the rate of the kinetic energy."""
    wanted = inertia * rate * speed
    np.testing.assert_allclose(torque * speed, wanted, rtol=0.0, atol=SAME * np.abs(wanted).max())


FORCE = 'body = "disc"\npoint = "250, 0, 0 mm"\nforce = "3 N"\ndirection = [0, 1, 0]\n'


def test_a_follower_is_a_constant_moment_and_a_fixed_force_is_not() -> None:
    times, angle, speed, rate = turned(td.simulate(disc(f'[loads.push]\n{FORCE}frame = "body"\n')))
    moment = 3.0 * RADIUS
    np.testing.assert_allclose(angle, 0.5 * moment / INERTIA * times**2, atol=CLOSE * angle.max())
    same_power(np.full(times.shape, moment), speed, rate, INERTIA)
    result = td.simulate(disc(f"[loads.push]\n{FORCE}"))
    times, angle, speed, rate = turned(result)
    # The work of a force that is fixed in space is force times displacement along it.
    energy, work = 0.5 * INERTIA * speed**2, moment * np.sin(angle)
    np.testing.assert_allclose(energy, work, atol=1e-7 * work.max())
    same_power(moment * np.cos(angle), speed, rate, INERTIA)
    np.testing.assert_allclose(result.energy_in, work, atol=1e-4 * work.max())


def test_a_force_against_the_velocity_slows_down_by_its_table_over_the_speed() -> None:
    """A constant force, a force in proportion to the speed, and a moment in proportion to it."""
    brake = 'frame = "motion"\nslip_velocity = "1e-9 m/s"\nslip_rate = "1e-9 rad/s"\n'
    constant = f'[loads.brake]\nbody = "block"\nforce = "1 N"\n{brake}'
    times, velocity, rate = slid(td.simulate(disc(constant)))
    np.testing.assert_allclose(velocity, 0.8 - times / MASS, atol=CLOSE)
    same_power(np.full(times.shape, -1.0), velocity, rate, MASS)
    for line in ("", "direction = [1, 0, 0]\n"):
        table = '[loads.drag]\nbody = "block"\nforce = { velocities = "0, 1 m/s", values = "0, 6 N" }\n'
        times, velocity, rate = slid(td.simulate(disc(table + line + brake)))
        np.testing.assert_allclose(velocity, 0.8 * np.exp(-6.0 * times / MASS), atol=CLOSE)
        same_power(-6.0 * velocity, velocity, rate, MASS)
    fan = '[loads.fan]\nbody = "disc"\nmoment = { speeds = "0, 20 rad/s", values = "0, 2 N m" }\n'
    times, _, speed, rate = turned(td.simulate(disc(fan + brake, "10 rad/s")))
    np.testing.assert_allclose(speed, 10.0 * np.exp(-0.1 * times / INERTIA), atol=10.0 * CLOSE)
    same_power(-0.1 * speed, speed, rate, INERTIA)


ALONG = '[loads.gas]\nbody = "disc"\ndirection = [0, 0, 1]\nalong = "pivot"\n'


def test_a_table_over_the_speed_of_a_joint_and_a_map_over_its_angle_too() -> None:
    speeds = 'moment = { speeds = "0, 20 rad/s", values = "0, -2 N m" }\n'
    times, _, speed, rate = turned(td.simulate(disc(ALONG + speeds, "10 rad/s")))
    np.testing.assert_allclose(speed, 10.0 * np.exp(-0.1 * times / INERTIA), atol=10.0 * CLOSE)
    same_power(-0.1 * speed, speed, rate, INERTIA)
    # M = −c θ ω, so that I dω/dθ = −c θ: ω = ω₀ − c θ²/2I.
    grid = 'angles = "0, 2, 6 rad", speeds = "0, 10 rad/s", values = "0, 0, 0, -0.2, 0, -0.6 N m"'
    result = td.simulate(disc(f"{ALONG}moment = {{ {grid} }}\n", "10 rad/s", "0.4 s"))
    _, angle, speed, rate = turned(result)
    assert angle[-1] > 2.5
    np.testing.assert_allclose(speed, 10.0 - 0.01 * angle**2 / (2.0 * INERTIA), atol=10.0 * CLOSE)
    same_power(-0.01 * angle * speed, speed, rate, INERTIA)


DRIVEN = '[drives.motor]\njoint = "pivot"\nspeed = "50 rad/s"\n'


def test_a_table_over_an_angle_repeats_after_whole_turns_and_one_over_time_does_not() -> None:
    knots = np.array([0.0, 90.0, 180.0, 270.0, 360.0])
    gas = f'{ALONG}moment = {{ angles = "0, 90, 180, 270, 360 deg", values = "0, 1, 0, -2, 0 N m" }}\n'
    clock = '[loads.clock]\nbody = "block"\nforce_z = { times = "0, 0.1, 0.2 s", values = "4, 5, 7 N" }\n'
    case = disc(gas + clock + DRIVEN, duration="0.4 s")
    result = td.simulate(case.replace({"run.output_interval": "10 ms", "run.step_rows": 0}))
    times, angle, _, _ = turned(result)
    assert angle[-1] > 6.0 * np.pi
    from scipy.interpolate import CubicSpline

    wanted = CubicSpline(np.radians(knots), [0.0, 1.0, 0.0, -2.0, 0.0], bc_type="periodic")(angle)
    np.testing.assert_allclose(-result.drive_moment.sel(joint="pivot"), wanted, atol=1e-9)
    held = np.where(times < 0.2, 4.0 + 5.0 * times + 50.0 * times**2, 7.0)
    np.testing.assert_allclose(-result.reaction_force_global.sel(joint="rail", axis="z"), held, atol=1e-9)


def test_a_span_is_its_resultant_at_its_centroid() -> None:
    """Half of 200 N/m over 100 mm is 10 N; it acts two thirds along, and 50 mm farther from the joint."""
    beam = (
        '[loads.snow]\nbody = "block"\npoint = "50, 0, 1000 mm"\nspan_axis = [1, 0, 0]\n'
        'direction = [0, 0, -1]\nspan = { positions = "0, 100 mm", values = "0, 200 N/m" }\n'
    )
    for size, force in (("", 10.0), ('force = "30 N"\n', 30.0)):
        result = td.simulate(disc(beam + size, duration="0.02 s"))
        rail = result.sel(joint="rail").isel(time=0)
        np.testing.assert_allclose(rail.reaction_force_global, [0.0, 0.0, force], atol=1e-9)
        arm = 0.05 + 0.2 / 3.0
        np.testing.assert_allclose(rail.reaction_moment_global, [0.0, -arm * force, 0.0], atol=1e-9)


def test_a_python_function_takes_the_place_of_a_load() -> None:
    case = disc(f'{ALONG}moment = "1 N m"\n{DRIVEN}', duration="0.3 s")
    result = td.simulate(case, loads={"gas": lambda angle, t: np.sin(2.0 * angle) * (1.0 + t)})
    times, angle, _, _ = turned(result)
    wanted = np.sin(2.0 * angle) * (1.0 + times)
    np.testing.assert_allclose(-result.drive_moment.sel(joint="pivot"), wanted, atol=1e-4)
    swung = td.simulate(
        case, drive=lambda t: 50.0 + 0.0 * t, loads={"gas.moment": lambda angle: 2.0 + 0.0 * angle}
    )
    np.testing.assert_allclose(swung.drive_moment.sel(joint="pivot"), -2.0, atol=1e-9)
    with pytest.raises(InputError, match="it must repeat after a whole turn"):
        td.simulate(case, loads={"gas": lambda angle: angle})
    with pytest.raises(InputError, match="there is no load 'wind'; allowed: gas"):
        td.simulate(case, loads={"wind": lambda t: t})
    free = disc(f'{ALONG}moment = "1 N m"\n')
    with pytest.raises(InputError, match="a case with one drive"):
        td.simulate(free, drive=lambda t: t)


VANE = """
case = "vsv"
run = { duration = "40 ms", output_interval = "1 ms" }
[loads]
air_force_x = "0 N"
air_force_y = "0 N"
air_moment = "0 N m"
[loads.more.gas]
"""


def test_loads_on_the_vane_turn_with_it_and_follow_its_speed() -> None:
    result = td.simulate(parse_case(f'{VANE}frame = "body"\nforce_x = "3 N"\npoint = "0, 20, -90 mm"\n', "x"))
    theta = result.theta_v.values
    np.testing.assert_allclose(result.F_airx, 3.0 * np.cos(theta), atol=1e-9)
    np.testing.assert_allclose(result.F_airy, 3.0 * np.sin(theta), atol=1e-9)
    np.testing.assert_allclose(result.M_air, -0.06, atol=1e-9)
    assert result.attrs["energy_residual"] < 1e-4
    fixed = td.simulate(parse_case(f'{VANE}force_x = "3 N"\npoint = "0, 20, -90 mm"\n', "x"))
    np.testing.assert_allclose(fixed.F_airx, 3.0, rtol=1e-12)
    np.testing.assert_allclose(fixed.M_air, -0.06 * np.cos(fixed.theta_v), atol=1e-9)
    over = 'moment = { speeds = "-1, 0, 1 rad/s", values = "0.5, 0, -0.5 N m" }\nalong = "crank"\n'
    drag = td.simulate(parse_case(VANE + over, "x"))
    np.testing.assert_allclose(drag.M_air, -0.5 * drag.omega_a, atol=1e-9)
    work = np.trapezoid(drag.M_air * drag.omega_v, drag.time)
    assert float(drag.energy_loads[-1]) == pytest.approx(work, rel=2e-2)


PULSE = '{ pulse = "4 N", begin = "5 ms", length = "10 ms" }'
PASSING = '{ value = "1 N", amplitude = "2 N", order = 3, shaft_speed = "12000 rpm", phase = "90 deg" }'


def pulse(t: np.ndarray) -> np.ndarray:
    """Return the force of the pulse above [N]."""
    return np.where((t > 0.005) & (t < 0.015), 4.0 * np.sin(np.pi * (t - 0.005) / 0.010) ** 2, 0.0)


def passing(t: np.ndarray) -> np.ndarray:
    """Return the force of the passing blades above [N]: 3 waves a turn, 200 turns a second."""
    return 1.0 + 2.0 * np.cos(2.0 * np.pi * 600.0 * t)


@pytest.mark.parametrize(("force", "wanted"), [(PULSE, pulse), (PASSING, passing)])
def test_pulses_and_passing_blades_have_the_same_keys_in_all_models(force: str, wanted: Any) -> None:
    vane = td.simulate(parse_case(f"{VANE}force_x = {force}\n", "x"))
    np.testing.assert_allclose(vane.F_airx, wanted(vane.time.values), atol=4e-6)
    free = disc(f'[loads.gust]\nbody = "block"\nforce_x = {force}\n').replace({"run.output_interval": "1 ms"})
    times, velocity, rate = slid(td.simulate(free))
    np.testing.assert_allclose(MASS * rate, wanted(times), atol=4e-6)
    assert velocity[-1] == pytest.approx(0.8 + _impulse(wanted) / MASS, rel=1e-8)


def _impulse(force: Any) -> float:
    """Return what a force gives in half a second [N s]: whole waves, and half the height of a pulse."""
    return 0.5 * 4.0 * 0.010 if force is pulse else 0.5


def test_a_short_pulse_is_not_leapt_over() -> None:
    load = '[loads.knock]\nbody = "block"\nforce_x = { pulse = "8 kN", begin = "0.3 s", length = "0.1 ms" }\n'
    for rtol in (1e-3, 1e-6):
        _, velocity, _ = slid(td.simulate(disc(load).replace({"solver.rtol": rtol})))
        assert velocity[-1] == pytest.approx(0.8 + 0.5 * 8e3 * 1e-4 / MASS, rel=5.0 * rtol)


REFUSED = {
    'force_x = { pulse = "1 N" }\n': "a pulse needs its length",
    'force_x = { value = "1 N", begin = "1 s" }\n': "only a pulse has a begin",
    'force_x = { amplitude = "1 N", order = 3 }\n': "order and shaft_speed go together",
    'force_x = { pulse = "1 N", length = "1 s", swing = "1 N" }\n': "give either",
    'force = "1 N"\n': "a load needs its direction",
    'frame = "body"\n': "a load needs a force or a moment",
    'force = { angles = "0, 90 deg", values = "0, 1 N" }\ndirection = [1, 0, 0]\n': "needs the joint",
    'force = { velocities = "0, 9 m/s", values = "0, 1 N" }\ndirection = [1, 0, 0]\n': "needs the joint",
    'moment_z = { positions = "0, 9 m", values = "0, 1 N m" }\nalong = "pivot"\n': "has no position",
    'moment_z = { times = "0, 1 s", values = "0, 1 N m" }\nalong = "pivot"\n': "a table over angles",
    'force = "1 N"\nmoment = "1 N m"\nframe = "motion"\n': "write two loads",
    'force_x = "1 N"\nframe = "motion"\n': "a direction restricts it",
    'force_x = "1 N"\nspan = { positions = "0, 9 mm", values = "1, 1 N/m" }\n': "span_axis",
    'direction = [0, 0, 0]\nforce = "1 N"\n': "a length above zero",
    'span_axis = [1, 0, 0]\nforce_x = "1 N"\n'
    'span = { positions = "-9, 9 mm", values = "-1, 1 N/m" }\n': "cancel",
    'force_x = { angles = "0, 9 deg", positions = "0, 9 mm", values = "0, 1, 1, 0 N" }\n': "give either",
}


@pytest.mark.parametrize("text", REFUSED)
def test_what_is_no_load_is_refused_with_what_to_change(text: str) -> None:
    with pytest.raises(InputError, match=REFUSED[text]):
        td.simulate(disc(f'[loads.wrong]\nbody = "disc"\n{text}'))


def test_components_and_a_direction_are_the_same_load() -> None:
    parts = '[loads.push]\nbody = "disc"\npoint = "250, 0, 0 mm"\nframe = "body"\n'
    one = td.simulate(disc(f'{parts}force = "5 N"\ndirection = [0.6, 0.8, 0]\nmoment_z = "0.1 N m"\n'))
    two = td.simulate(disc(f'{parts}force_x = "3 N"\nforce_y = "4 N"\nmoment_z = "0.1 N m"\n'))
    np.testing.assert_allclose(one.joint_angle, two.joint_angle, rtol=1e-9)
