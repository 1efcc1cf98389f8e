"""Elastic bodies against closed forms: deflection, elastica, frequencies, stiffening, rigid limit."""

import math
from typing import Any, Final

import numpy as np
import pytest
from scipy.special import ellipe, ellipeinc, ellipk, ellipkinc

import tribodyn as td
from tribodyn.cases.case import Case, with_entries
from tribodyn.core.errors import InputError
from tribodyn.mechanisms.catalogue import parse_case

LENGTH: Final = 0.5
RIGIDITY: Final = 200e9 * 20e-3 * 5e-3**3 / 12.0
ACROSS: Final = 200e9 * 5e-3 * 20e-3**3 / 12.0
MASS: Final = 7800.0 * 20e-3 * 5e-3
#: Of a cantilever: β L of the first three modes.
ROOTS: Final = np.array([1.8751040687, 4.6940911330, 7.8547574382])
BEAM: Final = """
case = "mechanism"
run.duration = "10 ms"
[bodies.beam]
elastic = "beam"
[bodies.beam.beam]
points = "0, 0, 0, 500, 0, 0 mm"
width = "20 mm"
height = "5 mm"
height_axis = [0, 0, 1]
young_modulus = "200 GPa"
density = "7800 kg/m^3"
segments = 8
[joints.clamp]
type = "fixed"
between = ["ground", "beam"]
point = "0, 0, 0 mm"
"""
TIP: Final = {"loads.tip.body": "beam", "loads.tip.point": "500, 0, 0 mm", "loads.tip.direction": [0, 0, 1]}


def parsed(text: str) -> Case:
    """Return the case of a text."""
    return parse_case(text, "test")


def beam(**changes: Any) -> Case:
    """Return the cantilever with other keys, written with double underscores for dots."""
    return with_entries(
        parsed(BEAM), {key.replace("__", "."): value for key, value in changes.items()}, "test"
    )


def bent(force: float, **changes: Any) -> Any:
    """Return place and attitude of the tip at rest under a force across."""
    case = with_entries(
        beam(run__analysis="static", **changes), {**TIP, "loads.tip.force": f"{float(force)!r} N"}, "test"
    )
    return td.simulate(case).isel(time=-1)


@pytest.mark.parametrize("segments", [2, 8])
def test_the_tip_of_a_cantilever_moves_by_its_closed_form_whatever_the_number_of_pieces(segments):
    place = bent(1.0, bodies__beam__beam__segments=segments)["position"].sel(body=f"beam:{segments}").values
    shear = LENGTH / (5.0 / 6.0 * 200e9 / 2.6 * 1e-4)
    assert place[2] == pytest.approx(LENGTH**3 / (3.0 * RIGIDITY) + shear, rel=1e-4)


def test_a_cantilever_bent_by_thirty_degrees_follows_the_elastica() -> None:
    turn = np.radians(30.0)
    k = (1.0 + np.sin(turn)) / 2.0
    first = np.arcsin(1.0 / np.sqrt(2.0 * k))
    size = ellipk(k) - ellipkinc(first, k)
    down = 1.0 - 2.0 * (ellipe(k) - ellipeinc(first, k)) / size
    along = np.sqrt(2.0 * np.sin(turn)) / size
    found = bent(size**2 * RIGIDITY / LENGTH**2)
    place = found["position"].sel(body="beam:8").values / LENGTH
    assert place[[0, 2]] == pytest.approx([along, down], rel=4e-3)
    w, _, y, _ = found["orientation"].sel(body="beam:8").values
    assert 2.0 * np.arctan2(abs(y), w) == pytest.approx(turn, rel=4e-3)


