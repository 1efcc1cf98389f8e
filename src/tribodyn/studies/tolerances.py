"""Tolerances of keys of a case with their costs: a TOML file, and the grades of ISO 286-1.

A table of the file is a tolerance: its ``key`` scatters about the value in the case, over a *width* that may
be chosen. What it costs stands in ``grades`` (of a ``size``) or ``widths``, each with a number, or in
``cost = {a = 3.0, k = 0.7, least = "5 um", most = "0.1 mm"}``, which is a/(w/mm)ᵏ.
"""

import math
from bisect import bisect_left
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.cases import Case, Key
from tribodyn.cases.units import UnitProblem, dimension, to_si
from tribodyn.core import files
from tribodyn.core.errors import InputError
from tribodyn.core.quoting import as_given, meant
from tribodyn.studies.plan import varied_key
from tribodyn.studies.sampling import DISTRIBUTIONS
from tribodyn.studies.variation import SOURCE

#: Ends of the ranges of sizes [mm], ISO 286-1:2010, Table 1.
_UP_TO: Final = (3, 6, 10, 18, 30, 50, 80, 120, 180, 250, 315, 400, 500)
#: Widths of the grades over the ranges [µm], same table.
_GRADES: Final = {
    "IT5": (4, 5, 6, 8, 9, 11, 13, 15, 18, 20, 23, 25, 27),
    "IT6": (6, 8, 9, 11, 13, 16, 19, 22, 25, 29, 32, 36, 40),
    "IT7": (10, 12, 15, 18, 21, 25, 30, 35, 40, 46, 52, 57, 63),
    "IT8": (14, 18, 22, 27, 33, 39, 46, 54, 63, 72, 81, 89, 97),
    "IT9": (25, 30, 36, 43, 52, 62, 74, 87, 100, 115, 130, 140, 155),
    "IT10": (40, 48, 58, 70, 84, 100, 120, 140, 160, 185, 210, 230, 250),
    "IT11": (60, 75, 90, 110, 130, 160, 190, 220, 250, 290, 320, 360, 400),
    "IT12": (100, 120, 150, 180, 210, 250, 300, 350, 400, 460, 520, 570, 630),
}
#: Arguments of each distribution for a width of 1: that of a normal one is six standard deviations.
LAWS: Final = {"normal": (0.0, 1.0 / 6.0), "uniform": (-0.5, 0.5)}


@dataclass(frozen=True)
class Tolerance:
    """One tolerance that may be chosen."""

    name: str  #: Of its table.
    key: Key  #: Key of the case that scatters.
    law: str  #: A key of :data:`LAWS`.
    #: Change of the key for a change of the toleranced size: one half for a radius of which the diameter is
    #: toleranced.
    share: float
    #: Width [SI] and cost of each choice by its label, the widest first; empty with ``curve``.
    steps: Mapping[str, tuple[float, float]]
    #: a, k, least and largest width [SI]: the cost of a width w is a/(w/mm)ᵏ.
    curve: tuple[float, float, float, float] | None

    @property
    def widest(self) -> float:
        """Largest width that may be chosen [SI]."""
        return self.curve[3] if self.curve else next(iter(self.steps.values()))[0]

    def cost(self, width: float) -> float:
        """Return the cost of a width [SI] on the curve."""
        assert self.curve is not None
        return self.curve[0] * math.pow(width / 1e-3, -self.curve[1])

    def scatter(self, probabilities: FloatArray) -> FloatArray:
        """Return the scatter of the key for a width of 1, shape of ``probabilities``."""
        return self.share * DISTRIBUTIONS[self.law].quantiles(LAWS[self.law], probabilities)


def standard_width(grade: str, size: float) -> float:
    """Return the width of a grade of ISO 286-1 at a nominal size, both SI.

    Raises InputError if there is no such grade here, or the size is beyond 500 mm.

    Examples
    --------
    >>> round(standard_width("IT7", 0.02) * 1e6)
    21
    """
    if grade not in _GRADES:
        raise InputError(f"{as_given(grade)}; allowed: {', '.join(_GRADES)}{meant(grade, list(_GRADES))}")
    if not 0.0 < size <= 0.5:
        raise InputError(f"a size of {size * 1e3:g} mm has no grades; allowed: above 0, at most 500 mm")
    return 1e-6 * _GRADES[grade][bisect_left(_UP_TO, size * 1e3 * (1.0 - 1e-12))]


