"""Results of journal cases: what they hold, and what ends early."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr

import tribodyn as td
from tribodyn.mechanisms.catalogue import MECHANISMS
from tribodyn.mechanisms.results import read, summarise, write_run
from tribodyn.presets.journal.system import journal_of
from tribodyn.results import VARIABLES

SHORT = {"run.duration": "0.4 ms", "run.output_interval": "2 us"}
KE = {"contact.law": "ke"}


def simulate(name: str, **changes: object) -> xr.Dataset:
    return td.simulate(td.load_case(name).replace({**SHORT, **changes}))


@pytest.fixture(scope="module")
def dry() -> xr.Dataset:
    return simulate("journal-dry")


@pytest.fixture(scope="module")
def undamped() -> xr.Dataset:
    return simulate("journal-dry", **KE)


@pytest.fixture(scope="module")
def oil() -> xr.Dataset:
    return simulate("journal-oil")


def test_two_laws_are_two_runs_that_part_at_the_contact(dry: xr.Dataset, undamped: xr.Dataset) -> None:
    assert dry["e_x"].dims == ("time",)
    assert dry.sizes["time"] == 201
    assert dry["time"].values[-1] == pytest.approx(0.4e-3)
    assert dry.attrs["kind"] == "journal"
    free = dry["time"].values < 0.15e-3
    assert dry["e_x"].values[free] == pytest.approx(undamped["e_x"].values[free], rel=1e-6)
    assert float(undamped["energy_damping"][-1]) == 0.0
    assert float(dry["energy_damping"][-1]) > 1e-4


def test_film_variables_are_there_with_oil_only(dry: xr.Dataset, oil: xr.Dataset) -> None:
    film = {"F_ox", "F_oy", "M_of", "energy_film", "film_force_peak"}
    assert not film & set(dry.variables)
    assert film <= set(oil.variables)
    assert set(oil.variables) <= set(VARIABLES) | set(MECHANISMS["journal"].variables)


def test_key_results(dry: xr.Dataset, undamped: xr.Dataset, oil: xr.Dataset) -> None:
    damped: Any = summarise(dry)
    summary: Any = summarise(undamped)
    assert summary["contact_force_max_N"] > damped["contact_force_max_N"] > 4000.0
    assert isinstance(summary["rebounds"], int)
    assert summary["contact_start_ms"] == pytest.approx(0.175, abs=0.003)
    assert "film_force_max_N" not in summary
    assert summarise(oil)["film_force_max_N"] == pytest.approx(223.6, rel=0.01)  # the whole load


def test_a_result_survives_the_disk(oil: xr.Dataset, tmp_path: Path) -> None:
    write_run(oil, tmp_path)
    again = read(tmp_path)
    assert summarise(again) == summarise(oil)
    assert td.load_case(tmp_path / "case.toml").to_toml() == oil.attrs["case"]


def test_the_same_case_gives_the_same_numbers(oil: xr.Dataset) -> None:
    again = simulate("journal-oil")
    assert all(np.array_equal(again[name], oil[name], equal_nan=True) for name in ("e_x", "F_ox"))


def test_an_interrupted_run_keeps_what_it_has() -> None:
    case = td.load_case("journal-dry").replace({**SHORT, "solver.name": "radau"})
    reached = [0.0]
    stopped = td.simulate(case, progress=reached.append, stop=lambda: reached[-1] > 0.1e-3)
    assert stopped.attrs["failure"] == "interrupted"
    assert 0.1e-3 < stopped.attrs["time_reached"] < case.duration
    assert 1 <= stopped.sizes["time"] < 201
    assert np.isfinite(stopped["e_x"]).all()
    summary: Any = summarise(stopped)
    assert summary["status"] == "failed"


def test_progress_ends_with_the_run() -> None:
    seen: list[float] = []
    td.simulate(td.load_case("journal-dry").replace(SHORT), progress=seen.append)
    assert all(np.diff(seen) >= 0.0)
    assert seen[-1] == pytest.approx(0.4e-3)


def test_a_start_in_equilibrium_stays_there() -> None:
    still = simulate("journal-dry", **{"run.start": "equilibrium"})
    assert float(np.ptp(still["e_x"].values)) < 1e-10
    summary: Any = summarise(still)
    assert summary["settling_time_ms"] == 0.0


def test_a_turning_journal_reports_its_friction() -> None:
    changes = {"journal.speed": "300 rad/s", "joint.friction_coefficient": 0.1, "run.start": "equilibrium"}
    summary: Any = summarise(simulate("journal-oil", **changes))
    assert 0.005 < summary["friction_coefficient"] < 0.01


def test_a_tilting_journal_tilts(dry: xr.Dataset) -> None:
    changes = {"journal.tilt": True, "loads.moment_x": "0.2 N m"}
    tilted = simulate("journal-dry", **changes)
    assert float(tilted["phi_x"].max()) > 1e-5
    assert float(abs(dry["phi_x"]).max()) == 0.0


def test_oil_is_in_the_clearance_at_the_temperatures_of_the_run() -> None:
    expansion = {f"surfaces.{part}.thermal_expansion": "20e-6 1/K" for part in ("trunnion", "bushing")}
    warm = {"temperature.trunnion": "40 degC", "temperature.bushing": "80 degC"}
    journal = journal_of(td.load_case("journal-oil").replace({**expansion, **warm}))
    assert journal.film is not None
    assert journal.film.clearance == journal.joint.geometry.clearance != 20e-6
