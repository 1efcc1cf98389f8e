"""Expressions over quantities, such as ``"2 * crank + 20 mm"``: arithmetic, square roots, trigonometry.

A text is turned into Python's syntax tree and that tree is walked: nothing but numbers, names of parameters,
the operations and the functions listed here has a meaning, and nothing is ever executed. Units are followed
through every operation; what they do not allow is refused.
"""

import ast
import math
import re
from collections.abc import Callable, Mapping
from dataclasses import replace
from fractions import Fraction
from functools import lru_cache
from itertools import pairwise
from typing import Final

from tribodyn.cases.dimensions import (
    ANGLE,
    PER_TIME,
    PLAIN,
    ROUNDING,
    Dimensioned,
    ExpressionProblem,
    described,
    dimensions_of,
    raised,
    same,
    times,
)
from tribodyn.cases.units import UnitProblem, base_of, counts_from_zero, to_si_base
from tribodyn.core.quoting import brief, meant

LONGEST: Final = 200  #: Characters of an expression.
_DEEPEST: Final = 30
_LARGEST_POWER: Final = 8.0
_LARGEST_ROOT: Final = 8
_NUMBER: Final = re.compile(
    r"(?<![A-Za-z0-9_.])(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][+-]?[0-9]{1,3}(?![0-9]))?"
)
_UNIT: Final = re.compile(r"\s*([A-Za-z%][A-Za-z_]*)(?:(?:\^|\*\*)(-?[1-9])(?![0-9]))?")
_NEXT_UNIT: Final = re.compile(r"(\s*[*/]\s*|\s+)([A-Za-z%][A-Za-z_]*)(?:(?:\^|\*\*)(-?[1-9])(?![0-9]))?")
_NAME: Final = re.compile(r"[A-Za-z_][A-Za-z0-9_]*")


Function = Callable[..., Dimensioned]


def _is_power(exponent: Dimensioned) -> Fraction:
    if exponent.dimensions or abs(exponent.value) > _LARGEST_POWER:
        raise ExpressionProblem(f"a power is a plain number of at most {_LARGEST_POWER:g}")
    power = Fraction(exponent.value).limit_denominator(_LARGEST_ROOT)
    return power if math.isclose(float(power), exponent.value) else Fraction(exponent.value)


def _power(base: Dimensioned, exponent: Dimensioned) -> Dimensioned:
    power = _is_power(exponent)
    _refuse_scale(base)
    if base.dimensions and power.denominator > _LARGEST_ROOT:
        raise ExpressionProblem("a quantity with a unit has a power such as 2 or 1/2")
    turns = base.turns * power
    return Dimensioned(math.pow(base.value, exponent.value), raised(base.dimensions, power), turns=turns)


def _refuse_scale(*operands: Dimensioned) -> None:
    """Refuse temperatures of a scale with a zero of its own, such as degC, where only sums have a meaning."""
    if any(one.has_scale for one in operands):
        raise ExpressionProblem("a temperature in degC can be added to and compared only: write it in K")


def _sum(a: Dimensioned, b: Dimensioned, sign: int) -> Dimensioned:
    dimensions = same(a, b, "a sum" if sign > 0 else "a difference")
    zeros = None if a.zeros is b.zeros is None else (a.zeros or 0.0) + sign * (b.zeros or 0.0)
    if sign > 0 and a.zeros is None and b.has_scale and a.value:
        raise ExpressionProblem("what is added to a temperature is a difference: write it in K, not in degC")
    return Dimensioned(a.value + sign * b.value, dimensions, zeros, max(a.turns, b.turns))


def _product(a: Dimensioned, b: Dimensioned, sign: int) -> Dimensioned:
    value = a.value * b.value if sign > 0 else a.value / b.value
    dimensions, turns = times(a.dimensions, b.dimensions, sign), a.turns + sign * b.turns
    if sign < 0 and dimensions == PER_TIME and not a.dimensions:
        turns += 1  # so many in some time, such as 3000 / (60 s)
    zeros = None
    if a.zeros is not None and not b.dimensions:
        zeros = a.zeros * b.value if sign > 0 else a.zeros / b.value
    elif b.zeros is not None and not a.dimensions and sign > 0:
        zeros = a.value * b.zeros
    else:
        _refuse_scale(a, b)
    return Dimensioned(value, dimensions, zeros, turns)


