"""What a headline number is."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import xarray as xr


@dataclass(frozen=True)
class Headline:
    """One headline number.

    Attributes
    ----------
    label
        What it is, for a table.
    unit
        Unit as printed.
    group
        What kind of question it answers.
    meaning
        Why an engineer cares, in a sentence.
    compute
        Returns the number, NaN or an error of lookup where the result does not hold it.
    count
        Whether it is a whole number.
    """

    label: str
    unit: str
    group: str
    meaning: str
    compute: Callable[[xr.Dataset], float]
    count: bool = False
