"""Numbers as a person reads them."""

from __future__ import annotations

from typing import Final

_RAISED: Final = str.maketrans("+-0123456789", " ⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def in_words(value: object) -> str:
    """Return a value for the page: four significant digits, no computer notation, counts in groups of three.

    Parameters
    ----------
    value
        A number, or anything else, which is shown as its text.
    """
    if isinstance(value, bool) or not isinstance(value, int | float):
        return str(value)
    if isinstance(value, int):
        return f"{value:,}".replace(",", "\N{NARROW NO-BREAK SPACE}")
    digits, _, power = f"{value + 0.0:.4g}".partition("e")
    text = digits.replace("-", "−")
    return f"{text} × 10{str(int(power)).translate(_RAISED)}" if power else text
