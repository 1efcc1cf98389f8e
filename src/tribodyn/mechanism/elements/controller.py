"""Controller: a torque or force that is set at sampling times and held between them.

At the k-th sampling time, with the set value w, the measured value x and e = w − x, a PID controller in
standard form gives

    u = K (e + (1/T_i) Σ T e + (T_d/T) (e − e₋₁)),   |u| ≤ u_max,

with the sampling time T and the sum over sampling times up to this one; the sum is not enlarged while the
output is at its limit (Åström and Hägglund, Advanced PID Control, 2006, sections 3.5 and 13.3). Before the
first sampling time the error counts as constant.
"""

import inspect
from collections.abc import Iterable, Mapping
from typing import Any, ClassVar, Final

from tribodyn.cases.case import demand
from tribodyn.cases.fields import quantity
from tribodyn.cases.loads import OwnFunction
from tribodyn.cases.signals import AngleSignal, PositionSignal, SpeedSignal, VelocitySignal
from tribodyn.core.errors import InputError
from tribodyn.core.quoting import as_given, meant
from tribodyn.kernels.mechanism.law import force_law
from tribodyn.mechanism.elements.element import ARM, DRIVE, ForceLaw, Joints, Leg, OfJointKeys

AnySetValue = AngleSignal | SpeedSignal | PositionSignal | VelocitySignal
#: Keys of what may be controlled; the gain of each is ``angle_gain`` and so on.
SET: Final = ("angle", "speed", "position", "velocity")
MOST_SAMPLES: Final = 100_000  #: Of a run: each restarts the integration.
_TURNS: Final = ("angle", "speed")


@force_law("limit")
def held(controller: Any, law: Any) -> None:
    """Fill the force that was set at the last sampling time."""
    law.force = law.held
    law.supplied = law.held * law.rate


