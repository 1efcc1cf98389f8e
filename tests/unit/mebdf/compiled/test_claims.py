"""Processes that fill one folder of machine code compile each function once."""

from __future__ import annotations

import select
import subprocess
import sys
from collections.abc import Iterator
from contextlib import ExitStack
from pathlib import Path

import pytest

PROGRAM = """
import sys
from pathlib import Path
from mebdf.compiled.claims import Claims

claims = Claims(Path(sys.argv[1]))
claims.take(sys.argv[2])
print("taken", flush=True)
sys.stdin.readline()
claims.give_back(sys.argv[2])
print("given back", flush=True)
sys.stdin.readline()
"""
LONG = 60.0
SHORT = 0.2
"""Times in which another process answers, and in which one that waits does not [s]."""


class Compiler:
    """A process that claims a function."""

    def __init__(self, folder: Path, name: str) -> None:
        command = [sys.executable, "-c", PROGRAM, str(folder), name]
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def says(self, timeout: float = LONG) -> str:
        """Return the next line, or nothing if none comes."""
        assert self.process.stdout is not None
        ready, _, _ = select.select([self.process.stdout], [], [], timeout)
        return self.process.stdout.readline().strip() if ready else ""

    def go_on(self) -> None:
        """Let it give back what it claimed."""
        assert self.process.stdin is not None
        self.process.stdin.write("\n")
        self.process.stdin.flush()


@pytest.fixture
def together(tmp_path: Path) -> Iterator[tuple[Compiler, Compiler, Compiler]]:
    """Three processes; the first has what the second wants, the third wants something else."""
    pytest.importorskip("fcntl")
    with ExitStack() as stack:
        found = []
        for name in ("double", "double", "half"):
            found.append(Compiler(tmp_path, name))
            stack.enter_context(found[-1].process)
            stack.callback(found[-1].process.kill)
            if name == "double" and len(found) == 1:
                assert found[0].says() == "taken"
        yield found[0], found[1], found[2]


def test_one_waits_for_what_another_compiles_and_nothing_else(
    together: tuple[Compiler, Compiler, Compiler],
) -> None:
    first, second, third = together
    assert third.says() == "taken"
    assert second.says(SHORT) == ""
    first.go_on()
    assert first.says() == "given back"
    assert second.says() == "taken"


def test_what_a_killed_process_claimed_is_free(together: tuple[Compiler, Compiler, Compiler]) -> None:
    first, second, _ = together
    assert second.says(SHORT) == ""
    first.process.kill()
    assert second.says() == "taken"
