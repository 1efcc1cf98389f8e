"""Spring-damper: two bodies that move against six stiffnesses, such as a rubber mount."""

from typing import Any, ClassVar

from tribodyn.cases.case import NamedGroup, demand
from tribodyn.cases.fields import Vector, vector
from tribodyn.kernels.mechanism.data import SPRINGS
from tribodyn.mechanism.joints.joint_type import JointType

#: Number of the key's component along x, y, z: keys are along axis, second axis and across both.
_OF_AXES = (1, 2, 0)


class SpringDamperKeys(NamedGroup):
    """Stiffness and damping of a spring-damper."""

    stiffness: Vector | None = vector(
        None,
        "stiffness of a spring-damper along axis, second axis and across both",
        "",
        unit="N/um",
        example='["10 N/um", "10 N/um", "10 N/um"]',
    )
    damping: Vector | None = vector(
        None,
        "damping of a spring-damper along these directions",
        "",
        unit="N s/m",
        example='["10 N s/m", "10 N s/m", "10 N s/m"]',
    )
    angular_stiffness: Vector | None = vector(
        None,
        "angular stiffness of a spring-damper about these directions",
        "",
        unit="N m/rad",
        example='["0 N m/rad", "10 N m/rad", "10 N m/rad"]',
    )
    angular_damping: Vector | None = vector(
        None,
        "angular damping of a spring-damper about these directions",
        "",
        unit="N m s/rad",
        example='["0 N m s/rad", "1 N m s/rad", "1 N m s/rad"]',
    )


class SpringDamper(JointType):
    """Springs and dampers along and about three axes."""

    NAME: ClassVar[str] = "spring-damper"
    MEANING: ClassVar[str] = "moves against `stiffness`, `angular_stiffness`, `damping`, `angular_damping`"
    COORDINATES: ClassVar[tuple[str, ...]] = ("angle", "position")
    KEYS: ClassVar[type[NamedGroup]] = SpringDamperKeys
    NEEDED: ClassVar[dict[str, object]] = {"stiffness": "1, 1, 1 N/um"}

    def check(self, keys: Any) -> None:
        """Refuse values below zero, and springs without a stiffness."""
        given = {key: getattr(keys, key) for key in SpringDamperKeys.model_fields}
        for key, values in given.items():
            demand(values is None or min(values) >= 0.0, key, "none of them may be below zero")
        stiff = given["stiffness"] or given["angular_stiffness"]
        demand(bool(stiff), "stiffness", "a spring-damper needs a stiffness")

    def fill(self, record: Any, keys: Any) -> None:
        """Fill stiffness and damping."""
        record.force = SPRINGS
        record.stiffness[:] = _six(keys.stiffness, keys.angular_stiffness)
        record.damping[:] = _six(keys.damping, keys.angular_damping)


def _six(along: Vector | None, about: Vector | None) -> list[float]:
    """Return the given values of two kinds of motion, along and about x, y, z."""
    return [given[k] for given in (along or (0.0,) * 3, about or (0.0,) * 3) for k in _OF_AXES]
