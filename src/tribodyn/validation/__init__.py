"""Comparison with measured data: one folder a set in ``sets``, listed once in ``catalogue.NAMES``.

A set holds its data, a README with source and licence, ``set.toml`` with inputs and acceptance bands, each
with the line of the source that gives it, and a module that computes what was measured. Nothing is
downloaded.
"""

from tribodyn.validation.base import Band, Comparison, Curve, Outcome, Plot, Verdict
from tribodyn.validation.catalogue import NAMES, ValidationSet, load

__all__ = ["NAMES", "Band", "Comparison", "Curve", "Outcome", "Plot", "ValidationSet", "Verdict", "load"]
