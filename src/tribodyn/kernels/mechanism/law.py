"""Force laws of elements: functions of one coordinate and its rate, called by their addresses.

A law is a function of two records: the parameters of its element, and a ``Law`` record, which holds its
arguments and takes its results. The equation of the element is then λ = F(q, q̇), with the coordinate q that
its legs make. A law is compiled by itself, so a new one leaves all other compiled code as it is.
"""

import inspect
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Final

from mebdf.compiled.kernel import UNCOMPILED, Instruction, Kernel, enlisted
from mebdf.compiled.layouts import One
from tribodyn.core.quantities import Record, RecordType, record_type
from tribodyn.kernels.actions import Signals, evaluate
from tribodyn.kernels.jit import SOURCES, inlined, kernel
from tribodyn.kernels.mechanism.data import DAMPING, FRICTION, NONE, WORK, Law

LEAST_SLOPE: Final = -1.0e4
#: Slopes of a reaction over the load that are extrapolated: beyond, rounds are taken as they come.
LARGEST_SLOPE: Final = 0.999
SAME: Final = 1.0e-10  #: Difference of load and reaction, over these, that may be rounding: the load is kept.
#: Change of a load, over the reaction, below which rounding decides about the slope.
LEAST_CHANGE: Final = 1.0e-6


@dataclass(frozen=True, eq=False)
class LawFunction:
    """A force law."""

    function: Callable[[Any, Any], None]  #: The law, in Python that numba compiles; it allocates nothing.
    #: Names of the parameters that it reads, in the order in which its record holds them.
    parameters: tuple[str, ...]

    def __post_init__(self) -> None:
        """List it among what the build compiles."""
        if not UNCOMPILED:
            enlisted(self._kernel)

    def __call__(self, parameters: Record, law: Record) -> None:
        """Fill the force in Python."""
        self.function(parameters, law)

    @cached_property
    def fields(self) -> RecordType:
        """Type of the record of its parameters."""
        return record_type(*((name, "f8") for name in self.parameters))

    @cached_property
    def _kernel(self) -> Kernel:
        layouts = One(self.fields), One(Law)
        return Kernel(self.function, SOURCES, layouts=layouts, stamp=self._source)

    def _source(self) -> str:
        """Return all that its machine code depends on beside kernels: its source, and numbers named there."""
        named = set(self.function.__code__.co_names) & self.function.__globals__.keys()
        values = {name: self.function.__globals__[name] for name in sorted(named)}
        numbers = {name: value for name, value in values.items() if isinstance(value, int | float)}
        return f"{inspect.getsource(self.function)}{numbers}"

    @cached_property
    def address(self) -> int:
        """Address of its compiled code; where nothing is compiled, its number."""
        if UNCOMPILED:
            _laws.append(self)
            return len(_laws)
        return self._kernel.code(self._kernel.layouts, "_law")[0]


def force_law(*parameters: str) -> Callable[[Callable[[Any, Any], None]], LawFunction]:
    """Return the decorator of a force law that reads these parameters."""
    return lambda function: LawFunction(function, parameters)


_laws: Final[list[LawFunction]] = []  #: Laws by their numbers from 1 on, where nothing is compiled.


def _in_python(number: int, held: Record, law: Record) -> None:
    """Call the law with a number."""
    called = _laws[number - 1]
    called(held.values[: len(called.parameters)].view(called.fields)[0], law)


_call: Final[Any] = (
    _in_python if UNCOMPILED else Instruction(_in_python, "tribodyn.kernels.instructions", "call_law")
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
    law.normal = law.followed = 0.0
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


@inlined
def followed_load(law: Record, extrapolates: float, backward: float, direction: float) -> float:
    """Return the load that friction takes from a reaction, times ``backward`` where this drives the motion.

    ``direction`` is that of the motion, by its sign.

    The force of a thread changes strongly with its friction. With ``extrapolates`` rounds of both are
    extrapolated to where neither changes, by the slope of the reaction over the load (Aitken). That slope is
    in ``held``; load of the last round, load and reaction of the one before are in the entries of a table,
    zero at first. Such a law has no table and no controller. Where several joints change each other's
    reactions, plain rounds are more reliable.
    """
    followed: float = law.normal * (backward if law.followed * direction > 0.0 else 1.0)
    if extrapolates > 0.0:
        normal = followed
        change, apart = law.table[0] - law.table[1], normal - law.table[0]
        if normal == 0.0 and law.table[0] == 0.0:
            law.held = 0.0
        elif abs(change) > LEAST_CHANGE * normal:
            slope = (normal - law.table_slope) / change
            law.held = slope if LEAST_SLOPE < slope < LARGEST_SLOPE else 0.0
        if abs(apart) <= SAME * normal:
            followed = law.table[0]
        elif change != 0.0:
            followed = max(law.table[0] + apart / (1.0 - law.held), 0.0)
        law.table[1], law.table_slope, law.table[0] = law.table[0], normal, followed
    return followed


@kernel
def remember(law: Record) -> None:
    """Let contact begin and end at the end of an accepted step, and take over what sticks by friction.

    The speed at which contact begins is kept.
    """
    law.anchor, law.elastic, law.stiffness = law.position, law.next_elastic, law.next_stiffness
    if law.touching == 0.0:
        law.entry_rate = 0.0
    elif law.entry_rate == 0.0:
        law.entry_rate = abs(law.rate)
