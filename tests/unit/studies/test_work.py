from importlib.metadata import version
from typing import Any

import pytest

from tribodyn.mechanisms.catalogue import load_case
from tribodyn.studies import work

CASE = load_case("vsv")


def computed(*more: Any, made_by: str = "", clearance: str = "20 um") -> work.PointOutcome:
    """Compute one point."""
    (found,) = work.compute(CASE, [{"joint.clearance": clearance}], made_by or version("tribodyn"), *more)
    return found


def test_another_version_computes_nothing_and_that_is_not_final(simulated: list[Any]) -> None:
    outcome = computed(True, made_by="99")
    assert "the sweep was planned by 99" in outcome.failure
    assert not outcome.final
    assert simulated == []


def test_lack_of_memory_is_the_fault_of_the_worker(monkeypatch: pytest.MonkeyPatch) -> None:
    def exhausted(*_: object) -> None:
        raise MemoryError

    monkeypatch.setattr(work, "_simulated", exhausted)
    assert not computed(True).final
