"""The pages on validation name tests and sets that exist."""

import re
from pathlib import Path

from tribodyn.validation import NAMES

ROOT = Path(__file__).parents[3]
PAGE = (ROOT / "docs" / "validation" / "index.md").read_text(encoding="utf-8")


def test_every_named_test_exists() -> None:
    named = re.findall(r"`(tests/[^`]+\.py)`", PAGE)
    assert len(named) > 20
    assert [path for path in named if not (ROOT / path).is_file()] == []


def test_every_set_stands_in_the_table_by_quantity() -> None:
    assert set(re.findall(r"\(sets/([a-z_0-9]+)\.md\)", PAGE)) == set(NAMES)
