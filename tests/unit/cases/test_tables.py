"""Tables that a user names: read, written, changed, swept and documented by dotted paths like all others."""

from collections.abc import Mapping
from typing import Any, Literal

import pytest

from tribodyn.cases import Case
from tribodyn.cases.case import Group, NamedGroup, demand
from tribodyn.cases.fields import Entry, choice, number, quantity, tables, text
from tribodyn.cases.load import parse
from tribodyn.cases.tables import empty_tables
from tribodyn.core.errors import InputError


class Faces(Group):
    """End faces of a joint."""

    gap: float | None = quantity(None, "axial clearance", "", gt=0, example="50 um")


class End(NamedGroup):
    """One end of a spring."""

    stiffness: float = number(1.0, "share of the stiffness", "", ge=0)


class Joint(NamedGroup):
    """A joint between two bodies."""

    type: Literal["revolute", "spherical"] = choice("revolute", "how it moves", "")
    law: str = choice("rsdc", "contact law", "", family="tribodyn.contact:LAWS")
    clearance: float = quantity("20 um", "radial clearance", "", gt=0)
    radius: float = quantity("6 mm", "radius of the pin", "", gt=0)
    faces: Faces = Faces()

    def model_post_init(self, context: object, /) -> None:
        """Check what involves two keys."""
        demand(self.clearance <= 0.1 * self.radius, "clearance", "at most a tenth of the radius")


class Spring(NamedGroup):
    """A spring."""

    note: str = text("", "what it is for")
    ends: Mapping[str, End] = tables("its ends")


class Toy(Case):
    """A kind of case with named tables."""

    case: Literal["toy"] = choice("toy", "the kind of system", "")
    gravity: float = quantity("9.81 m/s^2", "gravity", "", ge=0)
    joints: Mapping[str, Joint] = tables("the joints")
    springs: Mapping[str, Spring] = tables("the springs")


SOURCE = """
case = "toy"
[joints.wrist]
clearance = "30 um"
[joints.crankpin]
type = "spherical"
[joints.crankpin.faces]
gap = "50 um"
[joints.main-1]
[springs.s.ends.left]
stiffness = 0.5
[springs.s.ends.right]
"""


def parsed(text: str = SOURCE) -> Any:
    return parse(text, "toy.toml", {"toy": Toy})


def test_named_tables_are_read_in_their_order_with_defaults() -> None:
    case = parsed()
    assert list(case.joints) == ["wrist", "crankpin", "main-1"]
    assert case.joints["wrist"].clearance == 30e-6
    assert case.joints["main-1"] == Joint()
    assert case.at("joints.crankpin.faces.gap") == 50e-6
    assert case.at("springs.s.ends.left.stiffness") == 0.5
    assert list(case.springs["s"].ends) == ["left", "right"]
    assert parsed('case = "toy"\n[joints]').joints == {}


@pytest.mark.parametrize("comments", [False, True])
@pytest.mark.parametrize("source", [SOURCE, 'case = "toy"'])
def test_what_is_written_reads_back(source: str, comments: bool) -> None:
    case = parsed(source)
    again = parsed(case.to_toml(comments=comments))
    assert again == case
    assert list(again.joints) == list(case.joints)
    assert again.to_toml() == case.to_toml()


def test_show_explains_tables_that_a_case_has_none_of() -> None:
    shown = parsed(SOURCE.split("[springs")[0]).to_toml(comments=True)
    assert "# [springs.NAME]\n" in shown
    assert "# [springs.NAME.ends.NAME]\n# stiffness = 1 " in shown
    assert "# [joints.NAME]" not in shown


def test_values_are_changed_by_dotted_path() -> None:
    case = parsed()
    wide = case.replace({"joints.crankpin.clearance": "40 um", "springs.s.ends.right.stiffness": "0.25"})
    assert wide.joints["crankpin"].clearance == 40e-6
    assert wide.joints["crankpin"].type == "spherical"
    assert wide.springs["s"].ends["right"].stiffness == 0.25
    assert list(wide.joints) == list(case.joints)
    assert case.joints["crankpin"].clearance == 20e-6
    assert wide.replace({"joints.crankpin.clearance": "20 um", "springs.s.ends.right.stiffness": 1}) == case


