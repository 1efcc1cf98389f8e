"""Counts of claims and sentences by verdict."""

from collections import Counter
from collections.abc import Iterable
from typing import Any, Final

from tribodyn.papers.cheng_2022.claims.base import SENTENCES, VERDICTS, Verdict
from tribodyn.papers.cheng_2022.claims.table import Row

FAVOURABLE: Final[tuple[Verdict, ...]] = ("reproduced", "on a condition")
#: The verdict of a sentence is the first of these that any of its rows has.
_WORST_FIRST: Final[tuple[Verdict, ...]] = (
    "contradicted",
    "differs",
    "not decidable",
    "on a condition",
    "reproduced",
    "not tested",
)
FORMULATIONS: Final = ("paper", "exact")  #: Formulations that are counted; ``printed`` has a few rows only.


def by_sentence(rows: Iterable[Row], formulation: str) -> dict[str, Verdict]:
    """Return the verdict of every sentence: the least favourable one of its rows."""
    found: dict[str, set[Verdict]] = {name: set() for name in SENTENCES}
    for row in rows:
        for name in row.claim.sentences:
            found[name].add(row.verdict(formulation))
    return {name: next(one for one in _WORST_FIRST if one in verdicts) for name, verdicts in found.items()}


def counts(verdicts: Iterable[Verdict]) -> dict[Verdict, int]:
    """Return the number of times that each verdict occurs, in the order of :data:`VERDICTS`."""
    found = Counter(verdicts)
    return {verdict: found[verdict] for verdict in VERDICTS}


def summarise(rows: list[Row]) -> dict[str, Any]:
    """Return the counts as plain data."""
    favourable = [row for row in rows if row.verdict("paper") in FAVOURABLE]
    return {
        "rows": len(rows),
        "sentences": len(SENTENCES),
        "by_row": {name: counts(row.verdict(name) for row in rows) for name in FORMULATIONS},
        "by_sentence": {name: counts(by_sentence(rows, name).values()) for name in FORMULATIONS},
        "favourable": len(favourable),
        "favourable_by_our_bounds": sum(row.claim.bound.by == "we" for row in favourable),
    }


def as_markdown(found: dict[str, Any]) -> str:
    """Return the counts as a table, and what our bounds decide."""
    lines = [
        "| verdict | meaning | rows, `paper` | rows, `exact` | sentences, `paper` | sentences, `exact` |"
    ]
    lines.append("|---|---|---|---|---|---|")
    for verdict, meaning in VERDICTS.items():
        numbers = (found[what][name][verdict] for what in ("by_row", "by_sentence") for name in FORMULATIONS)
        lines.append(f"| {verdict} | {meaning} | {' | '.join(str(number) for number in numbers)} |")
    return "\n".join(lines) + "\n\n" + of_bounds(found) + "\n"


def of_bounds(found: dict[str, Any]) -> str:
    """Return in words how much rests on our bounds."""
    return (
        f"{found['rows']} rows judge {found['sentences']} sentences. In the formulation `paper` "
        f"{found['favourable']} verdicts are favourable; {found['favourable_by_our_bounds']} of them rest on "
        "bounds of ours."
    )


def as_text(found: dict[str, Any]) -> str:
    """Return the counts for a terminal."""
    lines = [f"{'verdict':16s}{'rows: paper':>12s}{'exact':>8s}{'sentences: paper':>18s}{'exact':>8s}"]
    for verdict in VERDICTS:
        row, sentence = (
            [found[what][name][verdict] for name in FORMULATIONS] for what in ("by_row", "by_sentence")
        )
        lines.append(f"{verdict:16s}{row[0]:12d}{row[1]:8d}{sentence[0]:18d}{sentence[1]:8d}")
    return "\n".join([*lines, of_bounds(found)])
