from __future__ import annotations

import subprocess
from collections.abc import Callable
from typing import Any

import numba as nb
import pytest

from tribodyn.cases import Case
from tribodyn.mechanisms.catalogue import load_case
from tribodyn.simulation import compilation

CASE = load_case("vsv").replace({"title": "not simulated by any other test"})


@pytest.fixture(autouse=True)
def nothing_loaded(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(compilation, "_loaded", set())


@nb.njit  # type: ignore[untyped-decorator]
def never_compiled(number: float) -> float:
    return number


def asks_for_compilation(case: Case, *, stop: Callable[[], bool]) -> None:
    never_compiled(1.0)


def test_loading_compiles_nothing() -> None:
    assert not compilation.loaded(CASE, asks_for_compilation)
    assert never_compiled.signatures == []
    # It is not forbidden for good.
    assert never_compiled(1.0) == 1.0
    assert compilation.loaded(CASE, asks_for_compilation)


def test_equations_are_loaded_once_whatever_the_numbers() -> None:
    runs: list[Case] = []

    def simulator(case: Case, *, stop: Callable[[], bool]) -> None:
        assert stop()
        runs.append(case)

    for clearance in ("20 um", "30 um"):
        assert compilation.loaded(CASE.replace({"joint.clearance": clearance}), simulator)
    assert len(runs) == 1
    assert compilation.loaded(CASE.replace({"solver.name": "bdf"}), simulator)
    assert len(runs) == 2


def test_what_is_wrong_with_a_case_is_left_to_the_run() -> None:
    def simulator(case: Case, *, stop: Callable[[], bool]) -> None:
        raise ValueError("wrong")

    assert compilation.loaded(CASE, simulator)


def test_ctrl_c_while_another_process_compiles_ends_this_one(monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupted(command: list[str], **_: Any) -> subprocess.CompletedProcess[bytes]:
        return subprocess.CompletedProcess(command, -2)

    monkeypatch.setattr(subprocess, "run", interrupted)
    with pytest.raises(KeyboardInterrupt):
        compilation.compile_elsewhere(CASE)
