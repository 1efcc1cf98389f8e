"""The table: what the paper says, what we find, and the verdict."""

import math
import textwrap
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any, Final

from tribodyn.papers.cheng_2022.claims.base import EARLY, IN, Claim, EndedEarly, Finding, Trial, Verdict
from tribodyn.papers.cheng_2022.claims.ensemble import Judgement, judgement, kept
from tribodyn.papers.cheng_2022.runs import Runs

_WIDTH: Final = 100
_ALIKE: Final = "alike"


@dataclass(frozen=True)
class Row:
    """A claim with what we find."""

    claim: Claim  #: The claim.
    #: What is found with the defaults, by formulation.
    findings: Mapping[str, Finding] = field(default_factory=dict)
    #: What the ensemble makes of it, by formulation.
    judgements: Mapping[str, Judgement] = field(default_factory=dict)

    def verdict(self, formulation: str) -> Verdict:
        """Return the verdict of a formulation."""
        found = self.judgements.get("paper" if self.claim.formulations == "alike" else formulation)
        return found.verdict if found else "not tested"

    @property
    def reason(self) -> str:
        """Reasons of the findings, the condition, and the choice that decides."""
        claim = self.claim
        agreed = all(self.verdict(name) == "reproduced" for name in IN[claim.formulations])
        parts = [claim.condition, "" if agreed else claim.reason]
        parts += [f"`{name}`: {found.decides}" for name, found in self.judgements.items() if found.decides]
        margins = {found.margin for found in self.judgements.values() if found.margin}
        if margins:
            parts.append(f"margin {', '.join(f'{margin:.2g}' for margin in sorted(margins))}")
        return "; ".join(part for part in parts if part)

    def found(self, formulation: str) -> str:
        """Return the finding of a formulation in words, with the range and the share of the ensemble."""
        if self.claim.formulations == "alike" and formulation != "paper":
            return _ALIKE if formulation == "exact" and self.findings else ""
        if formulation not in self.findings:
            return ""
        text, judged = self.findings[formulation].text, self.judgements.get(formulation)
        if judged is None:
            return text
        low, high = judged.span
        spread = "" if math.isnan(low) else f"{low:.3g} to {high:.3g}, "
        other = "" if formulation == "paper" else f"{judged.verdict}, "
        return f"{text} ({other}{spread}{100.0 * judged.share:.0f} %)"


def judge(runs: Runs, claims: Iterable[Claim]) -> list[Row]:
    """Measure every claim in its formulations, and judge it by the kept ensemble."""
    return [_row(runs, claim) for claim in claims]


def kept_rows(claims: Iterable[Claim]) -> list[Row]:
    """Return the table from the kept ensemble, without a run."""
    return [
        Row(
            claim,
            {name: Finding(found["text"], math.nan) for name, found in kept().get(claim.name, {}).items()},
            _judged(claim),
        )
        for claim in claims
    ]


def _row(runs: Runs, claim: Claim) -> Row:
    if claim.measure is None:
        return Row(claim)
    findings = {name: _finding(claim, Trial(runs, name)) for name in IN[claim.formulations]}
    return Row(claim, findings, _judged(claim))


def _judged(claim: Claim) -> dict[str, Judgement]:
    names = () if claim.measure is None else IN[claim.formulations]
    return {name: found for name in names if (found := judgement(claim, name)) is not None}


def _finding(claim: Claim, trial: Trial) -> Finding:
    assert claim.measure is not None
    try:
        return claim.measure(trial)
    except EndedEarly:
        return Finding(EARLY, math.nan)


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
            "found": {name: finding.text for name, finding in row.findings.items()},
            "bound": str(row.claim.bound),
            "bound_chosen_by": row.claim.bound.by,
            "bound_chosen_on": row.claim.bound.since,
            "verdict": row.verdict("paper"),
            "exact_verdict": row.verdict("exact"),
            "printed_verdict": row.verdict("printed"),
            "share": {name: round(judged.share, 3) for name, judged in row.judgements.items()},
            "reason": row.reason,
        }
        for row in rows
    ]


_HEAD: Final = (
    "verdict",
    "the paper says (where)",
    "measured; domain",
    "`paper` (range, share)",
    "`exact` (verdict, range, share)",
    "bound (whose, when); why",
)


def as_markdown(rows: Iterable[Row]) -> str:
    """Return the table as Markdown."""
    lines = [f"| {' | '.join(_HEAD)} |", "|" + "---|" * len(_HEAD)]
    for row in rows:
        claim = row.claim
        printed = row.found("printed")
        cells = (
            row.verdict("paper"),
            f"{claim.says} ({claim.where})",
            "; ".join(filter(None, (claim.quantity, claim.domain))),
            row.found("paper"),
            row.found("exact"),
            "; ".join(filter(None, (str(claim.bound), printed and f"`printed`: {printed}", row.reason))),
        )
        lines.append("| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |")
    return "\n".join(lines) + "\n"


def as_text(rows: Iterable[Row]) -> str:
    """Return the table for a terminal: a block a claim."""
    return "\n".join(_block(row) for row in rows)


def _block(row: Row) -> str:
    claim = row.claim
    number = f"{claim.quantity}; {claim.domain}" if claim.quantity else ""
    parts = (
        ("number", number),
        *((name, row.found(name)) for name in ("printed", "paper", "exact")),
        ("bound", str(claim.bound)),
        ("why", row.reason),
    )
    lines = [f"{row.verdict('paper').upper():14s} {claim.says}  [{claim.where}]"]
    lines += [f"  {name:7s} {text}" for name, text in parts if text]
    return "\n".join(
        textwrap.fill(line, _WIDTH, subsequent_indent=" " * 10, break_long_words=False) for line in lines
    )
