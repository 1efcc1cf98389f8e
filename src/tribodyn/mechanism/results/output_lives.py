"""Life until wear makes the errors of the outputs of a mechanism too large, from the wear of one cycle."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

import numpy as np

from tribodyn.core.arrays import FloatArray
from tribodyn.joints.clearances import Place
from tribodyn.mechanism.analyses.ideal_motion import IdealMechanism
from tribodyn.mechanism.analyses.superposition import superposed
from tribodyn.mechanism.assembly.assembly import Assembly
from tribodyn.mechanism.assembly.output_values import Output
from tribodyn.mechanisms.output_life import shaft_displacements

_LEAD: Final = 120
"""Positions in a cycle through which the ideal mechanism is led to the first one."""


def error_growth(
    assembly: Assembly,
    outputs: Sequence[Output],
    places: Sequence[Place],
    times: FloatArray,
    pressure: FloatArray,
    depth: FloatArray,
) -> FloatArray:
    """Return the growth of the errors of outputs by the wear of their joints, shape (n_t, n_outputs).

    Parameters
    ----------
    assembly
        The mechanism, its joints not worn.
    outputs
        At least one.
    places
        Of the surfaces of joints with clearance, counted among these.
    times
        Rising [s], shape (n_t,).
    pressure
        At the nodes [Pa], shape (n_t, n_nodes).
    depth
        Worn off at the nodes [m], shape (n_nodes,).

    Returns
    -------
    numpy.ndarray
        In the units of the outputs; NaN for velocities, for lengths of vectors, and from where ideal joints
        do not close.
    """
    model, moved = assembly.model, {}
    for number, name in enumerate(model.clearances):
        own = [place for place in places if place.joint == number]
        surfaces = [place.surface for place in own]
        nodes = np.concatenate([np.arange(place.nodes.start, place.nodes.stop) for place in own])
        area = np.concatenate([surface.area for surface in surfaces])
        position = np.concatenate([surface.position for surface in surfaces])
        normal = np.concatenate([surface.normal for surface in surfaces])
        followed = shaft_displacements(position, normal, area * pressure[:, nodes], depth[nodes])
        moved[model.joints.index(name)] = followed[:, None]
    lead = np.linspace(0.0, times[0], _LEAD)[:-1] if times[0] > 0.0 else np.empty(0)
    still = {k: np.concatenate([np.zeros((lead.size, 1, 6)), own]) for k, own in moved.items()}
    found = superposed(IdealMechanism(assembly), outputs, np.concatenate([lead, times]), still)
    growth = found[lead.size :].sum(axis=(2, 3))
    growth[:, ~np.array([output.has_displacement for output in outputs])] = np.nan
    return np.asarray(growth)
