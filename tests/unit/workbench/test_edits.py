"""Models edited on a page: what can be added and removed, and the same messages as for a case file."""

import pytest

from tribodyn.cases.case import Case
from tribodyn.core.errors import InputError
from tribodyn.mechanisms.catalogue import load_case, parse_case, templates
from tribodyn.workbench.description import description
from tribodyn.workbench.edits import edited, removable
from tribodyn.workbench.messages import Edit
from tribodyn.workbench.variant import Origin

CLEARANCE = {"radius": "6 mm", "radial": "20 um", "length": "10 mm"}


@pytest.fixture(scope="module")
def origin() -> Origin:
    return Origin(load_case("four-bar"), "four-bar")


def test_a_clearance_is_removed_and_another_added(origin: Origin) -> None:
    added = {f"joints.main.clearance.{key}": text for key, text in CLEARANCE.items()}
    found = edited(origin, Edit(removed=("joints.coupler-pin.clearance",), added=added))
    real = [name for name, joint in found.case.joints.items() if joint.clearance is not None]
    assert real == ["main"]
    assert found.case.joints["main"].clearance.radial == pytest.approx(20e-6, rel=1e-12)


def test_the_saved_file_holds_the_model_and_its_command_reads_it(origin: Origin) -> None:
    added = {"loads.tool.body": "rocker", "loads.tool.force.value": "3 N", "loads.tool.direction": "1, 0, 0"}
    variant = edited(origin, Edit(added=added)).varied({"drives.motor.speed": "250 rpm"})
    again: Case = parse_case(variant.toml, "again")
    assert again == variant.case
    assert again.at("drives.motor.speed.value") == variant.case.at("drives.motor.speed.value")
    assert variant.command == "tribodyn run case.toml"
    assert "load_case('case.toml')" in variant.python
    assert "replace" not in variant.python


@pytest.mark.parametrize("name", templates())
def test_every_template_can_be_started_from_and_described(origin: Origin, name: str) -> None:
    found = edited(origin, Edit(template=name))
    about = description(found)
    assert about["title"] == found.case.title
    assert about["controls"]
    assert about["run"] == found.varied({}).run


@pytest.mark.parametrize(
    ("edit", "key", "words"),
    [
        (Edit(removed=("joints.main",)), "drives.motor.joint", "is no joint"),
        (Edit(removed=("surfaces",)), "surfaces", "cannot be removed"),
        (Edit(added={"joints.x.type": "hinge"}), "joints.x.type", 'did you mean "revolute"'),
        (Edit(added={"joints.x y.type": "revolute"}), "joints.x y.type", "a name of letters"),
        (Edit(added={"loads.x.force.table": "/etc/passwd"}), "loads.x.force.table", "may not name files"),
        (Edit(added={"joints.main.clearance.mesh": "/etc/passwd"}), "joints.main.clearance.mesh", "files"),
        (Edit(added={"joints.main.clearance.radius": "6 mm"}), "joints.main.clearance.radial", "radial"),
        (Edit(template="../secret"), "TEMPLATE", "allowed: door-hinge"),
    ],
)
def test_what_cannot_be_is_refused_by_its_key(origin: Origin, edit: Edit, key: str, words: str) -> None:
    with pytest.raises(InputError) as refused:
        edited(origin, edit)
    assert key in [fault.key for fault in refused.value.faults]
    assert words in str(refused.value)


def test_the_messages_are_those_of_a_case_file(origin: Origin) -> None:
    text = origin.case.to_toml() + '\n[joints.x]\ntype = "revolute"\nbetween = ["ground", "crnk"]\n'
    text += 'point = ["0 mm", "0 mm", "0 mm"]\naxis = [0, 0, 1]\n'
    with pytest.raises(InputError) as of_file:
        parse_case(text, "file")
    joint = {"type": "revolute", "between": "ground, crnk", "point": "0, 0, 0 mm", "axis": "0, 0, 1"}
    with pytest.raises(InputError) as of_page:
        edited(origin, Edit(added={f"joints.x.{key}": value for key, value in joint.items()}))
    (page,), (file,) = of_page.value.faults, of_file.value.faults
    assert page.key == file.key
    # Only what was given is quoted as it was written.
    assert page.reason.partition("; ")[2] == file.reason.partition("; ")[2] != ""


def test_removable_tables_are_those_with_names_and_clearances(origin: Origin) -> None:
    found = removable(origin.case)
    assert "joints.coupler-pin.clearance" in found
    assert "drives.motor" in found
    assert "surfaces" not in found
    assert removable(load_case("vsv")) == ()


def test_forms_offer_the_names_of_the_model(origin: Origin) -> None:
    parts = {part["table"]: part for part in description(origin)["addable"]}
    between = next(field for field in parts["joints.*"]["fields"] if field["name"] == "between")
    assert between["known"] == ["ground", "crank", "coupler", "rocker"]
    assert between["many"] == 2
    assert parts["joints.*.clearance"]["parents"] == ["main", "crankpin", "rocker-pivot"]
