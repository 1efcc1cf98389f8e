"""A number that is stated before its measured value is seen."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Prediction:
    """A number stated before its measured value is seen."""

    #: Validation set, what it is, and its unit.
    set: str
    name: str
    unit: str
    #: Value and interval.
    value: float
    low: float
    high: float
    #: Value and interval of the null model.
    null: float
    null_low: float
    null_high: float
    reading: str  #: How the measured value is read.
    half_width: float  #: Half width of that reading.

    @property
    def refuted_by(self) -> str:
        """Measured values that refute the prediction."""
        low, high = self.low - self.half_width, self.high + self.half_width
        return f"a measured value below {low:.4g} or above {high:.4g} {self.unit}"
