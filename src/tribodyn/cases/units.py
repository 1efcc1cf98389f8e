"""The only place where units are converted: text with a unit to SI floats and back.

A quantity is written ``"20 um"``: one number, then a unit. The number is read as a decimal and
multiplied by the exact decimal factor of the unit before it becomes a float, so ``"20 um"`` is the
same float as ``2e-05`` and a value in SI units reads back to the bit. The text is matched against a
small grammar before pint sees the unit: nothing is ever evaluated as an expression.
"""

import math
import re
from collections.abc import Sequence
from decimal import Context, Decimal
from functools import lru_cache
from typing import Final, NamedTuple

from tribodyn.cases.known_units import MEASURES, SIZES, ZEROS
from tribodyn.core.quoting import brief

_ARITHMETIC: Final = Context(prec=34)
_LONGEST: Final = 100
_KEPT: Final = 4096  #: Quantities that are kept as numbers: points of a sweep have the same but for a few.
_NUMBER: Final = r"[+-]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][+-]?[0-9]{1,3}(?![0-9]))?"
_FACTOR: Final = r"(?:1|[A-Za-z][A-Za-z_]*(?:(?:\^|\*\*)-?[1-9](?![0-9]))?)"
_PRODUCT: Final = rf"{_FACTOR}(?:\s*[*/]\s*{_FACTOR}|\s+{_FACTOR})*"
_PART: Final = rf"(?:{_FACTOR}|\(\s*{_PRODUCT}\s*\))"
_UNIT: Final = rf"{_PART}(?:\s*[*/]\s*{_PART}|\s+{_PART})*"
#: A power without its sign, as in mm3.
_BARE_POWER: Final = re.compile(r"(?<=[A-Za-z])([2-4])(?![0-9A-Za-z_])")
_QUANTITY_PATTERN: Final = re.compile(rf"({_NUMBER})\s*(.*)", re.ASCII | re.DOTALL)
_UNIT_PATTERN: Final = re.compile(_UNIT, re.ASCII)
_NOT_FINITE: Final = re.compile(r"[+-]?(nan|inf|infinity)\b.*", re.IGNORECASE | re.DOTALL)
_SPELLINGS: Final = str.maketrans(
    {"µ": "u", "μ": "u", "°": "deg", "·": "*", "⋅": "*", "−": "-", "²": "^2", "³": "^3", "\u00a0": " "}
)

SI_UNITS: Final = tuple(MEASURES)


#: No constant: tables for workshops have 4 (firgelliauto.com) to 7.2 (frictioncalculator.com).
RZ_OVER_RA: Final = 5.6
#: Characters that a number may gain in another unit; with more it is not a round number there.
_ROUND: Final = 3
_GAUSSIAN: Final = math.sqrt(math.pi / 2.0)
#: Root mean square roughness over other measures of height, for Gaussian heights: σ = √(π/2) Ra.
AMPLITUDES: Final = {"Rq": 1.0, "Sq": 1.0, "Ra": _GAUSSIAN, "Sa": _GAUSSIAN, "Rz": _GAUSSIAN / RZ_OVER_RA}


class UnitProblem(ValueError):
    """A text is not a quantity of the wanted kind; the message says why."""


class MissingUnit(UnitProblem):
    """A number stands alone where a unit is needed."""


def si_unit(unit: str) -> str:
    """Return the SI unit that measures the same kind of quantity as `unit`; without one `unit` itself.

    Examples
    --------
    >>> si_unit("GPa")
    'Pa'
    """
    base = _scale(unit).base
    found = next((si for si in MEASURES if _scale(si).base == base), unit)
    if _scale(found).factor != 1:
        raise UnitProblem(
            f"{unit!r} is no SI unit, and no other key has such a quantity; give the key an SI unit"
        )
    return found


def dimension(unit: str) -> str:
    """Return the name of what `unit` measures, such as ``length``; without one the unit itself."""
    return MEASURES.get(si_unit(unit), unit)


def unit_of(text: str) -> str:
    """Return the unit part of a quantity that is known to be well written."""
    return _split(text)[1]


