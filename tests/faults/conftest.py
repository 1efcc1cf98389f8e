"""Disks of their own, which are full or may not be written to, and processes whose commands are watched."""

import shutil
import subprocess
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from tests.faults.trial import Watched


@pytest.fixture(scope="session")
def process() -> Iterator[Watched]:
    """Return what runs commands in processes of their own, which are there for all tests."""
    processes = Watched()
    yield processes
    processes.close()


@pytest.fixture
def mounted(tmp_path: Path) -> Iterator[Callable[[str], Path]]:
    """Return what gives a folder on a disk with the options asked for, where the system lets us mount one."""
    folder = tmp_path / "disk"
    folder.mkdir()

    def mount(options: str) -> Path:
        command = ["mount", "-t", "tmpfs", "-o", options, "tmpfs", str(folder)]
        if shutil.which("mount") is None or subprocess.run(command, capture_output=True).returncode:
            pytest.skip("mounting is not allowed here")
        return folder

    yield mount
    if folder.is_mount():
        subprocess.run(["umount", str(folder)], check=True)
