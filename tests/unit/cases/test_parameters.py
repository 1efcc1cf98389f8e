"""Parameters and expressions: values, units, links that changes follow, and refusals."""

import time
from typing import Any

import pytest

import tribodyn as td
from tribodyn.cases.dimensions import Dimensioned, ExpressionProblem, dimensions_of, fits
from tribodyn.cases.expressions import FUNCTIONS, OF_ANY_NUMBER, evaluate
from tribodyn.core.errors import InputError
from tribodyn.mechanisms.catalogue import parse_case
from tribodyn.studies.plan import Sampling, make_plan

SCOPE = {
    "crank": Dimensioned(0.04, dimensions_of("m")),
    "turn": Dimensioned(0.5, dimensions_of("rad")),
    "ratio": Dimensioned(3.0),
}


@pytest.mark.parametrize(
    ("text", "value", "unit"),
    [
        ("crank", 0.04, "m"),
        ("2*crank + 20 mm", 0.1, "m"),
        ("-crank / ratio", -0.04 / 3.0, "m"),
        ("sqrt(crank^2 + (30 mm)^2)", 0.05, "m"),
        ("hypot(crank, 30 mm)", 0.05, "m"),
        ("0 + crank", 0.04, "m"),
        ("max(crank, 20 mm)", 0.04, "m"),
        ("3 N m / crank", 75.0, "N"),
        ("2 m/s * 3 s", 6.0, "m"),
        ("atan2(30 mm, crank)", 0.6435011087932844, "rad"),
        ("turn + 30 deg", 1.0235987755982988, "rad"),
        ("sin(turn)", 0.479425538604203, ""),
        ("ratio ** 2", 9.0, ""),
        ("2 * pi * 1 rad", 6.283185307179586, "rad"),
        ("7850 kg/m^3 * crank^3", 0.5024, "kg"),
    ],
)
def test_an_expression_has_a_value_and_a_unit(text: str, value: float, unit: str) -> None:
    found = evaluate(text, SCOPE)
    assert found.value == pytest.approx(value, rel=1e-15)
    assert found.dimensions == dimensions_of(unit)


REFUSED = {
    "crnk + 1 mm": 'there is no parameter .crnk.; known: crank, turn, ratio; did you mean "crank"',
    "sine(turn)": 'there is no function .sine..*did you mean "sin"',
    "crank + 1 s": "a sum of meter and second",
    "sin(crank)": "an angle is needed, given meter",
    "asin(crank)": "a plain number is needed",
    "sqrt(crank, turn)": "sqrt takes 1 argument, given 2",
    "9**9**9": "a power is a plain number of at most 8",
    "crank ** turn": "a power is a plain number",
    "crank ^ 0.123456": "a power such as 2 or 1/2",
    "1e300 * 1e300": "too large",
    "1 / (crank - 40 mm)": "divides by zero",
    "sqrt(-1)": "no value there",
    "20 mmm": "unknown unit 'mmm'",
    "2 crank": "this is no expression",
    "crank.real": "it may hold",
    "[crank]": "it may hold",
    "crank if ratio else turn": "it may hold",
    "lambda: crank": "it may hold",
    "(crank := ratio)": "it may hold",
    "'crank'": "it may hold",
    "__import__('os')": "a name begins with a letter",
    "_0_ + 5 mm": "a name begins with a letter",
    "+".join(["ratio"] * 33): "nested more than 30 deep",
    "-" * 150 + "1": "nested more than 30 deep",
    "(" * 500 + "1" + ")" * 500: "at most 200 characters",
    "1" * 10**6: "at most 200 characters",
}


@pytest.mark.parametrize("text", REFUSED, ids=lambda text: text[:20])
def test_what_has_no_value_is_refused_at_once(text: str) -> None:
    begin = time.process_time()
    with pytest.raises(ExpressionProblem, match=REFUSED[text]):
        evaluate(text, SCOPE)
    # Milliseconds; an evaluation of the powers would never end.
    assert time.process_time() - begin < 5.0


