"""Builds that are killed with their workers and called again, as ``benchmarks/mechanisms/builds.py`` does."""

from pathlib import Path

import pytest

from benchmarks.mechanisms.builds import KILLS, killed


@pytest.mark.long
def test_builds_killed_and_resumed_equal_those_left_alone(tmp_path: Path) -> None:
    copies = 40
    found = killed(copies, tmp_path)
    assert len(found["killed at"]) == KILLS
    assert all(0 < done < copies for done in found["killed at"])
    assert found["resumed"] == found["undisturbed"]
