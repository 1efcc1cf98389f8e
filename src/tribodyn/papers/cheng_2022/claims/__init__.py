"""Every claim of the paper that can be measured, and the table that judges them."""

from __future__ import annotations

from typing import Final

from tribodyn.papers.cheng_2022.claims import clearance, journal, trunnion, wear
from tribodyn.papers.cheng_2022.claims.base import Claim, Finding, verdict
from tribodyn.papers.cheng_2022.claims.table import Row, as_json, as_markdown, as_text, judge

CLAIMS: Final[tuple[Claim, ...]] = (*journal.CLAIMS, *trunnion.CLAIMS, *clearance.CLAIMS, *wear.CLAIMS)
"""In the order of the paper."""

__all__ = ["CLAIMS", "Claim", "Finding", "Row", "as_json", "as_markdown", "as_text", "judge", "verdict"]
