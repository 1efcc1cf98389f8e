"""What the sets return: every miss explained, numbers finite, pages complete."""

from __future__ import annotations

from functools import cache

import pytest

from tribodyn.validation.base import Verdict
from tribodyn.validation.catalogue import NAMES, load
from tribodyn.validation.report import Judged, as_json, as_page, as_text

LEAST_JUDGED = 40


@cache
def _judged(name: str) -> Judged:
    one = load(name)
    return Judged(one, one.run())


@pytest.mark.parametrize("name", NAMES)
def test_every_miss_is_explained_and_nothing_else(name: str) -> None:
    judged = _judged(name)
    missed = {row.name for row in judged.outcome.comparisons if row.verdict is Verdict.OUTSIDE}
    assert missed == set(judged.set.table.get("explanations", {}))


@pytest.mark.parametrize("name", NAMES)
def test_every_band_is_used(name: str) -> None:
    judged = _judged(name)
    used = {row.band.name for row in judged.outcome.comparisons if row.band is not None}
    assert used == set(judged.set.bands)


@pytest.mark.parametrize("name", NAMES)
def test_names_of_numbers_are_unique_and_shown(name: str) -> None:
    judged = _judged(name)
    names = [row.name for row in judged.outcome.comparisons]
    assert len(set(names)) == len(names)
    text, page = as_text(judged), as_page(judged)
    for row in names:
        assert row in text
        assert row in page
    assert len(as_json(judged)["numbers"]) == len(names)


def test_enough_numbers_are_judged() -> None:
    judged = [row for name in NAMES for row in _judged(name).outcome.comparisons if row.band is not None]
    assert len(judged) >= LEAST_JUDGED
