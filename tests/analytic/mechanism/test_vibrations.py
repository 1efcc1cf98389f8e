"""Small vibrations: frequencies, damping ratios and mode shapes against closed forms."""

import math

import numpy as np
import pytest
import xarray as xr
from tests.analytic.mechanism.test_outputs import BAR, CRANK, ROD, of

import tribodyn as td
from tribodyn.core.errors import TribodynError
from tribodyn.figures.style import INK, PALE
from tribodyn.mechanism.figures import FIGURES
from tribodyn.mechanisms.results import summarise
from tribodyn.results.reading import column

GRAVITY = 9.81
EXACT = 1e-6


def drawn(gravity: float = 0.0, **run: object) -> td.Mechanism:
    keys = {"duration": "1 s", "analysis": "vibrations", **run}
    return td.Mechanism("Vibrations", gravity=f"0, {-gravity}, 0 m/s^2", run=keys)


def frequencies(result: xr.Dataset) -> np.ndarray:
    assert result.attrs["failure"] == ""
    return column(result, "natural_frequency")


def hertz(square: float) -> float:
    return math.sqrt(square) / (2.0 * math.pi)


def pendulum(place: str = "100, 0, 0 mm") -> td.Mechanism:
    return (
        drawn(GRAVITY)
        .body("arm", mass="2 kg", centre=place, inertia="1e-2, 2e-2, 3e-2 kg m^2")
        .revolute("hinge", "ground", "arm", point="0, 0, 0 mm", axis=[0, 0, 1])
    )


OF_PENDULUM = hertz(2.0 * GRAVITY * 0.1 / (3e-2 + 2.0 * 0.1**2))


def test_a_pendulum_swings_about_its_lowest_position() -> None:
    result = td.simulate(pendulum())
    assert frequencies(result)[0] == pytest.approx([OF_PENDULUM], rel=EXACT)
    assert column(result, "damping_ratio")[0] == pytest.approx([0.0], abs=1e-9)
    assert column(result, "position")[0, 0] == pytest.approx([0.0, -0.1, 0.0], abs=1e-7)
    assert column(result, "mode_rotation")[0, 0, 0, :2] == pytest.approx([0.0, 0.0], abs=1e-12)
    assert summarise(result)["frequency_Hz_1"] == pytest.approx(OF_PENDULUM, rel=EXACT)
    assert result.attrs["warnings"] == "[]"


def test_an_inverted_pendulum_is_unstable() -> None:
    result = td.simulate(pendulum("0, 100, 0 mm"))
    rate = 2.0 * math.pi * OF_PENDULUM
    assert frequencies(result)[0] == pytest.approx([OF_PENDULUM] * 2, rel=EXACT)
    assert sorted(column(result, "damping_ratio")[0]) == pytest.approx([-1.0, 1.0])
    assert f"grows e-fold in {1.0 / rate:.3g} s" in result.attrs["warnings"]


@pytest.mark.parametrize("ratio", [0.0, 0.3, 2.0])
def test_damping_of_one_mass(ratio: float) -> None:
    stiffness, mass = 2000.0, 3.0
    own = math.sqrt(stiffness / mass)
    result = td.simulate(
        drawn()
        .body("mass", mass=f"{mass} kg", centre="100, 0, 0 mm", **BAR)
        .prismatic("rail", "ground", "mass", point="100, 0, 0 mm", axis=[1, 0, 0])
        .spring(
            "spring",
            "ground",
            "mass",
            first_point="0, 0, 0 mm",
            second_point="100, 0, 0 mm",
            stiffness=f"{stiffness} N/m",
            damping=f"{2.0 * ratio * own * mass} N s/m",
        )
    )
    found, damping = frequencies(result)[0], column(result, "damping_ratio")[0]
    if ratio < 1.0:
        assert found == pytest.approx([own / (2.0 * math.pi)], rel=EXACT)
        assert damping == pytest.approx([ratio], abs=1e-9)
    else:
        root = math.sqrt(ratio**2 - 1.0)
        expected = [own * (ratio + side * root) / (2.0 * math.pi) for side in (-1.0, 1.0)]
        assert found == pytest.approx(expected, rel=EXACT)
        assert damping == pytest.approx([1.0, 1.0])


