"""Columns of results for spreadsheets and fits, and parts of a result in a notebook."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from tests.unit.mechanism.made_up import result

import tribodyn as td
import tribodyn.accessor
from tribodyn.cli.main import main
from tribodyn.core.errors import InputError
from tribodyn.results.columns import GROUPS, table
from tribodyn.studies.measured import read as read_measured


@pytest.fixture(scope="module")
def run() -> xr.Dataset:
    return td.simulate(td.load_case("slider-crank").replace({"run.duration": "2 ms"}))


@pytest.fixture
def stored(run: xr.Dataset, tmp_path: Path) -> Path:
    quick = ["--set", "run.duration=2 ms", "--no-figures", "--no-report", "--quiet"]
    assert main(["run", "slider-crank", *quick, "-o", str(tmp_path)]) == 0
    return tmp_path


def test_a_column_is_a_variable_with_its_labels_and_its_unit(run: xr.Dataset) -> None:
    found = table(run, ["reaction_force.wrist", "output_value"])
    assert list(found) == [
        *("time [s]", "reaction_force.wrist.x [N]", "reaction_force.wrist.y [N]"),
        *("reaction_force.wrist.z [N]", "output_value.slider [m]"),
    ]
    assert np.array_equal(
        found["reaction_force.wrist.y [N]"], run["reaction_force"].sel(joint="wrist", axis="y")
    )


@pytest.mark.parametrize("group", GROUPS)
def test_a_group_has_columns_that_say_something(group: str, run: xr.Dataset) -> None:
    found = table(run, [group])
    assert len(found.columns) > 1
    assert (found.drop(columns="time [s]") != 0.0).any().all()


def test_an_angle_of_a_joint_comes_first_in_degrees(run: xr.Dataset) -> None:
    found = table(run, ["drive_moment.main"], over="main")
    assert list(found)[:2] == ["joint_angle.main [deg]", "time [s]"]
    known = np.degrees(run["joint_angle"].sel(joint="main").values)
    np.testing.assert_allclose(found["joint_angle.main [deg]"], known, rtol=1e-14)


@pytest.mark.parametrize(
    ("names", "over", "reason"),
    [
        (["reaction_frce"], None, 'did you mean "reaction_force"'),
        (["force"], None, 'did you mean "forces"'),
        (["reaction_force.wirst"], None, "main, crankpin, wrist, guide"),
        (["forces"], "mian", 'did you mean "main"'),
        (["forces"], "joint_angle", "add a label"),
    ],
)
def test_what_is_not_there_is_refused(names, over, reason, run):
    with pytest.raises(InputError, match=reason):
        table(run, names, over=over)


def test_a_dataframe_has_a_row_for_each_time(run: xr.Dataset) -> None:
    assert len(run.tribodyn.to_dataframe("forces", "outputs", over="main")) == run.sizes["time"]


@pytest.mark.parametrize(("decimal", "separator"), [("point", ","), ("comma", ";")])
def test_a_file_opens_in_a_spreadsheet_and_in_a_fit(decimal, separator, stored, run):
    path = stored / "some.csv"
    arguments = ["export", str(stored), "--csv", "drive_moment.main", "--decimal", decimal, "-o", str(path)]
    assert main(arguments) == 0
    assert path.read_bytes().startswith(b"\xef\xbb\xbf")
    rows = list(csv.reader(path.read_text(encoding="utf-8-sig").splitlines(), delimiter=separator))
    assert rows[0] == ["time [s]", "drive_moment.main [N m]"]
    known = run["drive_moment"].sel(joint="main").values
    assert [float(row[1].replace(",", ".")) for row in rows[1:]] == known.tolist()
    measured = read_measured(path, run)
    assert np.array_equal(measured.values, known)


def test_a_table_goes_nowhere_but_into_a_file(stored: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["export", str(stored), "--csv", "forces", "-o", str(stored)]) == 2
    assert main(["export", str(stored), "--csv", ",", "-o", "x.csv"]) == 2
    assert "--csv" in capsys.readouterr().err


RESULT = result()


def test_a_joint_is_chosen_by_its_name_and_a_wrong_one_answered() -> None:
    assert RESULT.tribodyn.sel(joint="wrist")["reaction_force"].dims == ("time", "axis")
    with pytest.raises(
        InputError, match=r'joint: given "wirst"; allowed: main, pin, wrist, guide; did you mean "wrist"'
    ):
        RESULT.tribodyn.sel(joint="wirst")
    with pytest.raises(InputError, match="joints: no such dimension"):
        RESULT.tribodyn.sel(joints="wrist")


def test_a_result_is_read_at_even_times() -> None:
    step = 5e-5
    found = RESULT.tribodyn.resample(step)
    np.testing.assert_allclose(np.diff(found["time"]), step)
    expected = np.interp(found["time"], RESULT["time"], RESULT["joint_angle"].values[:, 0])
    np.testing.assert_allclose(found["joint_angle"].values[:, 0], expected, atol=1e-12)
    assert found.attrs["kind"] == "mechanism"
    with pytest.raises(InputError, match=r"above 0 and at most 0\.012"):
        RESULT.tribodyn.resample(0.0)


def test_key_results_are_a_table() -> None:
    numbers = RESULT.tribodyn.numbers
    assert numbers.loc["force_max_N_wrist", "part"] == "wrist"
    assert numbers.loc["force_max_N_wrist", "unit"] == "N"
    assert numbers.loc["force_max_N_wrist", "value"] == RESULT.tribodyn.summary["force_max_N_wrist"]


def test_a_chart_is_drawn_over_the_angle_of_a_joint() -> None:
    figure = RESULT.tribodyn.plot.joint_forces(over="main")
    assert figure.axes[-1].get_xlabel() == "angle of main [°]"
    assert RESULT.tribodyn.plot().texts[0].get_text() == "Errors of the outputs"
    with pytest.raises(InputError, match=r'over: given "mian"; allowed: a joint, .*did you mean "main"'):
        RESULT.tribodyn.plot.joint_forces(over="mian")
    with pytest.raises(InputError, match="orbits has no time axis"):
        RESULT.tribodyn.plot.orbits(over="main")
