"""Loads on a body: the keys that all mechanisms share, with their cross-checks.

A load is a force and a moment, given by their size along a direction or by components. Each is a signal: a
number, a sinusoid, a table over time, an angle, a position or a speed, or a map over two of them. A frame
says whether it is fixed in space, fixed in the body (follower), or opposes the motion.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import ClassVar, Final, Literal

from tribodyn.cases.case import NamedGroup, demand
from tribodyn.cases.directions import unit
from tribodyn.cases.fields import Vector, choice, quantity, vector
from tribodyn.cases.signals import ForceMap, LineLoadTable, TorqueMap

FORCES: Final = ("force_x", "force_y", "force_z")
MOMENTS: Final = ("moment_x", "moment_y", "moment_z")
SIZES: Final = ("force", "moment")
_GIVEN: Final = (*SIZES, *FORCES, *MOMENTS)
_CANCELLED: Final = 1.0e-9


class BodyLoad(NamedGroup):
    """A force and a moment on a body."""

    SPEED_OF: ClassVar = {"force": "velocities", "moment": "speeds"}
    """Quantity of a table over the speed that a force or a moment opposes."""

    force: ForceMap | None = None
    moment: TorqueMap | None = None
    force_x: ForceMap | None = None
    force_y: ForceMap | None = None
    force_z: ForceMap | None = None
    moment_x: TorqueMap | None = None
    moment_y: TorqueMap | None = None
    moment_z: TorqueMap | None = None
    direction: Vector | None = vector(
        None, "of force and moment; against the motion: only along it", "", example="[-1, 0, 0]"
    )
    frame: Literal["ground", "body", "motion"] = choice(
        "ground", "fixed in space, fixed in the body (follower), or opposing the motion", "assumed"
    )
    span: LineLoadTable | None = None
    slip_velocity: float = quantity(
        "1 mm/s", "speed below which a force against the motion fades", "assumed", gt=0
    )
    slip_rate: float = quantity(
        "1 mrad/s", "angular speed below which a moment against the motion fades", "assumed", gt=0
    )

    @property
    def given(self) -> dict[str, ForceMap | TorqueMap]:
        """Its forces and moments, as far as it has them; of a span alone the force that it adds up to."""
        found = {key: getattr(self, key) for key in _GIVEN}
        here = {key: signal for key, signal in found.items() if signal is not None}
        if self.span is not None and not any(key.startswith("force") for key in here):
            return {"force": ForceMap.model_validate({"value": self._resultant()[0]}), **here}
        return here

    def shares(self, key: str) -> tuple[float, ...]:
        """Return force and moment, three components each, of one newton or newton metre under a key."""
        if key in SIZES:
            axis: Vector = (1.0, 0.0, 0.0) if self.direction is None else unit(self.direction, "direction")
        else:
            axis = float(key[-1] == "x"), float(key[-1] == "y"), float(key[-1] == "z")
        nothing = (0.0, 0.0, 0.0)
        return (*nothing, *axis) if key.startswith("moment") else (*axis, *nothing)

    @property
    def slip(self) -> float:
        """Speed below which a load against the motion fades [m/s]; of a moment [rad/s]."""
        return self.slip_rate if "moment" in self.given else self.slip_velocity

    @property
    def centroid(self) -> float:
        """Position at which the force of the span acts [m]."""
        whole, moment = self._resultant()
        largest = max(map(abs, self.span.values or (0.0,))) * self._length() if self.span else 0.0
        words = "its parts cancel: such a load has no centre of pressure"
        demand(abs(whole) > _CANCELLED * largest, "span.values", words)
        return moment / whole

    def _length(self) -> float:
        knots = self.span.knots if self.span is not None else (0.0,)
        return knots[-1] - knots[0]

    def _resultant(self) -> tuple[float, float]:
        """Return force of the span [N] and its moment about position zero [N m]."""
        from scipy.interpolate import PPoly

        assert self.span is not None
        curve = self.span.curve()
        total = PPoly(curve.coefficients, curve.knots).antiderivative()
        # ∫ z q dz = [z Q] − ∫ Q dz with Q' = q.
        first, last = curve.knots[0], curve.knots[-1]
        moment = last * total(last) - first * total(first) - total.integrate(first, last)
        return float(total(last) - total(first)), float(moment)

    def check_given(self, example: str) -> None:
        """Refuse a table without a load, and a size without a direction."""
        key = example.partition(" ")[0]
        demand(bool(self.given), key, f"a load needs a force or a moment, such as {example}")
        needs = any(self._needs_direction(key) for key in self.given)
        words = "a load needs its direction, such as direction = [-1, 0, 0]"
        demand(not needs or self.direction is not None, "direction", words)
        if self.direction is not None:
            unit(self.direction, "direction")

    def _needs_direction(self, key: str) -> bool:
        return key in SIZES and self.frame != "motion"

    def check_opposing(self) -> None:
        """Refuse a load against the motion of a point or body that has more than one size."""
        words = "against the motion acts a force or a moment; write two loads"
        demand(self.frame != "motion" or len(self.given) == 1, "frame", words)
        words = 'against the motion a load has one size, such as force = "10 N"; a direction restricts it'
        sized = all(key in SIZES for key in self.given)
        demand(self.frame != "motion" or sized, "frame", words)

    def check_followed(self, allowed: Iterable[str], words: str) -> None:
        """Refuse tables over what this load cannot follow."""
        allowed = tuple(allowed)
        for key, signal in self.given.items():
            opposed = self.SPEED_OF.get(key) if self.frame == "motion" else None
            for over in signal.axes:
                demand(over in allowed or over == opposed, f"{key}.{over}", words)


class ShaftLoad(BodyLoad):
    """A force and a moment on a shaft that turns about Z and tilts little."""

    def shares(self, key: str) -> tuple[float, ...]:
        """Return force and moment of one unit under a key; ``moment_y`` is left-handed, as tilts are."""
        found = super().shares(key)
        return tuple(-share for share in found) if key == "moment_y" else found
