"""Loads as a scene shows them: where they act, and their forces and moments at the frames, global axes."""

from dataclasses import dataclass
from typing import Final

import numpy as np
import xarray as xr

from tribodyn.cases.case import unit
from tribodyn.core.arrays import FloatArray
from tribodyn.core.signals import Signal
from tribodyn.mechanism.assembly.skeleton import Skeleton, rotated
from tribodyn.mechanism.mechanism_case import MechanismCase
from tribodyn.mechanism.model.drives_and_loads import LoadKeys
from tribodyn.mechanism.results.followed import OBSERVED, coordinate, followed_by
from tribodyn.mechanisms.shaft_loads import Factors, parts_of
from tribodyn.views.playback import playback_times

_OVER: Final = ("times", *OBSERVED)
_NUMBERS: Final = {over: number for number, over in enumerate(_OVER)}  #: Numbers of what signals follow.


@dataclass(frozen=True)
class LoadArrows:
    """Point, force and moment of a load at the frames."""

    point: FloatArray  #: Where its force acts [mm], shape (n_frames, 3).
    #: Global axes [N] and [N m], shapes (n_frames, 3).
    force: FloatArray
    moment: FloatArray


def load_arrows(
    dataset: xr.Dataset, case: MechanismCase, drawn: Skeleton, position: FloatArray, orientation: FloatArray
) -> dict[str, LoadArrows]:
    """Return points, forces and moments of loads at the frames, by name, for those with stored motion.

    ``dataset``, ``case``, ``drawn``: the result, its case, and what is drawn of it; ``position``,
    ``orientation``: of all bodies at the frames, shapes (n_frames, n_bodies, 3) and (n_frames, n_bodies, 4).
    """
    found = {}
    for name, load in case.loads.items():
        if not {*followed_by(load)} <= set(map(str, dataset.variables)):
            continue
        body = drawn.bodies.index(load.body)
        moved, turned = position[:, body], orientation[:, body]
        point = np.array([load.acts_at(case.bodies[load.body].centre)])
        where = drawn.moved(point, body, moved, turned)[:, 0]
        arm = rotated(turned, np.broadcast_to(point[0] - drawn.centres[body], moved.shape))
        force, moment = _Load(dataset, case, load, body).at(turned, arm)
        found[name] = LoadArrows(where, force, moment)
    return found


@dataclass(frozen=True)
class _Load:
    """A load on the body with a number, in a result."""

    dataset: xr.Dataset
    case: MechanismCase
    load: LoadKeys
    body: int

    def at(self, turned: FloatArray, arm: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return force and moment at the frames, from quaternions of the body and the arm of the force."""
        if self.load.frame == "motion":
            return self._opposing(arm)
        wrench = np.zeros((arm.shape[0], 6))
        for vector, factors in parts_of(self.load, _NUMBERS, self.case.period, self.case.span):
            wrench += self._product(factors)[:, None] * vector
        force, moment = wrench[:, :3], wrench[:, 3:]
        return (
            (rotated(turned, force), rotated(turned, moment))
            if self.load.frame == "body"
            else (force, moment)
        )

    def _opposing(self, arm: FloatArray) -> tuple[FloatArray, FloatArray]:
        spin = self._interpolated(self.dataset["angular_velocity"].values[:, self.body])
        of_moment = "moment" in self.load.given
        speed = spin
        if not of_moment:
            speed = self._interpolated(self.dataset["velocity"].values[:, self.body]) + np.cross(spin, arm)
        if self.load.direction is not None:
            line = np.array(unit(self.load.direction, "direction"))
            speed = np.outer(speed @ line, line)
        own = np.linalg.norm(speed, axis=-1)
        size = np.zeros_like(own)
        for _, factors in parts_of(self.load, _NUMBERS, self.case.period, self.case.span):
            size += self._product(factors, own)
        vector = -(size / np.maximum(own, self.load.slip))[:, None] * speed
        nothing = np.zeros_like(vector)
        return (nothing, vector) if of_moment else (vector, nothing)

    def _product(self, factors: Factors, own: FloatArray | None = None) -> FloatArray:
        """Return the product of signals at the frames; tables may follow the load's own speed."""
        found = np.ones(playback_times(self.dataset).shape)
        for signal, number in factors:
            found = found * _values(signal, self._followed(_OVER[number], own))
        return found

    def _followed(self, over: str, own: FloatArray | None) -> FloatArray:
        if over == "times":
            return playback_times(self.dataset)
        if self.load.along is None:
            assert own is not None
            return own
        columns = {OBSERVED[over]: self.dataset[OBSERVED[over]].values}
        return self._interpolated(coordinate(self.case, columns, self.load.along, over))

    def _interpolated(self, values: FloatArray) -> FloatArray:
        """Return rows at the frames, shape (n_frames, ...)."""
        times, time = playback_times(self.dataset), self.dataset["time"].values
        if values.ndim == 1:
            return np.interp(times, time, values)
        return np.stack([np.interp(times, time, column) for column in values.T], axis=-1)


def _values(signal: Signal, places: FloatArray) -> FloatArray:
    """Return the values of a signal, shape of ``places``."""
    if signal.kind != "table":
        return np.array([signal.at(place) for place in places.tolist()])
    if signal.period:
        places = signal.knots[0] + np.mod(places - signal.knots[0], signal.period)
    return signal(places)
