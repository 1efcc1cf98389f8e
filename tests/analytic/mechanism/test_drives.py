"""Motors, controllers, base motion and cyclic tables against closed forms, with the energy they put in."""

import math
from collections.abc import Callable, Iterator

import numpy as np
import pytest
import xarray as xr

import tribodyn as td
from mebdf.arrays import FloatArray
from tribodyn.core.errors import InputError
from tribodyn.mechanisms.results import summarise

INERTIA = 1e-2
RUN = {"output_interval": "1 ms"}


def wheel(duration: str, **run: object) -> td.Mechanism:
    """Return a wheel of 0.01 kg m² on a fixed axle."""
    drawn = td.Mechanism("Wheel", run={"duration": duration, **RUN, **run}, solver={"rtol": 1e-9})
    drawn.body("wheel", mass="1 kg", centre="0, 0, 0 m", inertia=f"5e-3, 5e-3, {INERTIA} kg m^2")
    return drawn.revolute("axle", "ground", "wheel", point="0, 0, 0 m", axis=[0, 0, 1])


def slide(duration: str, mass: float = 2.0, gravity: float = 0.0) -> td.Mechanism:
    """Return a mass on a straight guide along x."""
    drawn = td.Mechanism(
        "Slide", gravity=f"{-gravity}, 0, 0 m/s^2", run={"duration": duration, **RUN}, solver={"rtol": 1e-9}
    )
    drawn.body("mass", mass=f"{mass} kg", centre="0, 0, 0 m", inertia="1e-3, 1e-3, 1e-3 kg m^2")
    return drawn.prismatic("guide", "ground", "mass", point="0, 0, 0 m", axis=[1, 0, 0])


def balanced(result: xr.Dataset, within: float = 1e-6) -> None:
    """Require that the work of the drives is all there is: it becomes kinetic energy and heat."""
    assert result.attrs["failure"] == ""
    assert result.attrs["energy_residual"] < within
    assert float(abs(result["energy_in"]).max()) > 0.0


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_dc_motor_runs_up_by_an_exponential(sign: float) -> None:
    stall, most = sign * 2.0, sign * 100.0
    drawn = wheel("0.3 s").motor(
        "dc", joint="axle", stall_torque=f"{stall} N m", no_load_speed=f"{most} rad/s"
    )
    result = td.simulate(drawn)
    # J ω̇ = M₀ (1 − ω/ω₀): a time constant of J ω₀/M₀.
    expected = -most * np.expm1(-result["time"].values * stall / (INERTIA * most))
    assert result["angular_velocity"].values[:, 0, 2] == pytest.approx(expected, abs=1e-6)
    torque = result["element_moment"].values[:, 0]
    assert torque == pytest.approx(stall * (1.0 - expected / most), abs=1e-7)
    balanced(result)
    assert float(result["energy_in"][-1]) == pytest.approx(0.5 * INERTIA * expected[-1] ** 2, rel=1e-6)


def test_a_linear_motor_by_a_table_holds_a_weight_at_the_velocity_of_its_curve() -> None:
    # F = 100 N − 50 N/(m/s) v as a table, against 2 kg · 10 m/s²: 1.6 m/s in the end.
    velocities = np.linspace(-1.0, 3.0, 9)
    drawn = slide("0.5 s", gravity=10.0).motor(
        "linear", joint="guide", force={"velocities": velocities, "values": 100.0 - 50.0 * velocities}
    )
    result = td.simulate(drawn)
    expected = -1.6 * np.expm1(-result["time"].values * 50.0 / 2.0)
    assert result["velocity"].values[:, 0, 0] == pytest.approx(expected, abs=1e-8)
    balanced(result)


def pid(
    set_value: Callable[[float], float],
    step: Callable[[float, float, float], tuple[float, float]],
    *,
    gain: float,
    times: tuple[float, float],
    sampling: float,
    limit: float = math.inf,
    rate: bool = False,
) -> Iterator[tuple[float, float, float]]:
    """Yield position, velocity and output at sampling times; ``step`` leads from one to the next."""
    integral, derivative = times
    x = v = total = 0.0
    last, k = math.nan, 0
    while True:
        error = set_value(k * sampling) - (v if rate else x)
        change = 0.0 if k == 0 else error - last
        u = gain * (error + (total + sampling * error) / integral + derivative * change / sampling)
        if abs(u) <= limit or u * gain * error <= 0.0:
            total += sampling * error
        u = float(np.clip(u, -limit, limit))
        yield x, v, u
        last, k = error, k + 1
        x, v = step(x, v, u)