@pytest.mark.parametrize(
    ("section", "inner"), [('section = "circle"', 0.0), ('section = "tube"\ninner_radius = "2 mm"', 2.0)]
)
def test_an_angled_bar_bends_in_both_legs_and_twists_in_the_first(section: str, inner: float) -> None:
    """P at the end of the second leg b, across both: P a³/3EI + P b³/3EI + P b² a/GJ, and little shear."""
    text = BEAM.replace('"0, 0, 0, 500, 0, 0 mm"', '"0, 0, 0, 200, 0, 0, 200, 150, 0 mm"')
    text = text.replace('width = "20 mm"\nheight = "5 mm"', f'{section}\nradius = "3 mm"')
    load = TIP | {"loads.tip.point": "200, 150, 0 mm", "loads.tip.force": "1 N", "run.analysis": "static"}
    found = td.simulate(with_entries(parsed(text.replace("height_axis = [0, 0, 1]\n", "")), load, "test"))
    second = math.pi / 4.0 * (3e-3**4 - (1e-3 * inner) ** 4)
    a, b, rigidity = 0.2, 0.15, 200e9 * second
    twist = rigidity / 1.3  # G J with a Poisson's ratio of 0.3: J is twice I, and G is E/2.6
    expected = (a**3 + b**3) / (3.0 * rigidity) + b**2 * a / twist
    tip = found["position"].isel(time=-1).sel(body="beam:8", axis="z")
    assert float(tip) == pytest.approx(expected, rel=5e-3)


def test_the_first_three_frequencies_are_within_half_a_percent() -> None:
    found = td.simulate(beam(run__analysis="vibrations", run__modes=6))
    weak = ROOTS**2 * np.sqrt(RIGIDITY / MASS) / LENGTH**2 / (2.0 * np.pi)
    known = np.sort([*weak, ROOTS[0] ** 2 * np.sqrt(ACROSS / MASS) / LENGTH**2 / (2.0 * np.pi)])
    assert found["natural_frequency"].values[0, :4] == pytest.approx(known, rel=5e-3)
    assert found["damping_ratio"].values[0, 0] == pytest.approx(0.01, rel=1e-2)


SPIN: Final = """
[bodies.hub]
mass = "1 kg"
centre = "0, 0, 0 mm"
inertia = "1e-3, 1e-3, 1e-3 kg m^2"
[joints.bearing]
type = "revolute"
between = ["ground", "hub"]
point = "0, 0, 0 mm"
axis = [0, 0, 1]
"""


def test_spin_stiffens_a_beam_as_tables_say() -> None:
    """Frequencies of A. D. Wright et al., Journal of Applied Mechanics 49 (1982), 3.5160 and 4.7973."""
    unit = np.sqrt(RIGIDITY / MASS) / LENGTH**2
    case = parsed(BEAM.replace('"ground", "beam"', '"hub", "beam"') + SPIN)
    for eta, known in ((0.0, 3.5160), (3.0, 4.7973)):
        changes = {
            **TIP,
            "loads.tip.force": "0.05 N",
            "drives.motor.joint": "bearing",
            "drives.motor.speed": f"{float(eta * unit)!r} rad/s",
            "bodies.beam.beam.damping_ratio": 1e-4,
            "bodies.beam.beam.segments": 4,
            "run.duration": "0.2 s",
            "run.output_interval": "0.5 ms",
            "run.start": "centred",
        }
        found = td.simulate(with_entries(case, changes, "test"))
        height = found["position"].sel(body="beam:4", axis="z").values
        above = height - 0.5 * (height.max() + height.min())
        time, rising = found["time"].values, np.flatnonzero((above[:-1] < 0.0) & (above[1:] >= 0.0))
        crossing = time[rising] - above[rising] * np.diff(time)[rising] / np.diff(above)[rising]
        period = (crossing[-1] - crossing[0]) / (crossing.size - 1)
        assert 2.0 * np.pi / period / unit == pytest.approx(known, rel=1e-2)


FREE: Final = 'type = "revolute"\naxis = [0, 1, 0]'


