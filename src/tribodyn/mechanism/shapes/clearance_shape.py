"""Common parts of the shapes of a clearance."""

from collections.abc import Callable
from typing import Any, ClassVar, TypeAlias

from mebdf.arrays import FloatArray
from tribodyn.cases.case import NamedGroup
from tribodyn.joints.shapes import Shape
from tribodyn.joints.shapes.guide import rows_across
from tribodyn.joints.shapes.rings import EDGES
from tribodyn.mechanism.joints.joint_type import JointType

Local: TypeAlias = Callable[[FloatArray], FloatArray]


class ClearanceShape:
    """Base of the shapes of a clearance; a member says all that is to be known of its shape."""

    NAME: ClassVar[str]  #: Its name in case files.
    #: Types of joints that may have it, beside those whose usual shape it is.
    TYPES: ClassVar[tuple[str, ...]] = ()
    #: Keys that it needs, with what they are.
    NEEDED: ClassVar[dict[str, str]] = {"radius": "its radius", "radial": "its clearance"}
    EXAMPLE: ClassVar[dict[str, object]] = {"radius": "10 mm", "radial": "20 um"}  #: Values of these keys.
    #: Keys of its own, beside radius, radial clearance, length and those of all shapes; others refuse them.
    KEYS: ClassVar[type[NamedGroup]] = NamedGroup
    #: Whether it is a shaft in a bore, which takes a form, a pin of another length, a sleeve and a film.
    BORE: ClassVar[bool] = False
    #: Type of the ideal joint that holds the same, which the joint becomes as the clearance vanishes; empty
    #: for that of the joint itself.
    IDEAL: ClassVar[str] = ""
    WALLS: ClassVar[int] = 0  #: Number of its walls, if these are flat.

    def check(self, kind: JointType, keys: Any) -> None:
        """Refuse keys that do not fit a type of joint, named as in its table; what is needed is there."""

    def ideal(self, kind: str, keys: Any) -> str:
        """Return the type of the ideal joint that holds the same as a joint of some type."""
        return self.IDEAL or kind

    def of(self, keys: Any, local: Local) -> Shape:
        """Return the shape as drawn; ``local`` takes points of the drawing into the axes of the joint [m]."""
        raise NotImplementedError

    def room(self, shape: Any) -> tuple[float, float, float]:
        """Return the play of the shaft across and along the axis, and the length over which it tilts [m].

        Over a length of 0 it may tilt freely.
        """
        return shape.clearance, shape.clearance, getattr(shape, "length", 0.0)

    def nodes(self, keys: Any, around: int, along: float) -> float:
        """Return the number of nodes on a grid, for the costs of a run."""
        return (self.WALLS * (rows_across(around) + EDGES) if self.WALLS else around) * along
