"""Controls of every built-in case, and where their sliders go."""

import pytest

import tribodyn as td
from tribodyn.cases.tables import keys_in, with_components
from tribodyn.mechanisms.catalogue import MECHANISMS, built_in, load_case
from tribodyn.workbench.controls import FIRST, controls, track


def found(name):
    case = load_case(name)
    return case, controls(case, MECHANISMS[case.kind()].controls)


@pytest.mark.parametrize("name", built_in())
def test_controls_of_a_case(name):
    case, made = found(name)
    first = [control["first"] for control in made]
    assert 2 <= sum(first) <= FIRST
    assert first == sorted(first, reverse=True)
    assert len({control["key"] for control in made}) == len(made)
    # What a control shows is the value itself.
    texts = {control["key"]: control["text"] for control in made if control["kind"] != "list"}
    given = {key: text for key, text in texts.items() if text}
    again = case.replace(given)
    assert {key: again.at(key) for key in given} == {key: case.at(key) for key in given}
    keys = with_components(keys_in(case))
    for control in made:
        if control["step"] is not None:
            assert control["least"] < control["greatest"]
            ends = [f"{control[end]!r} {control['unit']}".strip() for end in ("least", "greatest")]
            key = keys[control["key"]]
            texts = (
                [str(round(control[end])) for end in ("least", "greatest")] if key.kind == "count" else ends
            )
            for value in (key.read(text, text=True) for text in texts):
                for sign, bound in key.bounds:
                    kept = {
                        "gt": value > bound,
                        "ge": value >= bound,
                        "lt": value < bound,
                        "le": value <= bound,
                    }
                    assert kept[sign], (control["key"], value)


@pytest.mark.parametrize(
    ("path", "value", "expected"),
    [
        ("joint.clearance", 20e-6, (1.0, 50.0, 1.0)),
        ("joint.friction_coefficient", 0.1, (0.0, 0.5, 0.01)),
        # Zero says nothing, so the whole range that there is.
        ("joint.friction_coefficient", 0.0, (0.0, 2.0, 0.01)),
        ("surfaces.bushing.poisson_ratio", 0.34, (0.01, 0.5, 0.01)),
        ("loads.air_moment", -0.84, (-5.0, 5.0, 0.01)),
        ("solver.grid.theta", 96, (12.0, 500.0, 1.0)),
        # Where none is given, the example.
        ("joint.liner.thickness", None, (0.1, 5.0, 0.1)),
    ],
)
def test_sliders_go_in_round_steps_from_limit_to_well_beyond_the_value(path, value, expected):
    key = keys_in(load_case("vsv"))[path]
    made = track(key, value)
    assert (made.least, made.greatest, made.step) == expected


def test_what_has_no_size_has_no_slider():
    keys = keys_in(load_case("vsv"))
    assert track(keys["joint.form.crown"], 0.0) is None
    assert track(keys["contact.law"], None) is None


@pytest.mark.parametrize(
    ("name", "path", "expected"),
    [
        ("slider-crank", "drives.motor.speed.value", "motor: speed"),
        ("slider-crank", "joints.wrist.clearance.radial", "wrist: clearance, radial"),
        ("vsv", "surfaces.bushing.roughness", "root mean square roughness sigma_2"),
        ("vsv", "surfaces.bushing.conductivity", "conductivity, of heat"),
    ],
)
def test_controls_have_short_names_that_tell_them_apart(name, path, expected):
    labels = {control["key"]: control["label"] for control in found(name)[1]}
    assert labels[path] == expected


@pytest.mark.parametrize("name", built_in())
def test_no_two_first_controls_have_one_name(name):
    labels = [control["label"] for control in found(name)[1] if control["first"]]
    assert len(set(labels)) == len(labels)


def pressed(**clearance):
    """Return the controls of a hinge of steel in bronze, by key; keys of its clearance are given."""
    drawn = td.Mechanism("Hinge", run={"duration": "1 s"}).pair("bearing")
    drawn.body("door", mass="1 kg", centre="0.1, 0, 0 m", inertia="0.01, 0.01, 0.01 kg m^2")
    keys = {"radial": "20 um", "radius": "5 mm", "length": "10 mm", **clearance}
    case = drawn.revolute("pivot", "ground", "door", point="0, 0, 0 m", axis=[0, 0, 1], clearance=keys).case()
    return {control["key"]: control for control in controls(case, MECHANISMS["mechanism"].controls)}


def test_surfaces_that_no_joint_has_are_no_controls():
    of_case = {"surfaces.bushing.roughness", "contact.law"}
    assert of_case <= pressed().keys()
    made = pressed(pair="bearing").keys()
    assert not of_case & made
    assert {f"pairs.bearing.{key}" for key in of_case} <= made
    assert "pairs.bearing.contact.law" not in pressed()


def test_a_joint_is_made_ideal_by_a_control_and_then_has_no_other_of_its_clearance():
    assert pressed()["joints.pivot.clearance.ideal"]["first"]
    own = [key for key in pressed(ideal=True) if key.startswith("joints.pivot.clearance.")]
    assert own == ["joints.pivot.clearance.ideal"]


@pytest.mark.parametrize(
    ("name", "path"), [("vsv", "joint.clearance"), ("slider-crank", "joints.wrist.clearance.radial")]
)
def test_sliders_of_clearances_begin_above_three_times_the_roughness(name, path):
    case, made = found(name)
    (control,) = (one for one in made if one["key"] == path)
    roughness = case.rough_clearances()[path]
    assert 3.0 * roughness <= 1e-6 * control["least"] < 3.0 * roughness + 1e-6 * control["step"]
    key = with_components(keys_in(case))[path]
    # A case that is rougher than that keeps its value.
    assert track(key, 2e-6, 5e-6).least <= 2.0


def test_parameters_have_the_first_sliders():
    drawn = td.Mechanism("Pendulum", run={"duration": "1 s"}).parameter("length", "0.5 m")
    drawn.body("rod", shape="rod", start="0, 0, 0 m", end="0, -length, 0 m", radius="5 mm", mass="1 kg")
    case = drawn.revolute("pivot", "ground", "rod", point="0, 0, 0 m", axis=[0, 0, 1]).case()
    first = controls(case, MECHANISMS["mechanism"].controls)[0]
    assert (first["key"], first["label"], first["number"]) == ("parameters.length.value", "length", 0.5)
    assert first["least"] < 0.5 < first["greatest"]
    assert case.replace({first["key"]: "0.6 m"}).at("bodies.rod.end.y") == -0.6


def test_sliders_of_lengths_do_not_pass_zero():
    case = (
        td.Mechanism("Arm", run={"duration": "1 s"}).parameter("length", "50 mm").parameter("aside", "-50 mm")
    )
    case.body(
        "arm", shape="rod", start="0, 0, 0 mm", end="length, 0, 0 mm", radius="5 mm", density="1 g/cm^3"
    )
    case.revolute("pivot", "ground", "arm", point="0, 0, 0 mm", axis=[0, 0, 1])
    made = {one["key"]: one for one in controls(case.case(), ["parameters.*.value"])}
    assert made["parameters.length.value"]["least"] == made["parameters.length.value"]["step"]
    assert made["parameters.aside.value"]["least"] == -200.0