def pendulum(beam_keys: str) -> Case:
    """Return a beam that hangs out from a hinge and falls."""
    text = BEAM.replace('type = "fixed"', FREE).replace('elastic = "beam"\n', beam_keys)
    return parsed(text.replace('"10 ms"', '"0.1 s"\ngravity = "0, 0, -9.81 m/s^2"\nsolver.rtol = 1e-8'))


def test_a_beam_of_no_flexibility_falls_as_the_rigid_one() -> None:
    rigid = td.simulate(pendulum(""))
    stiff = {"bodies.beam.beam.young_modulus": "2e8 GPa", "bodies.beam.beam.segments": 2}
    stiff |= {"bodies.beam.beam.damping_ratio": 1.0}
    found = td.simulate(pendulum('elastic = "beam"\n').replace(stiff))
    turn = [
        2.0 * np.arctan2(d["orientation"].values[:, 0, 2], d["orientation"].values[:, 0, 0])
        for d in (rigid, found)
    ]
    assert np.max(np.abs(turn[1] - turn[0])) < 1e-6 * np.max(np.abs(turn[0]))
    box = rigid["position"].values[-1, 0]
    assert np.linalg.norm(box) == pytest.approx(0.5 * LENGTH, rel=1e-12)


def test_energy_is_kept_with_that_of_bending_and_its_damping() -> None:
    found = td.simulate(pendulum('elastic = "beam"\n'))
    assert found.attrs["energy_residual"] < 1e-5
    assert np.ptp(found["energy_stored"].values) > 0.0
    assert found["energy_damping"].values[-1] > 0.0


LEVER: Final = """
case = "mechanism"
run.duration = "1 s"
run.analysis = "ANALYSIS"
run.positions = 2
[bodies.shaft]
mass = "0.2 kg"
centre = "0, 0, 0 mm"
inertia = "1e-4, 1e-4, 1e-4 kg m^2"
[bodies.lever]
elastic = "beam"
[bodies.lever.beam]
points = "0, 0, 0, 50, 0, 0 mm"
width = "3 mm"
height = "10 mm"
height_axis = [0, 1, 0]
young_modulus = "110 GPa"
poisson_ratio = 0.34
density = "4430 kg/m^3"
segments = 3
[joints.trunnion]
type = "revolute"
between = ["ground", "shaft"]
point = "0, 0, 0 mm"
axis = [0, 0, 1]
[joints.root]
type = "fixed"
between = ["shaft", "lever"]
point = "0, 0, 0 mm"
[bodies.ring]
mass = "1 kg"
centre = "50, 0, 0 mm"
inertia = "1e-3, 1e-3, 1e-3 kg m^2"
[joints.guide]
type = "prismatic"
between = ["ground", "ring"]
point = "50, 0, 0 mm"
axis = [0, 1, 0]
[joints.pin]
type = "pin-slot"
between = ["ring", "lever"]
point = "50, 0, 0 mm"
axis = [1, 0, 0]
[drives.actuator]
joint = "guide"
position = { value = "0 mm", swing = "1 mm", angular_frequency = "6.283 rad/s" }
[loads.air]
body = "shaft"
moment = "-0.85 N m"
direction = [0, 0, 1]
[outputs.vane]
quantity = "angle"
body = "shaft"
along = [0, 0, 1]
"""


def test_loads_on_a_lever_on_a_spring_balance_at_the_start() -> None:
    """Bending is some 1e8 times softer than stretching: the search for balance must not stiffen it."""
    drawn = td.Mechanism("Lever", gravity="0, 0, -9.81 m/s^2", run={"duration": "10 us"})
    keys = {"points": "0, 0, 0, 100, 0, 0 mm", "width": "10 mm", "height": "3 mm", "segments": 4}
    drawn.body("lever", elastic="beam", beam=keys | {"young_modulus": "110 GPa", "density": "4430 kg/m^3"})
    drawn.revolute("pin", "ground", "lever", point="0, 0, 0 mm", axis=[0, 1, 0])
    drawn.clearance("pin", radius="5 mm", radial="20 um", length="20 mm", friction_coefficient=0.0)
    drawn.torsion_spring("hold", "pin", stiffness="50 N m/rad")
    assert td.simulate(drawn).attrs["warnings"] == "[]"


