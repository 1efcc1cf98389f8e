"""Keys that outputs of every mechanism have: where their error is read, and the error that is too large."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import ClassVar, Final

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.cases import fields
from tribodyn.cases.case import Group, NamedGroup, demand
from tribodyn.cases.fields import Numbers, series
from tribodyn.mechanisms.mechanism_protocol import plain

ANGLE_UNIT: Final = "deg"
#: Reasons for the end of a wear campaign, in words, by their names in its history.
ERROR_LIMIT_OF: Final = {"wear_error_share": "the error limit of an output"}
#: Unit that stands in the name of an instant, with its SI value, by what is given.
_SHOWN: Final = {"angle": (ANGLE_UNIT, np.pi / 180.0), "position": ("mm", 1e-3), "time": ("s", 1.0)}


class InstantKeys(Group):
    """Place at which the error of an output is read."""

    angles: Numbers | None = series(
        "angles of the drive at which the error is read", unit=ANGLE_UNIT, example='["30 deg", "90 deg"]'
    )
    times: Numbers | None = series(
        "times in each cycle at which the error is read", unit="s", example='["0.1 s", "0.25 s"]'
    )

    @property
    def given(self) -> Iterator[tuple[str, float]]:
        """Quantity of the values, ``angle``, ``position`` or ``time``, with each value (SI)."""
        for kind in _SHOWN:
            for value in getattr(self, f"{kind}s", None) or ():
                yield kind, value


class ErrorKeys(NamedGroup):
    """Limits on the error of an output, whatever its quantity."""

    #: SI unit of each quantity.
    UNITS: ClassVar[Mapping[str, str]] = {"angle": "rad", "angular_velocity": "rad/s"}
    #: Key of the limit of an error by the quantity.
    LIMITS: ClassVar[Mapping[str, str]] = {
        "angle": "angle_error_limit",
        "angular_velocity": "angular_velocity_error_limit",
    }

    quantity: str
    at: InstantKeys = InstantKeys()
    angle_error_limit: float | None = fields.quantity(
        None,
        "error of an angle at which the mechanism is worn out: a campaign ends there",
        "",
        unit=ANGLE_UNIT,
        gt=0,
        example="0.05 deg",
    )
    angular_velocity_error_limit: float | None = fields.quantity(
        None, "the same of an angular velocity", "", unit="deg/s", gt=0, example="1 deg/s"
    )

    @property
    def unit(self) -> str:
        """Its SI unit."""
        return self.UNITS[self.quantity]

    @property
    def limit(self) -> float | None:
        """Error at which the mechanism is worn out, in the unit of the quantity."""
        found: float | None = getattr(self, self.LIMITS[self.quantity])
        return found

    def model_post_init(self, context: object, /) -> None:
        """Check that the limit is one of this quantity."""
        for key in {*self.LIMITS.values()} - {self.LIMITS[self.quantity]}:
            words = f"the limit of this error is {self.LIMITS[self.quantity]}"
            demand(getattr(self, key) is None, key, words)


@dataclass(frozen=True)
class Instant:
    """Place at which the error of an output is read."""

    output: str  #: Name of the output.
    kind: str  #: ``angle`` or ``position`` of a drive, or ``time``.
    value: float  #: (SI).

    @property
    def name(self) -> str:
        """Its name in results: letters, digits and underscores."""
        unit, scale = _SHOWN[self.kind]
        number = f"{self.value / scale:g}".replace(".", "_").replace("-", "minus_").replace("+", "")
        return f"{plain(self.output)}_{number}_{unit}"


def instants_of(outputs: Mapping[str, ErrorKeys]) -> tuple[Instant, ...]:
    """Return the places at which errors are read, none twice."""
    found = (Instant(name, *given) for name, keys in outputs.items() for given in keys.at.given)
    return tuple({instant.name: instant for instant in found}.values())


def instant_coordinates(outputs: Mapping[str, ErrorKeys]) -> dict[str, list[str]]:
    """Return the names of instants and of their outputs, as results have them; nothing without instants."""
    instants = instants_of(outputs)
    named = {
        "instant": [instant.name for instant in instants],
        "instant_output": [instant.output for instant in instants],
    }
    return named if instants else {}


def wear_limits_of(outputs: Mapping[str, ErrorKeys]) -> dict[str, float]:
    """Return the limit of the errors of outputs, by what a campaign calls it; nothing without limits."""
    return dict.fromkeys(ERROR_LIMIT_OF, 1.0) if any(keys.limit for keys in outputs.values()) else {}


def limits_of(outputs: Mapping[str, ErrorKeys]) -> FloatArray:
    """Return the errors at which outputs are worn out, in their units; NaN without a limit, shape (n,)."""
    limits = [keys.limit for keys in outputs.values()]
    return np.array([np.nan if limit is None else limit for limit in limits])


def error_share(columns: Mapping[str, FloatArray], outputs: Mapping[str, ErrorKeys]) -> float:
    """Return the largest error of an output over its limit; zero without limits.

    ``columns``: of the outputs, ``output_error`` of shape (n_t, n) among them; none without outputs;
    ``outputs``: in this order.
    """
    shares = np.abs(columns["output_error"]) / limits_of(outputs) if outputs else np.zeros(1)
    known = shares[np.isfinite(shares)]
    return float(np.max(known, initial=0.0))
