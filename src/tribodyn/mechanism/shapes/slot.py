"""A round pin in a slot between flat walls."""

from typing import Any, ClassVar

from tribodyn.joints.shapes.guide import FEWEST
from tribodyn.joints.shapes.rings import EDGES
from tribodyn.joints.shapes.slot import WALLS, Slot
from tribodyn.mechanism.shapes.clearance_shape import ClearanceShape, Local


class PinInSlot(ClearanceShape):
    """A pin between two flat walls."""

    NAME: ClassVar[str] = "slot"
    NEEDED: ClassVar[dict[str, str]] = {
        **ClearanceShape.NEEDED,
        "length": "the length of the pin in its slot",
    }
    EXAMPLE: ClassVar[dict[str, object]] = {**ClearanceShape.EXAMPLE, "length": "20 mm"}

    def of(self, keys: Any, local: Local) -> Slot:
        """Return the slot as drawn."""
        return Slot(keys.radius, keys.radial, keys.length)

    def room(self, shape: Any) -> tuple[float, float, float]:
        """Return the clearance twice, and the length of the pin."""
        return shape.clearance, shape.clearance, shape.length

    def nodes(self, keys: Any, around: int, along: float) -> float:
        """Return the nodes of both walls."""
        return len(WALLS) * (max(around // 4, FEWEST) + EDGES) * along
