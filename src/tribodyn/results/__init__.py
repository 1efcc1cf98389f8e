"""Results: what variables are, the dataset, its key results and its files."""

from tribodyn.results.dataset import build, json_attribute
from tribodyn.results.netcdf import netcdf_content
from tribodyn.results.store import prepare_directory
from tribodyn.results.summary import KeyResult
from tribodyn.results.variables import COORDINATES, VARIABLES, Variable

__all__ = [
    "COORDINATES",
    "VARIABLES",
    "KeyResult",
    "Variable",
    "build",
    "json_attribute",
    "netcdf_content",
    "prepare_directory",
]
