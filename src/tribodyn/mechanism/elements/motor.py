"""Motor: a torque or force that depends on speed, by a straight line or a table.

A DC motor at constant voltage has the straight line

    M = M₀ (1 − ω/ω₀)

with the stall torque M₀ and the no-load speed ω₀, where the time constant of its winding is short.
"""

from typing import Any, ClassVar

from tribodyn.cases.case import demand
from tribodyn.cases.fields import quantity
from tribodyn.cases.signals import ForceSignal, TorqueSignal
from tribodyn.kernels.mechanism.law import force_law
from tribodyn.mechanism.elements.element import ARM, DRIVE, ForceLaw, Joints, Leg, OfJointKeys


@force_law("stall", "slope")
def of_speed(motor: Any, law: Any) -> None:
    """Fill the force that a motor has at a speed: a straight line, and a table."""
    law.force = motor.stall + motor.slope * law.rate + law.table[0]
    law.in_rate = motor.slope + law.table_slope
    law.supplied = law.force * law.rate


class Motor(OfJointKeys):
    """A motor: a torque or force on the second body of a joint that depends on its speed."""

    ALTERNATIVES: ClassVar[tuple[tuple[str, str], ...]] = (
        ("torque", "force"),
        *((table, key) for table in ("torque", "force") for key in ("stall_torque", "stall_force")),
        ("stall_torque", "stall_force"),
        ("no_load_speed", "no_load_velocity"),
    )
    TABLE: ClassVar[str] = "motors"
    METHOD: ClassVar[str] = "motor"
    FORCE: ClassVar[str] = "force on the second body along the axis; none for a torque"
    MOMENT: ClassVar[str] = "torque on the second body about the axis; none for a force"
    LAW: ClassVar = of_speed
    IS_DRIVE: ClassVar[bool] = True
    EXAMPLE: ClassVar[str] = (
        ARM
        + """[motors.dc]
joint = "input"
torque = { speeds = "-100, 0, 100, 200 rad/s", values = "3, 2, 1.2, 0 N m" }
"""
        + DRIVE
    )

    stall_torque: float | None = quantity(
        None, "torque at rest, on a straight line to the no-load speed", unit="N m", example="2 N m"
    )
    no_load_speed: float | None = quantity(
        None, "speed without torque, of the same sign", unit="rad/s", example="3000 rpm"
    )
    torque: TorqueSignal | None = None
    stall_force: float | None = quantity(
        None, "force at rest, on a straight line to the no-load velocity", unit="N", example="200 N"
    )
    no_load_velocity: float | None = quantity(
        None, "velocity without force, of the same sign", unit="m/s", example="0.5 m/s"
    )
    force: ForceSignal | None = None

    def legs(self, joints: Joints) -> tuple[Leg, ...]:
        """Return the leg of the angle or the position."""
        turns = self.torque is not None or self.stall_torque is not None
        words = 'say what it gives: stall_torque and no_load_speed, or a table such as torque = "motor.csv"'
        demand(turns or self.force is not None or self.stall_force is not None, "stall_torque", words)
        return (self.leg_of(joints, "angle" if turns else "position", "this motor"),)

    def force_law(self, joints: Joints) -> ForceLaw:
        """Return the straight line or the table."""
        for name, table, over in (("torque", self.torque, "speeds"), ("force", self.force, "velocities")):
            if table is not None:
                words = f"the {name} of a motor is a table over {over}; a constant one is a drive"
                demand(table.over == over, name, words)
                return ForceLaw(of_speed, {"stall": 0.0, "slope": 0.0}, table.curve(), over_rate=True)
        key, stall, most = "no_load_speed", self.stall_torque, self.no_load_speed
        if stall is None:
            key, stall, most = "no_load_velocity", self.stall_force, self.no_load_velocity
        demand(most is not None, key, f"a motor with a straight line needs its {key}")
        assert stall is not None
        assert most is not None
        demand(stall * most > 0.0, key, "both are above zero, or both below for a motor that turns backwards")
        return ForceLaw(of_speed, {"stall": stall, "slope": -stall / most})
