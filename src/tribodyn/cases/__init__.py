"""Cases: from TOML text with units to frozen, validated objects in SI units, and back."""

from __future__ import annotations

from tribodyn.cases.case import Case
from tribodyn.cases.catalogue import CASES, KINDS, BuiltIn
from tribodyn.cases.journal import Journal
from tribodyn.cases.keys import Key, keys_of
from tribodyn.cases.load import load_case, parse_case
from tribodyn.cases.tables import keys_in
from tribodyn.cases.vsv import Vsv

__all__ = [
    "CASES",
    "KINDS",
    "BuiltIn",
    "Case",
    "Journal",
    "Key",
    "Vsv",
    "keys_in",
    "keys_of",
    "load_case",
    "parse_case",
]
