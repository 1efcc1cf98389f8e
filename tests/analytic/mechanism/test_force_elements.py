"""Distance joint and forces of elements against closed forms: periods, rebounds, terminal speed."""

import math
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from scipy.special import ellipk, gamma

import tribodyn as td
from tribodyn.contact import DAMPING_FACTORS
from tribodyn.core.errors import InputError
from tribodyn.friction import FrictionLimit
from tribodyn.mechanism.builder.mechanism_builder import Mechanism

G = 9.81
BALL = {"mass": "1 kg", "inertia": "1e-3, 1e-3, 1e-3 kg m^2"}


def slider(duration: str, speed: float = 0.0, gravity: float = 0.0, interval: str = "1 ms") -> Mechanism:
    """Return 1 kg on a guide along z."""
    run = {"duration": duration, "output_interval": interval}
    found = Mechanism("Slider", gravity=f"0, 0, {-gravity} m/s^2", run=run, solver={"rtol": 1e-9})
    found.body("block", centre="0, 0, 0 mm", **BALL)
    return found.prismatic(
        "guide", "ground", "block", point="0, 0, 0 mm", axis=[0, 0, 1], start_velocity=f"{speed} m/s"
    )


def wheel(duration: str, speed: float = 0.0) -> Mechanism:
    """Return a wheel of 2e-3 kg m² about z."""
    found = Mechanism("Wheel", run={"duration": duration, "output_interval": "1 ms"}, solver={"rtol": 1e-9})
    found.body("wheel", mass="1 kg", centre="0, 0, 0 mm", inertia="2e-3, 2e-3, 2e-3 kg m^2")
    return found.revolute(
        "hinge", "ground", "wheel", point="0, 0, 0 mm", axis=[0, 0, 1], start_speed=f"{speed} rad/s"
    )


def place(result: xr.Dataset) -> np.ndarray:
    return result["position"].sel(body="block", axis="z").values


def speed(result: xr.Dataset) -> np.ndarray:
    return result["velocity"].sel(body="block", axis="z").values


def force(result: xr.Dataset, name: str = "element_force") -> np.ndarray:
    return result[name].values[:, 0]


def test_a_ball_on_a_distance_joint_swings_as_a_pendulum() -> None:
    # From a right angle: T = 4 √(L/g) K(1/√2) with K = 1.8540746773 (Abramowitz and Stegun, table 17.1).
    period = 4.0 * math.sqrt(0.25 / G) * 1.8540746773013719
    assert ellipk(0.5) == pytest.approx(1.8540746773013719, rel=1e-15)
    run = {"duration": f"{period} s", "output_interval": f"{period / 400.0} s"}
    pendulum = Mechanism("Pendulum", gravity=f"0, -{G}, 0 m/s^2", run=run, solver={"rtol": 1e-9})
    pendulum.body("ball", centre="250, 0, 0 mm", **BALL)
    pendulum.distance(
        "rod", between=["ground", "ball"], first_point="0, 0, 0 mm", second_point="250, 0, 0 mm"
    )
    result = td.simulate(pendulum.case())
    x, y = (result["position"].sel(body="ball", axis=axis).values for axis in "xy")
    assert np.hypot(x, y) == pytest.approx(0.25, rel=1e-12)
    assert (x[-1], x[200]) == pytest.approx((0.25, -0.25), rel=1e-6)
    # Tension m v²/L + m g cos: three times the weight at the lowest place.
    assert force(result) == pytest.approx(3.0 * G * y / 0.25, abs=1e-5)
    assert float(force(result).min()) == pytest.approx(-3.0 * G, rel=1e-6)


def test_a_length_that_is_not_the_one_drawn_moves_the_bodies_at_the_start() -> None:
    found = slider("2 ms", gravity=G)
    found.distance(
        "rod",
        between=["ground", "block"],
        first_point="0, 0, 100 mm",
        second_point="0, 0, 0 mm",
        length="90 mm",
    )
    result = td.simulate(found.case())
    assert place(result) == pytest.approx(0.01, rel=1e-12)
    assert force(result) == pytest.approx(-G, rel=1e-9)


