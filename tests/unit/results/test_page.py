from __future__ import annotations

from pathlib import Path

import pytest

from tribodyn.figures import FIGURES, JOURNAL_FIGURES
from tribodyn.results import HEADLINES, LAW_HEADLINES, VARIABLES

PAGE = Path(__file__).parents[3] / "docs" / "guide" / "results.md"


@pytest.mark.parametrize(
    "names", [VARIABLES, HEADLINES, LAW_HEADLINES, [f"{name}.png" for name in (*FIGURES, *JOURNAL_FIGURES)]]
)
def test_the_manual_lists_everything_a_result_may_hold(names):
    text = PAGE.read_text(encoding="utf-8")
    assert [name for name in names if f"`{name}`" not in text] == []
