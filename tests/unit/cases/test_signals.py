"""Tables of a case that follow time: formulas, CSV files, what is refused, and dotted paths into them."""

import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Literal

import numpy as np
import pytest

from tribodyn.cases import Case
from tribodyn.cases.case import NamedGroup
from tribodyn.cases.fields import Vector, choice, name, names, quantity, tables, vector
from tribodyn.cases.load import parse
from tribodyn.cases.signals import AngleSignal, ForceSignal
from tribodyn.core.errors import InputError
from tribodyn.studies.plan import make_plan


class Load(NamedGroup):
    """A load."""

    between: tuple[str, ...] = names("two bodies", "", length=2, example='["ground", "crank"]')
    body: str | None = name(None, "on which body", "", example="crank")
    mass: float = quantity(None, "its mass", "", unit="kg", example="2 kg", gt=0, required=True)
    point: Vector = vector("0, 0, 0 m", "where it acts", "", unit="mm", example='["1 mm", "0 mm", "0 mm"]')
    direction: Vector | None = vector(None, "where it goes", "", example="[1, 0, 0]")
    force: ForceSignal | None = None
    angle: AngleSignal | None = None


class Toy(Case):
    """A kind of case with loads."""

    case: Literal["toy"] = choice("toy", "the kind of system", "")
    loads: Mapping[str, Load] = tables("the loads")


HEAD = 'case = "toy"\n[loads.gas]\nmass = "2 kg"\nbetween = ["ground", "crank"]\n'


def parsed(text: str, folder: Path | None = None) -> Any:
    return parse(HEAD + text, "toy.toml", {"toy": Toy}, folder)


def refused(text: str, folder: Path | None = None) -> str:
    with pytest.raises(InputError) as caught:
        parsed(text, folder)
    return str(caught.value)


def signal(case: Any) -> Any:
    return case.loads["gas"].force.signal()


def test_a_value_alone_is_a_constant() -> None:
    case = parsed('force = "100 N"')
    assert case.at("loads.gas.force.value") == 100.0
    assert signal(case).kind == "constant"
    assert case.replace({"loads.gas.force": "0.2 kN"}).at("loads.gas.force.value") == 200.0
    assert parsed("").loads["gas"].force is None
    assert parsed("").at("loads.gas.force.value") is None


def test_a_swing_goes_there_and_back() -> None:
    case = parsed('force = { value = "1 N", swing = "4 N", angular_frequency = "2 rad/s" }')
    mean, amplitude, frequency, phase = signal(case).coefficients
    times = np.array([0.0, math.pi / 2.0, math.pi])
    # Rounding of the sine.
    np.testing.assert_allclose(
        mean + amplitude * np.sin(frequency * times + phase), [1.0, 5.0, 1.0], atol=1e-14
    )
    assert case.loads["gas"].force.period == pytest.approx(math.pi)


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "gas.csv").write_text(
        "# measured\ntime [ms], force [kN], torque [N m]\n0, 0, 7\n1, 0.25, 8\n1, 0.25, 8\n2.5, 0.5, 9\n"
    )
    (tmp_path / "comma.csv").write_text("angle [deg];force [N]\n0;1,5\n180;2,5\n")
    return tmp_path


def test_a_file_is_read_once_and_stands_in_the_case(folder: Path) -> None:
    case = parsed('force = { table = "gas.csv" }', folder)
    force = case.loads["gas"].force
    assert force.times == (0.0, 0.001, 0.001, 0.0025)
    assert force.values == (0.0, 250.0, 250.0, 500.0)
    assert list(signal(case).kinks) == [0.0, 0.001, 0.0025]
    assert force.table is None
    (folder / "gas.csv").unlink()
    assert parse(case.to_toml(), "again", {"toy": Toy}) == case


@pytest.mark.parametrize(
    "content",
    [
        "angle [deg];force [N]\n0;1,5\n180;2,5\n",
        "angle [deg]\tforce [N]\n0\t1,5\n180\t2,5\n",
        '\ufeffTest rig 3, cold\n% by hand\n"Angle (deg)","Force (N)"\n0,1.5\n// again\n180,2.5\n',
        "Rig;3\n\nangle (deg);force, mean (net) [N]\n0,0;1,5\n1,8e2;2,5\n",
    ],
)
def test_a_table_is_read_as_instruments_write_it(content: str, folder: Path) -> None:
    (folder / "rig.csv").write_text(content, encoding="utf-8")
    force = parsed('force = { table = "rig.csv" }', folder).loads["gas"].force
    assert (force.angles, force.values) == ((0.0, math.pi), (1.5, 2.5))


