"""Variations of a key: from ``joint.clearance = 10 um:50 um:10 um`` to values, or to a distribution."""

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from decimal import Decimal
from typing import Final, TypeAlias

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.cases.keys import Key, Value, ValueProblem, shown
from tribodyn.cases.units import from_si, with_shared_unit
from tribodyn.core.errors import InputError
from tribodyn.core.quoting import meant
from tribodyn.studies.sampling import DISTRIBUTIONS, Distribution, DistributionProblem

SOURCE: Final = "--vary"
MOST_VALUES: Final = 10_000
_CALL: Final = re.compile(r"\s*([A-Za-z_]+)\s*\((.*)\)\s*", re.DOTALL)
_SCALABLE: Final = ("quantity", "number")

#: Request for one parameter: text as on the command line, or values.
Asked: TypeAlias = str | Iterable[object]


@dataclass(frozen=True)
class Levels:
    """A parameter that takes one value after the other."""

    key: Key  #: The key of the case that varies.
    values: tuple[Value, ...]  #: SI values, switches or names.


@dataclass(frozen=True)
class Scatter:
    """A parameter that is drawn from a distribution."""

    key: Key  #: The key of the case that varies.
    distribution: Distribution  #: The family.
    arguments: tuple[float, ...]  #: Its arguments, SI.

    def values(self, probabilities: FloatArray) -> FloatArray:
        """Return the SI values at the given probabilities, of the same shape."""
        return self.distribution.quantiles(self.arguments, probabilities)


Variation: TypeAlias = Levels | Scatter


def written(key: Key, value: Value) -> str:
    """Return a value as a user would give it after ``--set``."""
    return value if isinstance(value, str) else key.write(value).strip('"')


def variation(key: Key, asked: Asked) -> Variation:
    """Return a user's request for one key.

    ``key``: the key that varies; ``asked``: ``"V1,V2,..."``, ``"A:B:STEP"``, ``"normal(MEAN, DEVIATION)"`` or
    another of :data:`~tribodyn.studies.sampling.DISTRIBUTIONS`; or any values. Raises InputError if it cannot
    be understood, or a value is not of the kind that the key takes.
    """
    if not isinstance(asked, str):
        plain = [value.item() if isinstance(value, np.generic) else value for value in asked]
        return _levels(key, plain, asked)
    call = _CALL.fullmatch(asked)
    if call is not None:
        return _scatter(key, call[1], call[2], asked)
    ends = asked.split(":")
    if len(ends) == 2:
        raise _refused(key, asked, "a range needs its step, too")
    if len(ends) == 3 and key.kind in (*_SCALABLE, "count"):
        return Levels(key, _range(key, ends, asked))
    return _levels(key, _with_shared_unit(key, asked.split(",")), asked)


def _levels(key: Key, texts: Sequence[object], asked: Asked) -> Levels:
    values = tuple(_read(key, text, asked) for text in texts)
    if not values:
        raise _refused(key, asked, "no value is given")
    if len(set(values)) < len(values):
        raise _refused(key, asked, "a value is given twice")
    return Levels(key, values)


def _scatter(key: Key, name: str, inside: str, asked: str) -> Scatter:
    if name not in DISTRIBUTIONS:
        raise _refused(key, asked, f"there is no distribution {shown(name)}")
    if key.kind not in _SCALABLE:
        raise _refused(key, asked, "only quantities and plain numbers can be drawn from a distribution")
    texts = _with_shared_unit(key, inside.split(","))
    scatter = Scatter(key, DISTRIBUTIONS[name], tuple(_number(key, text, asked) for text in texts))
    try:
        scatter.values(np.array([0.5]))
    except DistributionProblem as problem:
        raise _refused(key, asked, f"{problem}; usage: {name}{scatter.distribution.usage}") from None
    return scatter


def _with_shared_unit(key: Key, parts: Sequence[str]) -> list[str]:
    """Return the parts, to bare numbers of which the unit of the last one is added: ``20, 25, 30 um``."""
    texts = [part.strip() for part in parts]
    return with_shared_unit(texts) if key.kind == "quantity" else texts


def _range(key: Key, ends: Sequence[str], asked: str) -> tuple[Value, ...]:
    """Return the values from the first end to the last, which is one of them if a step lands on it.

    Decimal arithmetic in the unit of the key, so that the range holds just the values that a list would.
    """
    numbers, unit = _in_one_unit(key, [_number(key, text, asked) for text in _with_shared_unit(key, ends)])
    a, b, d = numbers
    if d == 0 or (b - a) * d < 0:
        raise _refused(key, asked, "the step must lead from the first value to the last")
    n = int((b - a) / d) + 1
    if n > MOST_VALUES:
        raise _refused(key, asked, f"these are {n} values; at most {MOST_VALUES} are allowed")
    return tuple(_read(key, f"{a + i * d} {unit}".strip(), asked) for i in range(n))


def _in_one_unit(key: Key, values: Sequence[float]) -> tuple[list[Decimal], str]:
    """Return values in the unit of the key where all of them read back exactly from it, else in SI units."""
    if key.kind != "quantity":
        return [Decimal(repr(value)) for value in values], ""
    parts = [from_si(value, key.unit).partition(" ") for value in values]
    units = {unit for _, _, unit in parts}
    if len(units) == 1:
        return [Decimal(number) for number, _, _ in parts], units.pop()
    texts = [from_si(value, si) for value in values for si in [_si(key)]]
    return [Decimal(text.partition(" ")[0]) for text in texts], _si(key)


def _si(key: Key) -> str:
    from tribodyn.cases.units import si_unit

    return si_unit(key.unit)


def _read(key: Key, text: object, asked: Asked) -> Value:
    try:
        value = key.read(text, text=True)
    except ValueProblem as problem:
        raise _refused(key, asked, str(problem) or f"{shown(text)} does not fit") from None
    if key.kind == "choice" and value not in key.choices:
        hint = meant(str(value), key.choices)
        raise _refused(key, asked, f"{shown(text)} is not one of {', '.join(key.choices)}{hint}")
    return value


def _number(key: Key, text: object, asked: Asked) -> float:
    value = _read(key, text, asked)
    assert isinstance(value, int | float)
    return float(value)


def _refused(key: Key, asked: Asked, why: str) -> InputError:
    given = shown(asked) if isinstance(asked, str) else "values"
    laws = " | ".join(f"{name}{law.usage}" for name, law in DISTRIBUTIONS.items())
    forms = "V1,V2,..." if key.kind not in (*_SCALABLE, "count") else "V1,V2,... | A:B:STEP"
    forms = f"{forms} | {laws}" if key.kind in _SCALABLE else forms
    bracket = isinstance(asked, str) and ".." in asked
    why = "a bracket with .. is for `tribodyn find`; a range has a step, A:B:STEP" if bracket else why
    return InputError(
        f"given {given}: {why}; allowed: {forms}, each value {key.allowed}", key=key.path, source=SOURCE
    )
