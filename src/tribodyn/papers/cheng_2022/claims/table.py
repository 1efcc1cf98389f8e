"""The table: what the paper says, what we find, and the verdict."""

from __future__ import annotations

import textwrap
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, Final

from tribodyn.papers.cheng_2022.claims.base import Assumption, Claim, Finding, Trial
from tribodyn.papers.cheng_2022.claims.bounds import Verdict
from tribodyn.papers.cheng_2022.runs import Runs

_WIDTH: Final = 100
_ALIKE: Final = "alike"
Spread = tuple[Assumption, float, float]
"""An assumption with the smallest and the largest number over the values tried."""


@dataclass(frozen=True)
class Row:
    """A claim with what we find.

    Attributes
    ----------
    claim
        The claim.
    paper, exact
        Findings in the two formulations; the first alone where they cannot differ, none if not tested.
    spreads
        What the assumptions do to the number of the paper's formulation.
    """

    claim: Claim
    paper: Finding | None = None
    exact: Finding | None = None
    spreads: tuple[Spread, ...] = ()

    @property
    def verdict(self) -> Verdict:
        """What the paper's own formulation makes of the claim."""
        return self._verdict(self.paper)

    @property
    def exact_verdict(self) -> Verdict:
        """What the formulation ``exact`` makes of it."""
        return self._verdict(self.exact or self.paper)

    def _verdict(self, finding: Finding | None) -> Verdict:
        if finding is None:
            return "not tested"
        found = self.claim.bound.verdict(finding.value)
        return "on a condition" if found == "reproduced" and self.claim.condition else found

    @property
    def reason(self) -> str:
        """Why the findings are what they are, on what condition, and what the assumptions do."""
        claim, agreed = self.claim, self.verdict == self.exact_verdict == "reproduced"
        parts = [claim.condition, "" if agreed else claim.reason]
        parts += [f"{low:.3g} to {high:.3g} with {about}" for about, low, high in self.spreads]
        return "; ".join(part for part in parts if part)

    @property
    def found(self) -> tuple[str, str]:
        """The findings in words, that of ``exact`` with its verdict where it is another one."""
        if self.paper is None:
            return "", ""
        if self.exact is None:
            return self.paper.text, _ALIKE
        other = "" if self.exact_verdict == self.verdict else f" ({self.exact_verdict})"
        return self.paper.text, self.exact.text + other


def judge(runs: Runs, claims: Iterable[Claim]) -> list[Row]:
    """Measure every claim in both formulations, and with other assumptions where they matter."""
    return [_row(runs, claim) for claim in claims]


def _row(runs: Runs, claim: Claim) -> Row:
    if claim.measure is None:
        return Row(claim)
    return Row(
        claim,
        claim.measure(Trial(runs, "paper")),
        claim.measure(Trial(runs, "exact")) if claim.mechanism else None,
        tuple(_spread(runs, claim, about) for about in claim.varies),
    )


def _spread(runs: Runs, claim: Claim, about: Assumption) -> Spread:
    assert claim.measure is not None
    values = [claim.measure(Trial(runs, "paper", {about.key: value})).value for value in about.values]
    return about, min(values), max(values)


def as_json(rows: Iterable[Row]) -> list[dict[str, Any]]:
    """Return the table as plain data."""
    return [
        {
            "claim": row.claim.name,
            "where": row.claim.where,
            "paper_says": row.claim.says,
            "paper_formulation": row.found[0],
            "exact_formulation": row.found[1],
            "bound": str(row.claim.bound),
            "bound_chosen_by": row.claim.bound.by,
            "verdict": row.verdict,
            "exact_verdict": row.exact_verdict,
            "reason": row.reason,
        }
        for row in rows
    ]


def as_markdown(rows: Iterable[Row]) -> str:
    """Return the table as Markdown."""
    head = "| where | the paper says | formulation `paper` | `exact` | bound (whose) | verdict | why |"
    lines = [head, "|---|---|---|---|---|---|---|"]
    for row in rows:
        cells = (row.claim.where, row.claim.says, *row.found, str(row.claim.bound), row.verdict, row.reason)
        lines.append("| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |")
    return "\n".join(lines) + "\n"


def as_text(rows: Iterable[Row]) -> str:
    """Return the table for a terminal: a block a claim."""
    return "\n".join(_block(row) for row in rows)


def _block(row: Row) -> str:
    paper, exact = row.found
    parts = (("paper", paper), ("exact", exact), ("bound", str(row.claim.bound)), ("why", row.reason))
    lines = [f"{row.verdict.upper():14s} {row.claim.says}  [{row.claim.where}]"]
    lines += [f"  {name:6s} {text}" for name, text in parts if text]
    return "\n".join(
        textwrap.fill(line, _WIDTH, subsequent_indent=" " * 9, break_long_words=False) for line in lines
    )
