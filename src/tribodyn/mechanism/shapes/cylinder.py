"""A shaft in a bore, with end faces where the clearance has axial gaps."""

from typing import Any, ClassVar, Final

from tribodyn.cases.case import NamedGroup, demand
from tribodyn.cases.fields import quantity
from tribodyn.joints.shapes.cylinder import Cylinder, rows_of_face
from tribodyn.joints.shapes.rings import EDGES
from tribodyn.mechanism.joints.joint_type import JointType
from tribodyn.mechanism.shapes.clearance_shape import ClearanceShape, Local

FLANGE: Final = 1.5  #: Outer radius of end faces over the radius of the pin, where the case does not say it.


class BoreKeys(NamedGroup):
    """Length of a pin, and sizes of end faces."""

    ALTERNATIVES: ClassVar[tuple[tuple[str, str], ...]] = (("axial", "axial_upper"), ("axial", "axial_lower"))

    pin_length: float | None = quantity(
        None,
        "length of a pin that is shorter than its bore, such as a piston; the pin passes through without it",
        gt=0,
        example="15 mm",
    )
    axial: float | None = quantity(
        None, "gap at each end face when centred; without it the pin slides freely", gt=0, example="50 um"
    )
    axial_upper: float | None = quantity(
        None,
        "gap at the end face that the axis points to; carries a pin pushed against the axis",
        gt=0,
        example="50 um",
    )
    axial_lower: float | None = quantity(
        None, "gap at the other end face; carries a pin pushed along the axis", gt=0, example="50 um"
    )
    flange: float | None = quantity(
        None, f"outer radius of the end faces; by default {FLANGE} times the radius", gt=0, example="12 mm"
    )

    @property
    def has_faces(self) -> bool:
        """Whether it has an end face."""
        return any(gap is not None for gap in (self.axial, self.axial_upper, self.axial_lower))


class ShaftInBore(ClearanceShape):
    """A shaft in a bore."""

    NAME: ClassVar[str] = "cylinder"
    TYPES: ClassVar[tuple[str, ...]] = ("revolute", "cylindrical", "pin-slot", "prismatic")
    NEEDED: ClassVar[dict[str, str]] = {**ClearanceShape.NEEDED, "length": "the length of the bore"}
    EXAMPLE: ClassVar[dict[str, object]] = {**ClearanceShape.EXAMPLE, "length": "20 mm"}
    KEYS: ClassVar[type[NamedGroup]] = BoreKeys
    BORE: ClassVar[bool] = True

    def check(self, kind: JointType, keys: Any) -> None:
        """Refuse a pin, a form or end faces that do not fit."""
        words = "a pin with end faces passes through its bore; leave pin_length out, or the axial gaps"
        pin = keys.length if keys.pin_length is None else min(keys.length, keys.pin_length)
        demand(not keys.has_faces or pin == keys.length, "clearance.pin_length", words)
        for key in ("axial", "axial_upper", "axial_lower", "flange"):
            words = f"end faces are for revolute joints, not for a {kind.NAME} one"
            demand(kind.FACES or getattr(keys, key) is None, f"clearance.{key}", words)
        bore = keys.radius + keys.radial
        words = f"the end faces must reach beyond the bore, {bore * 1e3:.6g} mm"
        demand(keys.flange is None or keys.flange > bore, "clearance.flange", words)
        keys.form.check(keys.contact, pin, "clearance.")

    def ideal(self, kind: str, keys: Any) -> str:
        """Return the hinge that end faces make of it, or a pin that slides in its sleeve."""
        return "revolute" if keys.has_faces else "cylindrical"

    def of(self, keys: Any, local: Local) -> Cylinder:
        """Return the cylinder as drawn."""
        return Cylinder(
            radius=keys.radius,
            clearance=keys.radial,
            length=keys.length,
            pin_length=keys.pin_length,
            axial=keys.axial,
            axial_upper=keys.axial_upper,
            axial_lower=keys.axial_lower,
            flange=_flange(keys) if keys.has_faces else keys.flange,
            form=keys.form.form(),
        )

    def room(self, shape: Any) -> tuple[float, float, float]:
        """Return the radial clearance, the least gap at an end face, and the length of the bore."""
        return shape.clearance, min(shape.faces.values(), default=shape.clearance), shape.length

    def nodes(self, keys: Any, around: int, along: float) -> float:
        """Return the nodes of the barrel and of its end faces."""
        ends = (keys.axial_upper or keys.axial, keys.axial_lower or keys.axial)
        width = _flange(keys) - keys.radius - keys.radial
        across = rows_of_face(round(along) - EDGES, width, keys.length) + EDGES
        return around * (along + across * sum(gap is not None for gap in ends))


def _flange(keys: Any) -> float:
    """Return the outer radius of end faces [m]."""
    return float(keys.flange or FLANGE * keys.radius)
