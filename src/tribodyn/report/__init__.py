"""The report: one self-contained page about a run, or about several."""

from tribodyn.report.comparison import ComparedRun, RunDifferences, differences, write_comparison
from tribodyn.report.figures import draw_all, figures_of
from tribodyn.report.write import write

__all__ = [
    "ComparedRun",
    "RunDifferences",
    "differences",
    "draw_all",
    "figures_of",
    "write",
    "write_comparison",
]
