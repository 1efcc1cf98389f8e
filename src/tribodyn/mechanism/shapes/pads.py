"""A ring that turns between pads at equal angles."""

from typing import Any, ClassVar

from tribodyn.cases.case import NamedGroup
from tribodyn.cases.fields import count, quantity
from tribodyn.joints.shapes.pads import Pads, nodes_along
from tribodyn.joints.shapes.rings import EDGES
from tribodyn.mechanism.shapes.clearance_shape import ClearanceShape, Local
from tribodyn.mechanism.shapes.cylinder import ShaftInBore


class PadKeys(NamedGroup):
    """Number, width and place of pads."""

    pads: int | None = count(None, "pads around a ring, at equal angles", ge=3, le=1000, example="4")
    pad_width: float | None = quantity(None, "width of a pad along the ring", gt=0, example="20 mm")
    pad_angle: float = quantity("0 deg", "angle of the first pad from second_axis", "assumed")


class RingOnPads(ClearanceShape):
    """A ring between pads."""

    NAME: ClassVar[str] = "pads"
    TYPES: ClassVar[tuple[str, ...]] = ("revolute", "cylindrical")
    NEEDED: ClassVar[dict[str, str]] = {
        **ClearanceShape.NEEDED,
        "length": "the length of the pads along the axis",
        "pads": "their number",
        "pad_width": "their width along the ring",
    }
    EXAMPLE: ClassVar[dict[str, object]] = {**ShaftInBore.EXAMPLE, "pads": "4", "pad_width": "5 mm"}
    KEYS: ClassVar[type[NamedGroup]] = PadKeys
    IDEAL: ClassVar[str] = "cylindrical"

    def of(self, keys: Any, local: Local) -> Pads:
        """Return the pads as drawn."""
        return Pads(keys.radius, keys.radial, keys.length, keys.pad_width, keys.pads, keys.pad_angle)

    def nodes(self, keys: Any, around: int, along: float) -> float:
        """Return the nodes of all pads."""
        each = nodes_along(around, keys.pad_width, keys.radius + keys.radial) + EDGES
        return float(keys.pads * each * along)
