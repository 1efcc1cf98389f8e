"""Outputs: what a mechanism is there for, such as the position of a slider, with its keys."""

from __future__ import annotations

from typing import Final, Literal

from tribodyn.cases import fields
from tribodyn.cases.case import NamedGroup, demand
from tribodyn.cases.directions import unit
from tribodyn.cases.fields import Vector, choice, name, vector
from tribodyn.mechanisms.general.frames import GROUND
from tribodyn.mechanisms.general.parts import POINT

UNITS: Final = {"position": "m", "distance": "m", "angle": "rad", "velocity": "m/s"}
"""Unit of each quantity."""
_LIMITS: Final = {
    "position": "error_limit",
    "distance": "error_limit",
    "angle": "angle_error_limit",
    "velocity": "velocity_error_limit",
}
"""Key of the limit of an error by the quantity."""
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

    error_limit: float | None = fields.quantity(
        None,
        "error of a position or distance at which the mechanism is worn out: a campaign ends there",
        "",
        gt=0,
        example="0.1 mm",
    )
    angle_error_limit: float | None = fields.quantity(
        None, "the same of an angle", "", unit="deg", gt=0, example="0.05 deg"
    )
    velocity_error_limit: float | None = fields.quantity(
        None, "the same of a velocity", "", gt=0, example="1 mm/s"
    )

    @property
    def limit(self) -> float | None:
        """Error at which the mechanism is worn out, in the unit of the quantity."""
        found: float | None = getattr(self, _LIMITS[self.quantity])
        return found

    def model_post_init(self, context: object, /) -> None:
        """Check that the quantity is defined."""
        for key in set(_LIMITS.values()) - {_LIMITS[self.quantity]}:
            words = f"the limit of this error is {_LIMITS[self.quantity]}"
            demand(getattr(self, key) is None, key, words)
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