# The first output is 21 N m, 20 N m without the sum: a limit between the two is reached all the same.
@pytest.mark.parametrize("limit", [math.inf, 20.5, 3.0])
def test_an_inertia_under_pid_follows_the_closed_form_between_samples(limit: float) -> None:
    drawn = wheel("0.2 s").controller(
        "servo",
        joint="axle",
        angle={"value": "1 rad", "amplitude": "0.2 rad", "angular_frequency": "40 rad/s"},
        angle_gain="20 N m/rad",
        integral_time="100 ms",
        derivative_time="30 ms",
        sampling_time="5 ms",
        **({} if limit == math.inf else {"torque_limit": f"{limit} N m"}),
    )
    result, h = td.simulate(drawn), 5e-3

    def step(x: float, v: float, u: float) -> tuple[float, float]:
        return x + h * v + 0.5 * h * h * u / INERTIA, v + h * u / INERTIA

    loop = pid(
        lambda t: 1.0 + 0.2 * math.sin(40.0 * t), step, gain=20.0, times=(0.1, 0.03), sampling=h, limit=limit
    )
    expected = np.array([next(loop) for _ in range(41)])
    assert result["joint_angle"].values[::5, 0] == pytest.approx(expected[:, 0], abs=1e-8)
    assert result["angular_velocity"].values[::5, 0, 2] == pytest.approx(expected[:, 1], abs=1e-6)
    # A row at a sampling time holds what was held before it.
    assert result["element_moment"].values[5::5, 0] == pytest.approx(expected[:-1, 2], abs=1e-6)
    assert (np.max(np.abs(expected[:, 2])) == limit) == (limit < math.inf)
    balanced(result, 1e-9)


def test_speed_under_pi_control_of_a_damped_inertia() -> None:
    friction, h = 0.05, 4e-3
    drawn = wheel("0.2 s").controller(
        "governor",
        joint="axle",
        speed="50 rad/s",
        speed_gain="0.4 N m s/rad",
        integral_time="40 ms",
        sampling_time="4 ms",
    )
    drawn.torsion_spring("oil", joint="axle", preload="1e-9 N m", damping=f"{friction} N m s/rad")
    result = td.simulate(drawn)
    decay = math.exp(-friction * h / INERTIA)

    def step(x: float, v: float, u: float) -> tuple[float, float]:
        return 0.0, v * decay + u / friction * (1.0 - decay)

    loop = pid(lambda t: 50.0, step, gain=0.4, times=(0.04, 0.0), sampling=h, rate=True)
    expected = np.array([next(loop) for _ in range(51)])
    assert result["angular_velocity"].values[::4, 0, 2] == pytest.approx(expected[:, 1], abs=1e-5)
    balanced(result)


def test_a_position_controller_moves_a_slide_to_its_set_value() -> None:
    drawn = slide("1 s").controller(
        "axis", joint="guide", position="20 mm", position_gain="2 N/mm", derivative_time="60 ms",
        sampling_time="2 ms", force_limit="30 N",
    )  # fmt: skip
    result = td.simulate(drawn)
    assert float(result["position"][-1, 0, 0]) == pytest.approx(0.02, rel=1e-3)
    assert float(abs(result["element_force"]).max()) == 30.0
    balanced(result, 1e-9)


def test_a_function_is_evaluated_at_sampling_times_alone_with_what_it_names() -> None:
    drawn = wheel("50 ms").controller("servo", joint="axle", sampling_time="2 ms", torque_limit="1 N m")
    drawn.output("turned-by", "wheel", quantity="angle", along=[0, 0, 1])
    called: list[tuple[float, ...]] = []

    def function(t: float, angle: float, speed: float, turned_by: float) -> float:
        called.append((t, angle, speed, turned_by))
        return 0.5 if t < 0.02 else -5.0 * speed

    result = td.simulate(drawn, controllers={"servo": function})
    t, angle, speed, measured = np.array(called[-25:]).T
    assert t == pytest.approx(2e-3 * np.arange(25), abs=1e-15)
    assert angle == pytest.approx(measured, abs=1e-12)
    x = v = 0.0
    for k in range(25):
        assert (angle[k], speed[k]) == pytest.approx((x, v), abs=1e-9)
        u = 0.5 if t[k] < 0.02 else float(np.clip(-5.0 * v, -1.0, 1.0))
        x, v = x + 2e-3 * v + 2e-6 * u / INERTIA, v + 2e-3 * u / INERTIA
    balanced(result, 1e-9)


