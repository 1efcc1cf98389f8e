"""Code generators of ``bits``, imported where something is compiled."""

from typing import Any

from mebdf.compiled.jit import intrinsic, ir, types


@intrinsic
def _bits(typing: Any, number: Any) -> Any:
    def generate(context: Any, builder: Any, called: Any, arguments: Any) -> Any:
        return builder.bitcast(arguments[0], ir.IntType(64))

    return types.int64(types.float64), generate


@intrinsic
def _number(typing: Any, bits: Any) -> Any:
    def generate(context: Any, builder: Any, called: Any, arguments: Any) -> Any:
        return builder.bitcast(arguments[0], ir.DoubleType())

    return types.float64(types.int64), generate
