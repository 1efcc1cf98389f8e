"""Keys that hold several values: how a user may write them."""

from __future__ import annotations

from typing import Final

from tribodyn.cases.units import with_shared_unit

LISTS: Final = frozenset({"vector", "series", "names"})
"""Kinds of keys that hold several values."""
AXES: Final = "xyz"
"""Components of a vector, as dotted paths name them: ``point.x``."""


def elements(value: object, unit: str) -> list[object] | None:
    """Return the elements of what a user wrote: a list, or one text with commas; None for other things.

    Parameters
    ----------
    value
        As parsed from TOML, or given on the command line or from Python.
    unit
        Of the elements, empty for bare numbers and names. In a text the last one may stand for all, as in
        ``"0, 0, 170 mm"``.
    """
    if isinstance(value, list | tuple):
        return list(value)
    if not isinstance(value, str):
        return None
    texts = [part.strip() for part in value.strip().removeprefix("[").removesuffix("]").split(",")]
    plain = [text.strip("\"'") for text in texts]
    return list(with_shared_unit(plain)) if unit else list(plain)
