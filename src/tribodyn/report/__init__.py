"""The report: one self-contained page about a run."""

from __future__ import annotations

from tribodyn.report.page import write

__all__ = ["write"]