def test_a_column_is_chosen_by_name_and_the_first_may_be_an_angle(folder: Path) -> None:
    assert "torque" in refused('force = { table = "gas.csv", column = "power" }', folder)
    assert "not a unit of force" in refused('force = { table = "gas.csv", column = "torque" }', folder)
    force = parsed('force = { table = "comma.csv" }', folder).loads["gas"].force
    assert force.over == "angles"
    assert force.angles == (0.0, math.pi)
    assert force.values == (1.5, 2.5)


def test_a_table_takes_the_place_of_a_value_and_back(folder: Path) -> None:
    case = parsed('force = "100 N"')
    tabled = case.replace({"loads.gas.force.table": str(folder / "gas.csv")})
    assert tabled.loads["gas"].force.value is None
    again = tabled.replace({"loads.gas.force": "3 N"})
    assert again.loads["gas"].force.values is None
    assert again == parsed('force = "3 N"')


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("force = {}", "give a value, or a table"),
        ('force = { amplitude = "1 N" }', "needs an angular_frequency"),
        ('force = { values = "1, 2 N" }', "give one of times, angles, positions"),
        ('force = { times = "1, 2 s" }', "give a value, or a table"),
        ('force = { times = "0, 1 s", values = "1, 2, 3 N" }', "3 values for 2 places"),
        ('force = { times = "0, 2, 1 s", values = "1, 2, 3 N" }', "row 3 goes back"),
        ('force = { times = "0, 1, 1, 2 s", values = "1, 2, 3, 4 N" }', "row 3 jumps"),
        ('force = { value = "1 N", table = "gas.csv" }', "not both"),
        ('force = { table = "none.csv" }', "no such file"),
        ('force = "2 m"', "not a unit of force"),
        ("force = 2", 'the unit is missing, probably force = "2 N"'),
    ],
)
def test_what_no_signal_can_be_is_refused(text: str, words: str, tmp_path: Path) -> None:
    message = refused(text, tmp_path)
    assert words in message
    assert "loads.gas.force" in message


@pytest.mark.parametrize(
    ("content", "words"),
    [
        ("", "needs a header"),
        ("0, 1\n1, 2\n2, 3\n", "names no unit"),
        ("time [s], force [N]\n0, 1\n1, x\n", 'row 2, "1, x", lacks a number'),
        ("time [s], force [N]\n0, 1\n1\n", "lacks a number"),
        ("time [kg], force [N]\n0, 1\n1, 2\n", "none of time, angle, length"),
        ("time [s]\n0\n1\n", "no column"),
    ],
)
def test_a_file_without_a_table_is_refused(content: str, words: str, tmp_path: Path) -> None:
    (tmp_path / "bad.csv").write_text(content)
    assert words in refused('force = { table = "bad.csv" }', tmp_path)


def test_components_of_a_vector_are_keys_to_change_and_vary() -> None:
    case = parsed('point = ["1 mm", "2 mm", "3 mm"]')
    assert case.loads["gas"].point == (0.001, 0.002, 0.003)
    changed = case.replace({"loads.gas.point.x": "5 mm", "loads.gas.point.z": "7 mm"})
    assert changed.loads["gas"].point == (0.005, 0.002, 0.007)
    assert changed.at("loads.gas.point.z") == 0.007
    plan = make_plan(case, {"loads.gas.point.y": "1:3:1 mm", "loads.gas.mass": "1, 2 kg"})
    assert len(plan.points) == 6
    with pytest.raises(InputError, match="not a unit of length"):
        case.replace({"loads.gas.point.x": "5 N"})
    with pytest.raises(InputError, match="give all three"):
        case.replace({"loads.gas.direction.x": "1"})


@pytest.mark.parametrize("given", ['["1 mm", "0 mm", "2 mm"]', '"1, 0, 2 mm"', '"1 mm, 0 mm, 2 mm"'])
def test_a_vector_is_a_list_or_one_text(given: str) -> None:
    case = parsed(f"point = {given}")
    assert case.loads["gas"].point == (0.001, 0.0, 0.002)
    assert 'point = ["1 mm", "0 mm", "2 mm"]' in case.to_toml()
    assert parse(case.to_toml(comments=True), "shown", {"toy": Toy}) == case


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ('["1 mm", "0 mm"]', "2 values"),
        ("[1, 0, 0]", "the unit is missing"),
        ("3", "three numbers with units of length"),
        ('["1 mm", "0 mm", ["2 mm"]]', "three numbers"),
    ],
)
def test_what_is_no_vector_is_refused(given: str, words: str) -> None:
    assert words in refused(f"point = {given}")


def test_a_key_that_must_be_given_says_so() -> None:
    with pytest.raises(InputError, match=r"loads.gas.mass: this key is missing.*2 kg"):
        parse('case = "toy"\n[loads.gas]\nbetween = ["a", "b"]\n', "toy.toml", {"toy": Toy})
