"""Elementary functions against more digits, at special values, and without a compiler."""

from __future__ import annotations

import itertools
import json
import math
import os
import subprocess
import sys
from collections.abc import Callable
from typing import Any, NamedTuple

import mpmath
import numpy as np
import pytest

from mebdf.arrays import FloatArray
from mebdf.kernels import elementary
from mebdf.kernels.elementary import portable

Draw = Callable[[np.random.Generator, int], FloatArray]


def even(low: float, high: float) -> Draw:
    """Return what draws numbers between two others."""
    return lambda chance, n: chance.uniform(low, high, n)


def scales(low: float, high: float, *, signs: tuple[float, ...] = (-1.0, 1.0)) -> Draw:
    """Return what draws numbers whose exponents are even between two others."""
    return lambda chance, n: np.exp2(chance.uniform(low, high, n)) * chance.choice(signs, n)


def near_one(low: float, high: float) -> Draw:
    """Return what draws numbers whose distances from 1 have such exponents."""
    return lambda chance, n: 1.0 + scales(low, high)(chance, n)


def below_one(low: float, high: float) -> Draw:
    """Return the same of numbers below 1, of both signs."""
    return lambda chance, n: (1.0 - np.exp2(chance.uniform(low, high, n))) * chance.choice((-1.0, 1.0), n)


class Function(NamedTuple):
    """Where a function is tested, and its name in NumPy."""

    draws: tuple[tuple[Draw, ...], ...]
    of_numpy: str
    bound: float = 1.0


ANGLES = ((even(-10.0, 10.0),), (scales(-30.0, 1023.0),), (even(-1.0e6, 1.0e6),), (even(-0.07, 0.07),))
POSITIVE = scales(-300.0, 300.0, signs=(1.0,))
#: All functions; bounds of the error in units in the last place.
FUNCTIONS = {
    "sin": Function(ANGLES, "sin"),
    "cos": Function(ANGLES, "cos"),
    "tan": Function(ANGLES, "tan"),
    "asin": Function(((even(-1.0, 1.0),), (below_one(-53.0, -1.0),), (scales(-70.0, -1.0),)), "arcsin"),
    "acos": Function(((even(-1.0, 1.0),), (below_one(-53.0, -1.0),), (scales(-70.0, -1.0),)), "arccos"),
    "atan": Function(((even(-2.0, 2.0),), (scales(-70.0, 70.0),)), "arctan"),
    "exp": Function(((even(-745.0, 709.7),), (scales(-60.0, 5.0),)), "exp"),
    "expm1": Function(((even(-2.0, 2.0),), (even(-40.0, 700.0),), (scales(-60.0, 0.0),)), "expm1"),
    "log": Function(
        ((even(1e-3, 3.0),), (scales(-1074.0, 1023.0, signs=(1.0,)),), (near_one(-50.0, -3.0),)), "log"
    ),
    "log1p": Function(((even(-0.999, 3.0),), (scales(-100.0, -1.0),), (POSITIVE,)), "log1p"),
    "tanh": Function(((even(-1.0, 1.0),), (scales(-60.0, 5.0),), (even(-20.0, 20.0),)), "tanh"),
    "erfc": Function(((even(-5.0, 1.0),), (even(1.0, 26.0),)), "", 16.0),
    "atan2": Function(
        ((even(-1.0, 1.0),) * 2, (scales(-1060.0, 1020.0),) * 2, (scales(-10.0, 10.0),) * 2), "arctan2"
    ),
    "hypot": Function(
        ((scales(-5.0, 5.0),) * 2, (scales(900.0, 1022.0),) * 2, (scales(-1060.0, -1000.0),) * 2), "hypot"
    ),
    "power": Function(
        (
            (even(1e-3, 3.0), even(-9.0, 9.0)),
            (POSITIVE, even(-2.0, 2.0)),
            (near_one(-40.0, -3.0), scales(5.0, 30.0)),
        ),
        "power",
    ),
}
SPECIAL = (0.0, -0.0, 1.0, -1.0, 0.5, -2.0, 3.0, 5e-324, -1e308, math.inf, -math.inf, math.nan)


def units(found: FloatArray, exact: Any) -> Any:
    """Return the error in units in the last place; that of zero is the smallest number."""
    return np.abs(found - exact) / np.spacing(np.maximum(np.abs(exact).astype(np.float64), 5e-324))