def test_modes_of_two_masses_between_three_springs() -> None:
    # Equal masses and springs: in phase with ω² = k/m, in antiphase with 3 k/m.
    mechanism = drawn()
    for number, name in enumerate(("first", "second"), start=1):
        place = f"{100 * number}, 0, 0 mm"
        mechanism = mechanism.body(name, mass="3 kg", centre=place, **BAR).prismatic(
            f"rail{number}", "ground", name, point=place, axis=[1, 0, 0]
        )
    ends = (("ground", 0, "first", 100), ("first", 100, "second", 200), ("second", 200, "ground", 300))
    for number, (one, start, other, end) in enumerate(ends):
        points = {"first_point": f"{start}, 0, 0 mm", "second_point": f"{end}, 0, 0 mm"}
        mechanism = mechanism.spring(f"spring{number}", one, other, stiffness="2 N/mm", **points)
    result = td.simulate(mechanism)
    assert frequencies(result)[0] == pytest.approx([hertz(2000.0 / 3.0), hertz(2000.0)], rel=EXACT)
    shape = column(result, "mode_shape")[0, :, :, 0]
    assert np.abs(shape) == pytest.approx(np.full((2, 2), 1.0 / math.sqrt(6.0)), rel=1e-9)
    assert np.sign(shape[:, 0] * shape[:, 1]) == pytest.approx([1.0, -1.0])
    assert column(result, "mode_share")[0] == pytest.approx(np.full((2, 2), 0.5), rel=1e-9)


def slider_crank(spring: str) -> td.Mechanism:
    """Return a slider-crank whose crank stands upright, held by a spring without tension at the slider."""
    way = math.sqrt(ROD**2 - CRANK**2)
    found = (
        drawn()
        .body("crank", mass="0.3 kg", centre="0, 25, 0 mm", inertia="1e-4, 1e-4, 2e-4 kg m^2")
        .body("rod", mass="0.2 kg", centre=f"{500 * way}, 25, 0 mm", inertia="2e-4, 2e-4, 3e-4 kg m^2")
        .body("slider", mass="0.4 kg", centre=f"{1000 * way}, 0, 0 mm", **BAR)
        .revolute("main", "ground", "crank", point="0, 0, 0 mm", axis=[0, 0, 1])
        .spherical("crankpin", "crank", "rod", point="0, 50, 0 mm")
        .universal(
            "wrist", "rod", "slider", point=f"{1000 * way}, 0, 0 mm", axis=[0, 1, 0], second_axis=[0, 0, 1]
        )
        .prismatic("guide", "ground", "slider", point=f"{1000 * way}, 0, 0 mm", axis=[1, 0, 0])
    )
    points = {"first_point": "500, 0, 0 mm", "second_point": f"{1000 * way}, 0, 0 mm"}
    return found.spring("spring", "ground", "slider", stiffness=spring, **points)


def test_a_linkage_with_a_spring() -> None:
    # At an upright crank the rod is parallel to its motion: it does not turn, and rod and slider have the
    # speed R of a unit turn. So ω² = k R²/(J + (m_rod + m_slider) R²) with the crank about its bearing.
    result = td.simulate(slider_crank("5 N/mm"))
    assert CRANK == 0.05
    crank = 2e-4 + 0.3 * 0.025**2
    expected = hertz(5000.0 * CRANK**2 / (crank + 0.6 * CRANK**2))
    assert frequencies(result)[0] == pytest.approx([expected], rel=EXACT)
    ways = column(result, "mode_shape")[0, 0]
    assert ways[2, 0] / ways[1, 0] == pytest.approx(1.0, rel=1e-9)
    assert ways[0, 0] / ways[1, 0] == pytest.approx(0.5, rel=1e-9)
    share = column(result, "mode_share")[0, 0]
    assert share == pytest.approx(
        np.array([crank, 0.2 * CRANK**2, 0.4 * CRANK**2]) / (crank + 0.6 * CRANK**2), rel=1e-9
    )


