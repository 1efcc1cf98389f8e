"""Blocks between flat walls, along which they slide: in square channels and in dovetails."""

from typing import Any, ClassVar, Final

from mebdf.kernels.elementary import portable
from tribodyn.cases.case import NamedGroup, demand
from tribodyn.cases.fields import quantity, switch
from tribodyn.joints.shapes import Guide, Wall
from tribodyn.mechanism.joints.joint_type import JointType
from tribodyn.mechanism.shapes.clearance_shape import ClearanceShape, Local

_NARROW: Final = 0.1  #: Largest clearance over the width or the height of a block.


class BlockKeys(NamedGroup):
    """Cross-section of a block, and which part is longer."""

    width: float | None = quantity(
        None,
        "width of the block of a guide, along second_axis; of a dovetail that of its wide side",
        gt=0,
        example="30 mm",
    )
    height: float | None = quantity(
        None, "height of the block of a guide, across axis and second_axis", gt=0, example="20 mm"
    )
    through: bool = switch(
        False,
        "length is that of a channel through which a longer rail passes, such as a carriage; "
        "without it that of a block in a longer channel",
        "assumed",
    )


class DovetailKeys(BlockKeys):
    """Cross-section of a dovetail."""

    flank_angle: float = quantity(
        "55 deg", "angle between the flanks of a dovetail and its wide side", "assumed", gt=0, lt="90 deg"
    )


class SquareGuide(ClearanceShape):
    """A bar of rectangular section between four walls."""

    NAME: ClassVar[str] = "square"
    TYPES: ClassVar[tuple[str, ...]] = ("prismatic",)
    NEEDED: ClassVar[dict[str, str]] = {
        "width": "its width",
        "height": "its height",
        "length": "the length of the block",
        "radial": "its clearance at each wall",
    }
    EXAMPLE: ClassVar[dict[str, object]] = {
        "width": "30 mm",
        "height": "20 mm",
        "length": "60 mm",
        "radial": "20 um",
    }
    KEYS: ClassVar[type[NamedGroup]] = BlockKeys
    WALLS: ClassVar[int] = 4

    def check(self, kind: JointType, keys: Any) -> None:
        """Refuse a radius, and a play that is as large as the block."""
        words = "between flat walls there is a width and a height, and no radius"
        demand(keys.radius is None, "clearance.radius", words)
        words = "the clearance must not exceed a tenth of width and height"
        demand(keys.radial <= _NARROW * min(keys.width, keys.height), "clearance.radial", words)

    def of(self, keys: Any, local: Local) -> Guide:
        """Return the guide as drawn."""
        return Guide(self.walls(keys), keys.radial, keys.length, keys.through)

    def walls(self, keys: Any) -> tuple[Wall, ...]:
        """Return the walls around the block: x is along its width, y along its height."""
        x, y = 0.5 * keys.width, 0.5 * keys.height
        return (
            Wall("right", (x, -y), (x, y)),
            Wall("top", (x, y), (-x, y)),
            Wall("left", (-x, y), (-x, -y)),
            Wall("bottom", (-x, -y), (x, -y)),
        )


class DovetailGuide(SquareGuide):
    """A block that its inclined flanks hold on its wide side."""

    NAME: ClassVar[str] = "dovetail"
    WALLS: ClassVar[int] = 3
    KEYS: ClassVar[type[NamedGroup]] = DovetailKeys

    def check(self, kind: JointType, keys: Any) -> None:
        """Refuse flanks that meet, too."""
        super().check(kind, keys)
        most = 0.5 * keys.width * float(portable.tan(keys.flank_angle))
        words = f"the flanks meet {1e3 * most:.4g} mm above the wide side: the height must be less"
        demand(keys.height < most, "clearance.height", words)

    def walls(self, keys: Any) -> tuple[Wall, ...]:
        """Return the wide side below, and the flanks."""
        wide, y = 0.5 * keys.width, 0.5 * keys.height
        narrow = wide - keys.height / float(portable.tan(keys.flank_angle))
        return (
            Wall("bottom", (-wide, -y), (wide, -y)),
            Wall("right flank", (wide, -y), (narrow, y)),
            Wall("left flank", (-narrow, y), (-wide, -y)),
        )