def test_a_stiff_spring_tends_to_the_distance_joint() -> None:
    # The ideal counterpart is the limit: the error falls as one over the stiffness.
    def swung(**spring: str) -> np.ndarray:
        run = {"duration": "0.3 s", "output_interval": "10 ms"}
        pendulum = Mechanism("Pendulum", gravity=f"0, -{G}, 0 m/s^2", run=run, solver={"rtol": 1e-8})
        pendulum.body("ball", centre="250, 0, 0 mm", **BALL)
        ends = {"first_point": "0, 0, 0 mm", "second_point": "250, 0, 0 mm"}
        kind = "nonlinear_spring" if spring else "distance"
        getattr(pendulum, kind)("rod", between=["ground", "ball"], **ends, **spring)
        return td.simulate(pendulum.case())["position"].values[:, 0]

    ideal = swung()
    errors = [
        float(np.abs(swung(stiffness=f"{k} N/m", damping=f"{c} N s/m") - ideal).max())
        for k, c in ((1e4, 100.0), (1e5, 400.0), (1e6, 1000.0))
    ]
    assert errors[1] == pytest.approx(0.1 * errors[0], rel=0.2)
    assert errors[2] == pytest.approx(0.1 * errors[1], rel=0.2)


def test_a_cubic_spring_from_a_table_oscillates_with_the_period_of_its_amplitude() -> None:
    # m ẍ = −κ x³: T = Γ(1/4)²/√π √(m/κ)/A = 7.4163 √(m/κ)/A (Nayfeh and Mook, section 2.1).
    kappa, amplitude = 1e6, 0.02
    number = gamma(0.25) ** 2 / math.sqrt(math.pi)
    assert number == pytest.approx(7.4163, abs=5e-5)
    period = number / math.sqrt(kappa) / amplitude
    found = slider(f"{period} s", interval=f"{period / 200.0} s")
    knots = np.linspace(-0.03, 0.03, 7)
    table = {
        "positions": ", ".join(f"{1e3 * x}" for x in knots) + " mm",
        "values": ", ".join(f"{kappa * x**3}" for x in knots) + " N",
    }
    ends = {"first_point": "0, 0, -100 mm", "second_point": "0, 0, 0 mm", "length": "80 mm"}
    found.nonlinear_spring("cubic", between=["ground", "block"], force=table, **ends)
    result = td.simulate(found.case())
    assert place(result)[[0, -1]] + 0.02 == pytest.approx(0.02, abs=1e-7)
    assert place(result)[100] == pytest.approx(-2.0 * amplitude, abs=1e-7)
    stretched = place(result) + 0.02
    assert force(result) == pytest.approx(-kappa * stretched**3, abs=1e-9)
    energy = 0.5 * speed(result) ** 2 + 0.25 * kappa * stretched**4
    assert energy == pytest.approx(0.25 * kappa * amplitude**4, rel=1e-6)
    assert result["energy_stored"].values == pytest.approx(0.25 * kappa * stretched**4, abs=1e-9)


def test_a_torsion_spring_swings_about_the_angle_of_its_preload() -> None:
    found = wheel("0.2 s")
    found.torsion_spring("coil", joint="hinge", preload="0.5 N m", stiffness="3 N m/rad")
    result = td.simulate(found.case())
    frequency = math.sqrt(3.0 / 2e-3)
    expected = -0.5 / 3.0 * (1.0 - np.cos(frequency * result["time"].values))
    assert result["joint_angle"].values[:, 0] == pytest.approx(expected, abs=1e-7)
    assert force(result, "element_moment") == pytest.approx(-0.5 - 3.0 * expected, abs=1e-6)
    assert np.isnan(force(result)).all()


@pytest.mark.parametrize("side", ["above", "below"])
def test_a_stop_without_damping_reverses_in_half_a_period(side: str) -> None:
    sign = 1.0 if side == "above" else -1.0
    found = slider("40 ms", speed=sign * 0.5, interval="0.05 ms")
    found.stop(
        "end", joint="guide", position=f"{sign * 5.0} mm", side=side, stiffness="100 N/mm", restitution=1.0
    )
    result = td.simulate(found.case())
    assert sign * speed(result)[-1] == pytest.approx(-0.5, rel=1e-7)
    deepest = 0.5 / math.sqrt(1e5)
    assert float(np.max(sign * place(result))) == pytest.approx(5e-3 + deepest, rel=1e-5)
    touching = result["time"].values[force(result) != 0.0]
    assert touching[-1] - touching[0] == pytest.approx(math.pi / math.sqrt(1e5), abs=1e-4)
    assert float(np.min(-sign * force(result))) >= 0.0
    # It returns at the instant that is left: there and back, and half a period.
    gone = 40e-3 - 0.01 - math.pi / math.sqrt(1e5)
    assert sign * place(result)[-1] == pytest.approx(5e-3 - 0.5 * gone, abs=1e-8)