@lru_cache(_KEPT)
def to_si(text: str, like: str) -> float:
    """Convert a quantity to its SI value.

    ``text``: number and unit, such as ``"20 um"``; a viscosity also as a kinematic one with the density,
    ``"32 cSt at 870 kg/m^3"``; ``like``: a unit of the wanted dimension; angles and plain ratios are
    distinguished. Raises UnitProblem if the text is no quantity, has no unit, or has one of another
    dimension.
    """
    kinematic, at, density = text.partition(" at ")
    if at and dimension(like) == "viscosity":
        return to_si(kinematic, "m^2/s") * to_si(density, "kg/m^3")
    number, unit = _split(text)
    scale = _known(unit)
    if scale.base != _scale(like).base:
        raise UnitProblem(
            f"{brief(unit)!r} is not a unit of {dimension(like)}{_meant(scale, number, unit, like)}"
        )
    value = scale.si(number)
    if not math.isfinite(value):
        raise UnitProblem("the number is too large")
    return value


def base_of(unit: str) -> str:
    """Return a unit in SI base units: ``kilogram * meter / second ** 2``."""
    return _known(unit).base


def counts_from_zero(unit: str) -> bool:
    """Return whether a unit counts from a zero of its own, as degC does."""
    return bool(_known(unit).zero)


def to_si_base(text: str) -> float:
    """Convert a quantity of any dimension to its value in SI base units."""
    number, unit = _split(text)
    return _known(unit).si(number)


def rms_roughness(text: str) -> float:
    """Convert a root mean square roughness to metres; ``Ra 0.8 um`` and the like are understood, too.

    ``text``: a length, after the name of one of :data:`AMPLITUDES` if it is another measure.
    """
    name, _, length = text.strip().partition(" ")
    factor = AMPLITUDES.get(name.rstrip("="))
    return to_si(text, "m") if factor is None else factor * to_si(length.lstrip("= "), "m")


def _meant(scale: "_Scale", number: Decimal, unit: str, like: str) -> str:
    """Return a correction for a kinematic viscosity and for turns in some time, else nothing."""
    wanted, given = dimension(like), scale.base
    if wanted == "viscosity" and given == _scale("m^2/s").base:
        return f': this one is kinematic; say the density, as in "{number:f} {unit} at 870 kg/m^3"'
    if wanted == "angular speed" and given == _scale("Hz").base:
        return f'; of turns, "{number:f} {unit}" is "{60.0 * scale.si(number):.9g} rpm"'
    return ""


def from_si(value: float, unit: str) -> str:
    """Write an SI value as text that :func:`to_si` reads back to the same float.

    ``value``: finite SI value. ``unit``: preferred unit. It is used when some number of at most 17 digits in
    it reads back exactly, otherwise the value stands in SI units.
    """
    return _written(value, unit, math.copysign(1.0, value))


# Of zeros with either sign one would stand for both.
@lru_cache(_KEPT, typed=True)
def _written(value: float, unit: str, _sign: float) -> str:
    scale = _scale(unit)
    in_unit = _ARITHMETIC.divide(Decimal(value) - scale.zero, scale.factor)
    # A number of fewer digits is what it rounds to with twelve, too; not so where a zero was taken off.
    for digits in range(1 if scale.zero else 12, 18):
        number = float(f"{in_unit:.{digits - 1}e}")
        # As to_si does it, but a rounded number may be too large here, which is no error.
        if scale.si(Decimal(repr(number))) == value:
            return f"{repr(number).removesuffix('.0')} {unit}"
    return f"{value!r} {si_unit(unit)}"


def number_in(value: float, unit: str) -> float:
    """Return an SI value in some unit as the nearest float, to draw it; :func:`from_si` writes it."""
    scale = _scale(unit)
    return float(_ARITHMETIC.divide(Decimal(value) - scale.zero, scale.factor))


def with_shared_unit(texts: Sequence[str]) -> list[str]:
    """Return quantities to whose bare numbers the unit of the last one is added: ``20, 25, 30 um``."""
    try:
        unit = unit_of(texts[-1]) if texts else ""
    except UnitProblem:
        unit = ""
    return [f"{text} {unit}" if unit and is_number(text) else text for text in texts]


def is_number(text: str) -> bool:
    """Tell whether a text is a number without a unit."""
    try:
        float(text)
    except ValueError:
        return False
    return True


def likely_unit(number: str, example: str, unit: str) -> str:
    """Return the unit in which a number was probably meant that was given without one.

    ``number``: as it was given; ``unit``: in which such a quantity is shown; returned unless the number is
    nearer to the example in SI units.
    """
    try:
        likely, first, second = (
            to_si(text, unit) for text in (example, f"{number} {unit}", f"{number} {si_unit(unit)}")
        )
    except UnitProblem:
        return unit
    if 0.0 in (likely, first, second) or _apart(first, likely) <= _apart(second, likely):
        return unit
    return si_unit(unit)


