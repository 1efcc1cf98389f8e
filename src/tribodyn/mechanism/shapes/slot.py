"""A round pin in a slot between flat walls."""

from typing import Any, ClassVar

from tribodyn.joints.shapes import Slot
from tribodyn.mechanism.shapes.clearance_shape import ClearanceShape, Local


class PinInSlot(ClearanceShape):
    """A pin between two flat walls."""

    NAME: ClassVar[str] = "slot"
    NEEDED: ClassVar[dict[str, str]] = {
        **ClearanceShape.NEEDED,
        "length": "the length of the pin in its slot",
    }
    EXAMPLE: ClassVar[dict[str, object]] = {**ClearanceShape.EXAMPLE, "length": "20 mm"}

    WALLS: ClassVar[int] = 2

    def of(self, keys: Any, local: Local) -> Slot:
        """Return the slot as drawn."""
        return Slot(keys.radius, keys.radial, keys.length)
