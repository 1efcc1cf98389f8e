"""Running a program and asking the system what it took."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Final

ROOT: Final = Path(__file__).parents[1]


def measured(arguments: list[str], environment: Mapping[str, str] | None = None) -> dict[str, Any]:
    """Run Python with arguments; return seconds of the clock and of the processor, peak memory and output."""
    with tempfile.TemporaryFile("w+") as output:
        begin = time.perf_counter()
        child = subprocess.Popen(
            [sys.executable, *arguments],
            stdout=output,
            stderr=subprocess.STDOUT,
            cwd=ROOT,
            env={**os.environ, **(environment or {})},
        )
        _, status, used = os.wait4(child.pid, 0)
        seconds = time.perf_counter() - begin
        child.returncode = os.waitstatus_to_exitcode(status)
        output.seek(0)
        text = output.read()
    if child.returncode != 0:
        raise RuntimeError(f"{arguments} ended with {child.returncode}:\n{text}")
    return {
        "seconds": seconds,
        "processor seconds": used.ru_utime + used.ru_stime,
        "peak memory [MB]": used.ru_maxrss / 1024,
        "output": text,
    }
