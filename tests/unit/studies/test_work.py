"""What else holds."""

from importlib.metadata import version
from pathlib import Path
from typing import Any

from tribodyn.mechanisms.catalogue import load_case
from tribodyn.results.netcdf import dataset_of
from tribodyn.studies import work

CASE = load_case("vsv")


def computed(*more: Any, made_by: str = "", clearance: str = "20 um") -> work.PointOutcome:
    """Compute one point."""
    (found,) = work.compute(CASE, [{"joint.clearance": clearance}], made_by or version("tribodyn"), *more)
    return found


def test_a_failed_run_keeps_what_it_computed(simulated: list[Any]) -> None:
    outcome = computed(True, clearance="30 um")
    assert outcome.failure
    assert outcome.final
    assert outcome.result


def test_a_result_is_staged_where_there_is_a_place_and_returned_where_not(
    simulated: list[Any], tmp_path: Path
) -> None:
    staged = computed(True, str(tmp_path / "sweep"))
    assert staged.result == b""
    assert Path(staged.staged).parent == tmp_path
    returned = computed(True, str(tmp_path / "nowhere" / "sweep"))
    assert returned.staged == ""
    # The file format notes the second in which each was written.
    assert dataset_of(returned.result).identical(dataset_of(Path(staged.staged).read_bytes()))
    assert returned.summary == staged.summary
    assert not computed(False, str(tmp_path / "sweep")).staged
    assert len(list(tmp_path.iterdir())) == 1
