"""Results: the variable table, the dataset, its headline numbers and its files."""

from __future__ import annotations

from tribodyn.results.dataset import build, json_attribute
from tribodyn.results.headline import Headline
from tribodyn.results.law_headlines import LAW_HEADLINES
from tribodyn.results.netcdf import netcdf_content
from tribodyn.results.store import prepare_directory, read, write_run
from tribodyn.results.summary import HEADLINES, known, summarise
from tribodyn.results.variables import COORDINATES, VARIABLES, Variable

__all__ = [
    "COORDINATES",
    "HEADLINES",
    "LAW_HEADLINES",
    "VARIABLES",
    "Headline",
    "Variable",
    "build",
    "json_attribute",
    "known",
    "netcdf_content",
    "prepare_directory",
    "read",
    "summarise",
    "write_run",
]
