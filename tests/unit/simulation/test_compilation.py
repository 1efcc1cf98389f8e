import os
import subprocess
import sys
from pathlib import Path

import numba as nb
import pytest

from tribodyn.core import stopping
from tribodyn.core.errors import Stopped
from tribodyn.mechanisms.catalogue import load_case
from tribodyn.simulation import compilation

CASE = load_case("vsv").replace({"title": "not simulated by any other test"})


@pytest.fixture(autouse=True)
def nothing_loaded(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(compilation, "_loaded", set())


@nb.njit  # type: ignore[untyped-decorator]
def never_compiled(number: float) -> float:
    return number


def asks_for_compilation() -> None:
    never_compiled(1.0)


def test_loading_compiles_nothing() -> None:
    assert not compilation.loaded(CASE, asks_for_compilation)
    assert never_compiled.signatures == []
    # It is not forbidden for good.
    assert never_compiled(1.0) == 1.0
    assert compilation.loaded(CASE, asks_for_compilation)


def test_equations_are_loaded_once_whatever_the_numbers() -> None:
    runs: list[None] = []

    def first_steps() -> None:
        runs.append(None)

    for clearance in ("20 um", "30 um"):
        assert compilation.loaded(CASE.replace({"joint.clearance": clearance}), first_steps)
    assert len(runs) == 1
    assert compilation.loaded(CASE.replace({"solver.name": "bdf"}), first_steps)
    assert len(runs) == 2


def test_what_is_wrong_with_a_case_is_left_to_the_run() -> None:
    def first_steps() -> None:
        raise ValueError("wrong")

    assert compilation.loaded(CASE, first_steps)


def test_ctrl_c_while_another_process_compiles_ends_this_one(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(
        compilation,
        "_CHILD",
        "import os, signal; signal.signal(2, signal.SIG_DFL); os.kill(os.getpid(), 2)",
    )
    with pytest.raises(KeyboardInterrupt):
        compilation.compile_elsewhere(CASE)


def test_the_other_process_ends_when_this_one_is_to_stop(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    note = tmp_path / "pid"
    child = f"import os, time; open({os.fspath(note)!r}, 'w').write(str(os.getpid())); time.sleep(60)"
    monkeypatch.setattr(compilation, "_CHILD", child)

    def stop() -> bool:
        return note.exists() and bool(note.read_text())

    with pytest.raises(Stopped), stopping.asked(stop):
        compilation.compile_elsewhere(CASE)
    with pytest.raises(ProcessLookupError):
        os.kill(int(note.read_text()), 0)


def test_what_compiles_ends_with_whoever_asked_for_it() -> None:
    child = "from tribodyn.simulation.compilation import from_parent; print(from_parent(), flush=True)"
    command = [sys.executable, "-c", f"{child}; import time; time.sleep(60)"]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE) as process:
        assert process.stdin is not None
        assert process.stdout is not None
        process.stdin.write(b'"case text"\n')
        process.stdin.flush()
        assert process.stdout.readline() == b"case text\n"
        process.stdin.close()
        assert process.wait(timeout=300) == 1
