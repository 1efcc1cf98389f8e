"""Runs that begin again with elastic bodies where asperities alone do not carry them."""

import json
from itertools import pairwise
from pathlib import Path

import numpy as np

import tribodyn as td
from tribodyn.cases.case import Case
from tribodyn.mechanisms.catalogue import load_case
from tribodyn.studies import sweep


def smooth(**more: object) -> Case:
    """Return a wear campaign on surfaces so smooth that the impacts press them through each other."""
    grid = {"solver.grid.theta": 48, "solver.grid.z": 8}
    surfaces = {f"surfaces.{body}.roughness": "0.03 um" for body in ("trunnion", "bushing")}
    run = {"run.cycles": 1, "wear.cycles": 2000, "loads.air_moment": "3 N m"}
    return load_case("vsv").replace(grid | surfaces | run | more)


def test_an_interrupted_campaign_goes_on_with_the_elastic_bodies_that_it_had(tmp_path: Path) -> None:
    whole, kept = td.simulate(smooth()), tmp_path / "campaign.npz"
    assert "Asperities alone do not carry this run" in whole.attrs["notes"]
    assert whole["wear_cycles"].size > 3
    seen: list[float] = []

    def late() -> bool:
        """Tell whether the second run, whose progress begins anew, is half through."""
        return any(b < a for a, b in pairwise(seen)) and seen[-1] > 1000.0

    stopped = td.simulate(smooth(), checkpoint=kept, progress=seen.append, stop=late)
    assert stopped.attrs["failure"] == "interrupted"
    again: list[float] = []
    resumed = td.simulate(smooth(), checkpoint=kept, progress=again.append)
    assert again[0] > 500.0
    assert resumed.attrs["notes"] == whole.attrs["notes"]
    np.testing.assert_array_equal(resumed["wear_depth"], whole["wear_depth"])
    assert resumed.attrs["rows_sha256"] == whole.attrs["rows_sha256"]


def test_the_case_in_a_result_holds_the_bodies_that_its_run_had() -> None:
    found = td.simulate(smooth(**{"wear.cycles": 0}))
    again = td.simulate(smooth(**{"wear.cycles": 0, "joint.bulk": "conformal"}))
    assert 'bulk = "conformal"' in found.attrs["case"]
    assert found.attrs["rows_sha256"] == again.attrs["rows_sha256"]
    assert td.simulate(smooth(**{"wear.cycles": 0, "joint.bulk": "none"})).attrs["failure"]


def test_a_load_that_bodies_do_not_carry_either_leaves_the_run_that_asperities_carried() -> None:
    found = td.simulate(load_case("vsv").replace({"loads.air_moment": "2000 N m"}))
    assert "closer than the contact law reaches" in found.attrs["failure"]
    assert "Asperities alone" not in found.attrs["notes"]


def test_a_sweep_says_which_of_its_points_have_elastic_bodies() -> None:
    surfaces = {f"surfaces.{body}.roughness": "0.1 um" for body in ("trunnion", "bushing")}
    case = load_case("journal-dry").replace({**surfaces, "run.duration": "1 ms"})
    vary = {"loads.x.force": ["1 N", "10 kN"]}
    found = sweep(case, vary, workers=0)
    (note,) = json.loads(found.attrs["notes"])
    assert note.startswith("1 of 2 points have elastic bodies")
    assert note.endswith("loads.x.force.value = 10000 N")
    alike = sweep(case.replace({"joints.bearing.clearance.bulk": "conformal"}), vary, workers=0)
    assert json.loads(alike.attrs["notes"]) == []
