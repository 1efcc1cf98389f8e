"""Cases: from TOML text with units to frozen, validated objects in SI units, and back."""

from tribodyn.cases.case import Case
from tribodyn.cases.keys import Key, keys_of
from tribodyn.cases.tables import keys_in

__all__ = ["Case", "Key", "keys_in", "keys_of"]