def _of_angle(function: Callable[[float], float]) -> Function:
    def call(x: Dimensioned) -> Dimensioned:
        if x.dimensions not in (ANGLE, PLAIN):
            raise ExpressionProblem(f"an angle is needed, given {described(x.dimensions)}")
        return Dimensioned(function(x.value))

    return call


def _to_angle(function: Callable[[float], float]) -> Function:
    def call(x: Dimensioned) -> Dimensioned:
        if x.dimensions:
            raise ExpressionProblem(f"a plain number is needed, given {described(x.dimensions)}")
        return Dimensioned(function(x.value), ANGLE)

    return call


def _arctangent(y: Dimensioned, x: Dimensioned) -> Dimensioned:
    same(y, x, "the angle of a triangle")
    return Dimensioned(math.atan2(y.value, x.value), ANGLE)


def _extreme(choose: Callable[..., Dimensioned]) -> Function:
    def call(*quantities: Dimensioned) -> Dimensioned:
        dimensions, zeros = quantities[0].dimensions, {one.zeros for one in quantities} - {None}
        for a, b in pairwise(quantities):
            dimensions = same(replace(a, dimensions=dimensions), b, "a comparison")
        if len(zeros) > 1:
            raise ExpressionProblem("a comparison of a temperature and a difference of temperatures")
        chosen, turns = choose(quantities, key=_value), max(one.turns for one in quantities)
        return Dimensioned(chosen.value, dimensions, next(iter(zeros), None), turns)

    return call


def _value(x: Dimensioned) -> float:
    return x.value


#: Functions of expressions, with the number of their arguments.
FUNCTIONS: Final[Mapping[str, tuple[int, Function]]] = {
    "sqrt": (1, lambda x: _power(x, Dimensioned(0.5))),
    "abs": (1, lambda x: replace(x, value=abs(x.value))),
    "hypot": (2, lambda a, b: Dimensioned(math.hypot(a.value, b.value), same(a, b, "the hypotenuse"))),
    "sin": (1, _of_angle(math.sin)),
    "cos": (1, _of_angle(math.cos)),
    "tan": (1, _of_angle(math.tan)),
    "asin": (1, _to_angle(math.asin)),
    "acos": (1, _to_angle(math.acos)),
    "atan": (1, _to_angle(math.atan)),
    "atan2": (2, _arctangent),
    "min": (2, _extreme(min)),
    "max": (2, _extreme(max)),
}
OF_ANY_NUMBER: Final = ("min", "max")  #: Functions that take more arguments, too.
CONSTANTS: Final = {"pi": Dimensioned(math.pi, turns=Fraction(-1))}
_OPERATIONS: Final[Mapping[type[ast.operator], Function]] = {
    ast.Add: lambda a, b: _sum(a, b, 1),
    ast.Sub: lambda a, b: _sum(a, b, -1),
    ast.Mult: lambda a, b: _product(a, b, 1),
    ast.Div: lambda a, b: _product(a, b, -1),
    ast.Pow: _power,
}
_SIGNS: Final[Mapping[type[ast.unaryop], Dimensioned]] = {
    ast.UAdd: Dimensioned(1.0),
    ast.USub: Dimensioned(-1.0),
}


def names_in(text: str) -> set[str]:
    """Return the names in an expression: those of parameters, functions and units."""
    return set(_NAME.findall(re.sub(_NUMBER, " ", text[:LONGEST])))


def evaluate(text: str, scope: Mapping[str, Dimensioned]) -> Dimensioned:
    """Return the value of an expression.

    ``text``: as a user wrote it; ``scope``: parameters by their names. Raises ExpressionProblem if it is too
    long or too deep, no expression, or units and names do not allow it.

    Examples
    --------
    >>> evaluate("sqrt(crank^2 + (30 mm)^2)", {"crank": Dimensioned(0.04, dimensions_of("m"))}).value
    0.05
    """
    if len(text) > LONGEST:
        raise ExpressionProblem(f"an expression has at most {LONGEST} characters")
    if re.search(r"(?<![A-Za-z0-9])_", text):
        raise ExpressionProblem("a name begins with a letter")
    written, quantities = _without_units(text.replace("−", "-").replace("·", "*").replace("°", " deg"), scope)
    try:
        tree = ast.parse(written.replace("^", "**").strip(), mode="eval").body
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        raise ExpressionProblem('this is no expression, such as "2 * crank + 20 mm"') from None
    try:
        found = _walk(tree, quantities, scope, 0)
    except (ZeroDivisionError, OverflowError):
        raise ExpressionProblem("it divides by zero or is too large") from None
    except ExpressionProblem:
        raise
    except ValueError:
        raise ExpressionProblem("a function has no value there") from None
    if not math.isfinite(found.value):
        raise ExpressionProblem("it is too large")
    if found.has_scale and not math.isclose(found.zeros or 0.0, 1.0, rel_tol=ROUNDING):
        raise ExpressionProblem(
            f"it holds {found.zeros:g} times the zero of degC, which no temperature does: write differences, "
            "and temperatures that are multiplied, in K"
        )
    return found


