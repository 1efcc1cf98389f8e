"""Run benchmarks: ``python -m benchmarks [NAME ...]``; all of them without a name.

Each is a module in a folder here with a function ``run`` that prints and returns what it found.
``benchmarks.json`` in the manual's folder collects it, with the machine it was found on; manual and figure
are made from that file.
"""

from __future__ import annotations

import importlib
import json
import os
import platform
import sys
import time
from pathlib import Path
from types import ModuleType
from typing import Final

from benchmarks.figure import draw

#: Every benchmark once, and its folder: to add one, write a module with ``run`` and name it here.
NAMES: Final = {
    "joint_kernel": "vane",
    "vsv": "vane",
    "mechanism": "mechanisms",
    "equal_errors": "vane",
    "film": "vane",
    "growth": "vane",
    "costs": "program",
    "long_run": "vane",
    "command": "program",
    "sweep": "program",
    "ring": "mechanisms",
    "workbench": "program",
    "cash": "solver",
    "kinks": "vane",
    "random_machines": "mechanisms",
    "static_machines": "mechanisms",
    "static_loops": "mechanisms",
    "options": "mechanisms",
}
#: Those that take hours, each a command of its own.
BY_HAND: Final = {"builds": "mechanisms"}
TARGET: Final = Path(__file__).parents[1] / "docs" / "_static" / "benchmarks.json"


def main(names: list[str]) -> None:
    """Run the named benchmarks, keep what the others found before, and draw the figure."""
    found = json.loads(TARGET.read_text(encoding="utf-8")) if TARGET.exists() else {}
    for name in names or NAMES:
        print(f"== {name}", flush=True)
        before, began = os.getloadavg()[0], time.perf_counter()
        measured = module(name).run()
        found[name] = {"on": machine(), "load": before, "took": time.perf_counter() - began, **measured}
        print(f"took {found[name]['took']:.0f} s", flush=True)
        TARGET.write_text(json.dumps(found, indent=1), encoding="utf-8")
    draw(found, TARGET.with_suffix(".svg"))


def module(name: str) -> ModuleType:
    """Return the module of a benchmark."""
    return importlib.import_module(f"benchmarks.{(NAMES | BY_HAND)[name]}.{name}")


def machine() -> str:
    """Return processor and Python."""
    about = Path("/proc/cpuinfo")
    lines = about.read_text(encoding="utf-8").splitlines() if about.exists() else []
    models = [line.split(":")[1].strip() for line in lines if line.startswith("model name")]
    return f"{models[0] if models else platform.processor()}, Python {platform.python_version()}"


if __name__ == "__main__":
    main(sys.argv[1:])
