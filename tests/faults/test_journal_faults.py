"""Journals that cannot be: refused with a clear message, or stopped with nothing lost."""

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

import tribodyn as td
from tribodyn.cli.main import main
from tribodyn.core.errors import InputError
from tribodyn.joints import BushingJoint
from tribodyn.lubrication import Film
from tribodyn.mechanisms.results import summarise
from tribodyn.presets.journal.equilibrium import Journal, Loads, equilibrium

REFUSED = [
    ("journal-oil", "film.viscosity", "0 Pa s", "> 0"),
    ("journal-oil", "film.viscosity", "-0.01 Pa s", "> 0"),
    ("journal-oil", "film.viscosity", "0.01", "Pa s"),
    ("journal-oil", "film.cavitation", "gumbel", "reynolds"),
    ("journal-oil", "film.boundary", "grove", "groove"),
    ("journal-oil", "film.grid.z", "15", "even"),
    ("journal-oil", "film.peklenik_journal", "20", "<= 9"),
    ("journal-dry", "run.start_x", "20 um", "outside the bushing"),
    ("journal-dry", "run.start_x", "-25 um", "outside the bushing"),
    ("journal-dry", "journal.mass", "0 kg", "> 0"),
    ("journal-dry", "journal.speed", "3000 Hz", "angular speed"),
    ("journal-dry", "contact.law", "rscd", "rsdc"),
    ("journal-dry", "contact.second_law", "ke", "unknown key"),
    ("journal-dry", "run.output_interval", "1 s", "lasts only"),
    ("journal-dry", "loads.force_z", "1 N", "loads.force_"),
    ("journal-dry", "joint.collar_radius", "12 mm", "unknown key"),
    ("journal-dry", "joint.friction", "moment", "traction"),
]


@pytest.mark.parametrize(("case", "key", "value", "said"), REFUSED)
def test_bad_keys_are_refused_by_name(
    case: str, key: str, value: str, said: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    target = tmp_path / "out"
    assert main(["run", case, "--set", f"{key}={value}", "-o", str(target)]) == 2
    message = capsys.readouterr().err
    assert key in message
    assert said in message
    assert "Traceback" not in message
    assert not target.exists()


def test_a_load_that_the_contact_cannot_carry_stops_the_run_and_is_explained(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    target = tmp_path / "out"
    changes = ["--set", "loads.force_x=200 kN", "--set", "joint.bulk=none"]
    assert main(["run", "journal-dry", *changes, "--no-figures", "-o", str(target)]) == 1
    message = capsys.readouterr().err
    assert "closer than the contact law reaches (-4 sigma)" in message
    assert '; joint.bulk = "conformal" lets' in message
    summary = json.loads((target / "summary.json").read_text(encoding="utf-8"))
    assert summary["status"] == "failed"
    assert "stopped at t = " in summary["failure"]
    assert td.load_case(target / "case.toml").at("loads.force_x") == 200e3
    assert (target / "result.nc").exists()
    assert (target / "report.html").exists()


def test_an_equilibrium_that_cannot_be_is_refused_before_anything_is_written(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    arguments = ["--set", "loads.force_x=2 MN", "--set", "run.start=equilibrium"]
    assert main(["run", "journal-oil", *arguments, "-o", str(tmp_path / "out")]) == 2
    assert "no equilibrium" in capsys.readouterr().err
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("solver", ["mebdf", "radau", "lsoda"])
def test_every_kind_of_integrator_stops_beyond_the_range_of_the_law(solver: str) -> None:
    case = td.load_case("journal-dry").replace(
        {"loads.force_x": "200 kN", "joint.bulk": "none", "solver.name": solver}
    )
    result = td.simulate(case)
    assert "stopped at t = " in result.attrs["failure"]
    assert 0.0 < result.attrs["time_reached"] < 1e-4


@pytest.fixture
def journal(make_joint: Callable[..., BushingJoint]) -> Journal:
    return Journal(False, 0.0, Loads(200.0, 100.0), make_joint())


def test_a_film_of_another_size_is_refused(journal: Journal) -> None:
    with pytest.raises(InputError, match="another clearance"):
        replace(journal, film=Film(0.01, 30e-6, 6e-3, 20e-3))


def test_too_much_load_has_no_equilibrium(journal: Journal) -> None:
    with pytest.raises(InputError, match="more than this bearing can carry") as caught:
        equilibrium(replace(journal, loads=Loads(2e6, 0.0)))
    assert caught.value.key == "loads.force_x"


def test_a_journal_without_load_stays_where_it_is() -> None:
    result: Any = td.simulate(
        td.load_case("journal-dry").replace({"loads.force_x": "0 N", "loads.force_y": "0 N"})
    )
    assert not result.attrs["failure"]
    assert float(abs(result["e_x"]).max()) == 0.0
    assert summarise(result)["rebounds"] == 0
