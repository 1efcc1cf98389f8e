"""What is told and drawn of a mechanism: numbers by the names of joints, figures, the report, and files."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from tests.unit.mechanisms.general.made_up import N, result

from tribodyn.mechanisms import results
from tribodyn.mechanisms.general.figures import FIGURES
from tribodyn.mechanisms.general.sections import CHAPTERS
from tribodyn.mechanisms.general.sections.mechanism import at_frames
from tribodyn.mechanisms.general.skeleton import case_of, rotated, skeleton, view
from tribodyn.mechanisms.general.variables import VARIABLES
from tribodyn.results.schema import check

RESULT = result()


def test_a_result_reads_back_and_opens_in_xarray_with_names(tmp_path: Path) -> None:
    results.write_run(RESULT, tmp_path)
    again = results.read(tmp_path)
    assert again["body"].values.tolist() == ["crank", "rod", "slider"]
    opened = xr.open_dataset(tmp_path / "result.nc", engine="netcdf4", decode_timedelta=False)
    wrist = opened["reaction_force"].sel(joint="wrist", axis="x")
    assert float(wrist.max()) == pytest.approx(2700.0)
    opened.close()


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"joint": ("joint", ["main", "main", "wrist", "guide"])}, "a name of joint is given twice"),
        ({"joint": ("joint", [1.0, 2.0, 3.0, 4.0])}, "joint does not hold texts"),
    ],
)
def test_a_result_whose_names_are_none_is_refused(change: dict[str, object], words: str) -> None:
    attributes = RESULT["joint"].attrs
    wrong = RESULT.assign_coords(change)
    wrong["joint"].attrs.update(attributes)
    with pytest.raises(ValueError, match=words):
        check(wrong, {"mechanism": VARIABLES})


def test_numbers_are_told_of_each_joint_by_its_name() -> None:
    told = results.summarise(RESULT)
    assert told["joint_force_max_N"] == pytest.approx(2700.0)
    assert told["force_max_N_guide"] == pytest.approx(40.0)
    assert told["offset_max_um_wrist"] == pytest.approx(22.0)
    assert told["peak_pressure_MPa_wrist"] == pytest.approx(40.0)
    assert "offset_max_um_main" not in told
    labels = results.known(told, "mechanism")
    assert labels["force_max_N_guide"].label == "Force, largest, guide"
    assert set(labels) == {name for name, value in told.items() if isinstance(value, int | float)}


def test_bodies_are_drawn_where_they_are() -> None:
    case = case_of(RESULT)
    assert case is not None
    drawn, (position, orientation) = skeleton(case), at_frames(RESULT)
    quarter = N // 4
    crank = drawn.lines(0, position[quarter, 0], orientation[quarter, 0])
    # Lengths in mm; straight lines between rows shorten an arc of six degrees by a thousandth.
    np.testing.assert_allclose(crank, [[0.0, 0.0, 0.0], [0.0, 50.0, 0.0]], atol=0.1)
    rod = drawn.lines(1, position[quarter, 1], orientation[quarter, 1])
    np.testing.assert_allclose(np.linalg.norm(rod[1] - rod[0]), 120.0, atol=0.1)


def test_a_quaternion_turns_vectors() -> None:
    half = np.sqrt(0.5)
    turned = rotated(np.array([half, 0.0, 0.0, half]), np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 2.0]]))
    # Rounding.
    np.testing.assert_allclose(turned, [[0.0, 1.0, 0.0], [0.0, 0.0, 2.0]], atol=1e-15)


@pytest.mark.parametrize("flat", [0, 1, 2])
def test_a_flat_mechanism_is_seen_across_its_plane(flat: int) -> None:
    points = np.random.default_rng(1).uniform(size=(9, 3))
    points[:, flat] *= 0.01
    eye, up = view(points)
    assert abs(eye[flat]) == 1.0
    assert eye @ up == 0.0


@pytest.mark.parametrize("name", FIGURES)
def test_every_figure_is_drawn_of_a_whole_result_and_of_an_empty_one(name: str) -> None:
    family = FIGURES[name]
    if not family.drawable(RESULT):
        assert name == "wear_history"
        return
    assert family.draw(RESULT).axes
    assert family.draw(RESULT.isel(time=slice(0, 0), frame=slice(0, 0))).axes


@pytest.mark.parametrize(
    "section", [s for chapter in CHAPTERS for s in chapter.sections], ids=lambda s: s.name
)
def test_every_section_has_data_where_the_result_has(section) -> None:
    whole = section.payload(RESULT)
    assert (whole is None) == (section.name == "wear-history")
    empty = section.payload(RESULT.isel(time=slice(0, 0), frame=slice(0, 0)))
    assert empty is None or section.name == "wear"


def test_each_joint_with_clearance_has_its_orbit_and_each_joint_its_forces() -> None:
    sections = {section.name: section for chapter in CHAPTERS for section in chapter.sections}
    orbits, forces = sections["orbits"].payload(RESULT), sections["reactions"].payload(RESULT)
    assert orbits is not None
    assert forces is not None
    assert orbits["names"] == ["wrist"]
    assert forces["names"] == ["main", "pin", "wrist", "guide"]
