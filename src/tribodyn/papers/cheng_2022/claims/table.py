"""The table of claims: terminal, Markdown and JSON."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, Final

from tribodyn.papers.cheng_2022.claims.base import Claim, Finding, Verdict, verdict
from tribodyn.papers.cheng_2022.runs import FRICTION, Runs

_WIDTH: Final = 100


@dataclass(frozen=True)
class Row:
    """A claim with what we find.

    Attributes
    ----------
    claim
        The claim.
    paper, exact
        Findings in the two formulations.
    spread
        Smallest and largest number in the paper's formulation over the coefficients of friction that were
        tried, NaN where that was not asked.
    """

    claim: Claim
    paper: Finding
    exact: Finding
    spread: tuple[float, float] = (math.nan, math.nan)

    @property
    def verdict(self) -> Verdict:
        """What the paper's own formulation makes of the claim."""
        return verdict(self.paper)

    @property
    def reason(self) -> str:
        """Why the findings are what they are, and what friction does."""
        agreed = verdict(self.paper) == verdict(self.exact) == "reproduced"
        parts = [] if agreed or not self.claim.reason else [self.claim.reason]
        if math.isfinite(self.spread[0]):
            tried = ", ".join(f"{value:g}" for value in FRICTION)
            parts.append(f"{self.spread[0]:.2g} to {self.spread[1]:.2g} with μ_f = {tried}")
        return "; ".join(parts)


def judge(runs: Runs, claims: Iterable[Claim]) -> list[Row]:
    """Measure every claim in both formulations, and with other frictions where that matters."""
    return [
        Row(
            claim,
            claim.measure(runs, "paper", None),
            claim.measure(runs, "exact", None),
            _spread(runs, claim),
        )
        for claim in claims
    ]


def _spread(runs: Runs, claim: Claim) -> tuple[float, float]:
    if not claim.depends_on_friction:
        return math.nan, math.nan
    values = [claim.measure(runs, "paper", friction).value for friction in FRICTION]
    return min(values), max(values)


def as_json(rows: Iterable[Row]) -> list[dict[str, Any]]:
    """Return the table as plain data."""
    return [
        {
            "claim": row.claim.name,
            "where": row.claim.where,
            "paper_says": row.claim.says,
            "paper_formulation": row.paper.text,
            "exact_formulation": row.exact.text,
            "verdict": row.verdict,
            "exact_verdict": verdict(row.exact),
            "reason": row.reason,
        }
        for row in rows
    ]


def as_markdown(rows: Iterable[Row]) -> str:
    """Return the table as Markdown."""
    head = "| where | the paper says | `paper` formulation | `exact` formulation | verdict | why |"
    lines = [head, "|---|---|---|---|---|---|"]
    for row in rows:
        cells = (row.claim.where, row.claim.says, row.paper.text, _exact(row), row.verdict, row.reason)
        lines.append("| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |")
    return "\n".join(lines) + "\n"


def _exact(row: Row) -> str:
    """Return the finding of ``exact``, with its verdict where that is another one."""
    other = verdict(row.exact)
    return row.exact.text if other == row.verdict else f"{row.exact.text} ({other})"


def as_text(rows: Iterable[Row]) -> str:
    """Return the table for a terminal: a block a claim."""
    return "\n".join(_block(row) for row in rows)


def _block(row: Row) -> str:
    lines = [
        f"{row.verdict.upper():13s} {row.claim.says}  [{row.claim.where}]",
        f"  paper  {row.paper.text}",
        f"  exact  {_exact(row)}",
    ]
    if row.reason:
        lines.append(f"  why    {row.reason}")
    return "\n".join(
        textwrap.fill(line, _WIDTH, subsequent_indent=" " * 9, break_long_words=False) for line in lines
    )
