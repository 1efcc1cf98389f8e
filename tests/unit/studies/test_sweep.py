import json
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr

import tribodyn as td
from tribodyn.core.errors import InputError
from tribodyn.mechanisms.catalogue import load_case, parse_case
from tribodyn.mechanisms.results import read
from tribodyn.studies import Arrival, Means, make_plan, run, sweep

GRID = {"joint.friction_coefficient": "0.1,0.2", "joint.clearance": "20,25 um"}
FAILING = {"joint.clearance": "20,30,35,40 um"}


def test_a_grid_gives_one_dimension_a_parameter(simulated: list[Any]) -> None:
    found = sweep("vsv", GRID, workers=0)
    force = found["contact_force_max_N"]
    assert force.dims == tuple(GRID)
    assert force.attrs["units"] == "N"
    assert force.attrs["long_name"]
    assert force.sel({"joint.friction_coefficient": 0.2, "joint.clearance": 2.5e-5}) == 5000.0
    clearance = found["joint.clearance"]
    assert clearance.values.tolist() == [2e-5, 2.5e-5]
    assert (clearance.attrs["units"], clearance.attrs["shown_unit"]) == ("m", "um")
    assert (found["failure"] == "").all()


def test_samples_have_a_dimension_of_their_own(simulated: list[Any]) -> None:
    vary = {"contact.law": "ke,rsdc", "joint.clearance": "uniform(10 um, 28 um)"}
    found = sweep("vsv", vary, samples=4, seed=3, workers=0)
    assert dict(found.sizes) == {"contact.law": 2, "point": 4}
    assert found["joint.clearance"].dims == ("point",)
    assert found["contact.law"].values.tolist() == ["ke", "rsdc"]
    expected = np.round(found["joint.clearance"] * 1e6) * 100.0
    xr.testing.assert_allclose(found["contact_force_max_N"], expected.broadcast_like(found["failure"]))
    assert found.attrs["sampling_seed"] == 3


def test_a_failed_point_is_nan_with_its_reason_and_the_rest_go_on(simulated: list[Any]) -> None:
    found = sweep("vsv", FAILING, workers=0)
    reasons = found["failure"].values.tolist()
    assert reasons[0] == ""
    assert "steps became too small" in reasons[1]
    assert "no equilibrium" in reasons[2]
    assert "ZeroDivisionError: surprise" in reasons[3]
    assert np.isfinite(found["contact_force_max_N"].values).tolist() == [True, False, False, False]
    assert found.attrs["points_failed"] == 3


def test_the_files_read_back(simulated: list[Any], tmp_path: Path) -> None:
    made = sweep("vsv", {**GRID, "contact.tensile_clip": "true,false"}, workers=0, directory=tmp_path)
    stored = read(tmp_path / "sweep.nc")
    assert stored["contact.tensile_clip"].values.tolist() == [True, False]
    xr.testing.assert_equal(stored, made)
    assert stored["contact_force_max_N"].attrs == made["contact_force_max_N"].attrs
    record = json.loads((tmp_path / "sweep.json").read_text(encoding="utf-8"))
    assert len(record["points"]) == 8
    assert record["points"][0]["changes"]["joint.clearance"] == "20 um"
    for row in record["points"]:
        folder = tmp_path / "points" / row["point"]
        summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
        assert summary["contact_force_max_N"] == row["contact_force_max_N"]
        assert read(folder)["contact_force_impact"].item() == row["contact_force_max_N"]
        point = parse_case((folder / "case.toml").read_text(encoding="utf-8"), "test")
        assert point == load_case("vsv").replace(row["changes"])


def test_a_rerun_computes_only_what_is_missing(simulated: list[Any], tmp_path: Path) -> None:
    sweep("vsv", {"joint.clearance": "20,25 um"}, workers=0, directory=tmp_path)
    simulated.clear()
    sweep("vsv", {"joint.clearance": "15:25:5 um"}, workers=0, directory=tmp_path)
    assert [case.joint.clearance for case in simulated] == [1.5e-5]


@pytest.mark.parametrize("spoiled", ["", '{"status": "comp', "[]"])
def test_a_point_without_a_whole_summary_is_computed_again(spoiled, simulated, tmp_path):
    vary = {"joint.clearance": "20,25 um"}
    name = make_plan(load_case("vsv"), vary).points[1].name
    first = sweep("vsv", vary, workers=0, directory=tmp_path)
    (tmp_path / "points" / name / "summary.json").write_text(spoiled, encoding="utf-8")
    (tmp_path / "points" / name / ".result.nc.abcd.part").write_bytes(b"left by a crash")
    simulated.clear()
    xr.testing.assert_equal(sweep("vsv", vary, workers=0, directory=tmp_path), first)
    assert len(simulated) == 1
    assert sorted(path.name for path in (tmp_path / "points" / name).iterdir()) == [
        "case.toml",
        "result.nc",
        "summary.json",
    ]


