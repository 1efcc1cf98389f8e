"""Controllers at their sampling times: what they measure, and what they hold until the next one.

A run has a breakpoint at each sampling time. There outputs are computed from the state as it is; between
them they are constants of the force laws, so an integrator sees nothing of controllers.
"""

import inspect
import math
from collections.abc import Iterator
from dataclasses import replace
from typing import Any, Final

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.cases.loads import OwnFunction
from tribodyn.core.errors import IntegrationFailure
from tribodyn.core.problem import Problem
from tribodyn.mechanism.assembly.output_values import Output, motion_of
from tribodyn.mechanism.assembly.parts_by_number import Model
from tribodyn.mechanism.elements.controller import Controller
from tribodyn.mechanisms.mechanism_protocol import plain

_DUE: Final = 1.0e-6  #: Share of a sampling time within which it is now.
_SAME: Final = 1.0e-12  #: Share of a run within which two instants are one.


def sampled(problem: Problem, model: Model, outputs: tuple[Output, ...]) -> Problem:
    """Return a problem with the breakpoints of its controllers, which are started anew."""
    duration = problem.t_span[1]
    loops = [*_loops(model, outputs, duration)]
    if not loops:
        return problem
    times = np.unique(np.concatenate([loop.times(duration) for loop in loops]))
    edges = np.array([-math.inf, 0.0, *problem.breakpoints, duration, math.inf])
    nearest = np.searchsorted(edges, times)
    apart = np.minimum(times - edges[nearest - 1], edges[np.minimum(nearest, edges.size - 1)] - times)
    times = times[apart > _SAME * duration]
    times = times[np.diff(times, prepend=-math.inf) > _SAME * duration]
    breakpoints = np.sort(np.concatenate([problem.breakpoints, times]))
    laws = problem.memory.now.couplings.law

    def sample(t: float, y: FloatArray) -> bool:
        due = [loop for loop in loops if loop.is_due(t)]
        for loop in due:
            laws.held[loop.coupling] = loop.output(t, y, laws[loop.coupling])
        return bool(due)

    return replace(problem, breakpoints=tuple(breakpoints.tolist()), sample=sample)


def _loops(model: Model, outputs: tuple[Output, ...], duration: float) -> Iterator["Loop"]:
    """Yield the control loops of a mechanism."""
    coupling = model.first_leg
    for element in model.elements:
        if isinstance(keys := element.keys, Controller):
            function = model.case.functions.get(element.name)
            if function is not None:
                own = keys.coordinates(model.case.joints)
                yield Function(element.name, keys, coupling, function, own, outputs)
            elif keys.gain is not None:
                yield Pid(element.name, keys, coupling, duration)
        coupling += len(element.legs)


class Loop:
    """A control loop: when it measures, and its limits."""

    def __init__(self, name: str, keys: Controller, coupling: int) -> None:
        self.name, self.keys, self.coupling = name, keys, coupling

    def times(self, duration: float) -> FloatArray:
        """Return its sampling times [s]."""
        step = self.keys.sampling_time
        return np.asarray(step * np.arange(math.floor(duration / step) + 1))

    def is_due(self, t: float) -> bool:
        """Tell whether it measures now."""
        step = self.keys.sampling_time
        return abs(t - step * round(t / step)) < _DUE * step

    def limited(self, value: float) -> float:
        """Return an output within the limits."""
        limit = math.inf if self.keys.limit is None else self.keys.limit
        return min(max(value, -limit), limit)

    def output(self, t: float, y: FloatArray, law: Any) -> float:
        """Return the values held from now on [N, N m].

        ``t``, ``y``: time [s] and state; ``law``: coordinate of the joint, with its rate; see
        ``kernels.mechanism.data.Law``.
        """
        raise NotImplementedError


class Pid(Loop):
    """A PID controller in standard form."""

    def __init__(self, name: str, keys: Controller, coupling: int, duration: float) -> None:
        super().__init__(name, keys, coupling)
        self._sum, self._last = 0.0, math.nan
        assert keys.set_value is not None
        assert keys.gain is not None
        self._set, self._gain = keys.set_value.over_run(duration), keys.gain
        self._rate = keys.measures in ("speed", "velocity")

    def output(self, t: float, y: FloatArray, law: Any) -> float:
        """Return the output, see :meth:`Loop.output`."""
        keys, step = self.keys, self.keys.sampling_time
        error = self._set.at(t) - float(law.rate if self._rate else law.position)
        change = 0.0 if math.isnan(self._last) else error - self._last
        self._last = error
        share = 0.0 if keys.integral_time is None else step / keys.integral_time

        total = self._sum + error
        found = self._gain * (error + share * total + keys.derivative_time / step * change)
        if found == self.limited(found) or found * self._gain * error <= 0.0:
            self._sum = total
        return self.limited(found)


class Function(Loop):
    """A controller that is a Python function of time, of its joint and of outputs."""

    def __init__(
        self,
        name: str,
        keys: Controller,
        coupling: int,
        function: OwnFunction,
        own: tuple[str, str],
        outputs: tuple[Output, ...],
    ) -> None:
        super().__init__(name, keys, coupling)
        self._function, self._own = function, own
        self._arguments = list(inspect.signature(function).parameters)
        self._outputs = {plain(o.name): o for o in outputs if plain(o.name) in self._arguments}
        self._angles: dict[str, float] = {}

    def output(self, t: float, y: FloatArray, law: Any) -> float:
        """Return the output, see :meth:`Loop.output`; what the function raises ends the run."""
        position, rate = self._own
        known = {"t": t, position: float(law.position), rate: float(law.rate), **self._measured(y)}
        try:
            found = float(self._function(*(known[name] for name in self._arguments)))
        except Exception as error:
            words = f"the controller {self.name} raised {type(error).__name__}: {error}"
            raise IntegrationFailure(t, words) from error
        if not math.isfinite(found):
            raise IntegrationFailure(t, f"the controller {self.name} returned {found}")
        return self.limited(found)

    def _measured(self, y: FloatArray) -> dict[str, float]:
        """Return the outputs that the function takes, angles with their whole turns."""
        if not self._outputs:
            return {}
        motion = motion_of(y)
        found = {name: float(o.value(o.components(motion))[0]) for name, o in self._outputs.items()}
        for name, output in self._outputs.items():
            if output.unit == "rad":
                turns = round((self._angles.get(name, 0.0) - found[name]) / (2.0 * math.pi))
                found[name] += 2.0 * math.pi * turns
                self._angles[name] = found[name]
        return found
