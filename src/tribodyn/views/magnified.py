"""Magnification of the motion in a clearance in a scene."""

from typing import Any, Final

import numpy as np

_SHOWN: Final = 0.35
"""Clearance as a scene first shows it, over the radius of the shaft."""


def magnification(ratio: float) -> dict[str, Any]:
    """Return the range of the magnification and where it begins: round numbers.

    Parameters
    ----------
    ratio
        Radius of the shaft over its clearance.
    """
    first = _SHOWN * ratio
    digit = 10.0 ** np.floor(np.log10(first))
    value = float(max(np.floor(first / digit) * digit, 1.0))
    return {"value": value, "most": 2.0 * value}