WARM = evaluate("90 degC", {})
TEMPERATURES = {
    "T": WARM,
    "T_2": evaluate("20 degC", {}),
    "K_1": evaluate("363.15 K", {}),
    "dT": evaluate("10 K", {}),
}
#: Temperatures [K]: 90 and 20 degC, 363.15 K, and a difference of 10 K.
RIGHT = {
    "T": 363.15,
    "T + 10 K": 373.15,
    "T - 10 K": 353.15,
    "T + dT": 373.15,
    "T - dT": 353.15,
    "20 degC + 10 K": 303.15,
    "20 degC + dT": 303.15,
    "dT + 5 K": 15.0,
    "2 * dT": 20.0,
    "T + 2 * dT": 383.15,
    "T - T_2": 70.0,
    "T - 20 degC": 70.0,
    "T_2 + (T - T_2) / 2": 328.15,
    "T_2 + 0.25 * (T - T_2)": 310.65,
    "(T + T_2) / 2": 328.15,
    "0.5 * (T + T_2)": 328.15,
    "0.3 * T + 0.7 * T_2": 0.3 * 363.15 + 0.7 * 293.15,
    "(T + T_2 + 40 degC) / 3": (363.15 + 293.15 + 313.15) / 3.0,
    "2 * T - T": 363.15,
    "T + T_2 - 20 degC": 363.15,
    "T - T_2 + 30 degC": 373.15,
    "max(T, T_2)": 363.15,
    "min(T, T_2)": 293.15,
    "max(T, T_2, 100 degC)": 373.15,
    "max(T, 300 K)": 363.15,
    "abs(T_2 - T)": 70.0,
    "2 * K_1": 726.3,
    "K_1 + 10 K": 373.15,
    "1.1 * 300 K": 330.0,
    "-(T_2 - T)": 70.0,
    "T + 0": 363.15,
    "0 + T": 363.15,
}
NO_TEMPERATURE = {
    "T + 10 degC": "2 times the zero of degC",
    "2 * T": "2 times the zero of degC",
    "T / 2": "0.5 times the zero of degC",
    "T + T_2": "2 times the zero of degC",
    "-T": "-1 times the zero of degC",
    "300 K - T": "-1 times the zero of degC",
    "K_1 + 10 degC": "what is added to a temperature is a difference",
    "dT + 10 degC": "what is added to a temperature is a difference",
    "T / T_2": "added to and compared only",
    "T / (20 degC)": "added to and compared only",
    "1 / T": "added to and compared only",
    "T^2": "added to and compared only",
    "sqrt(T)": "added to and compared only",
    "abs(T)": "added to and compared only",
    "hypot(T, T_2)": "added to and compared only",
    "T * 1.2e-5 m": "added to and compared only",
    "max(T, T - T_2)": "a comparison of a temperature and a difference",
    "T + 10 mm": "a sum of kelvin and meter",
}
assert len(RIGHT) + len(NO_TEMPERATURE) >= 40


@pytest.mark.parametrize("text", RIGHT)
def test_a_temperature_in_an_expression_is_right(text: str) -> None:
    assert evaluate(text, TEMPERATURES).value == pytest.approx(RIGHT[text], rel=1e-14)


@pytest.mark.parametrize("text", NO_TEMPERATURE)
def test_a_temperature_that_has_no_meaning_is_refused(text: str) -> None:
    with pytest.raises(ExpressionProblem, match=NO_TEMPERATURE[text]):
        evaluate(text, TEMPERATURES)


def test_temperatures_of_a_case_follow_their_parameters() -> None:
    text = """
        case = "vsv"
        [parameters]
        T = "90 degC"
        [temperature]
        bushing = "T + 10 K"
        [surfaces.bushing]
        thermal_expansion = "20e-6 1/K"
    """
    case = parse_case(text, "test")
    assert case.at("temperature.bushing") == pytest.approx(373.15)
    warmer = case.replace({"parameters.T": "100 degC"})
    assert warmer.at("temperature.bushing") == pytest.approx(383.15)
    again = parse_case(warmer.to_toml(), "test")
    assert again.at("temperature.bushing") == warmer.at("temperature.bushing")
    for text, words in (("T + 10 degC", "zero of degC"), ("T - 20 degC", "a difference of temperatures")):
        with pytest.raises(InputError, match=rf"temperature\.bushing.*{words}"):
            case.replace({"temperature.bushing": text})


