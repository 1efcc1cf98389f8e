"""Elements: constraint equations and force laws over coordinates of joints and distances of points.

An element is one file with one class, and its name in the list below. Keys of case files, their table in the
manual, methods of the builder, messages, constraint equations and results follow from the list.
"""

from typing import Final

from tribodyn.mechanism.elements.element import ElementKeys
from tribodyn.mechanism.members import members_of

#: Modules of this package that hold elements.
NAMES: Final = (
    "gear",
    "screw",
    "distance",
    "nonlinear_spring",
    "stop",
    "drag",
    "joint_friction",
    "motor",
    "controller",
)

#: Every kind of element.
ELEMENTS: Final[tuple[type[ElementKeys], ...]] = tuple(members_of(__name__, NAMES, ElementKeys))
