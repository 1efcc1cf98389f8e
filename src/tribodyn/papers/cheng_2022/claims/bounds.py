"""Judgement of a measured number: verdicts, bounds, and the origin of each bound."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import partial
from typing import Final, Literal, TypeAlias

Verdict: TypeAlias = Literal[
    "reproduced", "on a condition", "differs", "contradicted", "not decidable", "not tested"
]
Chooser: TypeAlias = Literal["the paper", "we"]
Range: TypeAlias = tuple[float, float]

#: All verdicts, each with its meaning.
VERDICTS: Final[dict[Verdict, str]] = {
    "reproduced": "the number is strictly inside the bound",
    "on a condition": "it is inside the bound with a value that no equation allows",
    "differs": "it is outside the bound and strictly inside a wider one",
    "contradicted": "it is outside both, or the run ends early",
    "not decidable": "no verdict has nine tenths of the ensemble: choices that the paper leaves open, or "
    "our own, decide",
    "not tested": "it is not simulated in this formulation",
}
#: A number is reproduced when ours is within this factor of the number that the paper prints.
CLOSE: Final = 1.25
NEAR: Final = 2.0  #: It differs within this factor, and contradicts beyond.
FIRST: Final = "2026-11-21"  #: Day of the first table of claims.
STRICT: Final = "2026-11-22"  #: Day on which every claim got a strict bound with an owner.
#: Day on which domains, sentences and the claims left out until then were added.
REVIEWED: Final = "2026-11-23"
#: Day on which every claim got an ensemble, and half-sentences rows of their own.
VARIED: Final = "2026-11-26"


@dataclass(frozen=True)
class Bound:
    """Interval in which a number must lie."""

    full: Range  #: A claim is reproduced strictly between these two.
    partly: Range  #: It differs strictly between these two, and is contradicted elsewhere.
    unit: str  #: Unit of the number.
    by: Chooser  #: Who chose ``full``: the paper where its words do, or we.
    since: str = STRICT  #: Day on which it was chosen. All of ours were chosen with results at hand.
    origin: float = 0.0  #: Number from which the limits are counted when the bound is scaled.
    factors: bool = False  #: Whether the limits are factors of ``origin``.

    def verdict(self, value: float) -> Verdict:
        """Return the verdict on a number; NaN contradicts the claim."""
        if self.full[0] < value < self.full[1]:
            return "reproduced"
        return "differs" if self.partly[0] < value < self.partly[1] else "contradicted"

    def with_margin(self, margin: float) -> Bound:
        """Return the bound that a number must pass by a margin; this near to its limits it differs."""
        low, high = self.full
        wide = min(low - margin, self.partly[0]), max(high + margin, self.partly[1])
        return replace(self, full=(low + margin, high - margin), partly=wide)

    @property
    def edges(self) -> tuple[float, ...]:
        """The finite ends of ``full``, at which a claim is not reproduced."""
        return tuple(edge for edge in self.full if math.isfinite(edge))

    def scaled(self, factor: float) -> Bound:
        """Return the bound with its distance from ``origin`` scaled; one that the paper chose stays."""
        if self.by == "the paper":
            return self
        full, partly = (
            (self._moved(low, factor), self._moved(high, factor)) for low, high in (self.full, self.partly)
        )
        return replace(self, full=full, partly=partly)

    def _moved(self, limit: float, factor: float) -> float:
        if not math.isfinite(limit):
            return limit
        if not self.factors:
            return self.origin + factor * (limit - self.origin)
        ratio = limit / self.origin
        wider = 1.0 + factor * (max(ratio, 1.0 / ratio) - 1.0)
        return self.origin * wider if ratio > 1.0 else self.origin / wider

    def __str__(self) -> str:
        """Return the bound in words, with who chose it and when."""
        low, high = self.full
        if math.isinf(low):
            text = f"below {high:.4g}"
        elif math.isinf(high):
            text = f"above {low:.4g}"
        else:
            text = f"{low:.3g} to {high:.3g}"
        return f"{text}{' ' if self.unit else ''}{self.unit} ({self.by}, {self.since})"


def of_span(bound: Bound, span: Range) -> Verdict:
    """Return the verdict on numbers of which the paper does not say which one is meant."""
    if bound.full[0] < span[0] and span[1] < bound.full[1]:
        return "reproduced"
    outside = span[1] <= bound.partly[0] or bound.partly[1] <= span[0]
    return "contradicted" if outside else "not decidable"


def _one_sided(
    limit: float,
    unit: str = "",
    *,
    upward: bool,
    partly: float | None = None,
    by: Chooser = "we",
    since: str = STRICT,
    origin: float = 0.0,
) -> Bound:
    full, wider = (
        (edge, math.inf) if upward else (-math.inf, edge)
        for edge in (limit, limit if partly is None else partly)
    )
    return Bound(full, wider, unit, by, since, origin)


#: Bound that a number must exceed; above ``partly`` the claim still differs only.
above: Final = partial(_one_sided, upward=True)
#: Bound that a number must stay below; below ``partly`` the claim still differs only.
below: Final = partial(_one_sided, upward=False)


def near(paper: float, unit: str, since: str = FIRST) -> Bound:
    """Return the bound of a number that the paper gives: within :data:`CLOSE`, or :data:`NEAR`."""
    full, partly = ((paper / factor, paper * factor) for factor in (CLOSE, NEAR))
    return Bound(full, partly, unit, "we", since, paper, factors=True)