def test_along_a_drive_positions_are_at_rest_and_the_drive_holds() -> None:
    # A slide on an arm that a motor turns: its spring carries the part of its weight along the arm.
    stiffness, mass = 2000.0, 1.0
    result = td.simulate(
        td.Mechanism(
            "Arm",
            gravity=f"0, {-GRAVITY}, 0 m/s^2",
            run={"cycles": 1, "positions": 8, "analysis": "vibrations"},
        )
        .body("arm", mass="1 kg", centre="50, 0, 0 mm", **BAR)
        .body("slide", mass=f"{mass} kg", centre="100, 0, 0 mm", **BAR)
        .revolute("main", "ground", "arm", point="0, 0, 0 mm", axis=[0, 0, 1])
        .prismatic("rail", "arm", "slide", point="100, 0, 0 mm", axis=[1, 0, 0])
        .spring(
            "spring",
            "arm",
            "slide",
            first_point="0, 0, 0 mm",
            second_point="100, 0, 0 mm",
            stiffness=f"{stiffness} N/m",
        )
        .drive("motor", "main", speed="3000 rpm")
        .output("reach", "slide", quantity="distance", reference_point="0, 0, 0 mm")
    )
    assert frequencies(result)[:, 0] == pytest.approx(np.full(9, hertz(stiffness / mass)), rel=EXACT)
    angle = np.linspace(0.0, 2.0 * np.pi, 9)
    reach = 0.1 - mass * GRAVITY * np.sin(angle) / stiffness
    assert of(result, "output_value", "reach") == pytest.approx(reach, abs=1e-9)
    numbers = summarise(result)
    assert numbers["frequency_min_Hz_1"] == pytest.approx(numbers["frequency_max_Hz_1"], rel=EXACT)


def carried(gravity: float, friction: str = "0") -> td.Mechanism:
    """Return a carriage on a rail that hangs by a pin, whose contact is Hertz's sphere, in a bore."""
    return (
        drawn(gravity)
        .body("block", mass="5 kg", centre="0, 0, 0 mm", **BAR)
        .body("pin", mass="1 kg", centre="0, 0, 0 mm", **BAR)
        .prismatic("rail", "ground", "pin", point="0, 0, 0 mm", axis=[0, 1, 0])
        .fixed("stand", "ground", "block", point="0, 0, 0 mm")
        .revolute("bearing", "block", "pin", point="0, 0, 0 mm", axis=[0, 0, 1])
        .clearance(
            "bearing",
            radius="9.5 mm",
            radial="20 um",
            length="20 mm",
            contact="point-lankarani-nikravesh",
            friction_coefficient=friction,
        )
    )


@pytest.mark.parametrize("friction", ["0", "0.3"])
def test_a_pin_rests_on_an_elastic_contact(friction: str) -> None:
    # F = K δ^1.5 carries m g, and dF/dδ = 1.5 m g/δ.
    result = td.simulate(carried(GRAVITY, friction))
    depth = -float(column(result, "position")[0, 1, 1]) - 20e-6
    assert 0.0 < depth < 5e-6
    assert frequencies(result)[0] == pytest.approx([hertz(1.5 * GRAVITY / depth)], rel=1e-5)
    assert column(result, "damping_ratio")[0] == pytest.approx([0.0], abs=1e-9)


def test_surfaces_that_do_not_touch_leave_a_free_motion() -> None:
    result = td.simulate(carried(0.0))
    assert "natural_frequency" not in result
    assert "surfaces of joint bearing do not touch at rest" in result.attrs["notes"]
    assert "and no modes: pin" in result.attrs["notes"]


