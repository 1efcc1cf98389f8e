"""Parameters of a journal in a bushing at rest but for its rotation, SI units."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from tribodyn.core.arrays import FloatArray
from tribodyn.core.errors import InputError
from tribodyn.joints import BushingJoint
from tribodyn.lubrication.film import Film


@dataclass(frozen=True)
class Loads:
    """Loads on the centre of the journal.

    Attributes
    ----------
    force_x, force_y
        W_x and W_y [N].
    moment_x, moment_y
        About X (right-handed) and Y (left-handed, as φ_y) [N m]; they matter with tilt only.
    """

    force_x: float
    force_y: float
    moment_x: float = 0.0
    moment_y: float = 0.0

    @property
    def force(self) -> float:
        """Size of the force [N]."""
        return math.hypot(self.force_x, self.force_y)

    @property
    def direction(self) -> FloatArray:
        """Unit vector along the force, shape (2,); along X where there is none."""
        if self.force == 0.0:
            return np.array([1.0, 0.0])
        return np.array([self.force_x, self.force_y]) / self.force


@dataclass(frozen=True)
class Journal:
    """A journal in a bushing under stated loads, for its static equilibrium.

    Attributes
    ----------
    tilts
        Whether the journal can tilt; otherwise it stays parallel to the bushing.
    speed
        Speed of rotation ω about Z, right-handed, kept by a drive [rad/s].
    loads
        Loads at the start.
    joint
        The bushing.
    film
        The oil film; none by default.
    changes
        Whether load or speed follow a table.

    Raises
    ------
    InputError
        If bushing and film are not of one size.
    """

    tilts: bool
    speed: float
    loads: Loads
    joint: BushingJoint
    film: Film | None = None
    changes: bool = False

    def __post_init__(self) -> None:
        """Refuse a film of another size than the bushing."""
        size, film = self.joint.geometry, self.film
        if film is None:
            return
        given = (film.clearance, film.radius, film.length)
        if not np.allclose(given, (size.clearance, size.radius, size.length), rtol=1e-9, atol=0.0):
            raise InputError("the film has another clearance, radius or length than the joint", key="film")

    @property
    def freedoms(self) -> int:
        """Number of degrees of freedom: 2, with tilt 4."""
        return 4 if self.tilts else 2
