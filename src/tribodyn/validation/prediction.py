"""A number that is stated before its measured value is seen."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Prediction:
    """A number stated before its measured value is seen.

    Attributes
    ----------
    set, name, unit
        Validation set, what it is, and its unit.
    value, low, high
        Value and interval.
    null, null_low, null_high
        Value and interval of the null model.
    reading
        How the measured value is read.
    half_width
        Half width of that reading.
    """

    set: str
    name: str
    unit: str
    value: float
    low: float
    high: float
    null: float
    null_low: float
    null_high: float
    reading: str
    half_width: float

    @property
    def refuted_by(self) -> str:
        """Measured values that refute the prediction."""
        low, high = self.low - self.half_width, self.high + self.half_width
        return f"a measured value below {low:.4g} or above {high:.4g} {self.unit}"
