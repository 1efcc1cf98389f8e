"""Quantities with dimensions: what expressions of a case compute with."""

import re
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from typing import Final

from tribodyn.cases.units import SI_UNITS, base_of

#: Powers of base units other than zero, by their names, sorted.
Dimensions = tuple[tuple[str, Fraction], ...]
PLAIN: Final[Dimensions] = ()
ANGLE: Final[Dimensions] = (("radian", Fraction(1)),)
PER_TIME: Final[Dimensions] = (("second", Fraction(-1)),)
ROUNDING: Final = 1e-9  #: Relative error of a sum of zeros of a temperature scale, at most.


class ExpressionProblem(ValueError):
    """An expression has no value; the message says why."""


@dataclass(frozen=True)
class Dimensioned:
    """A number with its dimensions."""

    value: float  #: In SI units.
    dimensions: Dimensions = PLAIN  #: Of it.
    #: Number of zeros of a temperature scale in the value, such as that of degC: 1 for a temperature in degC,
    #: 0 for a difference of two, 2 for their sum. None without such a scale.
    zeros: float | None = None
    #: Power of turns that the value counts instead of radians: 1 for a frequency, 0 for 2 pi times that.
    turns: Fraction = Fraction(0)

    @property
    def is_difference(self) -> bool:
        """Whether this is a difference of two temperatures."""
        return self.zeros is not None and abs(self.zeros) < ROUNDING

    @property
    def has_scale(self) -> bool:
        """Whether its value holds zeros of a temperature scale."""
        return self.zeros is not None and not self.is_difference


def times(a: Dimensions, b: Dimensions, sign: int = 1) -> Dimensions:
    """Return the dimensions of a product, or with ``sign`` -1 of a quotient."""
    powers = dict(a)
    for name, power in b:
        powers[name] = powers.get(name, Fraction(0)) + sign * power
    return tuple(sorted((name, power) for name, power in powers.items() if power))


def raised(a: Dimensions, power: Fraction) -> Dimensions:
    """Return the dimensions of a power."""
    return tuple((name, power * held) for name, held in a if power)


@lru_cache(maxsize=256)
def dimensions_of(unit: str) -> Dimensions:
    """Return the dimensions of a unit; none for an empty one."""
    if not unit:
        return PLAIN
    found: Dimensions = PLAIN
    sign = 1
    for token in re.split(r"\s+(?=[*/]\s)|(?<=\s[*/])\s+", base_of(unit)):
        token = token.strip()
        if token in ("*", "/"):
            sign = 1 if token == "*" else -1
        elif token not in ("1", "dimensionless"):
            name, _, power = token.partition(" ** ")
            found = times(found, ((name, Fraction(power or "1")),), sign)
    return found


def unit_for(found: Dimensioned) -> str:
    """Return the SI unit of a quantity that this package works with; empty for a plain number."""
    dimensions = found.dimensions
    if not dimensions:
        return ""
    if dimensions == PER_TIME and found.turns <= 0:
        return "rad/s"
    for unit in SI_UNITS:
        if dimensions_of(unit) == dimensions:
            return unit
    raise ExpressionProblem(f"it is {described(dimensions)}: write it where it is needed, not as a parameter")


def described(dimensions: Dimensions) -> str:
    """Return dimensions as a user reads them: ``meter^2/second``."""
    parts = ["".join((name, f"^{power}" if power != 1 else "")) for name, power in dimensions]
    return " ".join(parts) or "a plain number"


def fits(found: Dimensions, wanted: Dimensions, turns: Fraction = Fraction(0)) -> bool:
    """Return whether a quantity is of some dimensions.

    The radian is 1: an arc, radius times angle, is a length, and a speed over a radius an angular speed. A
    number of turns in some time is none.
    """
    if found == wanted or (_is_rate(found, wanted) and turns <= 0):
        return True
    names = dict(found)
    arc = "meter" in names and "radian" in names
    return arc and wanted == tuple((name, power) for name, power in found if name != "radian")


def _is_rate(found: Dimensions, wanted: Dimensions) -> bool:
    """Return whether one is a time to some power and the other an angle over it, or times it."""
    return dict(wanted).keys() == {"radian", "second"} and found == times(wanted, ANGLE, -1)


def same(a: Dimensioned, b: Dimensioned, what: str) -> Dimensions:
    """Return the dimensions of two quantities that are added or compared; refuse different ones."""
    for one, other in ((a, b), (b, a)):
        if fits(one.dimensions, other.dimensions, one.turns) and _is_rate(one.dimensions, other.dimensions):
            return other.dimensions
    if a.dimensions == b.dimensions or (not b.value and not b.dimensions):
        return a.dimensions
    if not a.value and not a.dimensions:
        return b.dimensions
    raise ExpressionProblem(f"{what} of {described(a.dimensions)} and {described(b.dimensions)}")
