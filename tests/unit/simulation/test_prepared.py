from typing import Any

import numpy as np
import pytest

import tribodyn as td
from tribodyn.mechanism import system
from tribodyn.simulation import compilation

CASE = td.load_case("slider-crank").replace({"run.cycles": 1})


def test_a_first_run_assembles_its_mechanism_once_and_equals_the_second(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(compilation, "_loaded", set())
    made: list[None] = []
    assemble = system.assemble

    def counted(*arguments: Any) -> Any:
        made.append(None)
        return assemble(*arguments)

    monkeypatch.setattr(system, "assemble", counted)
    first, second = td.simulate(CASE), td.simulate(CASE)
    assert len(made) == 2
    assert first.attrs["data_sha256"] == second.attrs["data_sha256"]
    for name, values in first.data_vars.items():
        np.testing.assert_array_equal(values.values, second[name].values)
