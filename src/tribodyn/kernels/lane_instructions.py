"""Code generators of ``lanes``, imported where something is compiled."""

import operator
from typing import Any, Final

from mebdf.compiled.jit import (
    AbstractTemplate,
    cgutils,
    infer_global,
    intrinsic,
    ir,
    lower_builtin,
    models,
    register_model,
    signature,
    types,
)
from tribodyn.kernels.lanes import ROW, WIDTH

_NUMBER: Final = ir.DoubleType()
_VECTOR: Final = ir.VectorType(_NUMBER, WIDTH)
_PAIR: Final = ir.VectorType(_NUMBER, 2)
_WHOLE: Final = ir.VectorType(ir.IntType(32), WIDTH)
_INDEX: Final = ir.IntType(64)


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
    (operator.truediv, "fdiv"),
):
    _define(_symbol, _instruction)


def _address(context: Any, builder: Any, kind: Any, array: Any, place: Any, read: Any = _VECTOR) -> Any:
    """Return the address of four numbers of an array, or of others that are ``read``."""
    data = context.make_array(kind)(context, builder, array).data
    return builder.bitcast(builder.gep(data, [place]), read.as_pointer())


def _read(builder: Any, address: Any) -> Any:
    return builder.load(address, align=8)


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


def _of_one(name: str) -> Any:
    """Return a function of each lane alone that is an instruction of the compiler."""

    @intrinsic
    def _function(typing: Any, lanes: Any) -> Any:
        def generate(context: Any, builder: Any, called: Any, arguments: Any) -> Any:
            kind = ir.FunctionType(_VECTOR, [_VECTOR])
            function = cgutils.get_or_insert_function(builder.module, kind, f"llvm.{name}.v{WIDTH}f64")
            return builder.call(function, arguments)

        return _lanes(_lanes), generate

    return _function


@intrinsic
def _above(typing: Any, a: Any, b: Any, x: Any, y: Any) -> Any:
    def generate(context: Any, builder: Any, called: Any, arguments: Any) -> Any:
        is_above = builder.fcmp_ordered(">", arguments[0], arguments[1])
        return builder.select(is_above, arguments[2], arguments[3])

    return _lanes(_lanes, _lanes, _lanes, _lanes), generate


@intrinsic
def _parts(typing: Any, lanes: Any) -> Any:
    def generate(context: Any, builder: Any, called: Any, arguments: Any) -> Any:
        numbers = [builder.extract_element(arguments[0], _INDEX(k)) for k in range(WIDTH)]
        return context.make_tuple(builder, called.return_type, numbers)

    return types.UniTuple(types.float64, WIDTH)(lanes), generate


@intrinsic
def _total(typing: Any, lanes: Any) -> Any:
    def generate(context: Any, builder: Any, called: Any, arguments: Any) -> Any:
        numbers = [builder.extract_element(arguments[0], _INDEX(k)) for k in range(WIDTH)]
        return builder.fadd(builder.fadd(numbers[0], numbers[1]), builder.fadd(numbers[2], numbers[3]))

    return types.float64(lanes), generate


@intrinsic
def _totals(typing: Any, a: Any, b: Any, c: Any, d: Any) -> Any:
    def generate(context: Any, builder: Any, called: Any, arguments: Any) -> Any:
        columns = _transposed(builder, list(arguments))
        return builder.fadd(builder.fadd(*columns[:2]), builder.fadd(*columns[2:]))

    return _lanes(_lanes, _lanes, _lanes, _lanes), generate


def _shuffled(builder: Any, order: tuple[int, ...], a: Any, b: Any) -> Any:
    return builder.shuffle_vector(a, b, ir.Constant(ir.VectorType(ir.IntType(32), WIDTH), list(order)))


def _places(builder: Any, numbers: Any) -> list[Any]:
    """Return the whole numbers in four lanes, none of them negative, as indices."""
    whole = builder.fptosi(numbers, _WHOLE)
    return [builder.zext(builder.extract_element(whole, _INDEX(k)), _INDEX) for k in range(WIDTH)]


