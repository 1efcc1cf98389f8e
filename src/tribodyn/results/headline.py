"""What a headline number is."""

from __future__ import annotations

from collections.abc import Callable, Mapping
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
    digits
        How many digits of it hold: neighbouring tolerances agree in them, or nearly.
    over
        Of a peak, the name of the headline number that says in how much of the motion it was looked for.
    span
        That in words; a plural s follows them.
    """

    label: str
    unit: str
    group: str
    meaning: str
    compute: Callable[[xr.Dataset], float]
    count: bool = False
    digits: int = 3
    over: str = ""
    span: str = "after {} reversal"

    def label_in(self, summary: Mapping[str, object]) -> str:
        """Return the label in a summary: a peak says in how much of the motion it was looked for."""
        if self.over not in summary:
            return self.label
        n = summary[self.over]
        return f"{self.label} {self.span.format(n)}" + ("" if n == 1 else "s")