def read_tolerances(path: str | Path, case: Case) -> tuple[Tolerance, ...]:
    """Return the tolerances of a file, checked against a case.

    Raises InputError if the file is none of these, names no key of the case, has an impossible grade or a
    cost that rises with the width; the message names the table.
    """
    try:
        tables = files.parse(files.text_of(files.read_regular(path, files.LARGEST)))
    except OSError as error:
        raise InputError(f"the file cannot be read: {error.strerror}", source=str(path)) from None
    except ValueError as error:
        raise InputError(f"this is not valid TOML: {error}", source=str(path)) from None
    found = []
    for name, table in tables.items():
        try:
            found.append(_tolerance(name, table, case))
        except InputError as error:
            raise InputError(error.reason, key=error.key or name, source=str(path)) from None
        except UnitProblem as problem:
            raise InputError(str(problem), key=name, source=str(path)) from None
    if not found:
        raise InputError("the file has no tables; write one a tolerance, with its key", source=str(path))
    if len({one.curve is None for one in found}) > 1:
        raise InputError("give all tolerances as steps, or all by cost = {a, k, ...}", source=str(path))
    return tuple(found)


def _tolerance(name: str, table: Any, case: Case) -> Tolerance:
    allowed = ("key", "law", "share", "size", "grades", "widths", "cost")
    wrong = next((key for key in table if key not in allowed), None) if isinstance(table, dict) else name
    if wrong is not None:
        raise InputError(f"allowed: {', '.join(allowed)}{meant(wrong, allowed)}", key=f"{name}.{wrong}")
    kinds = [one for one in ("grades", "widths", "cost") if one in table]
    if len(kinds) != 1:
        raise InputError("give one of grades, widths and cost", key=name)
    key = varied_key(case, str(table.get("key", "")))
    value = case.at(key.path)
    if key.kind != "quantity" or not isinstance(value, float):
        raise InputError("the case has no quantity here that could scatter", key=f"{name}.key", source=SOURCE)
    if kinds[0] == "grades" and dimension(key.unit) != dimension("mm"):
        raise InputError("grades are of lengths; give widths", key=f"{name}.grades")
    if kinds[0] == "grades" and "size" not in table:
        raise InputError('grades are of a nominal size, such as size = "20 mm"', key=f"{name}.size")
    law = table.get("law", "normal")
    if law not in LAWS:
        raise InputError(f"{as_given(str(law))}; allowed: {', '.join(LAWS)}", key=f"{name}.law")
    share, entries = _number(table.get("share", 1.0), f"{name}.share"), table[kinds[0]]
    if not isinstance(entries, dict) or not entries:
        raise InputError("write {...} with a cost of each", key=f"{name}.{kinds[0]}")
    if kinds[0] == "cost":
        return Tolerance(name, key, law, share, {}, _curve(entries, key, f"{name}.cost"))
    size = to_si(str(table["size"]), "mm") if kinds[0] == "grades" else 0.0
    widths = {
        label: standard_width(label, size) if kinds[0] == "grades" else to_si(label, key.unit)
        for label in entries
    }
    return Tolerance(name, key, law, share, _steps(widths, entries, f"{name}.{kinds[0]}"), None)


def _steps(
    widths: Mapping[str, float], entries: Mapping[str, Any], key: str
) -> dict[str, tuple[float, float]]:
    """Return width and cost of each choice, the widest first."""
    steps = {label: (width, _number(entries[label], key)) for label, width in widths.items()}
    ordered = dict(sorted(steps.items(), key=lambda item: -item[1][0]))
    costs = np.array([cost for _, cost in ordered.values()])
    if np.any(np.diff(costs) < 0.0):
        raise InputError("a cost rises with the width; a wider tolerance must not cost more", key=key)
    return ordered


def _curve(entries: Mapping[str, Any], key: Key, path: str) -> tuple[float, float, float, float]:
    if set(entries) != {"a", "k", "least", "most"}:
        raise InputError('write {a = 3.0, k = 0.7, least = "5 um", most = "0.1 mm"}', key=path)
    a, k = (_number(entries[one], f"{path}.{one}") for one in ("a", "k"))
    least, most = (to_si(str(entries[one]), key.unit) for one in ("least", "most"))
    if not 0.0 < least < most:
        raise InputError("the least width must be above 0 and below the largest", key=path)
    return a, k, least, most


def _number(value: Any, key: str) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float) or not 0.0 < value < np.inf:
        raise InputError(f"{as_given(str(value))}; allowed: a number above 0", key=key)
    return float(value)
