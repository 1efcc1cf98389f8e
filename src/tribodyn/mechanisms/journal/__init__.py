"""A rigid journal in a bushing under stated loads, dry or lubricated."""

from __future__ import annotations

from tribodyn.mechanisms.journal.equilibrium import Equilibrium, equilibrium
from tribodyn.mechanisms.journal.parameters import Journal, Loads
from tribodyn.mechanisms.journal.problem import journal_data, journal_memory, journal_problem
from tribodyn.mechanisms.journal.stribeck import Stribeck, stribeck

__all__ = [
    "Equilibrium",
    "Journal",
    "Loads",
    "Stribeck",
    "equilibrium",
    "journal_data",
    "journal_memory",
    "journal_problem",
    "stribeck",
]
