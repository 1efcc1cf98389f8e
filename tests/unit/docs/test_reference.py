"""The reference shows every part of the package, so that whatever is public is found there."""

from __future__ import annotations

import re
from pathlib import Path

ROOT = Path(__file__).parents[3]


def test_every_subpackage_stands_in_the_reference() -> None:
    page = (ROOT / "docs" / "reference" / "index.md").read_text(encoding="utf-8")
    listed = set(re.findall(r"^   tribodyn\.(\w+)$", page, re.MULTILINE))
    assert listed == {path.parent.name for path in (ROOT / "src" / "tribodyn").glob("*/__init__.py")}