def _without_units(text: str, scope: Mapping[str, Dimensioned]) -> tuple[str, dict[str, Dimensioned]]:
    """Return an expression with names for numbers with units, and what these are."""
    found: dict[str, Dimensioned] = {}
    written, place = "", 0
    for number in _NUMBER.finditer(text):
        if number.start() < place:
            continue
        written += text[place : number.start()]
        unit, end = _unit_at(text, number.end(), scope)
        name = f"_{len(found)}_"
        try:
            value = to_si_base(f"{number[0]} {unit}") if unit else float(number[0])
        except UnitProblem as problem:
            raise ExpressionProblem(str(problem)) from None
        dimensions = dimensions_of(unit)
        zeros = 1.0 if unit and counts_from_zero(unit) else None
        found[name] = Dimensioned(value, dimensions, zeros, Fraction(dimensions == PER_TIME))
        written, place = written + name, end
    return written + text[place:], found


def _unit_at(text: str, place: int, scope: Mapping[str, Dimensioned]) -> tuple[str, int]:
    """Return the unit after a number and where it ends; empty for a plain number."""
    first = _UNIT.match(text, place)
    if first is None or first[1] in scope or first[1] in FUNCTIONS:
        return "", place
    unit, end = first[0].strip(), first.end()
    while (more := _NEXT_UNIT.match(text, end)) and more[2] not in scope and is_unit(more[2]):
        unit, end = unit + more[0], more.end()
    return unit, end


@lru_cache(maxsize=256)
def is_unit(name: str) -> bool:
    """Return whether a name is that of a unit."""
    if name in FUNCTIONS or name in CONSTANTS:
        return False
    try:
        base_of(name)
    except UnitProblem:
        return False
    return True


def _walk(
    node: ast.expr, known: Mapping[str, Dimensioned], scope: Mapping[str, Dimensioned], depth: int
) -> Dimensioned:
    """Return the value of a node of the tree."""
    if depth > _DEEPEST:
        raise ExpressionProblem(f"it is nested more than {_DEEPEST} deep")

    def inside(part: ast.expr) -> Dimensioned:
        return _walk(part, known, scope, depth + 1)

    if isinstance(node, ast.Name):
        return _named(node.id, known, scope)
    if isinstance(node, ast.UnaryOp) and type(node.op) in _SIGNS:
        return _product(_SIGNS[type(node.op)], inside(node.operand), 1)
    if isinstance(node, ast.BinOp) and type(node.op) in _OPERATIONS:
        return _OPERATIONS[type(node.op)](inside(node.left), inside(node.right))
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and not node.keywords:
        return _called(node.func.id, [inside(part) for part in node.args])
    raise ExpressionProblem(f"it may hold + - * / ^, parentheses, and {', '.join(FUNCTIONS)}")


def _named(name: str, known: Mapping[str, Dimensioned], scope: Mapping[str, Dimensioned]) -> Dimensioned:
    for there in (known, CONSTANTS, scope):
        if name in there:
            return there[name]
    words = f"known: {', '.join(scope)}" if scope else "there are none"
    raise ExpressionProblem(f"there is no parameter {brief(name)!r}; {words}{meant(name, scope)}")


def _called(name: str, arguments: list[Dimensioned]) -> Dimensioned:
    if name not in FUNCTIONS:
        raise ExpressionProblem(
            f"there is no function {brief(name)!r}; known: {', '.join(FUNCTIONS)}{meant(name, FUNCTIONS)}"
        )
    n, function = FUNCTIONS[name]
    if name in OF_ANY_NUMBER:
        if len(arguments) < n:
            raise ExpressionProblem(f"{name} takes {n} arguments or more, given {len(arguments)}")
        return function(*arguments)
    if len(arguments) != n:
        raise ExpressionProblem(f"{name} takes {n} argument{'s' if n > 1 else ''}, given {len(arguments)}")
    _refuse_scale(*arguments)
    return function(*arguments)
