"""Units that few cases are written in, as pint knows them."""

from decimal import Decimal
from typing import Final

import pint

from tribodyn.core.quoting import brief

_REGISTRY: Final[pint.UnitRegistry[Decimal]] = pint.UnitRegistry(
    non_int_type=Decimal, on_redefinition="ignore", cache_folder=None, autoconvert_offset_to_baseunit=True
)
# pint reads Nm as the number metric of yarns; an engineer means the moment.
_REGISTRY.define("newton_meter = newton * meter = Nm")
# Hardness numbers of Vickers and Brinell are kilogrammes-force per square millimetre.
_REGISTRY.define("vickers_hardness = 9.80665 * megapascal = HV")
_REGISTRY.define("brinell_hardness = 9.80665 * megapascal = HB")


class UnknownUnit(ValueError):
    """Nobody knows this unit, or it cannot be used here; the message says which."""


def looked_up(unit: str) -> tuple[Decimal, Decimal, str]:
    """Return size and zero of a unit in SI base units, and these.

    Raises UnknownUnit if there is no such unit, or it counts from a zero of its own.
    """
    try:
        one, nothing = (_REGISTRY.Quantity(Decimal(n), unit).to_base_units() for n in (1, 0))
    except pint.UndefinedUnitError:
        raise UnknownUnit(f"unknown unit {brief(unit)!r}") from None
    except (pint.PintError, ArithmeticError, ValueError, TypeError):
        raise UnknownUnit(f"{brief(unit)!r} cannot be used as a unit here") from None
    zero = Decimal(nothing.magnitude)
    if zero and not unit.isidentifier():
        raise UnknownUnit(f"{brief(unit)!r} counts from a zero of its own; use kelvin")
    return Decimal(one.magnitude) - zero, zero, str(one.units)