@pytest.mark.parametrize("exponent", [1.0, 1.5])
@pytest.mark.parametrize(
    ("name", "meant"), [("calibrated", 0.6), ("calibrated", 0.2), ("lankarani-nikravesh", 0.6)]
)
def test_a_stop_rebounds_with_the_restitution_of_its_damping_factor(exponent, name, meant):
    found = slider("30 ms", speed=0.5)
    found.stop(
        "end",
        joint="guide",
        position="2 mm",
        stiffness="100 N/mm",
        exponent=exponent,
        damping_factor=name,
        restitution=meant,
    )
    result = td.simulate(found.case())
    realised = float(DAMPING_FACTORS[name].realised(np.array(meant)))
    # The speed at which contact began is that at the end of the first step in it.
    assert speed(result)[-1] == pytest.approx(-0.5 * realised, rel=2e-3)
    assert result["energy_damping"].values[-1] == pytest.approx(0.125 * (1.0 - realised**2), rel=5e-3)


def test_a_body_falls_through_air_towards_its_terminal_speed() -> None:
    # v = v_t tanh(g t/v_t), v_t = √(2 m g/(ρ c_d A)).
    found = slider("2 s", gravity=G, interval="20 ms")
    found.drag("air", body="block", point="0, 0, 0 mm", drag_coefficient=1.1, area="0.5 m^2")
    result = td.simulate(found.case())
    terminal = math.sqrt(2.0 * G / (1.2 * 1.1 * 0.5))
    time = result["time"].values
    assert speed(result) == pytest.approx(-terminal * np.tanh(G * time / terminal), abs=1e-6)
    fallen = terminal**2 / G * np.log(np.cosh(G * time / terminal))
    assert place(result) == pytest.approx(-fallen, abs=1e-6)
    assert force(result) == pytest.approx(-0.33 * speed(result) ** 2, rel=1e-9)


def test_coulomb_friction_stops_a_block_after_its_distance() -> None:
    # v²/(2 μ N/m), but for what regularisation adds: of the order of u_s²/(μ N/m).
    found = slider("0.3 s", speed=0.8)
    found.friction(
        "drag", joint="guide", normal_load="40 N", friction_coefficient=0.1, slip_velocity="0.1 mm/s"
    )
    result = td.simulate(found.case())
    time = result["time"].values
    moving = time < 0.19
    assert speed(result)[moving] == pytest.approx(0.8 - 4.0 * time[moving], abs=1e-5)
    assert place(result)[-1] == pytest.approx(0.8**2 / 8.0, abs=1e-6)
    assert force(result)[moving] == pytest.approx(-4.0, rel=1e-4)
    assert result["energy_friction"].values[-1] == pytest.approx(0.32, rel=1e-5)


@pytest.mark.parametrize("share", [0.5, 0.9])
def test_a_joint_that_sticks_creeps_as_the_regularisation_says(share: float) -> None:
    # F = μ N v/√(v² + u_s²).
    found = wheel("0.3 s")
    found.friction("bearing", joint="hinge", radius="10 mm", normal_load="100 N", friction_coefficient=0.2)
    found.drive("motor", "hinge", torque=f"{0.2 * share} N m")
    result = td.simulate(found.case())
    creep = 1e-3 * share / math.sqrt(1.0 - share**2) / 0.01
    assert result["angular_velocity"].values[-1, 0, 2] == pytest.approx(creep, rel=1e-4)
    assert force(result, "element_moment")[-1] == pytest.approx(-0.2 * share, rel=1e-4)


SEAL = {
    **{"joint": "guide", "normal_load": "50 N", "stribeck_velocity": "20 mm/s"},
    **{"friction_coefficient": 0.1, "static_coefficient": 0.2},
}


def test_a_block_breaks_away_at_static_friction() -> None:
    # A slow ramp; the largest force of the law, near μ_s N, at a speed between slip and Stribeck velocity.
    found = slider("1 s")
    found.friction("seal", **SEAL, slip_velocity="0.1 mm/s")
    found.drive("pull", "guide", force={"times": "0, 1 s", "values": "0, 12 N", "interpolation": "linear"})
    result = td.simulate(found.case())
    pull = 12.0 * result["time"].values
    v = np.linspace(1e-5, 0.1, 100001)
    law = FrictionLimit(coulomb=5.0, stribeck=5.0, stribeck_speed=0.02)(v) * v / np.hypot(v, 1e-4)
    assert law.max() == pytest.approx(10.0, rel=0.01)
    assert float(np.max(speed(result)[pull < 0.98 * law.max()])) < 5e-3
    assert float(np.max(-force(result))) == pytest.approx(law.max(), rel=2e-3)
    assert speed(result)[-1] > 0.5


