"""Numbers as a person reads them."""

import re
from typing import Final

_UNIT: Final = re.compile(r"(?<![A-Za-z])(u(?=[mNs](?![A-Za-z]))|deg(?![A-Za-z]))")
_RAISED: Final = str.maketrans("+-0123456789", " ⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def rounded(value: float, digits: int) -> float:
    """Return a number with as many significant digits."""
    return float(f"{value:.{digits - 1}e}")


def in_words(value: object, digits: int = 4) -> str:
    """Return a value for the page: no computer notation, counts in groups of three.

    Parameters
    ----------
    value
        A number, or anything else, which is shown as its text.
    digits
        How many significant digits are shown, four at most.
    """
    if isinstance(value, bool) or not isinstance(value, int | float):
        return str(value)
    if isinstance(value, int):
        return f"{value:,}".replace(",", "\N{NARROW NO-BREAK SPACE}")
    mantissa, _, power = f"{rounded(value, digits) + 0.0:.4g}".partition("e")
    text = mantissa.replace("-", "−")
    return f"{text} × 10{str(int(power)).translate(_RAISED)}" if power else text


def as_read(unit: str) -> str:
    """Return a unit of a case file as it stands in print: µm, °."""
    return _UNIT.sub(lambda found: {"u": "µ", "deg": "°"}[found[1]], unit)
