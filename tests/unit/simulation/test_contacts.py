"""Runs under every contact law, with elastic bodies, and their hashes."""

import json
from dataclasses import replace
from itertools import pairwise
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pytest
import xarray as xr

import tribodyn as td
from mebdf.arrays import FloatArray, IntArray
from tribodyn.cases.case import Case
from tribodyn.cli.main import main
from tribodyn.contact import LAWS
from tribodyn.core.problem import CompiledFunctions, Problem
from tribodyn.joints import CONTACTS, SURFACE
from tribodyn.mechanisms.catalogue import load_case
from tribodyn.results.summary import summarise
from tribodyn.simulation import session as hashes
from tribodyn.simulation import simulate
from tribodyn.studies import sweep

WEIGHT = 18.0  #: Force [N] that the loads of the vane mechanism lay on the trunnion at the start, about.


def run(name: str, **changes: object) -> xr.Dataset:
    return td.simulate(td.load_case(name).replace(changes))


def check(result: xr.Dataset, kind: str) -> None:
    assert not result.attrs["failure"]
    # The mechanism moves slowly for 20 ms from its equilibrium: its force is that of the loads.
    force = np.hypot(result["F_cx"], result["F_cy"])
    assert float(force.median()) == pytest.approx(WEIGHT, rel=0.25), kind
    # The bound above which a user is warned; the clearance has hardly moved yet.
    assert result.attrs["energy_residual"] < 0.01


@pytest.mark.parametrize("law", LAWS)
def test_vane_mechanism_under_every_law(law: str) -> None:
    changes = {"contact.law": law, "contact.damping_factor": "calibrated", "contact.restitution": 0.7}
    result = run("vsv", **{"run.duration": "20 ms", **changes})
    check(result, law)
    assert float(result["p_max"].min()) > 1e6


@pytest.mark.parametrize("contact", [name for name in CONTACTS if name != SURFACE])
def test_vane_mechanism_touching_at_points(contact: str) -> None:
    result = run("vsv", **{"run.duration": "20 ms", "joint.contact": contact})
    check(result, contact)
    assert not result["p_max"].any()
    assert "no pressure field" in result.attrs["warnings"]


@pytest.mark.parametrize("contact", CONTACTS)
def test_journal_settles_where_its_load_is_carried(contact: str) -> None:
    changes = {"joints.bearing.clearance.contact": contact, "contact.restitution": 0.5}
    result = run("journal-dry", **changes).isel(time=-1, joint=0)
    # The load of the built-in case: (200, 100) N, carried along the line of centres.
    assert float(result["contact_force"][0]) == pytest.approx(-200.0, rel=0.02)
    assert float(result["contact_force"][1]) == pytest.approx(-100.0, rel=0.02)
    x, y, _ = result["displacement"].values
    assert y / x == pytest.approx(0.5, rel=1e-3)
    far = np.hypot(x, y)
    assert (far > 20e-6) == (contact != SURFACE)


def smooth(**more: object) -> Case:
    """Return a wear campaign on surfaces so smooth that the impacts press them through each other."""
    grid = {"solver.grid.theta": 48, "solver.grid.z": 8}
    surfaces = {f"surfaces.{body}.roughness": "0.03 um" for body in ("trunnion", "bushing")}
    run = {"run.cycles": 1, "wear.cycles": 200, "loads.air_moment": "3 N m"}
    return load_case("vsv").replace(grid | surfaces | run | more)


def test_an_interrupted_campaign_goes_on_with_the_elastic_bodies_that_it_had(tmp_path: Path) -> None:
    whole, kept = td.simulate(smooth()), tmp_path / "campaign.npz"
    assert "Asperities alone do not carry this run" in whole.attrs["notes"]
    assert whole["wear_cycles"].size > 3
    seen: list[float] = []

    def late() -> bool:
        """Tell whether the second run, whose progress begins anew, is half through."""
        return any(b < a for a, b in pairwise(seen)) and seen[-1] > 100.0

    stopped = td.simulate(smooth(), checkpoint=kept, progress=seen.append, stop=late)
    assert stopped.attrs["failure"] == "interrupted"
    again: list[float] = []
    resumed = td.simulate(smooth(), checkpoint=kept, progress=again.append)
    assert again[0] > 50.0
    assert resumed.attrs["notes"] == whole.attrs["notes"]
    np.testing.assert_array_equal(resumed["wear_depth"], whole["wear_depth"])
    assert resumed.attrs["rows_sha256"] == whole.attrs["rows_sha256"]


def test_the_case_in_a_result_holds_the_bodies_that_its_run_had() -> None:
    found = td.simulate(smooth(**{"wear.cycles": 0}))
    again = td.simulate(smooth(**{"wear.cycles": 0, "joint.bulk": "conformal"}))
    assert 'bulk = "conformal"' in found.attrs["case"]
    assert found.attrs["rows_sha256"] == again.attrs["rows_sha256"]
    assert td.simulate(smooth(**{"wear.cycles": 0, "joint.bulk": "none"})).attrs["failure"]


def test_a_load_that_bodies_do_not_carry_either_leaves_the_run_that_asperities_carried(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("tribodyn.mechanisms.balance._MAX_ITERATIONS", 400)  # a tenth: nothing is found
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


NOTHING: Any = None
COUPLING = np.dtype([("law", "i8"), ("stiffness", "f8", (2,))])


class Data(NamedTuple):
    """What a problem reads."""

    couplings: Any
    table: FloatArray
    exchanges: IntArray


def problem(
    *, address: int = 1, stiffness: float = 2.0, entry: float = 3.0, start: float = 0.0, pivot: int = 0
) -> Problem:
    """Return a problem that nothing integrates."""
    couplings = np.zeros(1, COUPLING)
    couplings["law"], couplings["stiffness"] = address, stiffness
    return Problem(
        functions=CompiledFunctions(*[NOTHING] * 7),
        data=Data(couplings, np.array([1.0, entry]), np.array([pivot])),
        memory=None,
        y0=np.array([start]),
        t_span=(0.0, 1.0),
        breakpoints=(),
        atol=np.array([1e-6]),
        state_names=("x",),
        n_observed=1,
        field_shape=(),
    )


def test_each_number_that_a_run_reads_counts() -> None:
    found = [
        hashes.of_data(problem(), 1e-3, "mebdf"),
        hashes.of_data(problem(), 1e-3, "bdf"),
        hashes.of_data(problem(), 1e-4, "mebdf"),
        hashes.of_data(problem(stiffness=np.nextafter(2.0, 3.0)), 1e-3, "mebdf"),
        hashes.of_data(problem(entry=-3.0), 1e-3, "mebdf"),
        hashes.of_data(problem(start=-0.0), 1e-3, "mebdf"),
        hashes.of_data(replace(problem(), breakpoints=(0.5,)), 1e-3, "mebdf"),
    ]
    assert len(set(found)) == len(found)


def test_a_run_is_verified_by_its_hash(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    result = simulate(load_case("journal-dry").replace({"run.duration": "0.2 ms"}))
    found = str(summarise(result, {})["rows_sha256"])
    command = ["run", "journal-dry", "--set", "run.duration=0.2 ms", "--no-figures", "--no-report"]
    assert main([*command, "-o", str(tmp_path / "right"), "--verify", found.upper()]) == 0
    assert found in capsys.readouterr().out
    assert main([*command, "-o", str(tmp_path / "wrong"), "--verify", "0" * 64]) == 1
    assert "not verified" in capsys.readouterr().err