@intrinsic
def _store_places(typing: Any, array: Any, place: Any, numbers: Any) -> Any:
    def generate(context: Any, builder: Any, called: Any, arguments: Any) -> Any:
        index = context.cast(builder, arguments[1], called.args[1], types.int64)
        address = _address(context, builder, called.args[0], arguments[0], index)
        whole = builder.fptosi(arguments[2], _WHOLE)
        builder.store(whole, builder.bitcast(address, _WHOLE.as_pointer()), align=8)
        return context.get_dummy_value()

    return types.void(array, place, numbers), generate


def _stored_places(context: Any, builder: Any, kinds: Any, arguments: Any) -> list[Any]:
    """Return the indices that were stored in the second array at the place that is the third argument."""
    index = context.cast(builder, arguments[2], kinds[2], types.int64)
    address = _address(context, builder, kinds[1], arguments[1], index)
    first = builder.bitcast(address, ir.IntType(32).as_pointer())
    return [builder.zext(builder.load(builder.gep(first, [_INDEX(k)])), _INDEX) for k in range(WIDTH)]


@intrinsic
def _entries_at(typing: Any, array: Any, places: Any, place: Any) -> Any:
    def generate(context: Any, builder: Any, called: Any, arguments: Any) -> Any:
        data = context.make_array(called.args[0])(context, builder, arguments[0]).data
        found = ir.Constant(_VECTOR, ir.Undefined)
        for k, at in enumerate(_stored_places(context, builder, called.args, arguments)):
            found = builder.insert_element(found, builder.load(builder.gep(data, [at])), _INDEX(k))
        return found

    return _lanes(array, places, place), generate


def _transposed(builder: Any, parts: list[Any]) -> list[Any]:
    """Return the columns of a matrix of four rows of four numbers."""
    low = [_shuffled(builder, (0, 4, 2, 6), a, b) for a, b in (parts[:2], parts[2:])]
    high = [_shuffled(builder, (1, 5, 3, 7), a, b) for a, b in (parts[:2], parts[2:])]
    first, last = (0, 1, 4, 5), (2, 3, 6, 7)
    return [_shuffled(builder, order, *pair) for order in (first, last) for pair in (low, high)]


def _rows_from(context: Any, builder: Any, called: Any, array: Any, places: list[Any]) -> Any:
    """Return the columns of four rows of a table, by pairs: registers are filled while they are read."""
    starts = [builder.mul(place, _INDEX(ROW)) for place in places]
    columns: list[Any] = []
    for first in range(0, ROW, 2):
        parts = [builder.add(start, _INDEX(first)) for start in starts]
        addresses = [_address(context, builder, called.args[0], array, part, _PAIR) for part in parts]
        pairs = [_read(builder, address) for address in addresses]
        halves = [_shuffled(builder, (0, 1, 2, 3), *two) for two in (pairs[::2], pairs[1::2])]
        columns += [_shuffled(builder, order, *halves) for order in ((0, 4, 2, 6), (1, 5, 3, 7))]
    return context.make_tuple(builder, called.return_type, columns)


@intrinsic
def _rows(typing: Any, array: Any, numbers: Any) -> Any:
    def generate(context: Any, builder: Any, called: Any, arguments: Any) -> Any:
        return _rows_from(context, builder, called, arguments[0], _places(builder, arguments[1]))

    return types.UniTuple(_lanes, ROW)(array, numbers), generate


@intrinsic
def _rows_at(typing: Any, array: Any, places: Any, place: Any) -> Any:
    def generate(context: Any, builder: Any, called: Any, arguments: Any) -> Any:
        stored = _stored_places(context, builder, called.args, arguments)
        return _rows_from(context, builder, called, arguments[0], stored)

    return types.UniTuple(_lanes, ROW)(array, places, place), generate


_square_root: Final = _of_one("sqrt")
_absolute: Final = _of_one("fabs")
_floor: Final = _of_one("floor")
