"""Outputs: what a mechanism is there for, such as the position of a slider, with its keys."""

from __future__ import annotations

from typing import Final, Literal

from tribodyn.cases.case import NamedGroup, demand
from tribodyn.cases.directions import unit
from tribodyn.cases.fields import Vector, choice, name, vector
from tribodyn.mechanisms.general.frames import GROUND
from tribodyn.mechanisms.general.parts import POINT

UNITS: Final = {"position": "m", "distance": "m", "angle": "rad", "velocity": "m/s"}
"""Unit of each quantity."""
_AXIS: Final = "[1, 0, 0]"


class OutputKeys(NamedGroup):
    """A quantity of the motion, which is compared with that of ideal joints."""

    quantity: Literal["position", "distance", "angle", "velocity"] = choice(
        "position", "position or velocity of a point, distance of two points, angle of a body", "assumed"
    )
    body: str = name(None, "body that is observed", "", example='"slider"', required=True)
    point: Vector | None = vector(
        None, "observed point; by default the mass centre", "", unit="mm", example=POINT
    )
    reference: str = name(
        GROUND, "body against which it is observed, or ground", "assumed", example='"frame"'
    )
    reference_point: Vector | None = vector(
        None,
        "point of the reference; by default at the position of the observed point",
        "",
        unit="mm",
        example=POINT,
    )
    along: Vector | None = vector(
        None,
        "direction of a position or velocity, axis of an angle, fixed to the reference; without it "
        "a position or velocity counts in all directions",
        "",
        example=_AXIS,
    )

    def model_post_init(self, context: object, /) -> None:
        """Check that the quantity is defined."""
        demand(self.body != GROUND, "body", f"{GROUND} never moves; name a body")
        demand(
            self.body != self.reference, "reference", "a body does not move against itself; name another one"
        )
        needs_axis = "an angle needs its axis: give along, such as [0, 0, 1]"
        demand(self.quantity != "angle" or self.along is not None, "along", needs_axis)
        if self.quantity == "distance":
            words = "a distance needs its second point: give reference_point"
            demand(self.reference_point is not None, "reference_point", words)
            demand(
                self.along is None,
                "along",
                "a distance has no direction; leave along out, or take a position",
            )
        if self.quantity == "angle":
            for key in ("point", "reference_point"):
                demand(getattr(self, key) is None, key, "an angle needs no point; leave this key out")
        if self.along is not None:
            unit(self.along, "along")
