"""The page of a sweep, and bands of a sweep on the page of a run."""

import re

import numpy as np
import pytest

from tribodyn.mechanisms.catalogue import load_case
from tribodyn.mechanisms.results import summarise
from tribodyn.report import write
from tribodyn.report.page import FOLDER, bands
from tribodyn.report.parallel import at_first, axes_of, payload, points_of
from tribodyn.results import netcdf_content
from tribodyn.studies import Sampling, make_plan
from tribodyn.studies.archive import merge


@pytest.fixture
def sweep():
    """A grid of six points, the fourth of which failed with markup in its reason."""
    plan = make_plan(
        load_case("vsv"), {"joint.clearance": "20,30,40 um", "contact.law": "ke,rsdc"}, Sampling()
    )
    found = {
        point.name: {"failure": "", "contact_force_max_N": 10.0 * k, "tilt_max_mrad": 1.0}
        if k != 3
        else {"failure": "<i>no</i> equilibrium"}
        for k, point in enumerate(plan.points)
    }
    return merge(plan, found)


def test_axes_hold_parameters_in_their_units_and_numbers(sweep):
    axes = {axis.name: axis for axis in axes_of(sweep)}
    assert axes["joint.clearance"].label == "joint.clearance [µm]"
    assert axes["joint.clearance"].values == pytest.approx([20.0, 20.0, 30.0, 30.0, 40.0, 40.0])
    assert axes["contact.law"].categories == ("ke", "rsdc")
    assert axes["contact.law"].texts == ("ke", "rsdc") * 3
    assert axes["contact_force_max_N"].texts[3] == "—"
    assert at_first(list(axes.values()), ())[:2] == ["joint.clearance", "contact.law"]


def test_the_page_links_the_reports_that_are_there(sweep, tmp_path):
    name = str(sweep["points"].values.ravel()[1])
    report = tmp_path / "points" / name / "report.html"
    report.parent.mkdir(parents=True)
    report.write_text("", encoding="utf-8")
    text = write(sweep, tmp_path).read_text(encoding="utf-8")
    page = text[: text.index('id="page-data"')]
    assert re.findall(r'href="(points/[^"]*)"', page) == [f"points/{name}/report.html"]
    assert "1 of 6 points have no result" in page
    assert "&lt;i&gt;no&lt;/i&gt; equilibrium" in page
    assert "<i>" not in page


def test_a_sweep_without_any_result_still_has_a_page(sweep, tmp_path):
    bare = sweep.drop_vars(["contact_force_max_N", "tilt_max_mrad"])
    assert payload(axes_of(bare), points_of(bare, None), ()) is None
    text = write(bare, tmp_path).read_text(encoding="utf-8")
    assert "page-data" not in text
    assert "Table of all 6 points" in text


def test_lines_of_points_whose_energy_is_missed_are_marked(sweep):
    warnings = np.full(sweep["failure"].shape, "", dtype=object)
    warnings.flat[2] = "the energy balance misses 7 %"
    marked = sweep.assign(doubtful=(sweep["failure"].dims, warnings.astype(str)))
    found = payload(axes_of(marked), points_of(marked, None), ())
    assert [point["caution"] for point in found["points"]] == [
        "",
        "",
        "Do not use these numbers: the energy balance misses 7 %.",
        "",
        "",
        "",
    ]


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
