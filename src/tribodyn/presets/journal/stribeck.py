"""The Stribeck curve: friction of a loaded journal over its speed, and who carries the load.

At low speed asperities carry the load and friction is theirs; at high speed the film does and friction grows
with speed as its shear does. In between, in mixed lubrication, friction is least.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from tribodyn.core.arrays import FloatArray
from tribodyn.core.errors import InputError
from tribodyn.presets.journal.equilibrium import Equilibrium, equilibrium
from tribodyn.presets.journal.parameters import Journal


@dataclass(frozen=True)
class Stribeck:
    """Static equilibria of a journal over its speed.

    Attributes
    ----------
    points
        The equilibria, in the order of the speeds asked for.
    """

    points: tuple[Equilibrium, ...]

    @property
    def speed(self) -> FloatArray:
        """Speed of rotation [rad/s], shape (n,)."""
        return np.array([point.journal.speed for point in self.points])

    @property
    def friction_coefficient(self) -> FloatArray:
        """Friction moment over radius and load [1], shape (n,)."""
        return np.array([point.friction_coefficient for point in self.points])

    @property
    def film_share(self) -> FloatArray:
        """Share of the load that the film carries [1], shape (n,)."""
        return np.array([point.film_share for point in self.points])

    @property
    def contact_share(self) -> FloatArray:
        """Share of the load that asperities carry [1], shape (n,)."""
        return np.array([point.contact_share for point in self.points])

    @property
    def eccentricity(self) -> FloatArray:
        """Distance of the centre from the axis of the bushing [m], shape (n,)."""
        return np.array([point.eccentricity for point in self.points])


def stribeck(journal: Journal, speeds: Iterable[float]) -> Stribeck:
    """Return the Stribeck curve of a journal; each equilibrium starts from the one before.

    Parameters
    ----------
    journal
        The journal, its load and its film.
    speeds
        Speeds of rotation [rad/s], in an order in which neighbours are near.

    Raises
    ------
    InputError
        If there is no load, or no equilibrium at one of the speeds.
    """
    if journal.loads.force == 0.0:
        raise InputError("a Stribeck curve needs a load", key="loads.force_x")
    if journal.changes:
        raise InputError("a Stribeck curve needs loads and speeds that no table changes", key="loads.more")
    points: list[Equilibrium] = []
    for speed in speeds:
        guess = points[-1].attitude if points else None
        points.append(equilibrium(journal, speed=float(speed), guess=guess))
    return Stribeck(tuple(points))
