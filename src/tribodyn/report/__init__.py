"""The report: one self-contained page about a run, or about several."""

from __future__ import annotations

from tribodyn.report.comparison import Run, write_comparison
from tribodyn.report.figures import draw_all
from tribodyn.report.write import write

__all__ = ["Run", "draw_all", "write", "write_comparison"]
