"""Two surfaces that touch in a joint, and how deep a run has pressed them together."""

from dataclasses import dataclass

from mebdf.kernels.elementary import portable
from tribodyn.contact.liner import Liner
from tribodyn.core.tables import ContactTable
from tribodyn.joints.point_contact import SURFACE
from tribodyn.kernels.lookup import pressure_and_damping

_EDGE = 0.01
"""Share of the largest pressure at which a contact ends."""


@dataclass(frozen=True)
class Touch:
    """Two surfaces of a joint.

    Attributes
    ----------
    roughness
        Combined rms roughness σ [m].
    table
        Tabulated contact law, or the force of a point contact.
    contact
        One of :data:`~tribodyn.joints.point_contact.CONTACTS`.
    liner
        What the asperities stand on, which the table allows for; None where that is rigid.
    clearance
        Radial clearance [m]; NaN for surfaces that do not curve round each other.
    bore_radius
        Radius of the bore or race [m]; NaN likewise.
    """

    roughness: float
    table: ContactTable
    contact: str
    liner: Liner | None
    clearance: float
    bore_radius: float

    @property
    def over_surface(self) -> bool:
        """Whether the contact is over the surface, not at points."""
        return self.contact == SURFACE

    def asperity_separation(self, gap: float) -> float:
        """Return the mean planes' distance s over σ where they would be ``gap`` [m] apart unloaded [1]."""
        h_star = gap / self.roughness
        if self.liner is None:
            return h_star
        pressure = float(pressure_and_damping(self.table, h_star)[0])
        return h_star + pressure / (self.liner.stiffness * self.roughness)

    def half_width(self, gap: float) -> float:
        """Return half the arc on which an untilted shaft presses, where its least gap is ``gap`` [m].

        It ends where the pressure is a hundredth of the largest; NaN for surfaces that do not curve.
        """
        table, clearance = self.table, self.clearance
        peak = float(pressure_and_damping(table, gap / self.roughness)[0])
        pressing = int((table.nodes[:, 0] > _EDGE * peak).sum())
        edge = self.roughness * (table.h_first + (pressing - 1) / table.inverse_step)
        cosine = min(max((clearance - edge) / (clearance - gap), -1.0), 1.0)
        return self.bore_radius * float(portable.acos(cosine))
