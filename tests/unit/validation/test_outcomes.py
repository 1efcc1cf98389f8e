"""What the sets return: every miss explained, numbers finite, pages complete."""

import json
from collections.abc import Iterable
from functools import cache
from typing import Any

import pytest

from tribodyn.validation.base import Kind, Verdict
from tribodyn.validation.catalogue import NAMES, load
from tribodyn.validation.report import Judged, as_json, as_page, as_text, by_kind, sets_table, summary

LEAST_JUDGED = 40
#: Sets of many runs: these tests are long, and ``make check`` runs them.
SLOW = (
    *("cycloid_reducer_play", "friction_damper_backlash", "journal_stribeck", "oblique_impact"),
    *("published_statements", "published_statements_2", "vsv_practice", "journal_peak_pressure", "ball_drop"),
    *("hip_simulator_wear", "screw_drive_friction"),
)
#: A formula check, values of the library, and pull forces whose loads are not known.
WITHOUT_NULL = ("servo_friction_models", "dry_liners", "vsv_practice")


def over(names: Iterable[str]) -> Any:
    """Run a test over sets."""
    marked = [pytest.param(name, marks=pytest.mark.long) if name in SLOW else name for name in names]
    return pytest.mark.parametrize("name", marked)


@cache
def _judged(name: str) -> Judged:
    one = load(name)
    return Judged(one, one.run())


@over(NAMES)
def test_every_miss_and_every_large_e_is_explained_and_nothing_else(name: str) -> None:
    judged = _judged(name)
    needed = {
        row.name
        for row in judged.outcome.comparisons
        if row.verdict is Verdict.OUTSIDE or (row.error is not None and row.error > 1.0)
    }
    assert needed == set(judged.set.table.get("explanations", {}))
    text, page = as_text(judged), as_page(judged)
    for row in needed:
        assert judged.set.explanation(row) in text
        assert judged.set.explanation(row) in page


@pytest.mark.long
def test_assumed_inputs_of_the_bearing_only_lower_its_peak() -> None:
    rows = _judged("journal_peak_pressure").outcome.comparisons
    for row in rows:
        below, above = row.sides
        assert below > 20.0
        assert above < 1.0
        assert f"−{below:.2g} +{above:.2g}" in as_text(_judged("journal_peak_pressure"))


@pytest.mark.long
def test_numbers_are_counted_by_kind_and_by_what_the_null_model_does() -> None:
    judged = [_judged(name) for name in NAMES]
    counts = by_kind(judged)
    assert set(counts) == {Kind.PREDICTED, Kind.TABLES, Kind.FITS, Kind.CONSISTENCY}
    assert all(sum(counts[kind].values()) for kind in counts if kind is not Kind.PREDICTED)
    rows = [row for one in judged for row in one.outcome.comparisons]
    assert sum(sum(each.values()) for each in counts.values()) == len(rows)
    within = [row for row in rows if row.verdict is Verdict.WITHIN]
    for answer, name in ((True, "as is the null"), (False, "null model outside"), (None, "no null")):
        expected = sum(row.null_within is answer for row in within)
        assert sum(n for each in counts.values() for label, n in each.items() if name in label) == expected
    # No line of the text and no row of the table holds the sum of all kinds.
    total = str(len(within))
    assert total not in summary(judged).split()
    assert f"| {total} |" not in "\n".join(sets_table(judged))


@over(NAMES)
def test_every_band_is_used(name: str) -> None:
    judged = _judged(name)
    used = {row.band.name for row in judged.outcome.comparisons if row.band is not None}
    assert used == set(judged.set.bands)


@over(NAMES)
def test_names_of_numbers_are_unique_and_shown(name: str) -> None:
    judged = _judged(name)
    names = [row.name for row in judged.outcome.comparisons]
    assert len(set(names)) == len(names)
    text, page = as_text(judged), as_page(judged)
    for row in names:
        assert row in text
        assert row in page
    assert len(json.loads(json.dumps(as_json(judged), allow_nan=False))["numbers"]) == len(names)


@pytest.mark.long
def test_enough_numbers_are_judged() -> None:
    judged = [row for name in NAMES for row in _judged(name).outcome.comparisons]
    assert sum(row.verdict is not Verdict.REPORTED for row in judged) >= LEAST_JUDGED


@over(name for name in NAMES if name not in WITHOUT_NULL)
def test_a_null_model_stands_beside_every_number(name: str) -> None:
    assert all(row.null is not None for row in _judged(name).outcome.comparisons)


@pytest.mark.parametrize(
    ("name", "rows"),
    [pytest.param("journal_stribeck", 3, marks=pytest.mark.long), ("servo_gear_friction", 1)],
)
def test_what_was_chosen_with_the_values_known_is_reported_only(name: str, rows: int) -> None:
    judged = _judged(name)
    reported = [row for row in judged.outcome.comparisons if row.not_judged]
    assert len(reported) == rows
    page = as_page(judged)
    for row in reported:
        assert row.band is not None
        assert row.verdict is Verdict.REPORTED
        assert row.not_judged in page