ANGULAR = {
    "f": evaluate("50 Hz", {}),
    "v": evaluate("3 m/s", {}),
    "c": evaluate("1.5 m", {}),
    "n": evaluate("3000 rpm", {}),
}


@pytest.mark.parametrize(
    ("text", "speed"),
    [
        ("v / c", 2.0),
        ("2 * pi * f", 314.1592653589793),
        ("2 * pi / (20 ms)", 314.1592653589793),
        ("f * 2 * pi", 314.1592653589793),
        ("f * 360 deg", 314.1592653589793),
        ("n + v / c", 316.1592653589793),
        ("v / c + 1 rad/s", 3.0),
        ("max(v / c, 1 rad/s, 5 rad/s)", 5.0),
        ("sqrt(9.81 m/s^2 / (9.81 m))", 1.0),
    ],
)
def test_the_radian_is_one_in_an_angular_speed(text: str, speed: float) -> None:
    found = evaluate(text, ANGULAR)
    assert found.value == pytest.approx(speed, rel=1e-14)
    assert fits(found.dimensions, dimensions_of("rad/s"), found.turns)


def test_a_frequency_is_a_parameter() -> None:
    text = 'case = "vsv"\n[parameters]\nf = "8 Hz"\n[drive]\nangular_frequency = "2 * pi * f"\n'
    case = parse_case(text, "test")
    assert case.at("drive.angular_frequency") == pytest.approx(16.0 * 3.141592653589793)
    assert 'f = "8 Hz"' in case.to_toml()
    assert parse_case(case.to_toml(), "test").at("drive.angular_frequency") == case.at(
        "drive.angular_frequency"
    )
    plan = make_plan(case, {"parameters.f": "4:8:4 Hz"}, Sampling())
    assert len(plan.points) == 2
    with pytest.raises(InputError, match=r"2\*pi times turns"):
        case.replace({"drive.angular_frequency": "f"})


MODEL = """
case = "mechanism"
run.duration = "20 ms"
[parameters]
crank = "50 mm"
ratio = 3
rod = "ratio * crank"
[bodies.crank]
mass = "1 kg"
centre = ["crank / 2", "0 mm", "0 mm"]
inertia = ["1e-4 kg m^2", "1 kg * crank^2 / 12", "1 kg * crank^2 / 12"]
[bodies.rod]
shape = "rod"
start = "crank, 0, 0 mm"
end = "crank + rod, 0, 0 mm"
radius = "5 mm"
density = "7850 kg/m^3"
[joints.main]
type = "revolute"
between = ["ground", "crank"]
point = "0, 0, 0 mm"
axis = ["sin(0 deg)", 0, "cos(0 deg)"]
[joints.pin]
type = "revolute"
between = ["crank", "rod"]
point = ["crank", "0 mm", "0 mm"]
axis = [0, 0, 1]
"""


def model(text: str = MODEL) -> Any:
    return parse_case(text, "test")


def test_values_follow_parameters_through_changes_and_files() -> None:
    case = model()
    assert case.parameters["rod"].value == pytest.approx(0.15, rel=1e-15)
    assert case.bodies["crank"].centre == (0.025, 0.0, 0.0)
    assert case.joints["pin"].point == (0.05, 0.0, 0.0)
    longer = case.replace({"parameters.crank": "60 mm"})
    assert longer.joints["pin"].point == (0.06, 0.0, 0.0)
    assert longer.bodies["rod"].centre[0] == pytest.approx(0.06 + 0.09, rel=1e-15)
    assert longer.bodies["rod"].mass == pytest.approx(1.2 * case.bodies["rod"].mass, rel=1e-14)
    free = longer.replace({"parameters.rod": "100 mm"})
    assert free.bodies["rod"].centre[0] == pytest.approx(0.06 + 0.05, rel=1e-15)
    for one in (case, longer, free):
        again = model(one.to_toml())
        assert again == one
        # What is stored is linked, not only its numbers.
        assert again.replace({"parameters.crank": "50 mm", "parameters.rod": "ratio * crank"}) == case
        assert model(one.to_toml(comments=True)) == one
    assert 'centre = ["crank / 2", "0 mm", "0 mm"]  # ["25 mm", "0 mm", "0 mm"]' in case.to_toml()


