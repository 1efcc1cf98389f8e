"""Clearance joints: geometry, contact law and friction, made into what the kernels read."""

from __future__ import annotations

from tribodyn.joints.bushing import BushingGeometry, BushingJoint, EntryMemory, Friction, Grid

__all__ = ["BushingGeometry", "BushingJoint", "EntryMemory", "Friction", "Grid"]
