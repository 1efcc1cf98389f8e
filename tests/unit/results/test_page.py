from pathlib import Path

import pytest

from tribodyn.mechanisms.catalogue import MECHANISMS
from tribodyn.results import VARIABLES
from tribodyn.results.summary import EFFORT

PAGE = Path(__file__).parents[3] / "docs" / "guide" / "results.md"


LISTS = [VARIABLES, EFFORT]
for _mechanism in MECHANISMS.values():
    LISTS += [_mechanism.variables, _mechanism.key_results, [f"{name}.png" for name in _mechanism.figures]]


@pytest.mark.parametrize("names", LISTS)
def test_the_manual_lists_everything_a_result_may_hold(names):
    text = PAGE.read_text(encoding="utf-8")
    assert [name for name in names if f"`{name}`" not in text] == []
