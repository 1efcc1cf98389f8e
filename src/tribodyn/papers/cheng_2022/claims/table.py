"""The table: what the paper says, what we find, and the verdict."""

from __future__ import annotations

import textwrap
from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import Any, Final, TypeAlias

from tribodyn.papers.cheng_2022.claims.base import Assumption, Claim, Finding, Trial
from tribodyn.papers.cheng_2022.claims.bounds import Verdict
from tribodyn.papers.cheng_2022.runs import Runs

_WIDTH: Final = 100
_ALIKE: Final = "alike"
Spread: TypeAlias = tuple[Assumption, tuple[float, ...]]
"""An assumption with the number found for each value tried."""


@dataclass(frozen=True)
class Row:
    """A claim with what we find.

    Attributes
    ----------
    claim
        The claim.
    paper, exact
        Findings in the two formulations; none where it is not tested, or alike.
    spreads
        What the assumptions do to the number, in the paper's formulation where it is tested there.
    """

    claim: Claim
    paper: Finding | None = None
    exact: Finding | None = None
    spreads: tuple[Spread, ...] = ()

    @property
    def verdict(self) -> Verdict:
        """Verdict of the paper's own formulation."""
        return self._verdict(self.paper, varied=self.paper is not None)

    @property
    def exact_verdict(self) -> Verdict:
        """Verdict of the formulation ``exact``."""
        if self.claim.formulations == "alike":
            return self.verdict
        return self._verdict(self.exact, varied=self.claim.formulations == "exact")

    def _verdict(self, finding: Finding | None, *, varied: bool) -> Verdict:
        if finding is None:
            return "not tested"
        bound = self.claim.bound
        if finding.span is not None:
            return _of_span(bound.full, bound.partly, finding.span)
        tried = {bound.verdict(value) for _, values in self.spreads for value in values if varied}
        found = bound.verdict(finding.value)
        conditional = len(tried | {found}) > 1 and "reproduced" in tried | {found}
        if conditional or (found == "reproduced" and self.claim.condition):
            return "on a condition"
        return found

    def scaled(self, factor: float) -> Row:
        """Return the row with our bounds scaled."""
        return replace(self, claim=replace(self.claim, bound=self.claim.bound.scaled(factor)))

    @property
    def reason(self) -> str:
        """Why the findings are what they are, on what condition, and what the assumptions do."""
        claim, agreed = self.claim, self.verdict == self.exact_verdict == "reproduced"
        parts = [claim.condition, "" if agreed else claim.reason]
        parts += [f"{', '.join(f'{v:.3g}' for v in values)} with {about}" for about, values in self.spreads]
        return "; ".join(part for part in parts if part)

    @property
    def found(self) -> tuple[str, str]:
        """The findings in words, that of ``exact`` with its verdict where it is another one."""
        paper = self.paper.text if self.paper else ""
        if self.claim.formulations == "alike" and self.paper:
            return paper, _ALIKE
        if self.exact is None:
            return paper, ""
        other = "" if self.exact_verdict == self.verdict else f" ({self.exact_verdict})"
        return paper, self.exact.text + other


def _of_span(full: tuple[float, float], partly: tuple[float, float], span: tuple[float, float]) -> Verdict:
    """Return the verdict on numbers of which the paper does not say which one is meant."""
    if full[0] < span[0] and span[1] < full[1]:
        return "reproduced"
    return "contradicted" if span[1] <= partly[0] or partly[1] <= span[0] else "not decidable"


def judge(runs: Runs, claims: Iterable[Claim]) -> list[Row]:
    """Measure every claim in both formulations, and with other assumptions where they matter."""
    return [_row(runs, claim) for claim in claims]


def _row(runs: Runs, claim: Claim) -> Row:
    if claim.measure is None:
        return Row(claim)
    return Row(
        claim,
        None if claim.formulations == "exact" else claim.measure(Trial(runs, "paper")),
        None if claim.formulations == "alike" else claim.measure(Trial(runs, "exact")),
        tuple(_spread(runs, claim, about) for about in claim.varies),
    )


def _spread(runs: Runs, claim: Claim, about: Assumption) -> Spread:
    assert claim.measure is not None
    formulation = "exact" if claim.formulations == "exact" else "paper"
    tried = (Trial(runs, formulation, {about.key: value}) for value in about.values)
    return about, tuple(claim.measure(trial).value for trial in tried)


def as_json(rows: Iterable[Row]) -> list[dict[str, Any]]:
    """Return the table as plain data."""
    return [
        {
            "claim": row.claim.name,
            "sentences": list(row.claim.sentences),
            "where": row.claim.where,
            "paper_says": row.claim.says,
            "domain": row.claim.domain,
            "quantity": row.claim.quantity,
            "paper_formulation": row.found[0],
            "exact_formulation": row.found[1],
            "bound": str(row.claim.bound),
            "bound_chosen_by": row.claim.bound.by,
            "bound_chosen_on": row.claim.bound.since,
            "verdict": row.verdict,
            "exact_verdict": row.exact_verdict,
            "reason": row.reason,
        }
        for row in rows
    ]


_HEAD: Final = (
    "verdict",
    "the paper says (where)",
    "measured; domain",
    "formulation `paper`",
    "`exact`",
    "bound (whose, when); why",
)


def as_markdown(rows: Iterable[Row]) -> str:
    """Return the table as Markdown."""
    lines = [f"| {' | '.join(_HEAD)} |", "|" + "---|" * len(_HEAD)]
    for row in rows:
        claim = row.claim
        cells = (
            row.verdict,
            f"{claim.says} ({claim.where})",
            "; ".join(filter(None, (claim.quantity, claim.domain))),
            *row.found,
            "; ".join(filter(None, (str(claim.bound), row.reason))),
        )
        lines.append("| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |")
    return "\n".join(lines) + "\n"


def as_text(rows: Iterable[Row]) -> str:
    """Return the table for a terminal: a block a claim."""
    return "\n".join(_block(row) for row in rows)


def _block(row: Row) -> str:
    paper, exact = row.found
    claim = row.claim
    number = f"{claim.quantity}; {claim.domain}" if claim.quantity else ""
    parts = (
        ("number", number),
        ("paper", paper),
        ("exact", exact),
        ("bound", str(claim.bound)),
        ("why", row.reason),
    )
    lines = [f"{row.verdict.upper():14s} {claim.says}  [{claim.where}]"]
    lines += [f"  {name:6s} {text}" for name, text in parts if text]
    return "\n".join(
        textwrap.fill(line, _WIDTH, subsequent_indent=" " * 9, break_long_words=False) for line in lines
    )
