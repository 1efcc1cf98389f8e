"""What a claim is, what we find, and how the two are judged."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Final, Literal, TypeAlias

from tribodyn.papers.cheng_2022.runs import Runs

Verdict: TypeAlias = Literal["reproduced", "differs", "contradicted"]

CLOSE: Final = 1.25
"""A number is reproduced when ours is within this factor of the paper's, which are read off figures."""
NEAR: Final = 2.0
"""It differs within this factor, and contradicts beyond."""
MOSTLY: Final = 0.95
"""A statement about a motion is reproduced when it holds for this share of the smooth motion."""
SELDOM: Final = 0.5
"""It is contradicted when it holds for less than this share."""


@dataclass(frozen=True)
class Finding:
    """What one formulation gives.

    Attributes
    ----------
    text
        What was measured, with its unit.
    score
        How well the claim holds: 1 fully, 0 not at all.
    value
        The number itself, where the claim is one; NaN otherwise.
    """

    text: str
    score: float
    value: float = math.nan


@dataclass(frozen=True)
class Claim:
    """One statement of the paper.

    Attributes
    ----------
    name
        Short name, unique.
    where
        Section or figure of the paper.
    says
        What the paper says.
    measure
        Returns the finding of a formulation.
    reason
        Why the finding is what it is, where it is not simply the paper's.
    depends_on_friction
        Whether the finding is measured with other coefficients of friction too: the paper does not give one.
    """

    name: str
    where: str
    says: str
    measure: Callable[[Runs, str, float | None], Finding]
    reason: str = ""
    depends_on_friction: bool = False


def verdict(finding: Finding) -> Verdict:
    """Return what a finding makes of its claim."""
    if finding.score >= MOSTLY:
        return "reproduced"
    return "differs" if finding.score >= SELDOM else "contradicted"


def number(value: float, paper: float, unit: str) -> Finding:
    """Return the finding of a claimed number.

    The score is 1 within the factor :data:`CLOSE`, and falls to :data:`SELDOM` at the factor :data:`NEAR`.
    """
    if not (value > 0.0 and math.isfinite(value)):
        return Finding(f"{value:.3g} {unit}", 0.0, value)
    off = abs(math.log(value / paper))
    if off <= math.log(CLOSE):
        score = 1.0
    elif off <= math.log(NEAR):
        score = 0.5 * (MOSTLY + SELDOM)
    else:
        score = 0.0
    return Finding(f"{value:.3g} {unit}", score, value)


def share(value: float, what: str) -> Finding:
    """Return the finding of a statement that holds for a share of the motion."""
    return Finding(f"{what} in {100.0 * value:.3g} % of the smooth motion", value, value)


def truth(holds: bool, text: str, *, partly: bool = False) -> Finding:
    """Return the finding of a statement that holds, holds partly, or does not."""
    return Finding(text, 1.0 if holds else (0.5 * (MOSTLY + SELDOM) if partly else 0.0))