def test_the_bending_part_of_a_levers_error_is_that_of_a_cantilever() -> None:
    """17 N at 50 mm of titanium, 10 × 3 mm: F L²/3EI, and 3 % of shear, which one may leave out."""
    slender = 17.0 * 50e-3**2 / (3.0 * 110e9 * 3e-3 * 10e-3**3 / 12.0)
    factor = 13.4 / (12.0 + 11.0 * 0.34)
    turn = slender + 17.0 / (factor * 110e9 / 2.68 * 30e-6)
    estimate = td.simulate(parsed(LEVER.replace("ANALYSIS", "kinematic")))["error_estimate"].sum("joint")
    assert estimate.sel(output="vane", cause="bending").values[0] == pytest.approx(-turn, rel=1e-3)
    assert not estimate.sel(output="vane", cause=["clearance", "tilt", "friction"]).values.any()
    found = td.simulate(parsed(LEVER.replace("ANALYSIS", "static")))
    assert found["output_error"].values[0, 0] == pytest.approx(-turn, rel=2e-3)
    section = (
        'section = "any"\narea = "30 mm^2"\nsecond_moments = "250, 22.5 mm^4"\ntorsion_constant = "73 mm^4"'
    )
    text = LEVER.replace('width = "3 mm"\nheight = "10 mm"', section)
    bending = td.simulate(parsed(text.replace("ANALYSIS", "static")))["output_error"].values[0, 0]
    assert bending == pytest.approx(-slender, rel=2e-2)
    stress = 0.85 / (3e-3 * 10e-3**2 / 6.0)
    assert np.nanmax(found["beam_stress"].values[0]) == pytest.approx(stress, rel=1e-3)


def test_a_bent_coupler_between_balls_with_play_rests_where_it_does_without_drives_in_motion() -> None:
    """A static analysis at 0.01 rpm, without friction, and one of vibrations find the same place."""
    run = {"cycles": 1, "positions": 2, "analysis": "static"}
    drawn = td.Mechanism("Four-bar", gravity="0, 0, -9.81 m/s^2", run=run)
    rod = {"shape": "rod", "radius": "8 mm", "density": "7850 kg/m^3"}
    drawn.body("crank", start="0, 0, 0 mm", end="0, 40, 0 mm", **rod)
    tube = {"section": "tube", "radius": "5 mm", "inner_radius": "4 mm", "young_modulus": "70 GPa"}
    bent = {"points": "0, 40, 0, 100, 60, 30, 200, 0, 120 mm", "density": "2700 kg/m^3", "segments": 6}
    drawn.body("coupler", elastic="beam", beam=tube | bent)
    drawn.body("rocker", start="200, 0, 0 mm", end="200, 0, 120 mm", **rod)
    drawn.revolute("main", "ground", "crank", point="0, 0, 0 mm", axis=[0, 0, 1])
    drawn.revolute("pivot", "ground", "rocker", point="200, 0, 0 mm", axis=[0, 1, 0])
    for name, ends, at in (("b1", "crank coupler", "0, 40, 0"), ("b2", "coupler rocker", "200, 0, 120")):
        drawn.spherical(name, *ends.split(), point=f"{at} mm")
        drawn.clearance(name, radius="6 mm", radial="20 um", friction_coefficient=0.0)
    drawn.drive("motor", "main", speed="0.01 rpm")
    drawn.load("work", "rocker", moment="5 N m", direction=[0, 1, 0])
    case = drawn.case()
    found = [td.simulate(case.replace({"run.analysis": one})) for one in ("static", "vibrations")]
    assert [one.attrs["failure"] for one in found] == ["", ""]
    places = [one["position"].isel(time=0).values for one in found]
    assert places[0] == pytest.approx(places[1], abs=1e-7)


