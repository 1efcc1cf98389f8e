"""Every claim of the paper that can be measured, and the table that judges them."""

from typing import Final

from tribodyn.papers.cheng_2022.claims import (
    attitude,
    clearance,
    damping,
    errors,
    forces,
    journal,
    method,
    pressure,
    wear,
)
from tribodyn.papers.cheng_2022.claims.base import Claim, Finding, Trial
from tribodyn.papers.cheng_2022.claims.table import Row, as_json, as_markdown, as_text, judge, kept_rows

#: The conclusion that matters most, then in the order of the paper.
CLAIMS: Final[tuple[Claim, ...]] = (
    *damping.UNDAMPED_CLAIMS,
    *damping.CLAIMS,
    *method.CLAIMS,
    *journal.CLAIMS,
    *forces.CLAIMS,
    *attitude.CLAIMS,
    *forces.CAUSE_CLAIMS,
    *pressure.CLAIMS,
    *errors.CLAIMS,
    *clearance.CLAIMS,
    *wear.CLAIMS,
)

__all__ = [
    "CLAIMS",
    "Claim",
    "Finding",
    "Row",
    "Trial",
    "as_json",
    "as_markdown",
    "as_text",
    "judge",
    "kept_rows",
]