def test_failed_points_are_retried_only_when_asked(simulated: list[Any], tmp_path: Path) -> None:
    for means, computed in (
        (Means(0), 4),
        (Means(0), 0),
        (Means(0, retry=True), 3),
        (Means(0, fresh=True), 4),
    ):
        simulated.clear()
        found = run(make_plan(load_case("vsv"), FAILING), tmp_path, means)
        assert len(simulated) == computed
        assert found.attrs["points_failed"] == 3


def test_a_stopped_sweep_keeps_what_it_has(simulated: list[Any], tmp_path: Path) -> None:
    found = sweep("vsv", GRID, workers=0, directory=tmp_path, stop=lambda: len(simulated) == 3)
    assert np.isfinite(found["contact_force_max_N"]).sum() == 3
    assert "stopped" in found["failure"].values[1, 1]
    assert len(list((tmp_path / "points").iterdir())) == 3


def test_key_results_alone_may_be_kept(simulated: list[Any], tmp_path: Path) -> None:
    run(make_plan(load_case("vsv"), GRID), tmp_path, Means(0, keep_results=False))
    assert (tmp_path / "points.jsonl").read_text(encoding="utf-8").count("\n") == 4
    assert not (tmp_path / "points").exists()
    # Who asks for whole results later gets them.
    run(make_plan(load_case("vsv"), GRID), tmp_path, Means(0))
    assert len(list(tmp_path.glob("points/*/result.nc"))) == 4
    before = len(simulated)
    run(make_plan(load_case("vsv"), GRID), tmp_path, Means(0))
    assert len(simulated) == before


def test_statistics_of_samples_leave_failures_out(simulated: list[Any], tmp_path: Path) -> None:
    vary = {"joint.friction_coefficient": "uniform(0.1, 0.2)", "joint.clearance": "20,30 um"}
    found = sweep("vsv", vary, samples=16, workers=0, directory=tmp_path)
    good, bad = json.loads((tmp_path / "sweep.json").read_text(encoding="utf-8"))["statistics"]
    assert good["at"] == {"joint.clearance": "20 um"}
    force = found["contact_force_max_N"].values[0]
    assert good["numbers"]["contact_force_max_N"]["mean"] == pytest.approx(force.mean())
    assert good["numbers"]["contact_force_max_N"]["p95"] == pytest.approx(np.percentile(force, 95.0))
    assert bad["numbers"] == {}


def test_equal_points_are_computed_once(simulated: list[Any]) -> None:
    vary = {"joint.clearance": "20,25 um", "title": ["one"]}
    assert sweep("vsv", vary, workers=0).sizes["title"] == 1
    assert len(simulated) == 2


def test_progress_is_told_of_every_arrival(simulated: list[Any]) -> None:
    told: list[Arrival] = []
    sweep("vsv", FAILING, workers=0, progress=told.append)
    assert [(arrival.done, arrival.to_do) for arrival in told] == [(n, 4) for n in range(5)]
    assert told[0].point is None
    assert "no equilibrium" in told[3].failure


def test_bad_means_are_refused(simulated: list[Any], tmp_path: Path) -> None:
    with pytest.raises(InputError, match="0 or more"):
        sweep("vsv", GRID, workers=-1)
    (tmp_path / "points").write_text("in the way", encoding="utf-8")
    with pytest.raises(InputError, match="is a file"):
        sweep("vsv", GRID, workers=0, directory=tmp_path)
    assert simulated == []


def test_points_that_no_memory_holds_are_refused_before_any_is_computed(monkeypatch, tmp_path):
    monkeypatch.setattr(sys.modules["tribodyn.studies.sweep"], "memory", lambda: 1e8)
    with pytest.raises(InputError, match=r"estimated to take .* of memory, more than the .* of this machine"):
        sweep("vsv", {"joint.clearance": "20, 30 um"}, workers=0, directory=tmp_path)
    assert not [path for path in tmp_path.rglob("*") if path.is_file()]


def test_a_mechanism_of_python_is_swept_as_its_case_is() -> None:
    drawn = td.Mechanism(
        "Arm", gravity="0, -9.81, 0 m/s^2", run={"duration": "10 ms", "analysis": "kinematic"}
    )
    drawn.body("arm", mass="1 kg", centre="100, 0, 0 mm", inertia="1e-3, 1e-2, 1e-2 kg m^2")
    drawn.revolute("pivot", "ground", "arm", point="0, 0, 0 mm", axis=[0, 0, 1]).drive(
        "motor", "pivot", speed="1 rpm"
    )
    found, same = (sweep(one, {"bodies.arm.mass": "1, 2 kg"}, workers=0) for one in (drawn, drawn.case()))
    assert found["drive_moment_max_Nm"].values == pytest.approx(same["drive_moment_max_Nm"].values)
