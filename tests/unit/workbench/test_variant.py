"""What is said of a case that the page changed: enough to make it again to the bit."""

import shlex

import pytest

from tribodyn.cli.options import _change
from tribodyn.core.errors import InputError
from tribodyn.mechanisms.catalogue import load_case
from tribodyn.workbench.variant import Origin

ODD = {
    "joint.clearance": "0.0371234567890123 mm",
    "title": 'it\'s "odd" $HOME `id` \\ µm',
    "contact.law": "gw",
}


@pytest.fixture
def origin():
    return Origin(load_case("vsv").replace({"joint.radius": "7 mm"}), "vsv", {"joint.radius": "7 mm"})


def test_the_command_makes_the_very_same_case(origin):
    variant = origin.varied(ODD)
    program, command, name, *options = shlex.split(variant.command)
    assert (program, command, options[::2]) == ("tribodyn", "run", ["--set"] * 4)
    again = load_case(name).replace(dict(_change(text) for text in options[1::2]))
    assert again.to_toml() == variant.toml


def test_the_lines_of_python_make_the_very_same_case(origin):
    variant = origin.varied(ODD)
    lines, _, _ = variant.python.rpartition("\n")
    space: dict = {}
    exec(lines, space)
    assert space["case"].to_toml() == variant.toml


def test_a_name_is_that_of_the_case_and_not_of_its_spelling(origin):
    names = [
        origin.varied({"joint.clearance": text}).run for text in ("37 um", "0.037 mm", "3.7e-5 m", "38 um")
    ]
    assert names[0] == names[1] == names[2] != names[3]


def test_values_that_follow_are_told_apart_from_those_that_were_changed(origin):
    variant = origin.varied({"mechanism.crank_mass": "1 kg"})
    assert variant.values == {"mechanism.crank_mass": "1 kg"}
    assert list(variant.follows) == ["mechanism.crank_inertia"]


def test_components_of_vectors_can_be_turned():
    origin = Origin(load_case("slider-crank"), "slider-crank")
    assert origin.varied({"gravity.z": "-9.81 m/s^2"}).case.at("gravity") == (0.0, 0.0, -9.81)


@pytest.mark.parametrize(
    ("path", "message"),
    [
        ("asperities.surface", "may not name files"),
        ("asperities", "this is a table"),
        ("x" * 5000, "unknown key"),
    ],
)
def test_what_cannot_be_turned_is_refused(origin, path, message):
    with pytest.raises(InputError, match=message) as error:
        origin.varied({path: "/etc/passwd"})
    assert len(str(error.value)) < 500
