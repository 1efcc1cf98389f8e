"""Benchmarks are run by hand and seldom: here each runs once over next to nothing, so that it still can."""

from __future__ import annotations

import importlib
import json

import pytest

from benchmarks.__main__ import BY_HAND, NAMES

#: These take many seconds even so; some compile kernels that the library lacks.
LASTING = ("joint_kernel", "kinks", "long_run", "ring", "vsv", "workbench")


@pytest.mark.parametrize(
    "name",
    [pytest.param(name, marks=pytest.mark.long) if name in LASTING else name for name in (*NAMES, *BY_HAND)],
)
def test_a_benchmark_runs(name: str) -> None:
    found = importlib.import_module(f"benchmarks.{name}").run(quick=True)
    assert found
    json.dumps(found)
