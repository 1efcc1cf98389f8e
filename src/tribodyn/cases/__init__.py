"""Cases: from TOML text with units to frozen, validated objects in SI units, and back."""

from __future__ import annotations

from tribodyn.cases.base import Case
from tribodyn.cases.keys import Key, keys_of

__all__ = ["Case", "Key", "keys_of"]