REFUSED = {
    "joints.crankpin.CLEARANCE": "nearest valid one is joints.crankpin.clearance",
    "joints.crankpin.radial_clearance": "nearest valid one is joints.crankpin.clearance",
    "joints.hub.clearance": r"the case has no joints.hub; it has: wrist, crankpin, main-1; write a table",
    "joints.crankpin.qqqq": "unknown key; keys of joints.crankpin: type, law, clearance, radius, faces",
    "joints.crankpin.gravity": "nearest valid one is gravity, which stands above the first",
    "joint.wrist.radius": "nearest valid one is joints.wrist.radius",
    "joints.crankpn.clearance": "nearest valid one is joints.crankpin.clearance",
    "joints.crankpin.clerance": "nearest valid one is joints.crankpin.clearance",
    "joint.wrist.clearance": "nearest valid one is joints.wrist.clearance",
    "joints.crankpin": "this is a table, not a value; its keys: type, law, clearance, radius",
    "joints.crankpin.faces": "this is a table, not a value; its keys: gap",
    "joints": r"this holds only tables: joints.NAME, joints.NAME.faces",
    "springs.s.ends": r"this holds only tables: springs.NAME.ends.NAME",
    "joints.crankpin.clearance.more": "unknown key",
    "joints.*.clearance": r'given "\*.clearance"; allowed: a name of letters',
    "joints..clearance": r'given ".clearance"; allowed: a name of letters',
}


@pytest.mark.parametrize(("path", "message"), REFUSED.items(), ids=REFUSED.keys())
def test_changing_what_is_not_there_is_refused_with_a_hint(path: str, message: str) -> None:
    with pytest.raises(InputError, match=message) as caught:
        parsed().replace({path: "30 um"}, source="--set")
    assert (caught.value.key, caught.value.source) == (path, "--set")


@pytest.mark.parametrize("name", ['"crank pin"', '"a.b"', '""', '"kurbelöse"', "a" * 41, '"a\\u0000"', '"*"'])
def test_names_are_bare_keys_of_limited_length(name: str) -> None:
    for line in ("", 'clearance = "30 um"'):
        with pytest.raises(InputError, match="allowed: a name of letters without accents, digits, - and _"):
            parsed(f'case = "toy"\n[joints.{name}]\n{line}')
    with pytest.raises(InputError, match='given "crank pin"; allowed'):
        parsed('case = "toy"\n[joints."crank pin"]\nclearance = "30 um"')


WRONG = {
    'clearance = "30 kg"': ("clearance", "allowed: a number with a unit of length"),
    'clearance = "0 m"': ("clearance", "allowed: a number with a unit of length, > 0"),
    'type = "revolut"': ("type", 'did you mean "revolute"'),
    'law = "rsdd"': ("law", 'did you mean "rsdc"'),
    'clearance = "1 mm"': ("clearance", 'given "1 mm"; at most a tenth of the radius'),
    'radius = "0.1 mm"': ("clearance", 'by default "20 um"; at most a tenth of the radius'),
    "clearence = 1": ("clearence", "nearest valid one is joints.pin.clearance"),
    "faces = 3": ("faces", "this is a table, not a value"),
}


@pytest.mark.parametrize("line", WRONG)
def test_messages_name_the_table(line: str) -> None:
    key, message = WRONG[line]
    with pytest.raises(InputError, match=message) as caught:
        parsed(f'case = "toy"\n[joints.good]\n[joints.pin]\n{line}')
    assert (caught.value.key, caught.value.source) == (f"joints.pin.{key}", "toy.toml")


def test_a_value_in_the_place_of_a_table_is_refused() -> None:
    with pytest.raises(InputError, match="this is a table, not a value") as caught:
        parsed('case = "toy"\njoints.pin = 3')
    assert caught.value.key == "joints.pin"


def test_the_order_of_names_is_no_difference() -> None:
    blocks = ('[joints.a]\nclearance = "30 um"\n', "[joints.b]\n")
    one, other = (parsed('case = "toy"\n' + "".join(order)) for order in (blocks, blocks[::-1]))
    assert one == other
    assert hash(one) == hash(other)
    assert one != parsed('case = "toy"\n[joints.a]\n[joints.b]')


def test_empty_tables_outlive_a_change() -> None:
    assert "main-1" in parsed().replace({"gravity": "0 m/s^2"}).joints


def test_a_table_is_empty_where_it_or_a_table_in_it_has_keys() -> None:
    given = {path: Entry({}, "") for path in ("a", "a.b", "a.b.c", "d")} | {"e": Entry({}, "", text=True)}
    assert empty_tables(given, ["a.b.c.key", "d", "e.key"]) == {"a", "a.b", "a.b.c"}
