"""Counts of claims and sentences by verdict, and the share that rests on our bounds."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable
from typing import Any, Final

from tribodyn.papers.cheng_2022.claims.base import SENTENCES
from tribodyn.papers.cheng_2022.claims.bounds import VERDICTS, Verdict
from tribodyn.papers.cheng_2022.claims.table import Row

FAVOURABLE: Final[tuple[Verdict, ...]] = ("reproduced", "on a condition")
_WORST_FIRST: Final[tuple[Verdict, ...]] = (
    "contradicted",
    "differs",
    "not decidable",
    "on a condition",
    "reproduced",
    "not tested",
)
"""The verdict of a sentence is the first of these that any of its rows has."""
_SCALES: Final = (0.5, 2.0)
_OF: Final[dict[str, Callable[[Row], Verdict]]] = {
    "paper": lambda row: row.verdict,
    "exact": lambda row: row.exact_verdict,
}


def by_sentence(rows: Iterable[Row], formulation: str) -> dict[str, Verdict]:
    """Return the verdict of every sentence: the least favourable one of its rows."""
    found: dict[str, set[Verdict]] = {name: set() for name in SENTENCES}
    for row in rows:
        for name in row.claim.sentences:
            found[name].add(_OF[formulation](row))
    return {name: next(one for one in _WORST_FIRST if one in verdicts) for name, verdicts in found.items()}


def counts(verdicts: Iterable[Verdict]) -> dict[Verdict, int]:
    """Return the number of times that each verdict occurs, in the order of :data:`VERDICTS`."""
    found = Counter(verdicts)
    return {verdict: found[verdict] for verdict in VERDICTS}


def changed(rows: Iterable[Row], factor: float) -> list[str]:
    """Return the names of the claims with another verdict in ``paper`` once our bounds are scaled."""
    return [row.claim.name for row in rows if row.scaled(factor).verdict != row.verdict]


def summarise(rows: list[Row]) -> dict[str, Any]:
    """Return the counts as plain data."""
    favourable = [row for row in rows if row.verdict in FAVOURABLE]
    return {
        "rows": len(rows),
        "sentences": len(SENTENCES),
        "by_row": {name: counts(of(row) for row in rows) for name, of in _OF.items()},
        "by_sentence": {name: counts(by_sentence(rows, name).values()) for name in _OF},
        "favourable": len(favourable),
        "favourable_by_our_bounds": sum(row.claim.bound.by == "we" for row in favourable),
        "changed_with_our_bounds_halved": changed(rows, _SCALES[0]),
        "changed_with_our_bounds_doubled": changed(rows, _SCALES[1]),
    }


def as_markdown(found: dict[str, Any]) -> str:
    """Return the counts as a table, and what our bounds decide."""
    lines = [
        "| verdict | meaning | rows, `paper` | rows, `exact` | sentences, `paper` | sentences, `exact` |"
    ]
    lines.append("|---|---|---|---|---|---|")
    for verdict, meaning in VERDICTS.items():
        numbers = (found[what][name][verdict] for what in ("by_row", "by_sentence") for name in _OF)
        lines.append(f"| {verdict} | {meaning} | {' | '.join(str(number) for number in numbers)} |")
    return "\n".join(lines) + "\n\n" + of_bounds(found) + "\n"


def of_bounds(found: dict[str, Any]) -> str:
    """Return in words how much rests on our bounds."""
    halved, doubled = (found[f"changed_with_our_bounds_{how}"] for how in ("halved", "doubled"))
    return (
        f"{found['rows']} rows judge {found['sentences']} sentences. In the formulation `paper` "
        f"{found['favourable']} verdicts are favourable; {found['favourable_by_our_bounds']} of them rest on "
        f"bounds of ours. With all our bounds halved {len(halved)} verdicts change{_named(halved)}, with all "
        f"doubled {len(doubled)}{_named(doubled)}."
    )


def _named(names: list[str]) -> str:
    return f" ({', '.join(names)})" if names else ""


def as_text(found: dict[str, Any]) -> str:
    """Return the counts for a terminal."""
    lines = [f"{'verdict':16s}{'rows: paper':>12s}{'exact':>8s}{'sentences: paper':>18s}{'exact':>8s}"]
    for verdict in VERDICTS:
        row, sentence = ([found[what][name][verdict] for name in _OF] for what in ("by_row", "by_sentence"))
        lines.append(f"{verdict:16s}{row[0]:12d}{row[1]:8d}{sentence[0]:18d}{sentence[1]:8d}")
    return "\n".join([*lines, of_bounds(found)])