def test_functions_that_do_not_fit_are_refused_and_failing_ones_end_the_run() -> None:
    drawn = wheel("10 ms").controller("servo", joint="axle", sampling_time="2 ms")
    for functions, words in (
        ({}, r"controllers\.servo: without a gain it needs a function: td\.simulate"),
        ({"servos": lambda t: 0.0}, 'controllers: .*did you mean "servo"'),
        ({"servo": lambda force: 0.0}, "its argument is force; allowed: t, angle, speed"),
        ({"servo": 3.0}, "its argument is float"),
    ):
        with pytest.raises(InputError, match=words):
            td.simulate(drawn, controllers=functions)
    with pytest.raises(InputError, match='"vsv" has no controllers'):
        td.simulate("vsv", controllers={"servo": lambda t: 0.0})
    ended = td.simulate(drawn, controllers={"servo": lambda t: 1.0 / (0.004 - t)})
    assert "servo raised ZeroDivisionError" in ended.attrs["failure"]
    assert float(ended["time"][-1]) == pytest.approx(4e-3)
    lost = td.simulate(drawn, controllers={"servo": lambda t: math.nan})
    assert "servo returned nan" in lost.attrs["failure"]


def shaken(frequency: float, damping: float) -> FloatArray:
    """Return the motion of a mass on spring and damper on a base that is shaken, over the last ten cycles."""
    k, m, omega = 400.0, 1.0, 2.0 * math.pi * frequency
    c, period = 2.0 * damping * math.sqrt(k * m), 1.0 / frequency
    times = np.linspace(0.0, period, 65)
    drawn = td.Mechanism(
        "Shaker", run={"cycles": 60, "output_interval": f"{period / 32} s"}, solver={"rtol": 1e-8}
    )
    drawn.body("table", mass="1 kg", centre="0, 0, 0 m", inertia="1e-3, 1e-3, 1e-3 kg m^2")
    drawn.body("mass", mass=f"{m} kg", centre="0, 0.5, 0 m", inertia="1e-3, 1e-3, 1e-3 kg m^2")
    drawn.prismatic("base", "ground", "table", point="0, 0, 0 m", axis=[0, 1, 0])
    drawn.prismatic("guide", "ground", "mass", point="0, 0.5, 0 m", axis=[0, 1, 0])
    ends = {"first_point": "0, 0, 0 m", "second_point": "0, 0.5, 0 m"}
    drawn.spring("leg", "table", "mass", **ends, stiffness=f"{k} N/m", damping=f"{c} N s/m")
    values = 1e-3 * np.sin(omega * times)
    values[-1] = values[0]
    drawn.drive("shake", "base", position={"times": times, "values": values, "cyclic": True})
    result = td.simulate(drawn)
    # After each restart, one a cycle, work is integrated by a straight line.
    balanced(result, 1e-4)
    found: FloatArray = result["position"].values[-321:, 1, 1] - 0.5
    return found


@pytest.mark.parametrize(
    ("ratio", "damping"),
    [
        (1.0, 0.2),
        pytest.param(0.5, 0.1, marks=pytest.mark.long),
        pytest.param(2.5, 0.1, marks=pytest.mark.long),
    ],
)
def test_a_mass_on_a_shaken_base_moves_by_the_transmissibility(ratio: float, damping: float) -> None:
    found = shaken(ratio * 20.0 / (2.0 * math.pi), damping)
    share = (2.0 * damping * ratio) ** 2
    # Den Hartog, Mechanical Vibrations, section 2.12.
    expected = 1e-3 * math.sqrt((1.0 + share) / ((1.0 - ratio**2) ** 2 + share))
    # Root mean square over ten whole cycles; the table's spline is a sine to 1e-6.
    amplitude = math.sqrt(2.0 * float(np.mean(found[:-1] ** 2)))
    assert amplitude == pytest.approx(expected, rel=1e-4)


def test_a_cyclic_angle_goes_on_turning_and_a_cyclic_torque_comes_again() -> None:
    table = {"times": "0, 25, 50, 75, 100 ms", "values": "0, 90, 180, 270, 360 deg", "cyclic": True}
    result = td.simulate(wheel("0.35 s", output_interval="5 ms").drive("crank", "axle", angle=table))
    turned = result["joint_angle"].values[:, 0]
    assert turned == pytest.approx(20.0 * math.pi * result["time"].values, abs=1e-9)
    drawn = wheel("0.35 s").drive(
        "push",
        "axle",
        torque={
            "times": "0, 40, 60, 100 ms",
            "values": "1, 1, -1, -1 N m",
            "cyclic": True,
            "interpolation": "linear",
        },
    )
    result = td.simulate(drawn)
    # Over each cycle the torque gives nothing; a speed is there only within.
    assert result["angular_velocity"].values[::100, 0, 2] == pytest.approx(np.zeros(4), abs=1e-8)
    assert float(result["angular_velocity"][250, 0, 2]) == pytest.approx((0.04 + 0.005) / INERTIA, abs=1e-8)
    # Work is integrated by parabolas over steps, which here are as long as a ramp.
    balanced(result, 1e-4)