def test_parameters_are_swept_and_sampled_as_keys_are() -> None:
    plan = make_plan(model(), {"parameters.crank": "40, 50, 60 mm"})
    points = [parse_case(point.toml, "point") for point in plan.points]
    assert [point.joints["pin"].point[0] for point in points] == [0.04, 0.05, 0.06]  # type: ignore[attr-defined]
    drawn = make_plan(model(), {"parameters.crank": "normal(50 mm, 1 mm)"}, Sampling(8))
    lengths = {parse_case(point.toml, "point").joints["pin"].point[0] for point in drawn.points}  # type: ignore[attr-defined]
    assert len(lengths) == 8


def test_a_builder_and_a_vane_take_parameters_too() -> None:
    rod = (
        td.Mechanism("Pendulum", run={"duration": "1 s"})
        .parameter("length", "0.5 m")
        .body("rod", shape="rod", start="0, 0, 0 m", end="0, -length, 0 m", radius="length / 50", mass="1 kg")
        .revolute("pivot", "ground", "rod", point="0, 0, 0 m", axis=[0, 0, 1])
        .case()
    )
    assert rod.bodies["rod"].centre == (0.0, -0.25, 0.0)
    case = parse_case('case = "vsv"\njoint.clearance = "2 * c"\n[parameters]\nc = "20 um"\n', "test")
    assert case.at("joint.clearance") == 4e-5
    assert case.at("parameters.c.value") == 2e-5


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ('rod = "ratio * crank"', 'rod = "ratio * crnk"', 'parameters.rod: .*did you mean "crank"'),
        ('crank = "50 mm"', 'crank = "rod / 3"', "defined by each other: crank -> rod -> crank"),
        ('crank = "50 mm"', 'crank = "50 mm"\nmm = "3 m"', "parameters.mm: mm is a unit or a function"),
        ('crank = "50 mm"', 'crank = "50 mm"\nsin = 3', "parameters.sin: sin is a unit or a function"),
        ('crank = "50 mm"', 'crank = "50 mm"\n"a-b" = 3', "letters, digits and _"),
        ('crank = "50 mm"', 'crank = "50 mm"\na = true', "parameters.a: given true: a parameter is a number"),
        ('["crank / 2", ', '["crnk / 2", ', 'bodies.crank.centre: .*did you mean "crank"'),
        ('["crank / 2", ', '["crank^2", ', "it is meter.2, and meter is needed"),
        ('radius = "5 mm"', 'radius = "crank - 1 m"', "bodies.rod.radius: given .crank - 1 m.; allowed"),
        ('radius = "5 mm"', 'radius = "5 umm"', "unknown unit 'umm'"),
        ('radius = "5 mm"', "", "bodies.rod.radius: a rod needs start, end, radius"),
        ('density = "7850 kg/m^3"', "", "bodies.rod.density: a rod needs its density, or its mass"),
        ('radius = "5 mm"', 'radius = "5 mm"\nsize = "1, 1, 1 mm"', "bodies.rod.size: .*a rod has start"),
        ('radius = "5 mm"', 'radius = "5 mm"\ninertia = "1, 1, 1 kg m^2"', "give either bodies.rod.inertia"),
        ('mass = "1 kg"', 'mass = "1 kg"\nradius = "1 mm"', "this belongs to a shape: rod, cylinder, box"),
    ],
)
def test_a_wrong_parameter_is_refused_with_its_place(old: str, new: str, words: str) -> None:
    with pytest.raises(InputError, match=words):
        model(MODEL.replace(old, new, 1))


