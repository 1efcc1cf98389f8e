"""Journals that cannot be: refused with a clear message, or stopped with nothing lost."""

import json
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import pytest

import tribodyn as td
from tribodyn.cli.main import main
from tribodyn.core.errors import InputError
from tribodyn.joints import BushingJoint
from tribodyn.mechanism.analyses.shaft_in_bore import Journal, equilibrium
from tribodyn.mechanisms.catalogue import parse_case

REFUSED = [
    ("journal-oil", "joints.bearing.film.viscosity", "0 Pa s", "> 0"),
    ("journal-oil", "joints.bearing.film.viscosity", "-0.01 Pa s", "> 0"),
    ("journal-oil", "joints.bearing.film.viscosity", "0.01", "Pa s"),
    ("journal-oil", "joints.bearing.film.cavitation", "gumbel", "reynolds"),
    ("journal-oil", "joints.bearing.film.boundary", "grove", "groove"),
    ("journal-oil", "joints.bearing.film.grid.z", "15", "even"),
    ("journal-oil", "joints.bearing.film.peklenik_journal", "20", "<= 9"),
    ("journal-dry", "bodies.journal.mass", "0 kg", "> 0"),
    ("journal-dry", "drives.motor.speed", "3000 Hz", "angular speed"),
    ("journal-dry", "contact.law", "rscd", "rsdc"),
    ("journal-dry", "contact.second_law", "ke", "unknown key"),
    ("journal-dry", "run.output_interval", "1 s", "lasts only"),
    ("journal-dry", "joint.clearance", "20 um", "unknown key"),
]


def test_a_file_of_an_earlier_version_learns_the_new_keys() -> None:
    with pytest.raises(InputError, match=r"joints\.bearing\.clearance\.radial") as caught:
        parse_case('case = "journal"\njoint.clearance = "30 um"\n', "mine.toml")
    assert caught.value.key == "case"
    assert "tribodyn new journal-oil" in str(caught.value)


@pytest.mark.parametrize(("case", "key", "value", "said"), REFUSED)
def test_bad_keys_are_refused_by_name(case, key, value, said, tmp_path, capsys):
    target = tmp_path / "out"
    assert main(["run", case, "--set", f"{key}={value}", "-o", str(target)]) == 2
    message = capsys.readouterr().err
    assert key in message
    assert said in message
    assert "Traceback" not in message
    assert not target.exists()


def test_a_load_that_the_contact_cannot_carry_stops_the_run_and_is_explained(tmp_path, capsys):
    target = tmp_path / "out"
    changes = ["--set", "loads.x.force=200 kN", "--set", "joints.bearing.clearance.bulk=none"]
    assert main(["run", "journal-dry", *changes, "--no-figures", "-o", str(target)]) == 1
    message = capsys.readouterr().err
    assert "closer than the contact law reaches (-4 sigma)" in message
    assert '; joints.bearing.clearance.bulk = "conformal" lets' in message
    summary = json.loads((target / "summary.json").read_text(encoding="utf-8"))
    assert summary["status"] == "failed"
    assert "stopped at t = " in summary["failure"]
    assert td.load_case(target / "case.toml").at("loads.x.force.value") == 200e3
    assert (target / "result.nc").exists()
    assert (target / "report.html").exists()


@pytest.mark.parametrize("solver", ["mebdf", "radau", "lsoda"])
def test_every_kind_of_integrator_stops_beyond_the_range_of_the_law(solver: str) -> None:
    case = td.load_case("journal-dry").replace(
        {"loads.x.force": "200 kN", "joints.bearing.clearance.bulk": "none", "solver.name": solver}
    )
    result = td.simulate(case)
    assert "stopped at t = " in result.attrs["failure"]
    assert 0.0 < result.attrs["time_reached"] < 1e-4


def test_too_much_load_has_no_equilibrium(make_joint: Callable[..., BushingJoint]) -> None:
    journal = Journal(make_joint(), (200.0, 100.0))
    with pytest.raises(InputError, match="more than this bearing can carry") as caught:
        equilibrium(replace(journal, load=(2e6, 0.0)))
    assert caught.value.key == "load"


def test_a_journal_without_load_stays_where_it_is() -> None:
    still = td.load_case("journal-dry").replace({f"loads.{axis}.force": "0 N" for axis in "xy"})
    result: Any = td.simulate(still)
    assert not result.attrs["failure"]
    assert float(abs(result["displacement"]).max()) == 0.0
