"""Surfaces that touch in a joint: how deep a run has pressed them together, and shafts between flat walls."""

import math
from dataclasses import dataclass
from typing import Final, TypeAlias

import numpy as np

from mebdf.kernels.elementary import portable
from tribodyn.contact.bulk import Bulk, Liner
from tribodyn.core.arrays import FloatArray
from tribodyn.core.remembered import ContactTable
from tribodyn.joints.point_contact import SURFACE
from tribodyn.joints.shapes import Guide, Slot
from tribodyn.kernels.lookup import pressure_and_damping

_EDGE = 0.01  #: Share of the largest pressure at which a contact ends.


@dataclass(frozen=True)
class Touch:
    """Two surfaces of a joint."""

    roughness: float  #: Combined rms roughness σ [m].
    table: ContactTable  #: Tabulated contact law, or the force of a point contact.
    contact: str  #: One of :data:`~tribodyn.joints.point_contact.CONTACTS`.
    #: What the asperities stand on, which the table allows for; None where that is rigid.
    liner: Liner | None
    clearance: float  #: Radial clearance [m]; NaN for surfaces that do not curve round each other.
    bore_radius: float  #: Radius of the bore or race [m]; NaN likewise.
    bulk: Bulk | None = None  #: Elastic bodies under the asperities, in the place of a liner.
    size: float = math.nan  #: Half the width of a surface that does not curve [m].

    @property
    def over_surface(self) -> bool:
        """Whether the contact is over the surface, not at points."""
        return self.contact == SURFACE

    def asperity_separation(self, gap: float) -> float:
        """Return the mean planes' distance s over σ where they would be ``gap`` [m] apart unloaded [1]."""
        table, compliance = self._under(gap)
        pressure = float(pressure_and_damping(table, gap / self.roughness)[0])
        return (gap + pressure * compliance) / self.roughness if compliance else gap / self.roughness

    def _under(self, gap: float) -> tuple[ContactTable, float]:
        """Return the table over the gap and the compliance below the asperities [m/Pa] at a gap."""
        if self.bulk is None:
            return self.table, 0.0 if self.liner is None else 1.0 / self.liner.stiffness
        if math.isfinite(self.bore_radius):
            compliance = self.bulk.of_arc(gap, self.clearance, self.bore_radius)
        else:
            compliance = self.bulk.compliance(self.size)
        return self.bulk.on(compliance), compliance

    def half_width(self, gap: float) -> float:
        """Return half the arc on which an untilted shaft presses, where its least gap is ``gap`` [m].

        It ends where the pressure is a hundredth of the largest; NaN for surfaces that do not curve.
        """
        table, clearance = self._under(gap)[0], self.clearance
        peak = float(pressure_and_damping(table, gap / self.roughness)[0])
        pressing = int((table.nodes[:, 0] > _EDGE * peak).sum())
        edge = self.roughness * (table.h_first + (pressing - 1) / table.inverse_step)
        cosine = min(max((clearance - edge) / (clearance - gap), -1.0), 1.0)
        return self.bore_radius * float(portable.acos(cosine))


FlatWalls: TypeAlias = Guide | Slot  #: Shapes with flat walls.
#: Distance of a point beyond the walls, over the clearance: loads so much smaller than others do not move.
_FAR: Final = 1.0e3


def resting(shape: FlatWalls, loads: FloatArray) -> FloatArray:
    """Return displacement and rotation of a smooth, rigid shaft that loads hold against flat walls, (n, 6).

    Loads are forces [N] and moments [N m] about its middle, shape (n, 6); those along the axis do not count.
    It goes as far as the walls let it, and only as far as the loads push it: the point of all allowed ones
    that is next to one far away in the direction of the loads, by the active set of Lawson and Hanson (1974).
    """
    from scipy.optimize import nnls

    corners, gaps = shape.corners()
    unit = shape.clearance / np.array([1.0, 1.0, 1.0, *3 * [0.5 * shape.length]])
    corners, gaps = corners * unit / shape.clearance, gaps / shape.clearance
    found, pushed = np.zeros(loads.shape), loads * unit * corners.any(axis=0)
    for place, load in zip(found, pushed, strict=True):
        if load.any():
            far = _FAR * load / np.linalg.norm(load)
            matrix, wanted = np.vstack([-corners.T, corners @ far - gaps]), np.eye(7)[6]
            rest = matrix @ nnls(matrix, wanted)[0] - wanted
            place[:] = unit * (far - rest[:6] / rest[6])
    return found
