"""Reactions of the fixed joints that make one piece of bodies.

A joint carries what moves the bodies beyond it, about the origin of the drawing:

    F = Σ m (a − g) − Σ F_k,    M = Σ (r × m (a − g) + d(J ω)/dt) − Σ M_k,

summed over those bodies and over what acts between them and others.
"""

from dataclasses import replace
from typing import Any, Final

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.kernels import dense
from tribodyn.mechanism.assembly.parts_by_number import Model
from tribodyn.mechanism.assembly.pieces import inertia_of, motion_of_bodies
from tribodyn.mechanism.assembly.skeleton import back, rotated
from tribodyn.mechanism.mechanism_variables import Observed

#: Observed quantities of couplings from which reactions follow.
INPUTS: Final = ("reaction_force", "reaction_moment", "drive_force", "drive_moment")
_Wrench = tuple[FloatArray, FloatArray]


def with_reactions(model: Model, couplings: Any, found: Observed) -> Observed:
    """Return rows with the reactions of fixed joints; ``couplings`` are records of the kernels."""
    names = [name for name in model.joints if name in model.pieces.joints]
    if not names:
        return found
    acting = _Acting(model, couplings, found)
    kept = {name: values.copy() for name, values in found.couplings.items()}
    for name in names:
        for quantity, values in acting.reaction(model.joints.index(name)).items():
            if quantity in kept:
                kept[quantity][:, model.joints.index(name)] = values
    return replace(found, couplings=kept)


class _Acting:
    """Wrenches on bodies about the origin of the drawing."""

    def __init__(self, model: Model, couplings: Any, found: Observed) -> None:
        self._model, self._couplings, self._found = model, couplings, found
        self._motion = motion_of_bodies(model.pieces, found.bodies)
        self._needed = {name: self._inertial(b) for b, name in enumerate(model.case.bodies)}

    def reaction(self, k: int) -> dict[str, FloatArray]:
        """Return the observed quantities of the reaction of fixed joint ``k`` on its shaft."""
        beyond = self._beyond(k)
        force, moment = (sum(parts) for parts in zip(*(self._needed[body] for body in beyond), strict=True))
        for other, (socket, shaft) in enumerate(self._model.ends):
            side = (shaft in beyond) - (socket in beyond)
            if side and other != k:
                on_shaft, about = self._wrench(other)
                force, moment = force - side * on_shaft, moment - side * about
        moment = moment - np.cross(self._origin(k), force)
        found = {"reaction_force_global": force, "reaction_moment_global": moment}
        turn = back(self._orientation(self._model.ends[k][0]))
        for name, values in dict(found).items():
            found[name.removesuffix("_global")] = dense.product(
                rotated(turn, values), self._couplings[k].to_socket.T
            )
        return found

    def _beyond(self, k: int) -> set[str]:
        """Return the bodies of the piece on the side of the shaft of a fixed joint."""
        model = self._model
        joints = [model.case.joints[name].between for name in model.pieces.joints if name != model.joints[k]]
        beyond, more = set[str](), {model.ends[k][1]}
        while more:
            beyond |= more
            more = {body for ends in joints if beyond & {*ends} for body in ends} - beyond
        return beyond

    def _inertial(self, b: int) -> _Wrench:
        """Return what moves a body against its weight."""
        body, motion = tuple(self._model.case.bodies.values())[b], self._motion
        turn, spin = motion["orientation"][:, b], motion["angular_velocity"][:, b]
        force = body.mass * (motion["acceleration"][:, b] - np.array(self._model.case.gravity))
        inertia, inverse = inertia_of(body), back(turn)

        def turned(rate: FloatArray) -> FloatArray:
            return rotated(turn, dense.product(rotated(inverse, rate), inertia))

        moment = turned(motion["angular_acceleration"][:, b]) + np.cross(spin, turned(spin))
        return force, moment + np.cross(motion["position"][:, b], force)

    def _wrench(self, k: int) -> _Wrench:
        """Return the wrench of a coupling on its shaft."""
        given, axes = self._found.couplings, self._couplings[k].to_socket
        parts, turn = [], self._orientation(self._model.ends[k][0])
        for name in ("force", "moment"):
            whole = given[f"reaction_{name}"][:, k].copy()
            whole[:, 2] += given[f"drive_{name}"][:, k]
            parts.append(rotated(turn, dense.product(whole, axes)))
        return parts[0], parts[1] + np.cross(self._origin(k), parts[0])

    def _orientation(self, body: str) -> FloatArray:
        number = self._model.number(body)
        orientation = self._found.bodies["orientation"]
        return orientation[:, number] if number >= 0 else np.array([[1.0, 0.0, 0.0, 0.0]])

    def _origin(self, k: int) -> FloatArray:
        """Return where the origin of a coupling's shaft is [m], shape (n_t, 3)."""
        body, arm = self._model.ends[k][1], self._couplings[k].shaft_point
        number = self._model.number(body)
        place = self._found.bodies["position"][:, number] if number >= 0 else 0.0
        return np.asarray(place + rotated(self._orientation(body), arm))