def test_cyclic_motions_that_jump_are_refused() -> None:
    for given, words in (
        ({"angle": {"times": "0, 1 s", "values": "0, 90 deg"}}, "ends where it begins, or whole turns on"),
        ({"speed": {"times": "0, 1 s", "values": "0, 9 rpm"}}, "a cyclic motion ends where it begins"),
        ({"torque": {"times": "1, 2 s", "values": "0, 9 N m"}}, "times that begin at 0 s"),
        ({"torque": {"value": "1 N m"}}, "cyclic: given true; a cyclic table is one over times"),
    ):
        (key, table), *_ = given.items()
        with pytest.raises(InputError, match=words):
            wheel("1 s").drive("motor", "axle", **{key: {**table, "cyclic": True}}).case()


@pytest.mark.parametrize(
    ("run", "wear", "words"),
    [
        ({"analysis": "static", "cycles": 1}, {}, "acts in dynamic runs alone"),
        ({"cycles": 1}, {"cycles": 100}, "begins anew in each cycle of a wear campaign"),
    ],
)
def test_where_a_controller_would_not_act_it_is_refused(run, wear, words):
    drawn = td.Mechanism("Wheel", run=run, wear=wear)
    drawn.body("wheel", mass="1 kg", centre="0, 0, 0 m", inertia="5e-3, 5e-3, 1e-2 kg m^2")
    drawn.revolute("axle", "ground", "wheel", point="0, 0, 0 m", axis=[0, 0, 1])
    drawn.clearance("axle", radius="10 mm", radial="20 um", length="20 mm")
    drawn.controller("servo", joint="axle", speed="9 rpm", speed_gain="1 N m s/rad", sampling_time="1 ms")
    drawn.drive("motor", "axle", torque={"amplitude": "1 N m", "angular_frequency": "9 rad/s"})
    with pytest.raises(InputError, match=rf"controllers\.servo: a controller {words}"):
        drawn.case()


def test_the_integrators_of_scipy_hold_outputs_too() -> None:
    drawn = wheel("20 ms").controller(
        "servo", joint="axle", angle="1 rad", angle_gain="20 N m/rad", sampling_time="5 ms"
    )
    ours = td.simulate(drawn)
    theirs = td.simulate(drawn.case().replace({"solver.name": "radau"}))
    assert theirs["joint_angle"].values == pytest.approx(ours["joint_angle"].values, abs=1e-7)


def test_a_measured_angle_counts_whole_turns() -> None:
    drawn = wheel("1 s", output_interval="10 ms").drive("motor", "axle", speed="300 rpm")
    drawn.body("pointer", mass="1 kg", centre="1, 0, 0 m", inertia=f"1, 1, {INERTIA} kg m^2")
    drawn.revolute("free", "ground", "pointer", point="1, 0, 0 m", axis=[0, 0, 1])
    drawn.controller("copy", joint="free", sampling_time="20 ms").output(
        "turned", "wheel", quantity="angle", along=[0, 0, 1]
    )
    seen: list[float] = []
    td.simulate(drawn, controllers={"copy": lambda turned: seen.append(turned) or 0.0})
    assert seen[-50:] == pytest.approx(10.0 * math.pi * 0.02 * np.arange(50), abs=1e-9)


def test_a_controller_and_a_table_whose_instants_meet_have_one_breakpoint_there() -> None:
    # 0.3 s as 3 · 0.1 s, and as the knot of a table.
    drawn = wheel("0.5 s", output_interval="10 ms").controller(
        "servo", joint="axle", angle="0.1 rad", angle_gain="1 N m/rad", sampling_time="100 ms"
    )
    ramp = {"times": "0, 0.3, 0.3, 0.5 s", "values": "0, 1, 1, 0 N m", "interpolation": "linear"}
    drawn.load("push", "wheel", moment_z=ramp)
    # Work is integrated by parabolas over steps, which here are as long as a ramp.
    balanced(td.simulate(drawn), 1e-4)


def test_a_constant_force_is_at_its_peak_where_it_is_fastest() -> None:
    """From rest by 4 N over 2 kg for 0.5 s: 1 m/s in the end."""
    told = summarise(td.simulate(slide("0.5 s").drive("push", "guide", force="4 N")))
    assert told["drive_velocity_at_peak_m_per_s"] == pytest.approx(1.0)
