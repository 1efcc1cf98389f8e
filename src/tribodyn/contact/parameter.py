"""Parameters of single laws: a law declares them, and they are keys of ``[contact]`` in case files."""

from collections.abc import Iterator
from dataclasses import dataclass, field, fields
from typing import Any

from tribodyn.core.errors import InputError

_KEY = "parameter"


@dataclass(frozen=True)
class Parameter:
    """Declaration of a law's parameter."""

    default: float  #: In SI units.
    unit: str  #: In which case files and tables show it; empty for a number without one.
    #: One line each; where the default comes from.
    meaning: str
    source: str = "assumed"
    #: It is greater than the first and at most the second, in SI units; None for no such limit.
    above: float | None = None
    most: float | None = None


def parameter(default: float, unit: str, meaning: str, **more: Any) -> Any:
    """Declare a field of a law that is a key of ``[contact]``, too.

    Parameters
    ----------
    default, unit, meaning, more
        See :class:`Parameter`.

    Returns
    -------
    dataclasses.Field
        For the body of the class.
    """
    return field(default=default, metadata={_KEY: Parameter(default, unit, meaning, **more)})


def parameters_of(law: Any) -> Iterator[tuple[str, Parameter]]:
    """Yield the names of the fields of a law that are such parameters, each with its description."""
    for entry in fields(law):
        if described := entry.metadata.get(_KEY):
            yield entry.name, described


def check_parameters(law: Any) -> None:
    """Refuse a parameter out of its range, or one that is not a finite number."""
    for name, described in parameters_of(law):
        value = getattr(law, name)
        least = -float("inf") if described.above is None else described.above
        most = float("inf") if described.most is None else described.most
        if not (least < value <= most and abs(value) < float("inf")):
            limits = [] if described.above is None else [f"> {described.above:g}"]
            limits += [] if described.most is None else [f"<= {described.most:g}"]
            allowed = " and ".join(limits) or "a finite number"
            raise InputError(f"given {value:g}; allowed: {allowed} (SI units)", key=f"contact.{name}")
