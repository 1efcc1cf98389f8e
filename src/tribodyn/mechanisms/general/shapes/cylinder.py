"""A shaft in a bore, with end faces where the clearance has axial gaps."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar, Final

from tribodyn.core.arrays import FloatArray
from tribodyn.joints.shapes import Cylinder
from tribodyn.mechanisms.general.shapes.base import ClearanceShape

FLANGE: Final = 1.5
"""Outer radius of end faces over the radius of the pin, where the case does not say it."""


class ShaftInBore(ClearanceShape):
    """A shaft in a bore."""

    NAME: ClassVar[str] = "cylinder"
    NEEDED: ClassVar[Mapping[str, str]] = {**ClearanceShape.NEEDED, "length": "the length of the bore"}
    BORE: ClassVar[bool] = True

    def ideal(self, kind: str, keys: Any) -> str:
        """Return the hinge that end faces make of it, or a pin that slides in its sleeve."""
        return "revolute" if keys.has_faces else "cylindrical"

    def of(self, keys: Any, facets: FloatArray | None = None) -> Cylinder:
        """Return the cylinder as drawn."""
        return Cylinder(
            radius=keys.radius,
            clearance=keys.radial,
            length=keys.length,
            pin_length=keys.pin_length,
            axial=keys.axial,
            axial_upper=keys.axial_upper,
            axial_lower=keys.axial_lower,
            flange=keys.flange or (FLANGE * keys.radius if keys.has_faces else None),
            form=keys.form.form(),
        )

    def room(self, shape: Any) -> tuple[float, float, float]:
        """Return the radial clearance, the least gap at an end face, and the length of the bore."""
        return shape.clearance, min(shape.faces.values(), default=shape.clearance), shape.length

    def nodes(self, keys: Any, around: int, along: float) -> float:
        """Return the nodes of the barrel and of its end faces."""
        ends = (keys.axial_upper or keys.axial, keys.axial_lower or keys.axial)
        return around * along * (1.0 + sum(gap is not None for gap in ends))
