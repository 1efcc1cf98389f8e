from pathlib import Path

import pytest

from tribodyn.mechanisms.catalogue import load_case
from tribodyn.results.store import stage
from tribodyn.studies import make_plan
from tribodyn.studies.archive import Archive
from tribodyn.studies.plan import Point
from tribodyn.studies.work import PointOutcome

SUMMARY = {"status": "complete", "failure": ""}


@pytest.fixture
def point() -> Point:
    return make_plan(load_case("vsv"), {"joint.clearance": "20 um"}).points[0]


def test_what_nobody_kept_goes_in_the_end_and_that_of_other_sweeps_stays(tmp_path: Path) -> None:
    archive, other = (Archive(tmp_path, whole=True) for _ in range(2))
    with archive.open():
        stage(archive.staging, b"of a point under way when the sweep was stopped")
        left = stage(other.staging, b"of a sweep that still runs")
    assert list(archive.folder.iterdir()) == [left]


def kept(folder: Path, point: Point, number: float) -> Archive:
    """Keep the key results of a point, and return what another sweep finds there."""
    archive = Archive(folder, whole=False)
    with archive.open():
        archive.keep(point, PointOutcome({**SUMMARY, "number": number}))
    return Archive(folder, whole=False)


def test_key_results_are_lines_of_one_file_and_the_latest_counts(point: Point, tmp_path: Path) -> None:
    kept(tmp_path, point, 0.1)
    found = kept(tmp_path, point, 1.0 / 3.0)
    assert [path.name for path in tmp_path.iterdir()] == ["points.jsonl"]
    assert found.find(point) == {**SUMMARY, "number": 1.0 / 3.0}
    assert Archive(tmp_path, whole=True).find(point) is None


@pytest.mark.parametrize(
    "torn", ['{"point": "a", "summ', "[]", '{"point": 1, "summary": {}}', "\xff\x00", "[" * 9999]
)
def test_a_line_that_is_not_whole_is_left_out_and_gone_with_the_next(torn, point, tmp_path):
    kept(tmp_path, point, 1.0)
    with (tmp_path / "points.jsonl").open("a", encoding="latin-1") as stream:
        stream.write(torn)
    assert Archive(tmp_path, whole=False).find(point) == {**SUMMARY, "number": 1.0}
    assert kept(tmp_path, point, 2.0).find(point) == {**SUMMARY, "number": 2.0}
    assert (tmp_path / "points.jsonl").read_text(encoding="utf-8").count("\n") == 2


def test_a_staged_result_takes_its_place(point: Point, tmp_path: Path) -> None:
    archive = Archive(tmp_path, whole=True)
    with archive.open():
        part = stage(archive.staging, b"result")
        archive.keep(point, PointOutcome(dict(SUMMARY), staged=str(part)))
    kept = archive.folder / point.name
    assert (kept / "result.nc").read_bytes() == b"result"
    assert sorted(path.name for path in kept.iterdir()) == ["case.toml", "result.nc", "summary.json"]
    assert list(archive.folder.iterdir()) == [kept]


def test_a_sweep_that_kept_nothing_leaves_no_folder(tmp_path: Path) -> None:
    with Archive(tmp_path, whole=True).open():
        pass
    assert list(tmp_path.iterdir()) == []


def test_a_link_in_the_place_of_the_lines_is_replaced(point: Point, tmp_path: Path) -> None:
    victim = tmp_path / "victim"
    victim.write_text("precious", encoding="utf-8")
    (tmp_path / "points.jsonl").symlink_to(victim)
    kept(tmp_path, point, 1.0)
    assert victim.read_text(encoding="utf-8") == "precious"
