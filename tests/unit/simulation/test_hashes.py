"""Hashes change with every number of a run, and with nothing else."""

from dataclasses import replace
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pytest

from tribodyn.cli.main import main
from tribodyn.core.arrays import FloatArray, IntArray
from tribodyn.core.problem import CompiledFunctions, Problem
from tribodyn.mechanisms.catalogue import load_case
from tribodyn.results.summary import summarise
from tribodyn.simulation import session as hashes
from tribodyn.simulation import simulate

NOTHING: Any = None
COUPLING = np.dtype([("law", "i8"), ("stiffness", "f8", (2,))])


class Data(NamedTuple):
    """What a problem reads."""

    couplings: Any
    table: FloatArray
    exchanges: IntArray


def problem(
    *, address: int = 1, stiffness: float = 2.0, entry: float = 3.0, start: float = 0.0, pivot: int = 0
) -> Problem:
    """Return a problem that nothing integrates."""
    couplings = np.zeros(1, COUPLING)
    couplings["law"], couplings["stiffness"] = address, stiffness
    return Problem(
        functions=CompiledFunctions(*[NOTHING] * 7),
        data=Data(couplings, np.array([1.0, entry]), np.array([pivot])),
        memory=None,
        y0=np.array([start]),
        t_span=(0.0, 1.0),
        breakpoints=(),
        atol=np.array([1e-6]),
        state_names=("x",),
        n_observed=1,
        field_shape=(),
    )


def test_each_number_that_a_run_reads_counts() -> None:
    found = [
        hashes.of_data(problem(), 1e-3, "mebdf"),
        hashes.of_data(problem(), 1e-3, "bdf"),
        hashes.of_data(problem(), 1e-4, "mebdf"),
        hashes.of_data(problem(stiffness=np.nextafter(2.0, 3.0)), 1e-3, "mebdf"),
        hashes.of_data(problem(entry=-3.0), 1e-3, "mebdf"),
        hashes.of_data(problem(start=-0.0), 1e-3, "mebdf"),
        hashes.of_data(replace(problem(), breakpoints=(0.5,)), 1e-3, "mebdf"),
    ]
    assert len(set(found)) == len(found)


def test_a_run_is_verified_by_its_hash(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    result = simulate(load_case("journal-dry").replace({"run.duration": "0.2 ms"}))
    found = str(summarise(result, {})["rows_sha256"])
    command = ["run", "journal-dry", "--set", "run.duration=0.2 ms", "--no-figures", "--no-report"]
    assert main([*command, "-o", str(tmp_path / "right"), "--verify", found.upper()]) == 0
    assert found in capsys.readouterr().out
    assert main([*command, "-o", str(tmp_path / "wrong"), "--verify", "0" * 64]) == 1
    assert "not verified" in capsys.readouterr().err
