"""Common syntax of text files of numbers: comments, separators, decimal commas, names with units.

Scans (:mod:`tribodyn.surfaces.text`) are read block by block and may be large; tables and maps of a case
(:mod:`tribodyn.cases.columns`) are small and keep the digits as they stand. Both ask here what a line means.
"""

from typing import Final

SEPARATORS: Final = (";", "\t", ",")
"""Separators of the fields of a line; the first one that occurs counts."""
_COMMENTS: Final = ("#", "%", "//")
"""Beginning of a comment line."""


def is_comment(text: str) -> bool:
    """Tell whether a line holds no numbers but says something."""
    return text.lstrip().startswith(_COMMENTS)


def separator_of(text: str) -> str:
    """Return the separator of the fields of a line."""
    return next((mark for mark in SEPARATORS if mark in text), ",")


def with_points(text: str, separator: str) -> str:
    """Return a line with points for commas, which are decimal commas where they do not separate fields."""
    return text if separator == "," else text.replace(",", ".")


def named(cell: str) -> tuple[str, str | None] | None:
    """Return name and unit of a column as its header gives them, None where it cannot be one.

    Examples
    --------
    >>> named('"Position (mm)"'), named("torque (net) [N m]"), named("x")
    (('Position', 'mm'), ('torque (net)', 'N m'), ('x', None))
    """
    # Not by a regular expression: one that leaves blanks to three parts tries all divisions among them.
    text = cell.strip().removeprefix('"').removesuffix('"').rstrip()
    name, unit = text, None
    if text.endswith("]"):
        name, _, unit = text[:-1].partition("[")
    elif text.endswith(")"):
        before, opened, inside = text[:-1].rpartition("(")
        name, unit = (before, inside) if opened and inside and ")" not in inside else (text, None)
    if unit == "" or any(mark in name for mark in '[]"') or (text.endswith("]") and "]" in text[:-1]):
        return None
    return name.strip(), None if unit is None else unit.strip()
