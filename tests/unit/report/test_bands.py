"""The band of key results over a sweep of what is assumed, on the page of the run in its middle."""

import pytest

from tribodyn.mechanisms.catalogue import load_case
from tribodyn.mechanisms.results import summarise
from tribodyn.report import write
from tribodyn.report.page import FOLDER, bands
from tribodyn.results import netcdf_content
from tribodyn.studies import Sampling, make_plan
from tribodyn.studies.archive import merge

VARIED = {"joint.friction_coefficient": [0.05, 0.1], "contact.minimum_entry_velocity": "0.1 mm/s, 1 mm/s"}
FORCES = (101.0, 104.0, 110.0, 117.0)  #: Of friction 0.05 with both velocities, then of 0.1.


@pytest.fixture
def run(make_result, tmp_path):
    """Return the result of a run beside which a sweep around it stands."""
    case = load_case("vsv")
    plan = make_plan(case, VARIED, Sampling())
    points = [point.name for point in plan.points]
    found = {
        name: {"contact_force_outside_N": force, "reversals": 3}
        for name, force in zip(points, FORCES, strict=True)
    }
    (tmp_path / FOLDER).mkdir()
    (tmp_path / FOLDER / "sweep.nc").write_bytes(netcdf_content(merge(plan, found)))
    return make_result(4.0, case=case.to_toml())


def test_a_band_goes_over_all_keys_and_over_each_alone(run, tmp_path):
    table = bands(run, summarise(run), tmp_path)
    (row,) = table["rows"]  # a count has no band
    assert row["whole"] == "101 to 117"
    # The run has a friction of 0.1 and 1 mm/s.
    assert row["alone"] == ["104 to 117", "110 to 117"]
    assert [key["range"] for key in table["keys"]] == ["0.05 to 0.1", "0.1 to 1 mm/s"]


def test_it_stands_on_the_page(run, tmp_path):
    page = write(run, tmp_path, []).read_text(encoding="utf-8")
    assert "What assumed numbers do" in page
    assert "101 to 117" in page


def test_a_sweep_of_another_case_or_a_damaged_one_is_left_alone(run, make_result, tmp_path):
    other = make_result(4.0, case=load_case("vsv").replace({"joint.clearance": "30 um"}).to_toml())
    assert bands(other, summarise(other), tmp_path) is None
    assert "What assumed numbers do" not in write(other, tmp_path, []).read_text(encoding="utf-8")
    (tmp_path / FOLDER / "sweep.nc").write_bytes(b"no result")
    assert bands(run, summarise(run), tmp_path) is None
