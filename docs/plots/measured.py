"""Measure the numbers on pages of the manual, which ``docs/fill.py`` writes into them.

python docs/plots/measured.py OUTPUT_DIRECTORY
"""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Final

from measures import contact, joints, journal, laws_in_the_vane, mebdf, mechanisms, stored, vane, wear
from measures.base import Numbers

from tribodyn.papers.cheng_2022.runs import Runs

#: Numbers by name, with what measures them.
NUMBERS: Final[Numbers] = {
    **contact.NUMBERS,
    **laws_in_the_vane.NUMBERS,
    **vane.NUMBERS,
    **journal.NUMBERS,
    **joints.NUMBERS,
    **mechanisms.NUMBERS,
    **wear.NUMBERS,
    **mebdf.NUMBERS,
    **stored.NUMBERS,
}


def main() -> None:
    """Write all numbers."""
    target = Path(sys.argv[1])
    target.mkdir(parents=True, exist_ok=True)
    runs = Runs()
    found = {name: measure(runs) for name, measure in NUMBERS.items()}
    text = json.dumps(found, indent=2, ensure_ascii=False)
    (target / "numbers.json").write_text(text + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
