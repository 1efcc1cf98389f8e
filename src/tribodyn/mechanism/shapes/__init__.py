"""Shapes of a clearance: each says once which keys it needs, what it is made of and what it holds.

A shape is one class, in a file of this package whose name is in the list below. Allowed shapes in case files,
messages, surfaces, the ideal counterpart of a joint and costs follow from the list.
"""

from typing import Final

from tribodyn.mechanism.joints.joint_type import JointType
from tribodyn.mechanism.members import members_of
from tribodyn.mechanism.shapes.clearance_shape import ClearanceShape

NAMES: Final = ("cylinder", "round", "mesh", "guide", "pads")  #: Modules of this package.

#: Every shape of a clearance by its name.
SHAPES: Final[dict[str, ClearanceShape]] = {
    kind.NAME: kind() for kind in members_of(__name__, NAMES, ClearanceShape)
}


def shapes_of(kind: JointType) -> tuple[str, ...]:
    """Return the names of the shapes that a type of joint may have, the usual one first."""
    others = (name for name, shape in SHAPES.items() if kind.NAME in shape.TYPES)
    return tuple(dict.fromkeys((kind.SHAPE, *others))) if kind.SHAPE else ()
