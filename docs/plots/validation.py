"""Compute every validation set: a page and a plot each, and the table of all sets.

python docs/plots/validation.py OUTPUT_DIRECTORY
"""

from __future__ import annotations

import sys
from pathlib import Path

from tribodyn.validation.catalogue import chosen
from tribodyn.validation.report import Judged, save, sets_table


def main() -> None:
    """Write everything into the given directory."""
    target = Path(sys.argv[1]) / "validation"
    target.mkdir(parents=True, exist_ok=True)
    judged = [Judged(one, one.run()) for one in chosen([])]
    save(judged, target)
    (target / "table_of_sets.md").write_text("\n".join(sets_table(judged)) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
