"""Draw the picture of the mechanism in the README: its parts in motion.

python docs/plots/mechanism.py docs/_static/mechanism.png
"""

from __future__ import annotations

import re
import sys
from pathlib import Path
from typing import Any

import tribodyn as td

README = Path(__file__).parents[2] / "README.md"


def lines(text: str) -> str:
    """Return the lines of the README that describe the mechanism and simulate it."""
    found = re.search(r"^    bar = \{.*?^    motion = [^\n]*", text, flags=re.MULTILINE | re.DOTALL)
    assert found is not None
    return "\n".join(line[4:] for line in found[0].splitlines())


def main() -> None:
    """Run the lines of the README, and draw what comes of them."""
    names: dict[str, Any] = {"td": td}
    exec(compile(lines(README.read_text(encoding="utf-8")), "README", "exec"), names)
    names["motion"].tribodyn.plot.mechanism().savefig(sys.argv[1], dpi=110)


if __name__ == "__main__":
    main()