def likely_quantity(number: str, example: str, unit: str) -> str:
    """Return a number that was given without a unit with the one it was probably meant in.

    ``number``, ``example`` and ``unit`` are those of :func:`likely_unit`. The quantity is written in ``unit``
    where that is as short.
    """
    likely = likely_unit(number, example, unit)
    given = f"{brief(number)} {likely}"
    if likely == unit:
        return given
    written = from_si(to_si(f"{number} {likely}", unit), unit)
    return written if len(written) <= len(given) + _ROUND else given


def _apart(a: float, b: float) -> float:
    """Return the number of powers of e between the sizes of two numbers."""
    return abs(math.log(abs(a)) - math.log(abs(b)))


def _split(text: str) -> tuple[Decimal, str]:
    """Split a quantity into its number and its unit."""
    if len(text) > _LONGEST:
        raise UnitProblem("the text is too long for a number and a unit")
    plain = text.translate(_SPELLINGS).strip()
    if _NOT_FINITE.fullmatch(plain):
        raise UnitProblem("the number must be finite")
    match = _QUANTITY_PATTERN.fullmatch(plain)
    if match is None:
        raise UnitProblem("this is not a number followed by a unit")
    number, unit = match.group(1), match.group(2).strip()
    if not unit:
        raise MissingUnit("the unit is missing")
    if unit.startswith(",") and unit[1:2].isdigit():
        raise UnitProblem("numbers have a decimal point, not a comma")
    return Decimal(number), f"1{unit}" if unit.startswith("/") else unit


_SEVERAL: Final = re.compile(r"\s*,\s+[-+.\d]")
_COMMA: Final = re.compile(r"\d,\d")  #: Decimal comma of a computation.


class _Scale(NamedTuple):
    """Unit in SI base units: zero + factor times the number, in ``base``."""

    factor: Decimal
    zero: Decimal
    base: str

    def si(self, number: Decimal) -> float:
        """Return the SI value of a number of this unit."""
        return float(_ARITHMETIC.add(_ARITHMETIC.multiply(number, self.factor), self.zero))


def _known(unit: str) -> _Scale:
    """Return the definition of a unit that a user wrote."""
    unit = _BARE_POWER.sub(r"^\1", unit)
    if _SEVERAL.match(unit):
        raise UnitProblem(
            "these are several numbers, and this key takes one: forces and moments are sizes here, and have "
            "their directions in a key of their own, direction = [-1, 0, 0]"
        )
    if _COMMA.search(unit):
        raise UnitProblem("numbers have a decimal point, not a comma")
    if not _UNIT_PATTERN.fullmatch(unit):
        raise UnitProblem(
            f"{brief(unit)!r} is not a unit (write products and powers as N*m or N m, m/s, 1/um^2)"
        )
    return _scale(unit)


_KNOWN: Final = {
    unit: _Scale(Decimal(size), Decimal(ZEROS.get(unit, "0")), base)
    for base, sizes in SIZES.items()
    for unit, size in sizes.items()
}


@lru_cache(maxsize=1024)
def _scale(unit: str) -> _Scale:
    """Return the exact way from a unit to SI base units.

    Plain numbers, angles and frequencies have the same dimension but different base units (none,
    radian, 1/s against rad/s), which is why base units are compared and not dimensions.
    """
    if unit in _KNOWN:
        return _KNOWN[unit]
    # Loading pint takes longer than reading a case.
    from tribodyn.cases.other_units import UnknownUnit, looked_up

    try:
        size, zero, base = looked_up(unit)
    except UnknownUnit as problem:
        known = next((one for one in _KNOWN if one.lower() == unit.lower()), "")
        raise UnitProblem(f"{problem}, write {known!r}" if known else str(problem)) from None
    return _Scale(size, zero, base)


LISTS: Final = frozenset({"vector", "series", "names"})  #: Kinds of keys that hold several values.
AXES: Final = "xyz"  #: Components of a vector, as dotted paths name them: ``point.x``.


def elements(value: object, unit: str) -> list[object] | None:
    """Return the elements of what a user wrote: a list, or one text with commas; None for other things.

    ``value``: as parsed from TOML, or given on the command line or from Python. ``unit``: of the elements,
    empty for bare numbers and names. In a text the last one may stand for all, as in ``"0, 0, 170 mm"``.
    """
    if isinstance(value, list | tuple):
        return list(value)
    if not isinstance(value, str):
        return None
    texts = [part.strip() for part in value.strip().removeprefix("[").removesuffix("]").split(",")]
    plain = [text.strip("\"'") for text in texts]
    return list(with_shared_unit(plain)) if unit else list(plain)
