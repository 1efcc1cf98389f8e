"""Clearance joints: geometry, contact law and friction, made into what the kernels read."""

from tribodyn.joints.bushing import BushingJoint, EntryMemory, Friction, Grid
from tribodyn.joints.clearances import contact_table
from tribodyn.joints.point_contact import CONTACTS, SURFACE, point_table
from tribodyn.joints.rows import Form

__all__ = [
    "CONTACTS",
    "SURFACE",
    "BushingJoint",
    "EntryMemory",
    "Form",
    "Friction",
    "Grid",
    "contact_table",
    "point_table",
]
