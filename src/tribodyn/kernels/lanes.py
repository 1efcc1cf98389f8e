"""Four numbers at once, added up in an order that does not depend on the processor.

A compiler may process several entries at once in a loop that writes each result to a place of its own. It
must not reorder a sum. A sum over nodes is therefore written as four sums, one in each lane, which
:func:`total` adds at the end: processors with registers of two, four or eight numbers return the same bits.

In uncompiled code lanes are arrays of four numbers.
"""

from __future__ import annotations

import operator
from collections.abc import Callable
from typing import Any, Final

import numba
import numpy as np
from llvmlite import ir
from numba.core import types
from numba.core.imputils import lower_builtin
from numba.core.typing.templates import AbstractTemplate, infer_global, signature
from numba.extending import intrinsic, models, register_model

WIDTH: Final = 4
_NUMBER: Final = ir.DoubleType()
_VECTOR: Final = ir.VectorType(_NUMBER, WIDTH)
_INDEX: Final = ir.IntType(64)
_ROW: Final = 8
"""Numbers in a row of the array that :func:`rows` reads."""


class _Lanes(types.Type):
    """Numba's type of four numbers in a register."""

    def __init__(self) -> None:
        super().__init__(name=f"float64x{WIDTH}")


_lanes: Final = _Lanes()


@register_model(_Lanes)
class _LanesModel(models.PrimitiveModel):
    def __init__(self, manager: Any, kind: Any) -> None:
        super().__init__(manager, kind, _VECTOR)


def _define(symbol: Any, instruction: str) -> None:
    """Define an operator of two lanes by an instruction of the compiler."""

    @infer_global(symbol)
    class _Template(AbstractTemplate):
        key = symbol

        def generic(self, arguments: Any, keywords: Any) -> Any:
            return signature(_lanes, _lanes, _lanes) if tuple(arguments) == (_lanes, _lanes) else None

    @lower_builtin(symbol, _lanes, _lanes)
    def _lower(context: Any, builder: Any, called: Any, arguments: Any) -> Any:
        return getattr(builder, instruction)(*arguments)


for _symbol, _instruction in (
    (operator.add, "fadd"),
    (operator.iadd, "fadd"),
    (operator.sub, "fsub"),
    (operator.isub, "fsub"),
    (operator.mul, "fmul"),
):
    _define(_symbol, _instruction)


def _address(context: Any, builder: Any, kind: Any, array: Any, place: Any) -> Any:
    """Return the address of four numbers of an array."""
    data = context.make_array(kind)(context, builder, array).data
    return builder.bitcast(builder.gep(data, [place]), _VECTOR.as_pointer())


def _read(builder: Any, address: Any) -> Any:
    return builder.load(address, align=8)


def _either(compiled: Any, uncompiled: Callable[..., Any]) -> Any:
    """Return the function for compiled code, or the other where compilation is switched off."""
    return uncompiled if vars(numba.config)["DISABLE_JIT"] else compiled


@intrinsic
def _load(typing: Any, array: Any, place: Any) -> Any:
    def generate(context: Any, builder: Any, called: Any, arguments: Any) -> Any:
        index = context.cast(builder, arguments[1], called.args[1], types.int64)
        return _read(builder, _address(context, builder, called.args[0], arguments[0], index))

    return _lanes(array, place), generate


@intrinsic
def _store(typing: Any, array: Any, place: Any, lanes: Any) -> Any:
    def generate(context: Any, builder: Any, called: Any, arguments: Any) -> Any:
        index = context.cast(builder, arguments[1], called.args[1], types.int64)
        address = _address(context, builder, called.args[0], arguments[0], index)
        builder.store(arguments[2], address, align=8)
        return context.get_dummy_value()

    return types.void(array, place, lanes), generate


@intrinsic
def _zeros(typing: Any) -> Any:
    def generate(context: Any, builder: Any, called: Any, arguments: Any) -> Any:
        return ir.Constant(_VECTOR, [0.0] * WIDTH)

    return _lanes(), generate


@intrinsic
def _spread(typing: Any, number: Any) -> Any:
    def generate(context: Any, builder: Any, called: Any, arguments: Any) -> Any:
        first = builder.insert_element(ir.Constant(_VECTOR, ir.Undefined), arguments[0], _INDEX(0))
        return _shuffled(builder, (0,) * WIDTH, first, first)

    return _lanes(types.float64), generate


@intrinsic
def _total(typing: Any, lanes: Any) -> Any:
    def generate(context: Any, builder: Any, called: Any, arguments: Any) -> Any:
        parts = [builder.extract_element(arguments[0], _INDEX(k)) for k in range(WIDTH)]
        return builder.fadd(builder.fadd(parts[0], parts[1]), builder.fadd(parts[2], parts[3]))

    return types.float64(lanes), generate


def _shuffled(builder: Any, order: tuple[int, ...], a: Any, b: Any) -> Any:
    return builder.shuffle_vector(a, b, ir.Constant(ir.VectorType(ir.IntType(32), WIDTH), list(order)))


def _transposed(builder: Any, parts: list[Any]) -> list[Any]:
    """Return the columns of a matrix of four rows of four numbers."""
    low = [_shuffled(builder, (0, 4, 2, 6), a, b) for a, b in (parts[:2], parts[2:])]
    high = [_shuffled(builder, (1, 5, 3, 7), a, b) for a, b in (parts[:2], parts[2:])]
    first, last = (0, 1, 4, 5), (2, 3, 6, 7)
    return [_shuffled(builder, order, *pair) for order in (first, last) for pair in (low, high)]


@intrinsic
def _rows(typing: Any, array: Any, numbers: Any) -> Any:
    def generate(context: Any, builder: Any, called: Any, arguments: Any) -> Any:
        whole = builder.fptosi(arguments[1], ir.VectorType(ir.IntType(32), WIDTH))
        starts = [
            builder.mul(builder.zext(builder.extract_element(whole, _INDEX(k)), _INDEX), _INDEX(_ROW))
            for k in range(WIDTH)
        ]
        columns: list[Any] = []
        for half in (0, WIDTH):
            places = [builder.add(start, _INDEX(half)) for start in starts]
            addresses = [_address(context, builder, called.args[0], arguments[0], place) for place in places]
            columns += _transposed(builder, [_read(builder, address) for address in addresses])
        return context.make_tuple(builder, called.return_type, columns)

    return types.UniTuple(_lanes, _ROW)(array, numbers), generate


def _put(array: Any, place: int, lanes: Any) -> None:
    array[place : place + WIDTH] = lanes


load: Final = _either(_load, lambda array, place: array[place : place + WIDTH].copy())
"""Return the four numbers of an array from ``place`` on."""
store: Final = _either(_store, _put)
"""Write lanes into an array, from ``place`` on."""
zeros: Final = _either(_zeros, lambda: np.zeros(WIDTH))
"""Return four zeros, with which sums begin."""
spread: Final = _either(_spread, lambda number: np.full(WIDTH, number))
"""Return a number in all lanes."""
total: Final = _either(_total, lambda lanes: (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]))
"""Return the sum of the lanes."""
rows: Final = _either(_rows, lambda array, numbers: tuple(array.reshape(-1, _ROW)[numbers.astype(int)].T))
"""Return eight lanes: the columns of those four rows of a table of eight columns that ``numbers`` name."""
