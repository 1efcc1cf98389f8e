"""Code generator of the call of a user function, imported where something is compiled."""

from typing import Any

from mebdf.compiled.jit import intrinsic, ir, types


@intrinsic
def _call(typing: Any, address: Any, t: Any, y: Any, out: Any, data: Any) -> Any:
    def generate(context: Any, builder: Any, called: Any, arguments: Any) -> Any:
        numbers = ir.DoubleType().as_pointer()
        function = ir.FunctionType(ir.VoidType(), [ir.DoubleType(), numbers, numbers, numbers]).as_pointer()
        arrays = zip((y, out, data), arguments[2:], strict=True)
        places = [context.make_array(kind)(context, builder, array).data for kind, array in arrays]
        builder.call(builder.inttoptr(arguments[0], function), [arguments[1], *places])
        return context.get_dummy_value()

    return types.void(types.int64, types.float64, y, out, data), generate