def test_mass_properties_of_solids_are_those_of_textbooks() -> None:
    rho, r, inner, length = 7850.0, 0.1, 0.05, 0.02
    solids = """
[bodies.disc]
shape = "cylinder"
centre = "1, 2, 3 m"
first_axis = [0, 0, 1]
length = "20 mm"
radius = "100 mm"
density = "7850 kg/m^3"
second_axis = [1, 0, 0]
[bodies.ring]
shape = "cylinder"
centre = "0, 0, 0 m"
length = "20 mm"
radius = "100 mm"
inner_radius = "50 mm"
density = "7850 kg/m^3"
[bodies.box]
shape = "box"
centre = "0, 0, 0 m"
size = "30, 20, 10 mm"
mass = "6 kg"
[bodies.strut]
shape = "rod"
start = "0, 0, 0 m"
end = "3, 4, 0 m"
radius = "20 mm"
mass = "2 kg"
"""
    bodies = model(MODEL + solids).bodies
    disc, ring, box, strut = (bodies[name] for name in ("disc", "ring", "box", "strut"))
    assert disc.mass == pytest.approx(rho * 3.141592653589793 * r**2 * length)
    assert disc.inertia[0] == pytest.approx(0.5 * disc.mass * r**2)
    assert disc.inertia[1] == pytest.approx(disc.mass * (3.0 * r**2 + length**2) / 12.0)
    assert disc.centre == (1.0, 2.0, 3.0)
    # What is left of a cylinder out of which a smaller one is taken.
    hole = rho * 3.141592653589793 * inner**2 * length
    assert ring.mass == pytest.approx(disc.mass - hole)
    assert ring.inertia[0] == pytest.approx(disc.inertia[0] - 0.5 * hole * inner**2)
    assert ring.inertia[2] == pytest.approx(disc.inertia[2] - hole * (3.0 * inner**2 + length**2) / 12.0)
    assert box.inertia == pytest.approx((0.5 * (4e-4 + 1e-4), 0.5 * (9e-4 + 1e-4), 0.5 * (9e-4 + 4e-4)))
    assert strut.centre == (1.5, 2.0, 0.0)
    assert strut.first_axis == pytest.approx((0.6, 0.8, 0.0))
    assert strut.inertia == pytest.approx((4e-4, 2e-4 + 50.0 / 12.0, 2e-4 + 50.0 / 12.0))


def test_an_arc_is_a_length_and_a_frequency_is_no_angular_one() -> None:
    arc = evaluate("crank * turn / (1 s)", SCOPE).dimensions
    assert fits(arc, dimensions_of("m/s"))
    assert not fits(arc, dimensions_of("m"))
    for text in ("1 Hz", "2 * 1 Hz"):
        with pytest.raises(InputError, match=r"drive\.angular_frequency"):
            td.load_case("vsv").replace({"drive.angular_frequency": text})
    assert not fits(evaluate("1 rad/s", SCOPE).dimensions, dimensions_of("Hz"))


def test_every_function_names_how_many_arguments_it_takes() -> None:
    for name, (n, _) in FUNCTIONS.items():
        given = n - 1 if name in OF_ANY_NUMBER else n + 1
        with pytest.raises(ExpressionProblem, match=f"{name} takes {n} argument"):
            evaluate(f"{name}({', '.join(['ratio'] * given)})", SCOPE)


@pytest.mark.parametrize(
    "text", ["f", "2 * f", "50 Hz", "3000 / (60 s)", "1 / (2 s)", "f / pi", "f * (1 + 0)", "max(f, v / c)"]
)
def test_turns_in_some_time_are_no_angular_speed(text: str) -> None:
    found = evaluate(text, ANGULAR)
    assert not fits(found.dimensions, dimensions_of("rad/s"), found.turns)


@pytest.mark.parametrize(("text", "value"), [("max(1, 2, ratio)", 3.0), ("min(4, ratio, 5, 6)", 3.0)])
def test_the_extreme_of_more_than_two(text: str, value: float) -> None:
    assert evaluate(text, SCOPE).value == value


def test_what_follows_from_a_wrong_parameter_is_not_reported_again() -> None:
    with pytest.raises(InputError) as caught:
        model(MODEL.replace('crank = "50 mm"', 'crank = "rod / 3"', 1))
    assert len(caught.value.faults) == 1


def test_a_number_that_is_not_finite_is_no_expression() -> None:
    with pytest.raises(InputError, match="the number must be finite"):
        model(MODEL.replace('mass = "1 kg"', 'mass = "nan kg"', 1))
