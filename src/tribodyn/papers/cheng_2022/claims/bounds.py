"""How a measured number is judged: strictly inside a bound or not, and who chose the bound."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Final, Literal, TypeAlias

Verdict: TypeAlias = Literal["reproduced", "differs", "contradicted", "not tested", "on a condition"]
Chooser: TypeAlias = Literal["the paper", "we"]
Range: TypeAlias = tuple[float, float]

CLOSE: Final = 1.25
"""A number is reproduced when ours is within this factor of the paper's, which are read off figures."""
NEAR: Final = 2.0
"""It differs within this factor, and contradicts beyond."""


@dataclass(frozen=True)
class Bound:
    """Where a number must lie.

    Attributes
    ----------
    full
        A claim is reproduced strictly between these two.
    partly
        It differs strictly between these two, and is contradicted elsewhere.
    unit
        Unit of the number.
    by
        Who chose ``full``.
    """

    full: Range
    partly: Range
    unit: str
    by: Chooser

    def verdict(self, value: float) -> Verdict:
        """Return what a number makes of the claim; one that is none contradicts it."""
        if self.full[0] < value < self.full[1]:
            return "reproduced"
        return "differs" if self.partly[0] < value < self.partly[1] else "contradicted"

    @property
    def edges(self) -> tuple[float, ...]:
        """The finite ends of ``full``, at which a claim is not reproduced."""
        return tuple(edge for edge in self.full if math.isfinite(edge))

    def __str__(self) -> str:
        """Return the bound in words, with who chose it."""
        low, high = self.full
        if math.isinf(low):
            text = f"below {high:.4g}"
        elif math.isinf(high):
            text = f"above {low:.4g}"
        else:
            text = f"{low:.3g} to {high:.3g}"
        return f"{text}{' ' if self.unit else ''}{self.unit} ({self.by})"


def above(limit: float, unit: str = "", *, partly: float | None = None, by: Chooser = "we") -> Bound:
    """Return a bound that a number must exceed; above ``partly`` the claim still differs only."""
    other = limit if partly is None else partly
    return Bound((limit, math.inf), (other, math.inf), unit, by)


def below(limit: float, unit: str = "", *, partly: float | None = None, by: Chooser = "we") -> Bound:
    """Return a bound that a number must stay below; below ``partly`` the claim still differs only."""
    other = limit if partly is None else partly
    return Bound((-math.inf, limit), (-math.inf, other), unit, by)


def near(paper: float, unit: str) -> Bound:
    """Return the bound of a number that the paper gives: within :data:`CLOSE`, or :data:`NEAR`."""
    return Bound((paper / CLOSE, paper * CLOSE), (paper / NEAR, paper * NEAR), unit, "we")