class Controller(OfJointKeys):
    """A controller: a torque or force by PID or a Python function, held between sampling times."""

    ALTERNATIVES: ClassVar[tuple[tuple[str, str], ...]] = (
        *((first, second) for k, first in enumerate(SET) for second in SET[k + 1 :]),
        ("torque_limit", "force_limit"),
    )
    TABLE: ClassVar[str] = "controllers"
    METHOD: ClassVar[str] = "controller"
    FORCE: ClassVar[str] = "force on the second body along the axis; none for a torque"
    MOMENT: ClassVar[str] = "torque on the second body about the axis; none for a force"
    LAW: ClassVar = held
    IS_DRIVE: ClassVar[bool] = True
    EXAMPLE: ClassVar[str] = (
        ARM
        + """[controllers.servo]
joint = "input"
angle = "20 deg"
angle_gain = "2 N m/rad"
derivative_time = "20 ms"
torque_limit = "1 N m"
sampling_time = "5 ms"
"""
        + DRIVE
    )

    angle: AngleSignal | None = None
    speed: SpeedSignal | None = None
    position: PositionSignal | None = None
    velocity: VelocitySignal | None = None
    angle_gain: float | None = quantity(
        None, "gain K of the angle; without a gain a Python function takes its place", example="20 N m/rad"
    )
    speed_gain: float | None = quantity(None, "gain K of the speed", example="0.5 N m s/rad")
    position_gain: float | None = quantity(None, "gain K of the position", example="20 N/mm")
    velocity_gain: float | None = quantity(None, "gain K of the velocity", example="50 N s/m")
    integral_time: float | None = quantity(
        None, "T_i, of the integral part; no such part without it", gt=0, example="50 ms"
    )
    derivative_time: float = quantity("0 s", "T_d, of the derivative part", "assumed", ge=0, example="10 ms")
    torque_limit: float | None = quantity(
        None, "largest torque in both directions", unit="N m", gt=0, example="5 N m"
    )
    force_limit: float | None = quantity(None, "likewise of a force", unit="N", gt=0, example="200 N")
    sampling_time: float = quantity(
        None,
        "T, from one measurement to the next, the first at the start",
        gt=0,
        example="1 ms",
        required=True,
    )

    @property
    def measures(self) -> str:
        """Member of :data:`SET` that it controls; empty where it controls none."""
        return next((key for key in SET if getattr(self, key) is not None), "")

    @property
    def set_value(self) -> AnySetValue | None:
        """Set value of the measured quantity."""
        found: AnySetValue | None = getattr(self, self.measures) if self.measures else None
        return found

    @property
    def gain(self) -> float | None:
        """Gain K of a PID controller; None where a Python function takes its place."""
        return getattr(self, f"{self.measures}_gain") if self.measures else None

    @property
    def limit(self) -> float | None:
        """Largest output, if there is one."""
        return self.force_limit if self.torque_limit is None else self.torque_limit

    def legs(self, joints: Joints) -> tuple[Leg, ...]:
        """Return the leg of the angle or the position."""
        gains = [key for key in SET if getattr(self, f"{key}_gain") is not None]
        words = f"say what it controls, such as {gains[0]} = ..." if gains else "say what it controls"
        demand(not gains or bool(self.measures), gains[0] if gains else SET[0], words)
        if self.measures:
            words = f"a controller of the {self.measures} has the gain {self.measures}_gain"
            demand(all(key == self.measures for key in gains), f"{(gains or SET)[0]}_gain", words)
            assert self.set_value is not None
            over = self.set_value.over
            demand(over in ("", "times"), self.measures, "the set value of a controller follows time")
        turns = self._turns(joints)
        key = "force_limit" if turns else "torque_limit"
        words = f"this controller gives a {'torque' if turns else 'force'}"
        demand(getattr(self, key) is None, key, words)
        return (self.leg_of(joints, "angle" if turns else "position", "this controller"),)

    def coordinates(self, joints: Joints) -> tuple[str, str]:
        """Return the measurements of a joint for a function: the coordinate and its rate."""
        return ("angle", "speed") if self._turns(joints) else ("position", "velocity")

    def check_run(self, duration: float, *, dynamic: bool, campaign: bool) -> None:
        """Refuse an analysis without time, a wear campaign, and too many sampling times."""
        demand(
            dynamic, "", 'a controller acts in dynamic runs alone; leave it out, or run.analysis = "dynamic"'
        )
        words = "a controller begins anew in each cycle of a wear campaign; leave it out"
        demand(not campaign, "", words)
        n = duration / self.sampling_time
        words = f"the run has {n:.3g} sampling times; allowed are {MOST_SAMPLES}: a longer time between them"
        demand(n <= MOST_SAMPLES, "sampling_time", words)

    def _turns(self, joints: Joints) -> bool:
        """Return whether it gives a torque."""
        if self.measures:
            return self.measures in _TURNS
        if self.limit is not None:
            return self.torque_limit is not None
        return "angle" in joints[self.joint].kind.COORDINATES

    def force_law(self, joints: Joints) -> ForceLaw:
        """Return the law of what is held."""
        return ForceLaw(held, {"limit": self.limit or 0.0})


def check_functions(
    controllers: Mapping[str, Controller],
    functions: Mapping[str, OwnFunction],
    joints: Joints,
    outputs: Iterable[str],
) -> None:
    """Refuse functions that do not fit their controllers, and controllers that lack one.

    ``controllers``, ``functions``: by their names; ``joints``: of the case; ``outputs``: names of outputs, as
    arguments of functions spell them. Raises InputError with the name of the controller, what was given
    and what is allowed.
    """
    for name, function in functions.items():
        if name not in controllers:
            words = f"{as_given(name)}; allowed: {', '.join(controllers) or 'none'}{meant(name, controllers)}"
            raise InputError(words, key="controllers")
        known = ("t", *controllers[name].coordinates(joints), *outputs)
        try:
            arguments = list(inspect.signature(function).parameters)
        except (TypeError, ValueError):
            arguments = [type(function).__name__]
        for argument in arguments:
            words = f"its argument is {argument}; allowed: {', '.join(known)}"
            demand(argument in known, f"controllers.{name}", words)
    for name, keys in controllers.items():
        words = f"without a gain it needs a function: td.simulate(case, controllers={{{name!r}: function}})"
        demand(keys.gain is not None or name in functions, f"controllers.{name}", words)
