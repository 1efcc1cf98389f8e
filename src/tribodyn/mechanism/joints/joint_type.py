"""Common parts of the types of joints.

A type of ideal joint is a list of constraint equations on the displacement and the rotation of its second
body against the first, in axes of which z is the axis of the joint.
"""

from typing import Any, ClassVar, Final

from mebdf.arrays import FloatArray
from tribodyn.cases.case import NamedGroup
from tribodyn.kernels.mechanism.data import DIRECTION, POINT
from tribodyn.mechanism.frames import frame

#: A constraint equation: its kind, axis of the first body, axis of the second one; 0, 1, 2 for x, y, z.
Row = tuple[int, int, int]

#: The origins of both bodies coincide.
AT_POINT: Final[tuple[Row, ...]] = tuple((POINT, i, 0) for i in range(3))
ON_AXIS: Final = AT_POINT[:2]  #: That of the second body stays on the axis.
#: The axis of the second body stays parallel to that of the first.
ALIGNED: Final[tuple[Row, ...]] = ((DIRECTION, 0, 2), (DIRECTION, 1, 2))
NO_TURN: Final[Row] = (DIRECTION, 1, 0)  #: Of aligned bodies, the second does not turn about the axis.


class JointType:
    """Base of the types of joints; a member says all that is to be known of its type."""

    NAME: ClassVar[str]  #: Its name in case files; the builder's method has underscores for hyphens.
    MEANING: ClassVar[str]  #: What it lets move, in a few words; keys in backquotes.
    ROWS: ClassVar[tuple[Row, ...]] = ()  #: What vanishes in the ideal joint.
    #: What its axes are called; empty where it has none.
    AXIS: ClassVar[str] = ""
    SECOND_AXIS: ClassVar[str] = ""
    #: What can be driven, and followed by elements: ``angle``, ``position``.
    COORDINATES: ClassVar[tuple[str, ...]] = ()
    #: Name of the shape of its clearance, unless the case gives another one; empty where it is always ideal.
    SHAPE: ClassVar[str] = ""
    #: Whether a clearance may have end faces, which hold the pin along the axis.
    FACES: ClassVar[bool] = False
    CLEARANCE: ClassVar[str] = ""  #: What a clearance makes of it, for the manual.
    #: Type of the ideal joint in the place of one that yields by itself; empty for others.
    HELD: ClassVar[str] = ""
    #: Keys of its own, beside those of all joints; other types refuse them.
    KEYS: ClassVar[type[NamedGroup]] = NamedGroup
    #: Those of them that the builder's method takes as required, with values for its example.
    NEEDED: ClassVar[dict[str, object]] = {}

    @property
    def named(self) -> str:
        """Name with its article: ``a revolute joint``."""
        return f"{'an' if self.NAME[0] in 'aeio' else 'a'} {self.NAME} joint"

    @property
    def held(self) -> list[int]:
        """Components of the displacement between its points that the ideal joint holds, of 0, 1, 2."""
        return [axis for kind, axis, _ in self.ROWS if kind == POINT]

    @property
    def holds_across(self) -> bool:
        """Whether it has a reaction across its axis."""
        return bool({0, 1} & set(self.held))

    @property
    def example(self) -> dict[str, object]:
        """Keys of a joint of this type beside its bodies: a complete example."""
        axes = {"axis": [0, 0, 1]} if self.AXIS else {}
        second = {"second_axis": [1, 0, 0]} if self.SECOND_AXIS else {}
        return {"point": "0, 0, 0 mm", **axes, **second, **self.NEEDED}

    def check(self, keys: Any) -> None:
        """Refuse keys of the joint that do not fit, with the key of the table of the joint in the error."""

    def shaft_axes(self, first: FloatArray, second: FloatArray) -> FloatArray:
        """Return the axes of the second body as columns, shape (3, 3), from the axes of the joint (3,)."""
        return frame(first, second)

    def fill(self, record: Any, keys: Any) -> None:
        """Fill the record of the coupling beside its constraint equations; by default nothing."""
