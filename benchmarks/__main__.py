"""Run benchmarks: ``python -m benchmarks [NAME ...]``; all of them without a name.

Each is a module here with a function ``run`` that prints and returns what it found; ``all.json`` collects it.
"""

from __future__ import annotations

import importlib
import json
import sys
from pathlib import Path
from typing import Final

NAMES: Final = ("joint_kernel", "vsv", "growth")
"""Every benchmark once: to add one, write a module with ``run`` and name it here."""
TARGET: Final = Path(__file__).parents[1] / "docs" / "_static" / "benchmarks.json"


def main(names: list[str]) -> None:
    """Run the named benchmarks and keep what the others found before."""
    found = json.loads(TARGET.read_text(encoding="utf-8")) if TARGET.exists() else {}
    for name in names or NAMES:
        print(f"== {name}", flush=True)
        found[name] = importlib.import_module(f"benchmarks.{name}").run()
    TARGET.write_text(json.dumps(found, indent=1), encoding="utf-8")


if __name__ == "__main__":
    main(sys.argv[1:])