def test_a_bent_coupler_between_balls_with_friction_turns_at_120_rpm() -> None:
    """Steel, 10 × 5 mm: looks at it come nearer by a factor of 2.4 each, and end by themselves."""
    run = {"cycles": 1, "positions": 24, "analysis": "static"}
    drawn = td.Mechanism("Four-bar", gravity="0, 0, -9.81 m/s^2", run=run)
    rod = {"shape": "rod", "radius": "8 mm", "density": "7850 kg/m^3"}
    section = {"width": "5 mm", "height": "10 mm", "height_axis": [0, 1, 0], "segments": 6}
    bent = {"points": "0, 40, 0, 100, 60, 30, 200, 0, 120 mm", "young_modulus": "210 GPa"}
    drawn.body("crank", start="0, 0, 0 mm", end="0, 40, 0 mm", **rod)
    drawn.body("coupler", elastic="beam", beam=section | bent | {"density": "7850 kg/m^3"})
    drawn.body("rocker", start="200, 0, 0 mm", end="200, 0, 120 mm", **rod)
    drawn.revolute("main", "ground", "crank", point="0, 0, 0 mm", axis=[0, 0, 1])
    drawn.revolute("pivot", "ground", "rocker", point="200, 0, 0 mm", axis=[0, 1, 0])
    for name, ends, at in (("b1", "crank coupler", "0, 40, 0"), ("b2", "coupler rocker", "200, 0, 120")):
        drawn.spherical(name, *ends.split(), point=f"{at} mm")
        drawn.clearance(name, radius="6 mm", radial="20 um", friction_coefficient=0.1)
    drawn.drive("motor", "main", speed="120 rpm")
    drawn.load("work", "rocker", moment="5 N m", direction=[0, 1, 0])
    found = td.simulate(drawn.case())
    assert found.attrs["failure"] == ""
    assert "after them shafts walk" not in found.attrs["notes"]
    far = np.linalg.norm(found["displacement"].sel(joint=["b1", "b2"]).values, axis=2)
    assert np.all((far > 15e-6) & (far < 40e-6))


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        (
            {"joints.clamp.point": "-3, 0, 0 mm"},
            "joints.clamp.point: .*3 mm beyond the end of the elastic body beam",
        ),
        ({"bodies.beam.mass": "1 kg"}, "bodies.beam.mass: .*leave this out"),
        ({"bodies.beam.beam.density": "-1 kg/m^3"}, "bodies.beam.beam.density: .*density, > 0"),
        ({"bodies.beam.beam.points": "0, 0, 0 mm"}, "bodies.beam.beam.points: .*two points or more"),
        ({"bodies.beam.beam.section": "circle"}, "bodies.beam.beam.radius: .*a section circle needs radius"),
        ({"bodies.beam.beam.height_axis": (1.0, 0.0, 0.0)}, "beam.height_axis: .*lies across the line"),
    ],
)
def test_a_wrong_elastic_body_is_refused_in_one_sentence(changes: dict[str, object], words: str) -> None:
    with pytest.raises(InputError, match=words) as caught:
        with_entries(beam(), changes, "test")
    assert "\n" not in str(caught.value)


def test_a_written_case_with_an_elastic_body_reads_back_and_takes_changes_of_the_whole_body() -> None:
    case = beam()
    assert parsed(case.to_toml()) == case
    thicker = case.replace({"bodies.beam.beam.height": "6 mm"})
    assert thicker.at("joints.beam:1.bending_rigidity")[0] == pytest.approx(RIGIDITY * 1.2**3)
    heavier = case.replace({"bodies.beam:8.mass": "3 kg"})
    assert heavier.at("bodies.beam:8.mass") == 3.0
