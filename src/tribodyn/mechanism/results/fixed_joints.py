"""Reactions of the fixed joints that make one piece of bodies.

A joint carries what moves the bodies beyond it, about the origin of the drawing:

    F = Σ m (a − g) − Σ F_k,    M = Σ (r × m (a − g) + d(J ω)/dt) − Σ M_k,

summed over those bodies and over what acts between them and others.
"""

from dataclasses import replace
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from mebdf.arrays import FloatArray
from tribodyn.mechanism.assembly.parts_by_number import Model
from tribodyn.mechanism.assembly.pieces import inertia_of, motion_of_bodies
from tribodyn.mechanism.assembly.skeleton import back, rotated
from tribodyn.mechanism.frames import GROUND
from tribodyn.mechanism.mechanism_variables import Observed

#: Observed quantities of couplings from which reactions follow.
INPUTS: Final = ("reaction_force", "reaction_moment", "drive_force", "drive_moment")


def with_reactions(model: Model, couplings: Any, found: Observed) -> Observed:
    """Return rows with the reactions of fixed joints; ``couplings`` are records of the kernels."""
    pieces = model.pieces
    if not pieces.joints:
        return found
    names = {name: number for number, name in enumerate((*pieces.bodies, GROUND))}
    ends = np.array([[names[body] for body in bodies] for bodies in model.ends])
    of_pieces = np.append(pieces.of_bodies, -1)[ends]
    turn, origin, acting = _acting(couplings, of_pieces, found)
    needed, kept = _needed(model, found), {name: values.copy() for name, values in found.couplings.items()}
    for joint in pieces.joints:
        k = model.joints.index(joint)
        beyond = np.isin(np.arange(len(names)), [names[body] for body in pieces.beyond(joint)])
        side = beyond[ends[:, 1]].astype(float) - beyond[ends[:, 0]]
        side[k] = 0.0
        force, moment = (
            own[:, beyond[:-1]].sum(axis=1) - np.sum(side[:, None] * others, axis=1)
            for own, others in zip(needed, acting, strict=True)
        )
        carried = {"reaction_force": force, "reaction_moment": moment - np.cross(origin[:, k], force)}
        for name, values in carried.items():
            local = rotated(back(turn[:, k]), values)[:, None] * couplings.to_socket[k]
            for quantity, put in ((name, local.sum(axis=2)), (f"{name}_global", values)):
                if quantity in kept:
                    kept[quantity][:, k] = put
    return replace(found, couplings=kept)


def _acting(
    couplings: Any, of_pieces: NDArray[np.intp], found: Observed
) -> tuple[FloatArray, FloatArray, tuple[FloatArray, FloatArray]]:
    """Return the attitude of sockets, origins of shafts [m], and wrenches on these, (n_t, n_couplings, …)."""
    n, (socket, shaft) = found.bodies["position"].shape[1], of_pieces.T
    turn = np.insert(found.bodies["orientation"], n, [1.0, 0.0, 0.0, 0.0], axis=1)  # the ground
    place = np.insert(found.bodies["position"], n, 0.0, axis=1)
    origin = place[:, shaft] + rotated(turn[:, shaft], couplings.shaft_point)
    parts = []
    for name in ("force", "moment"):
        whole = found.couplings[f"reaction_{name}"].copy()
        whole[..., 2] += found.couplings[f"drive_{name}"]
        parts.append(rotated(turn[:, socket], np.sum(whole[..., None] * couplings.to_socket, axis=-2)))
    return turn[:, socket], origin, (parts[0], parts[1] + np.cross(origin, parts[0]))


def _needed(model: Model, found: Observed) -> tuple[FloatArray, FloatArray]:
    """Return forces and moments that move the bodies against their weights, (n_t, n_bodies, 3) each."""
    bodies, motion = tuple(model.case.bodies.values()), motion_of_bodies(model.pieces, found.bodies)
    inertia, turn = np.array([inertia_of(body) for body in bodies]), motion["orientation"]
    masses, spin = np.array([body.mass for body in bodies]), motion["angular_velocity"]
    force = masses[:, None] * (motion["acceleration"] - np.array(model.case.gravity))

    def turned(rate: FloatArray) -> FloatArray:
        return rotated(turn, np.sum(inertia * rotated(back(turn), rate)[..., None, :], axis=-1))

    moment = turned(motion["angular_acceleration"]) + np.cross(spin, turned(spin))
    return force, moment + np.cross(motion["position"], force)