def ours(name: str, arguments: list[FloatArray]) -> FloatArray:
    """Return the values of a function of arrays."""
    if hasattr(portable, name):
        return np.asarray(getattr(portable, name)(*arguments))
    return np.array([getattr(elementary, name)(*each) for each in zip(*arguments, strict=True)])


@pytest.mark.parametrize("name", FUNCTIONS)
def test_errors_are_below_one_unit_in_the_last_place(name: str) -> None:
    mpmath.mp.prec = 160
    chance, function = np.random.default_rng(33), FUNCTIONS[name]
    for draws in function.draws:
        arguments = [draw(chance, 600) for draw in draws]
        found = ours(name, arguments)
        for value, each in zip(found.tolist(), zip(*arguments, strict=True), strict=True):
            exact = getattr(mpmath, name)(*map(mpmath.mpf, each))
            rounded = float(exact)
            if math.isfinite(rounded):
                error = abs(mpmath.mpf(value) - exact) / mpmath.mpf(math.ulp(rounded))
                assert error < function.bound, each
            else:
                assert value == rounded, each


@pytest.mark.long
@pytest.mark.skipif(np.finfo(np.longdouble).nmant < 63, reason="long double has no more digits here")
@pytest.mark.parametrize("name", [name for name in FUNCTIONS if FUNCTIONS[name].of_numpy])
def test_errors_of_ten_million_arguments(name: str) -> None:
    chance, function, most = np.random.default_rng(34), FUNCTIONS[name], 0.0
    reference = getattr(np, function.of_numpy)
    for draws in function.draws:
        for _ in range(10):
            arguments = [draw(chance, 10_000_000 // (10 * len(function.draws))) for draw in draws]
            with np.errstate(over="ignore", under="ignore"):
                exact = reference(*(values.astype(np.longdouble) for values in arguments))
                found = ours(name, arguments)
                finite = np.abs(exact) < np.finfo(np.float64).max
                most = max(most, float(units(found[finite], exact[finite]).max()))
    print(f"{name}: {most:.4f} units in the last place")
    assert most < function.bound


@pytest.mark.parametrize("name", [name for name in FUNCTIONS if FUNCTIONS[name].of_numpy])
def test_special_values_are_those_of_c99(name: str) -> None:
    function = FUNCTIONS[name]
    for each in itertools.product(SPECIAL, repeat=len(function.draws[0])):
        found = ours(name, [np.array([value]) for value in each])[0]
        with np.errstate(all="ignore"):
            # For 64 bits NumPy has x^½ as a square root, of −0 too.
            exact = np.float64(getattr(np, function.of_numpy)(*map(np.longdouble, each)))
        if math.isnan(exact):
            assert math.isnan(found), each
        else:
            assert math.copysign(1.0, found) == math.copysign(1.0, exact), each
            assert found == exact or found == pytest.approx(exact, rel=1e-15, abs=0.0), each


VALUES = """
import json, sys
from mebdf.kernels import elementary
print(json.dumps([
    [getattr(elementary, name)(*each).hex() for each in sets] for name, sets in json.load(sys.stdin).items()
]))
"""


def test_functions_without_a_compiler_return_the_same_bits() -> None:
    chance = np.random.default_rng(35)
    sets = {
        name: [
            each
            for draws in function.draws
            for each in np.transpose([draw(chance, 5) for draw in draws]).tolist()
        ]
        for name, function in FUNCTIONS.items()
    }
    compiled = [[getattr(elementary, name)(*each).hex() for each in sets[name]] for name in sets]
    done = subprocess.run(
        [sys.executable, "-c", VALUES],
        input=json.dumps(sets),
        stdout=subprocess.PIPE,
        text=True,
        check=True,
        env=os.environ | {"NUMBA_DISABLE_JIT": "1"},
    )
    assert json.loads(done.stdout) == compiled


def test_functions_of_arrays_take_shapes_as_those_of_numpy_do() -> None:
    grid = portable.power(np.arange(1.0, 3.0)[:, None], np.arange(3.0))
    assert grid.tolist() == [[1.0, 1.0, 1.0], [1.0, 2.0, 4.0]]
    assert portable.exp(0.0) == 1.0
    assert isinstance(portable.exp(0.0), float)
