"""Joints with clearance after wear: how deep they are worn, and the roughness that is left of them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from tribodyn.core.arrays import FloatArray
from tribodyn.joints.clearances import Place
from tribodyn.kernels.joints.surface.data import GAP, SurfaceData
from tribodyn.mechanism.assembly.clearance_surfaces import clearances_of, material_of
from tribodyn.mechanism.assembly.parts_by_number import Model
from tribodyn.mechanism.mechanism_case import MechanismCase
from tribodyn.wear import loaded_depth


def depth_of(data: SurfaceData, places: Sequence[Place]) -> FloatArray:
    """Return the wear depth that a run was made with, at the nodes of all joints [m], shape (n_nodes,)."""
    drawn = np.concatenate([np.empty(0), *(place.surface.gap for place in places)])
    return np.asarray(data.nodes[GAP] - drawn)


def worn_model(model: Model, places: Sequence[Place], depth: FloatArray | None) -> Model:
    """Return a mechanism with the roughness that its joints have at a wear depth.

    Parameters
    ----------
    model
        The mechanism as drawn.
    places
        Where the surfaces of its joints lie among all nodes.
    depth
        Wear depth at the nodes [m], shape (n_nodes,); None for none.
    """
    if not model.case.wear.running_in or depth is None or not depth.any():
        return model
    depths = {}
    for number, name in enumerate(model.clearances):
        own = [place for place in places if place.joint == number]
        area = np.concatenate([place.surface.area for place in own])
        depths[name] = loaded_depth(depth[own[0].nodes.start : own[-1].nodes.stop], area)
    return replace(model, clearances=clearances_of(model.case, depths))


def least_roughness(case: MechanismCase) -> float:
    """Return the least combined rms roughness that a joint with clearance comes to [m]; 1 without any."""
    worn = math.inf if case.wear.running_in else 0.0
    real = [name for name, joint in case.joints.items() if joint.real is not None]
    pairs = [material_of(case, name, worn) for name in real]
    return min((pair.surface_pair.roughness_rms for pair in pairs), default=1.0)
