"""Benchmarks are run by hand and seldom: here each runs once over next to nothing, so that it still can."""

from __future__ import annotations

import importlib
import json

import pytest

from benchmarks.__main__ import NAMES


@pytest.mark.parametrize("name", NAMES)
def test_a_benchmark_runs(name: str) -> None:
    found = importlib.import_module(f"benchmarks.{name}").run(quick=True)
    assert found
    json.dumps(found)
