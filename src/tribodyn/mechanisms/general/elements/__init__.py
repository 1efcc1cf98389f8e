"""Elements: constraint equations and force laws over coordinates of joints and distances of points.

An element is one file with one class, and its name in the list below. Keys of case files, their table in the
manual, methods of the builder, messages, constraint equations and results follow from the list.
"""

from __future__ import annotations

from importlib import import_module
from typing import Final

from tribodyn.mechanisms.general.elements.base import ElementKeys

NAMES: Final = (
    "gear",
    "rack",
    "screw",
    "distance",
    "nonlinear_spring",
    "torsion_spring",
    "stop",
    "drag",
    "joint_friction",
    "motor",
    "controller",
)
"""Modules of this package; each holds the class of its name."""

ELEMENTS: Final[tuple[type[ElementKeys], ...]] = tuple(
    getattr(import_module(f"{__name__}.{name}"), name.title().replace("_", "")) for name in NAMES
)
"""Every kind of element."""
