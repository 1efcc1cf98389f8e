"""Code generators of the larger of two numbers and of the call of a force law, for what compiles."""

from typing import Any, Final

from mebdf.compiled.jit import intrinsic, ir, types

_BYTES: Final = ir.IntType(8).as_pointer()


def _of_two(name: str) -> Any:
    """Return a function of two numbers that is an instruction of the compiler."""

    @intrinsic
    def function(typing: Any, a: Any, b: Any) -> Any:
        number = ir.DoubleType()

        def generate(context: Any, builder: Any, called: Any, arguments: Any) -> Any:
            kinds = ir.FunctionType(number, [number, number])
            return builder.call(builder.module.declare_intrinsic(name, [number], kinds), arguments)

        return types.float64(types.float64, types.float64), generate

    return function


_larger: Final = _of_two("llvm.maximum")
_smaller: Final = _of_two("llvm.minimum")


@intrinsic
def _call_law(typing: Any, address: Any, parameters: Any, law: Any) -> Any:
    def generate(context: Any, builder: Any, called: Any, arguments: Any) -> Any:
        function = ir.FunctionType(ir.VoidType(), [_BYTES, _BYTES]).as_pointer()
        records = [builder.bitcast(record, _BYTES) for record in arguments[1:]]
        builder.call(builder.inttoptr(arguments[0], function), records)
        return context.get_dummy_value()

    return types.void(types.int64, parameters, law), generate
