"""Compute every validation set with the command: a page and a plot each, and the table of all sets.

python docs/plots/validation.py OUTPUT_DIRECTORY
"""

from __future__ import annotations

import json
import sys
from collections import Counter
from pathlib import Path
from types import SimpleNamespace
from typing import Any

from tribodyn.cli.main import main as tribodyn
from tribodyn.validation.base import Kind
from tribodyn.validation.report import sets_table


def counted(one: dict[str, Any]) -> Any:
    """Return what the table needs of a set that the command has written."""
    about = SimpleNamespace(name=one["set"], title=one["title"], kind=Kind(one["kind"]))
    return SimpleNamespace(set=about, counts=Counter(one["counts"]))


def main() -> None:
    """Write everything into the given directory."""
    target = Path(sys.argv[1]) / "validation"
    if status := tribodyn(["validate", "-o", str(target), "--quiet"]):
        sys.exit(status)
    sets = json.loads((target / "validation.json").read_text(encoding="utf-8"))
    table = sets_table(map(counted, sets))
    (target / "table_of_sets.md").write_text("\n".join(table) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