def test_the_force_over_speed_is_the_friction_law_of_the_project() -> None:
    found = slider("1 s", interval="10 ms")
    found.friction("seal", **SEAL, viscous="30 N s/m")
    ramp = {"times": "0, 1 s", "values": "0, 0.1 m/s", "interpolation": "linear"}
    result = td.simulate(found.drive("pull", "guide", velocity=ramp).case())
    v = speed(result)
    law = FrictionLimit(coulomb=5.0, viscous=0.0, stribeck=5.0, stribeck_speed=0.02)(v)
    assert force(result) == pytest.approx(-law * v / np.hypot(v, 1e-3) - 30.0 * v, rel=1e-8, abs=1e-9)
    driven = result["drive_force"].values[:, 0]
    assert driven[1:-1] == pytest.approx(0.1 - force(result)[1:-1], rel=1e-6)


def gears(duration: str, torque: float, held: bool, **teeth: object) -> xr.Dataset:
    """Return a run of wheels of 30 and 60 mm under a torque [N m] on the first."""
    run = {"duration": duration, "output_interval": "0.1 ms"}
    found = Mechanism("Gears", run=run, solver={"rtol": 1e-8})
    for name, spin, x in (("a", 2e-3, 0), ("b", 5e-3, 90)):
        found.body(name, mass="1 kg", centre=f"{x}, 0, 0 mm", inertia=f"{spin}, {spin}, {spin} kg m^2")
        found.revolute(name, "ground", name, point=f"{x}, 0, 0 mm", axis=[0, 0, 1])
    found.gear("mesh", joints=["a", "b"], ratio=-0.5, **teeth)
    found.drive("motor", "a", torque=f"{torque} N m")
    if held:
        found.drive("brake", "b", angle="0 deg")
    return td.simulate(found.case())


@pytest.mark.parametrize("torque", [0.3, -0.3])
def test_a_wheel_turns_through_its_backlash_until_a_flank_carries_it(torque: float) -> None:
    # Until then freely, half of the backlash; at last (j/2 + F/K)/r with the tooth force F = T/r.
    teeth = {"backlash": "0.6 mm", "mesh_stiffness": "1 N/um", "restitution": 0.2}
    result = gears("60 ms", torque, True, **teeth)
    time, angle = result["time"].values, result["joint_angle"].values[:, 0]
    free = np.abs(angle) < 0.3e-3 / 0.03
    assert np.count_nonzero(free) > 50
    assert angle[:50] == pytest.approx(0.5 * torque / 2e-3 * time[:50] ** 2, abs=1e-9)
    assert np.all(force(result)[:50] == 0.0)
    assert angle[-1] == pytest.approx(math.copysign((0.3e-3 + 10.0 / 1e6) / 0.03, torque), rel=1e-4)
    assert force(result)[-1] == pytest.approx(torque / 0.03, rel=1e-3)
    assert force(result, "element_moment")[-1] == pytest.approx(-2.0 * torque, rel=1e-3)
    # The bearings hold the wheels together against F tan 20°, whichever flank is in contact.
    apart = result["reaction_force_global"].values[-1, :, 0]
    assert apart == pytest.approx(10.0 * math.tan(math.radians(20.0)) * np.array([1.0, -1.0]), rel=1e-3)
    across = result["reaction_force_global"].values[-1, :, 1]
    assert across == pytest.approx(torque / 0.03 * np.array([1.0, -1.0]), rel=1e-3)
    assert result.attrs["energy_residual"] < 1e-3


def test_gears_without_play_tend_to_the_exact_ratio_as_their_teeth_get_stiff() -> None:
    # Both turn as one mass; the teeth give way by F/K, twice that at most as they begin to vibrate.
    rate = 0.3 / (2e-3 + 0.25 * 5e-3)
    tooth = 5e-3 * 0.5 * rate / 0.06
    misses = []
    for stiffness in (1e5, 1e6, 1e7):
        teeth = {"backlash": "0 mm", "mesh_stiffness": f"{stiffness} N/m", "restitution": 1.0}
        result = gears("10 ms", 0.3, False, **teeth)
        turned = 0.03 * result["joint_angle"].values[:, 0] + 0.06 * result["joint_angle"].values[:, 1]
        misses.append(float(np.max(np.abs(turned))))
        assert misses[-1] == pytest.approx(2.0 * tooth / stiffness, rel=0.02)
    assert misses[0] > 50.0 * misses[2]


