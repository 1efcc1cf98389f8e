"""Shares of joints in the error of an output."""

from pathlib import Path

import numpy as np
import pytest
from tests.analytic.mechanism.test_outputs import CRANK, ROD, press

import tribodyn as td
from tribodyn.core.errors import InputError
from tribodyn.mechanism.descriptor import TEMPLATES
from tribodyn.mechanisms.catalogue import parse_case
from tribodyn.studies import contributions
from tribodyn.studies.contributions import BENDING

PIN = {"radius": "9.5 mm", "length": "20 mm", "axial": "50 um", "nodes_around": 48, "nodes_along": 8}


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("shares")


def test_errors_of_two_joints_add_up(folder: Path) -> None:
    # The load presses both pins along the rod: twice the clearance, twice the error.
    drawn = press(radial="20 um", **PIN).clearance("crankpin", radial="40 um", **PIN)
    found = {one.output: one for one in contributions(drawn.case(), directory=folder, workers=0)}
    way = found["way"]
    assert way.unit == "µm"
    assert sorted(way.joints) == ["crankpin", "wrist"]
    share = dict(zip(way.joints, way.shares.tolist(), strict=True))
    alone = dict(zip(way.joints, way.alone.tolist(), strict=True))
    # Clearance over cos β, root mean square (1 − (R/L)²)^(−1/4); roughness holds both pins apart alike.
    assert alone["crankpin"] - alone["wrist"] == pytest.approx(
        20.0 * (1.0 - (CRANK / ROD) ** 2) ** -0.25, rel=0.01
    )
    assert share["crankpin"] / share["wrist"] == pytest.approx(alone["crankpin"] / alone["wrist"], rel=0.01)
    assert abs(way.interaction) < 0.01
    assert way.together == pytest.approx(sum(alone.values()), rel=0.01)


def test_superposition_is_that_of_the_closed_form(folder: Path) -> None:
    # A rod that carries no other load: clearance over cos β for each pin, and the sum of both together.
    drawn = press(radial="20 um", friction_coefficient="0", **PIN)
    drawn = drawn.clearance("crankpin", radial="40 um", friction_coefficient="0", **PIN)
    found = {one.output: one for one in contributions(drawn.case(), directory=folder / "smooth", workers=0)}
    way = found["way"]
    assert way.causes == ("clearance", "tilt", "friction", "bending")
    assert way.estimated == pytest.approx(60.0 * (1.0 - (CRANK / ROD) ** 2) ** -0.25, rel=2e-3)
    share = dict(zip(way.joints, way.estimate, strict=True))
    assert share["crankpin"] == pytest.approx([2.0 / 3.0, 0.0, 0.0, 0.0], abs=2e-3)
    assert share["wrist"] == pytest.approx([1.0 / 3.0, 0.0, 0.0, 0.0], abs=2e-3)
    # Roughness of 1.6 µm holds both pins apart, which makes the simulated error smaller.
    simulated = dict(zip(way.joints, way.shares, strict=True))
    assert simulated["crankpin"] == pytest.approx(share["crankpin"].sum(), abs=0.03)
    assert 0.0 < way.estimated - way.together < 2.0 * 4.0 * 1.634


def test_shares_are_those_of_results_in_the_folder(folder: Path) -> None:
    # The runs of the test above are found again; the folder holds one result for each run.
    drawn = press(radial="20 um", **PIN).clearance("crankpin", radial="40 um", **PIN)
    before = {path: path.stat().st_mtime_ns for path in folder.glob("points/*/result.nc")}
    again = contributions(drawn.case(), directory=folder, workers=0)
    assert len(before) == 3
    assert {path: path.stat().st_mtime_ns for path in folder.glob("points/*/result.nc")} == before
    for one in again:
        assert np.sum(one.shares) + one.interaction == pytest.approx(1.0, abs=1e-12)


def test_elastic_bodies_are_a_part_of_their_own(tmp_path: Path) -> None:
    # The air moment bends a lever of titanium: F L²/3EI, and 3 % of shear.
    changes = {"pattern.vanes.count": 2, "run.cycles": 0.4}
    case = parse_case(TEMPLATES["vsv-ring"].text, "ring").replace(changes)
    vane, *_ = contributions(case, directory=tmp_path, workers=0)
    assert vane.joints == ("trunnion[1]", "trunnion[2]", BENDING)
    length, moment_of_area = np.hypot(24.240900475, 43.730752842), 3.0 * 10.0**3 / 12.0
    angle = 840.0 / length * length**2 / (3.0 * 110e3 * moment_of_area)
    assert vane.alone[-1] == pytest.approx(1.03 * np.degrees(angle), rel=0.02)
    assert vane.alone[1] < 1e-3 * vane.alone[0]
    assert vane.shares[-1] == pytest.approx(vane.estimate[-1].sum(), abs=0.05)
    assert 0.0 < vane.interaction < 0.1


@pytest.mark.parametrize(
    ("case", "said"),
    [("vsv", "one joint with clearance, which causes all"), ("ideal", "no joint has clearance")],
    ids=["vsv", "ideal"],
)
def test_without_outputs_or_clearances_there_is_nothing_to_divide(case, said, tmp_path):
    chosen = press().case() if case == "ideal" else td.load_case(case)
    with pytest.raises(InputError, match=said):
        contributions(chosen, directory=tmp_path)
    assert not list(tmp_path.iterdir())
