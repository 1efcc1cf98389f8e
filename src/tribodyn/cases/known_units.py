"""Units that cases are written in every day, see ``units.toml``: with these alone pint is not loaded."""

import re
import tomllib
from importlib.resources import files
from typing import Any, Final

_TABLES: Final[Any] = tomllib.loads(
    files("tribodyn.cases").joinpath("units.toml").read_text(encoding="utf-8")
)
#: The SI units that tribodyn works in, and what each of them measures.
MEASURES: Final[dict[str, str]] = _TABLES["measures"]
#: Sizes in base units, as decimals, by the base unit and then by the unit.
SIZES: Final[dict[str, dict[str, str]]] = _TABLES["sizes"]
ZEROS: Final[dict[str, str]] = _TABLES["zeros"]  #: Origins of units that do not count from zero.
#: Names in these units.
EVERYDAY: Final = frozenset(
    name for units in SIZES.values() for unit in units for name in re.findall("[A-Za-z]+", unit)
)