@pytest.mark.parametrize("brake", [1.0, pytest.param(-1.0, marks=pytest.mark.long)])
def test_backlash_is_an_error_against_the_gears_without_it(brake: float, tmp_path: Path) -> None:
    # The teeth come to rest on the flank that the brake presses: half of the play, and T / K r², over r.
    drawn = Mechanism("Gears", run={"duration": "0.4 s"})
    for name, x in (("a", 0), ("b", 90)):
        drawn.body(name, mass="1 kg", centre=f"{x}, 0, 0 mm", inertia="2e-3, 2e-3, 2e-3 kg m^2")
        drawn.revolute(name, "ground", name, point=f"{x}, 0, 0 mm", axis=[0, 0, 1])
    drawn.gear("mesh", joints=["a", "b"], ratio=-0.5, backlash="0.1 mm", mesh_stiffness="100 N/um")
    drawn.drive("motor", "a", speed="60 rpm").load("brake", "b", direction=[0, 0, 1], moment=f"{brake} N m")
    drawn.output("angle", "b", quantity="angle", along=[0, 0, 1])
    result = td.simulate(drawn)
    expected = (0.05e-3 + 1.0 / 0.06 / 1e8) / 0.06 * brake
    assert result["output_error"].values[-1, 0] == pytest.approx(expected, rel=2e-3)
    at_rest = td.simulate(drawn.case().replace({"run.analysis": "static", "run.positions": 4}))
    assert at_rest["output_error"].values[-1, 0] == pytest.approx(expected, rel=1e-6)
    exact = td.simulate(drawn.case().replace({"gears.mesh.ideal": True}))
    assert float(np.abs(exact["output_error"]).max()) < 1e-9
    ideal = td.simulate(drawn.case().replace({"run.analysis": "kinematic"}))
    assert ideal["output_value"].values[-1] == pytest.approx(-0.5 * 2.0 * math.pi * 0.4, rel=1e-9)
    [shares] = td.studies.contributions(drawn.case(), directory=tmp_path, workers=0)
    assert shares.joints == ("mesh",)
    assert shares.interaction == pytest.approx(0.0, abs=1e-12)


def test_teeth_and_stops_come_to_rest_unless_a_case_says_otherwise() -> None:
    result = gears("0.2 s", 0.3, True, backlash="0.6 mm", mesh_stiffness="1 N/um")
    late = force(result)[-200:]
    assert late == pytest.approx(0.3 / 0.03, rel=0.01)


def test_a_run_with_clearance_begins_where_a_spring_presses_the_shaft_into_its_bore() -> None:
    found = wheel("2 ms")
    found.clearance("hinge", radius="10 mm", radial="20 um", length="20 mm", friction_coefficient=0.0)
    ends = {"first_point": "100, 0, 0 mm", "second_point": "0, 0, 0 mm"}
    found.nonlinear_spring("pull", between=["ground", "wheel"], preload="50 N", stiffness="1 N/mm", **ends)
    result = td.simulate(found.case())
    assert result.attrs["start"] == "equilibrium"
    contact = result["contact_force"].sel(joint="hinge").values
    expected = np.tile([-50.0, 0.0, 0.0], (len(contact), 1))
    assert contact == pytest.approx(expected, abs=0.05)
    assert float(abs(result["velocity"]).max()) < 1e-6


@pytest.mark.parametrize("linear", [True, False])
def test_a_spring_of_no_free_length_pulls_in_proportion_to_its_length(linear: bool) -> None:
    # Pulled to a point 30 mm beside the guide: along it the force is k z, whatever the angle.
    drawn = slider("0.3 s", speed=1.0)
    keys = {
        "first_point": "30, 0, 0 mm",
        "second_point": "0, 0, 0 mm",
        "length": "0 mm",
        "stiffness": "0.4 N/mm",
    }
    if linear:
        drawn.spring("rubber", "ground", "block", **keys)
    else:
        drawn.nonlinear_spring("rubber", between=["ground", "block"], **keys)
    result = td.simulate(drawn)
    assert place(result) == pytest.approx(np.sin(20.0 * result["time"].values) / 20.0, abs=1e-8)


def test_a_rotational_damper_alone_slows_a_wheel_exponentially() -> None:
    result = td.simulate(
        wheel("0.5 s", 10.0).torsion_spring("damper", joint="hinge", damping="0.01 N m s/rad")
    )
    spin = result["angular_velocity"].sel(body="wheel", axis="z").values
    assert spin == pytest.approx(10.0 * np.exp(-0.01 / 2e-3 * result["time"].values), rel=1e-6)


def test_a_distance_of_zero_is_refused() -> None:
    drawn = slider("0.1 s")
    points = {"first_point": "30, 0, 0 mm", "second_point": "0, 0, 0 mm"}
    drawn.distance("rod", between=["ground", "block"], length="0 mm", **points)
    with pytest.raises(InputError, match="spherical joint"):
        td.simulate(drawn)
