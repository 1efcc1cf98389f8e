from pathlib import Path

import pytest

from tribodyn.mechanisms.catalogue import load_case
from tribodyn.results.atomic import stage
from tribodyn.studies import make_plan
from tribodyn.studies.archive import Archive
from tribodyn.studies.plan import Point
from tribodyn.studies.work import PointOutcome

SUMMARY = {"status": "complete", "failure": ""}


@pytest.fixture
def point() -> Point:
    return make_plan(load_case("vsv"), {"joint.clearance": "20 um"}).points[0]


def test_a_staged_result_takes_its_place(point: Point, tmp_path: Path) -> None:
    archive = Archive(tmp_path)
    with archive.open():
        part = stage(archive.staging, b"result")
        archive.keep(point, PointOutcome(dict(SUMMARY), staged=str(part)))
    kept = archive.folder / point.name
    assert (kept / "result.nc").read_bytes() == b"result"
    assert sorted(path.name for path in kept.iterdir()) == ["case.toml", "result.nc", "summary.json"]
    assert list(archive.folder.iterdir()) == [kept]


def test_what_nobody_kept_goes_in_the_end_and_that_of_other_sweeps_stays(tmp_path: Path) -> None:
    archive, other = Archive(tmp_path), Archive(tmp_path)
    with archive.open():
        stage(archive.staging, b"of a point under way when the sweep was stopped")
        left = stage(other.staging, b"of a sweep that still runs")
    assert list(archive.folder.iterdir()) == [left]


def test_a_sweep_that_kept_nothing_leaves_no_folder(tmp_path: Path) -> None:
    with Archive(tmp_path).open():
        pass
    assert list(tmp_path.iterdir()) == []
