"""Drives and loads of a mechanism: their keys and their cross-checks."""

from __future__ import annotations

import math
from typing import Final, Literal, TypeAlias

from tribodyn.cases.case import NamedGroup, demand
from tribodyn.cases.fields import Vector, choice, name, quantity, vector
from tribodyn.cases.signals import (
    AngleSignal,
    ForceSignal,
    PositionSignal,
    SpeedSignal,
    TorqueSignal,
    VelocitySignal,
)
from tribodyn.mechanisms.general.parts import POINT, unit

AnySignal: TypeAlias = (
    AngleSignal | SpeedSignal | TorqueSignal | PositionSignal | VelocitySignal | ForceSignal
)

GIVEN: Final = {
    "angle": ("angle", 0),
    "speed": ("angle", 1),
    "torque": ("angle", 2),
    "position": ("position", 0),
    "velocity": ("position", 1),
    "force": ("position", 2),
}
"""What a drive may give: a coordinate, and 0 for itself, 1 for its rate, 2 for what acts along it."""


class DriveKeys(NamedGroup):
    """What moves the mechanism, at a joint: one of the tables below it."""

    joint: str = name(None, "which joint it moves", "", example="main", required=True)
    angle: AngleSignal | None = None
    speed: SpeedSignal | None = None
    torque: TorqueSignal | None = None
    position: PositionSignal | None = None
    velocity: VelocitySignal | None = None
    force: ForceSignal | None = None

    def model_post_init(self, context: object, /) -> None:
        """Check that it gives one thing, over time."""
        given = [key for key in GIVEN if getattr(self, key) is not None]
        words = f'a drive gives one of {", ".join(GIVEN)}, such as speed = "100 rpm"'
        demand(len(given) == 1, given[1] if given[1:] else "speed", words)
        demand(self.signal.over in ("", "times"), f"{given[0]}.{self.signal.over}", "a drive follows time")

    @property
    def gives(self) -> str:
        """Which of :data:`GIVEN`."""
        return next(key for key in GIVEN if getattr(self, key) is not None)

    @property
    def signal(self) -> AnySignal:
        """What it gives."""
        found: AnySignal = getattr(self, self.gives)
        return found

    @property
    def period(self) -> float | None:
        """Time after which the drive comes again [s]; None for one that does not."""
        turning, signal = self.gives == "speed", self.signal
        if turning and signal.value and signal.period is None:
            return 2.0 * math.pi / abs(signal.value)
        return signal.period


class LoadKeys(NamedGroup):
    """A force and a moment on a body."""

    body: str = name(None, "which body it acts on", "", example="slider", required=True)
    point: Vector | None = vector(
        None, "where the force acts, as drawn; the mass centre without it", "", unit="mm", example=POINT
    )
    direction: Vector | None = vector(
        None, "of force and moment; against the motion: only along it", "", example="[-1, 0, 0]"
    )
    frame: Literal["ground", "body", "motion"] = choice(
        "ground", "direction stands still, turns with the body, or is always against the motion", "assumed"
    )
    force: ForceSignal | None = None
    moment: TorqueSignal | None = None
    along: str | None = name(
        None, "joint whose angle or position a table follows; time without it", "", example="main"
    )
    slip_velocity: float = quantity(
        "1 mm/s", "speed below which a force against the motion fades", "assumed", gt=0
    )
    slip_rate: float = quantity(
        "1 mrad/s", "angular speed below which a moment against the motion fades", "assumed", gt=0
    )

    def model_post_init(self, context: object, /) -> None:
        """Check what involves several keys."""
        demand(bool(self.given), "body", 'a load needs a force or a moment, such as force = "100 N"')
        against = self.frame == "motion"
        words = "a load needs its direction in the drawing, such as direction = [-1, 0, 0]"
        demand(against or self.direction is not None, "direction", words)
        words = "against the motion acts a force or a moment; write two loads"
        demand(not against or len(self.given) == 1, "frame", words)
        if self.direction is not None:
            unit(self.direction, "direction")
        for signal in self.given.values():
            words = "a load along a joint's coordinate is a table over angles or positions"
            over = ("times", "") if self.along is None else ("angles", "positions")
            demand(signal.over in over, "along", words)

    @property
    def given(self) -> dict[str, ForceSignal | TorqueSignal]:
        """Its force and its moment, as far as it has them."""
        found = {"force": self.force, "moment": self.moment}
        return {key: signal for key, signal in found.items() if signal is not None}
