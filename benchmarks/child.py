"""Running a program and asking the system what it took.

The peak of a process begins with that of the process that started it, so a small one in between starts it:
``python -m benchmarks.child ARGUMENTS``.
"""

from __future__ import annotations

import json
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
    between = subprocess.run(
        [sys.executable, "-m", "benchmarks.child", *arguments],
        stdout=subprocess.PIPE,
        cwd=ROOT,
        env={**os.environ, **(environment or {})},
        check=True,
    )
    found: dict[str, Any] = json.loads(between.stdout)
    if found.pop("status") != 0:
        raise RuntimeError(f"{arguments} failed:\n{found['output']}")
    return found


def main(arguments: list[str]) -> None:
    """Run Python with arguments and print what it took."""
    with tempfile.TemporaryFile("w+", encoding="utf-8") as output:
        begin = time.perf_counter()
        child = subprocess.Popen([sys.executable, *arguments], stdout=output, stderr=subprocess.STDOUT)
        _, status, used = os.wait4(child.pid, 0)
        seconds = time.perf_counter() - begin
        output.seek(0)
        text = output.read()
    found = {
        "seconds": seconds,
        "processor seconds": used.ru_utime + used.ru_stime,
        "peak memory [MB]": used.ru_maxrss / 1024,
        "status": os.waitstatus_to_exitcode(status),
        "output": text,
    }
    print(json.dumps(found))


if __name__ == "__main__":
    main(sys.argv[1:])