def test_pins_that_slide_in_their_end_gaps_are_no_modes_and_not_unstable() -> None:
    sizes = {"radius": "6 mm", "radial": "20 um", "length": "12 mm", "axial": "50 um"}
    clear = {
        f"joints.{name}.clearance.{key}": value
        for name in ("crankpin", "coupler-pin", "rocker-pivot")
        for key, value in sizes.items()
    }
    run = {"run.analysis": "vibrations", "run.positions": "3"}
    result = td.simulate(td.load_case("four-bar").replace(run | clear))
    assert result.attrs["warnings"] == "[]"
    assert frequencies(result).min() > 20.0
    assert np.all(column(result, "damping_ratio") == 0.0)
    assert "no modes: rocker along coupler-pin, coupler along crankpin" in result.attrs["notes"]
    assert summarise(result)["frequency_Hz_1"] == pytest.approx(25.2257, rel=1e-3)


def test_a_body_that_a_force_drives_away_has_no_position_at_rest() -> None:
    pushed = (
        drawn()
        .body("mass", mass="1 kg", centre="100, 0, 0 mm", **BAR)
        .prismatic("rail", "ground", "mass", point="100, 0, 0 mm", axis=[1, 0, 0])
        .load("push", "mass", direction=[1, 0, 0], force="3 N")
    )
    assert "no position at rest was found" in td.simulate(pushed).attrs["failure"]


def test_a_pendulum_in_a_bore_swings_and_its_slide_is_no_mode() -> None:
    sizes = {"radius": "6 mm", "radial": "20 um", "length": "12 mm", "axial": "50 um"}
    result = td.simulate(pendulum().clearance("hinge", **sizes))
    assert result.attrs["warnings"] == "[]"
    assert frequencies(result)[0, 0] == pytest.approx(OF_PENDULUM, rel=1e-3)
    assert "no modes: arm along hinge" in result.attrs["notes"]


def test_shapes_of_modes_are_drawn_at_rest_and_displaced() -> None:
    result = td.simulate(slider_crank("5 N/mm"))
    (axes,) = FIGURES["mode_shapes"].draw(result).axes
    assert axes.get_title() == f"mode 1, {float(result['natural_frequency'][0, 0]):.4g} Hz"
    rest, moved = (
        np.concatenate([line.get_xydata() for line in axes.lines if line.get_color() == c])
        for c in (PALE, INK)
    )
    # The crank turns by 0.15 rad as drawn: its pin, rod and slider move by R times that.
    assert np.abs(moved - rest[-len(moved) :]).max() == pytest.approx(150.0 * CRANK, rel=1e-2)


def test_a_mechanism_without_a_freedom_cannot_vibrate() -> None:
    case = td.load_case("four-bar", {"run.analysis": "vibrations"})
    ideal = {f"joints.{name}.clearance.ideal": "true" for name in case.joints if case.joints[name].clearance}
    with pytest.raises(TribodynError, match="nothing can vibrate"):
        td.simulate(case.replace(ideal))


def test_only_the_lowest_modes_are_kept() -> None:
    case = td.load_case("vsv-free", {"run.analysis": "vibrations", "run.positions": "2", "run.modes": "3"})
    result = td.simulate(case)
    found = frequencies(result)
    assert found.shape == (3, 3)
    assert np.all(np.diff(found, axis=1) >= 0.0)
    assert column(result, "mode_share").sum(axis=2) == pytest.approx(np.ones((3, 3)))


def test_bodies_at_rest_have_no_heat_of_friction_and_no_wear() -> None:
    case = td.load_case("vsv-free", {"run.positions": "2"})
    at_rest, led = (
        summarise(td.simulate(case.replace({"run.analysis": one}))) for one in ("vibrations", "static")
    )
    missing = ("friction_heat_J", "wear_depth_max_nm", "worn_volume_mm3", "load_power_mean_W")
    for name in (
        *missing,
        "wear_depth_nm_trunnion",
        "friction_heat_J_trunnion",
        "drive_speed_at_peak_rad_per_s",
    ):
        assert name in led
        assert name not in at_rest
