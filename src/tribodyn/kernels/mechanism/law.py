"""Force laws of elements: functions of one coordinate and its rate, called by their addresses.

A law is a function of two records: the parameters of its element, and a ``Law`` record, which holds its
arguments and takes its results. The equation of the element is then λ = F(q, q̇), with the coordinate q that
its legs make. A law is compiled by itself, so a new one leaves all other compiled code as it is.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import Any, Final, TypeAlias

import numba
from llvmlite import ir
from numba.core import types
from numba.extending import intrinsic

from tribodyn.core.quantities import Record, RecordType
from tribodyn.kernels import address
from tribodyn.kernels.jit import entry, kernel
from tribodyn.kernels.mechanism.data import DAMPING, FRICTION, NONE, WORK, Law
from tribodyn.kernels.signals import Signals, evaluate

Function: TypeAlias = Callable[[Any, Any], None]

_UNCOMPILED: Final[bool] = vars(numba.config)["DISABLE_JIT"]
_laws: Final[dict[int, Callable[[Any, Any], None]]] = {}
"""Laws by their numbers, where compilation is switched off."""
_BYTES: Final = ir.IntType(8).as_pointer()


@cache
def address_of(function: Function, parameters: RecordType) -> int:
    """Return the address of a law's compiled code.

    Parameters
    ----------
    function
        The law, in Python that numba compiles; it allocates nothing.
    parameters
        Type of the record of its parameters.
    """
    if _UNCOMPILED:
        n = len(parameters.names or ())
        _laws[len(_laws) + 1] = lambda held, law: function(held.values[:n].view(parameters)[0], law)
        return len(_laws)
    compiled = entry(function)
    _kept.append(compiled)
    return address.address_of(compiled, types.void(numba.from_dtype(parameters), numba.from_dtype(Law)))


_kept: Final[list[Any]] = []
"""Compiled laws, which last as long as the process: records hold their addresses."""


@intrinsic
def _compiled_call(typing: Any, address: Any, parameters: Any, law: Any) -> Any:
    def generate(context: Any, builder: Any, called: Any, arguments: Any) -> Any:
        function = ir.FunctionType(_BYTES, [_BYTES, _BYTES]).as_pointer()
        records = [builder.bitcast(record, _BYTES) for record in arguments[1:]]
        builder.call(builder.inttoptr(arguments[0], function), records)
        return context.get_dummy_value()

    return types.void(types.int64, parameters, law), generate


_call: Final[Any] = (
    (lambda address, parameters, law: _laws[address](parameters, law)) if _UNCOMPILED else _compiled_call
)


@kernel
def fill_law(coupling: Record, now: Record, signals: Signals) -> None:
    """Fill the force of an element from its coordinate, with its derivatives, energy and powers."""
    law = now.law
    law.position, law.rate = now.residual[0], now.rate[0]
    place = law.rate if coupling.over_rate == 1 else law.position
    for i in range(2):
        law.table[i] = 0.0
        if coupling.table[i] != NONE:
            value, slope, _ = evaluate(signals, coupling.table[i], place, place)
            law.table[i] = value
            if i == 0:
                law.table_slope = slope
    law.normal = 0.0
    call_law(coupling, now)


@kernel
def call_law(coupling: Record, now: Record) -> None:
    """Fill the force of an element from the arguments that its law holds."""
    law = now.law
    law.force = law.in_position = law.in_rate = law.stored = law.damping = law.friction = 0.0
    law.supplied = law.touching = 0.0
    _call(coupling.law, coupling.parameters, law)
    now.stored = law.stored
    now.powers[DAMPING], now.powers[FRICTION], now.powers[WORK] = law.damping, law.friction, law.supplied


@kernel
def remember_entry(law: Record) -> None:
    """Let contact begin and end at the end of an accepted step; the speed at which it begins is kept."""
    if law.touching == 0.0:
        law.entry_rate = 0.0
    elif law.entry_rate == 0.0:
        law.entry_rate = abs(law.rate)
