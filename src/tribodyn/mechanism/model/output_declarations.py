"""Outputs: what a mechanism is there for, such as the position of a slider, with its keys."""

from collections.abc import Mapping
from typing import ClassVar, Final, Literal

from tribodyn.cases import fields
from tribodyn.cases.case import demand, unit
from tribodyn.cases.fields import Numbers, Vector, choice, name, series, vector
from tribodyn.mechanism.frames import GROUND
from tribodyn.mechanism.model.parts import POINT
from tribodyn.mechanisms.output_keys import ErrorKeys, InstantKeys

_AXIS: Final = "[1, 0, 0]"


class JointInstants(InstantKeys):
    """Places at which the error of an output is read, by the coordinate of a joint."""

    positions: Numbers | None = series(
        "positions of the drive at which the error is read", unit="mm", example='["5 mm", "20 mm"]'
    )
    joint: str | None = name(
        None, "joint whose angles or positions these are; by default that of the first drive", example="main"
    )


class OutputKeys(ErrorKeys):
    """A quantity of the motion, which is compared with that of ideal joints."""

    UNITS: ClassVar[Mapping[str, str]] = {
        "position": "m",
        "distance": "m",
        "velocity": "m/s",
        **ErrorKeys.UNITS,
    }
    LIMITS: ClassVar[Mapping[str, str]] = {
        "position": "error_limit",
        "distance": "error_limit",
        "velocity": "velocity_error_limit",
        **ErrorKeys.LIMITS,
    }

    quantity: Literal["position", "distance", "angle", "velocity", "angular_velocity"] = choice(
        "position",
        "position or velocity of a point, distance of two points, angle of a body or the rate of this angle",
        "assumed",
    )
    at: JointInstants = JointInstants()
    body: str = name(None, "body that is observed", example="slider", required=True)
    point: Vector | None = vector(
        None, "observed point; by default the mass centre", unit="mm", example=POINT
    )
    reference: str = name(GROUND, "body against which it is observed, or ground", "assumed", example="frame")
    reference_point: Vector | None = vector(
        None,
        "point of the reference; by default at the position of the observed point",
        unit="mm",
        example=POINT,
    )
    follows: str | None = name(
        None,
        "joint whose motion in the run the ideal mechanism has, too; by default those of motors, controllers "
        "and drives by a torque or a force, where drives by a motion leave the output free",
        example="main",
    )
    along: Vector | None = vector(
        None,
        "direction of a position or velocity, axis of an angle, fixed to the reference; without it "
        "a position or velocity counts in all directions",
        example=_AXIS,
    )

    error_limit: float | None = fields.quantity(
        None,
        "error of a position or distance at which the mechanism is worn out: a campaign ends there",
        "",
        gt=0,
        example="0.1 mm",
    )
    velocity_error_limit: float | None = fields.quantity(
        None, "the same of a velocity", "", gt=0, example="1 mm/s"
    )

    def model_post_init(self, context: object, /) -> None:
        """Check that the quantity is defined."""
        super().model_post_init(context)
        demand(self.body != GROUND, "body", f"{GROUND} never moves; name a body")
        demand(
            self.body != self.reference, "reference", "a body does not move against itself; name another one"
        )
        turns = self.quantity in ErrorKeys.UNITS
        needs_axis = "an angle needs its axis: give along, such as [0, 0, 1]"
        demand(not turns or self.along is not None, "along", needs_axis)
        if self.quantity == "distance":
            words = "a distance needs its second point: give reference_point"
            demand(self.reference_point is not None, "reference_point", words)
            demand(
                self.along is None,
                "along",
                "a distance has no direction; leave along out, or take a position",
            )
        if turns:
            for key in ("point", "reference_point"):
                demand(getattr(self, key) is None, key, "an angle needs no point; leave this key out")
        if self.along is not None:
            unit(self.along, "along")
