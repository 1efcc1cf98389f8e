"""Results: the variable table, the dataset, its headline numbers and its files."""

from __future__ import annotations

from tribodyn.results.dataset import build, json_attribute
from tribodyn.results.store import prepare_directory, read, write_run
from tribodyn.results.summary import HEADLINES, Headline, summarise
from tribodyn.results.variables import COORDINATES, VARIABLES, Variable

__all__ = [
    "COORDINATES",
    "HEADLINES",
    "VARIABLES",
    "Headline",
    "Variable",
    "build",
    "json_attribute",
    "prepare_directory",
    "read",
    "summarise",
    "write_run",
]
