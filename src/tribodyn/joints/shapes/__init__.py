"""Shapes of clearance joints: how nodes come onto their surfaces, listed once."""

from collections.abc import Callable
from typing import Final

from tribodyn.joints.shapes.cylinder import Cylinder
from tribodyn.joints.shapes.guide import Guide, Wall
from tribodyn.joints.shapes.mesh import Mesh
from tribodyn.joints.shapes.pads import Pads
from tribodyn.joints.shapes.rings import Annulus
from tribodyn.joints.shapes.round import Ball, Slot, Sphere
from tribodyn.joints.shapes.surface import Points, Shape, Surface

#: Made with their sizes by name.
SHAPES: Final[dict[str, Callable[..., Shape]]] = {
    "cylinder": Cylinder,
    "annulus": Annulus,
    "sphere": Sphere,
    "ball": Ball,
    "mesh": Mesh,
    "guide": Guide,
    "pads": Pads,
    "slot": Slot,
}

__all__ = [
    "SHAPES",
    "Annulus",
    "Ball",
    "Cylinder",
    "Guide",
    "Mesh",
    "Pads",
    "Points",
    "Shape",
    "Slot",
    "Sphere",
    "Surface",
    "Wall",
]
