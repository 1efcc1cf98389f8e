"""Point contact of a trunnion in its bushing, and surfaces that a run has pressed together.

Smooth bodies and one contact at each end of the bushing, which carries half the line load. With the composite
modulus E, radii r_j and r_b = r_j + c and the penetration δ = ρ − c:

- Lankarani and Nikravesh (1990), the sphere of Hertz: F = K δ^1.5, K = (4/3) E √(r_j r_b/c).
- Johnson (1985), cylinders: δ = f/(πE) [ln(4πE c/f) − 1] with the load per length f; it has no
  solution beyond δ = 4c/e², and goes on as a straight line from δ = 8c/e³.

Both are multiplied by 1 + a δ̇/δ̇₋ with the damping factor a of the case.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from typing import Final, TypeAlias

import numpy as np

from mebdf.arrays import FloatArray
from mebdf.kernels.elementary import portable
from tribodyn.contact import OURS
from tribodyn.contact.bulk import Bulk, Liner, lined
from tribodyn.contact.contact_law import MEMORYLESS, ContactLaw
from tribodyn.contact.table import table_of_nodes, tabulate
from tribodyn.core.errors import InputError
from tribodyn.core.remembered import ContactTable
from tribodyn.joints.shapes import Guide, Pads, Slot
from tribodyn.joints.shapes.surface import Points
from tribodyn.kernels.lookup import pressure_and_damping

INTERVALS: Final = 4096
_ITERATIONS: Final = 8  #: Far from the branch point at −1/e: the argument is above −2/e².


Curve = tuple[FloatArray, FloatArray]  #: Force of the whole bushing [N] and its slope [N/m] over penetration.


def lankarani_nikravesh(depth: FloatArray, modulus: float, cylinders: Points) -> Curve:
    """Return force and slope at penetrations ``depth`` [m], shape (n,); ``modulus`` is composite [Pa]."""
    radius = cylinders.radius * cylinders.bore_radius / cylinders.clearance
    stiffness = 4.0 / 3.0 * modulus * math.sqrt(radius)
    root = np.sqrt(depth)
    return stiffness * depth * root, 1.5 * stiffness * root


def johnson(depth: FloatArray, modulus: float, cylinders: Points) -> Curve:
    """Return force and slope at penetrations ``depth`` [m], shape (n,); ``modulus`` is composite [Pa].

    With x = f/(4πEc) the formula is x ln(ex) = −δ/4c, solved by the Lambert W function: ln(ex) = W₋₁(−eδ/4c).
    """
    compliance = 1.0 / (math.pi * modulus)
    straight = 8.0 * cylinders.clearance * portable.exp(-3.0)
    curved = np.clip(depth, 1e-300, straight)
    logarithm = _lower_lambert(-math.e * curved / (4.0 * cylinders.clearance))
    load = 4.0 * cylinders.clearance / compliance * portable.exp(logarithm - 1.0)
    slope = 1.0 / (compliance * (-1.0 - logarithm))
    load = load + slope * np.maximum(depth - straight, 0.0)
    touching = depth > 0.0
    return cylinders.length * load * touching, cylinders.length * slope * touching


def _lower_lambert(a: FloatArray) -> FloatArray:
    """Return the w ≤ −1 with w eʷ = a, −1/e < a < 0, by Newton's method for w + ln(w/a) = 0."""
    w = portable.log(-a) - portable.log(-portable.log(-a))
    for _ in range(_ITERATIONS):
        w = w * (1.0 - portable.log(w / a)) / (1.0 + w)
    return np.asarray(w)


POINT_CONTACTS: dict[str, Callable[[FloatArray, float, Points], Curve]] = {
    "point-lankarani-nikravesh": lankarani_nikravesh,
    "point-johnson": johnson,
}
SURFACE: Final = "surface"
CONTACTS: Final = (SURFACE, *POINT_CONTACTS)  #: Kinds of contact between a trunnion and its bushing.


# Runs that differ in a clearance or a load share a table, which takes a twentieth of a run.
_kept = lru_cache(maxsize=16)(tabulate)


def surface_table(
    law: ContactLaw, *, onset: float, smoothing_width: float, liner: Liner | None
) -> ContactTable:
    """Tabulate the pressure over the surface, whose asperities stand on a liner or on what is rigid."""
    # A law from elsewhere may be more than its fields say, and its class another than a run ago.
    make = _kept if type(law) in OURS else tabulate
    table = make(law, onset=onset, smoothing_width=smoothing_width)
    return table if liner is None else lined(table, liner.stiffness * law.pair.roughness_rms)


def point_table(name: str, law: ContactLaw, cylinders: Points, points: int = 2) -> ContactTable:
    """Tabulate the force of one point over (c − ρ)/σ, from a penetration by the whole clearance to none.

    The law gives the materials, the damping factor and, at its design pressure, the restitution; ``points``
    share the force of the joint, such as the ends of a bushing.
    """
    if law.factor.dashpot:
        raise InputError(
            f"{law.damping_factor} is not for a point contact: its dashpot would push at the touch",
            key="contact.damping_factor",
        )
    sigma = law.pair.roughness_rms
    depth = np.linspace(cylinders.clearance, 0.0, INTERVALS + 1)
    force, slope = POINT_CONTACTS[name](depth, law.pair.composite_modulus, cylinders)
    step = cylinders.clearance / (sigma * INTERVALS)
    force, rise = force / points, -slope * sigma * step / points
    ratio = point_damping(law)
    nodes = np.column_stack([force, rise, ratio * force, ratio * rise])
    return table_of_nodes(-cylinders.clearance / sigma, step, nodes)


def point_damping(law: ContactLaw) -> float:
    """Return the ratio a of damping to stiffness of a point contact with the restitution of a law [1]."""
    if law.loss_coefficient is not None:
        return 1.5 * law.loss_coefficient * MEMORYLESS
    if law.damping_factor == "none":
        return 0.0
    where = np.array([0.0 if law.restitution is not None else law.design_separation()])
    return float(law.factor(law.meant_restitution(where))[0])


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
Cornered: TypeAlias = FlatWalls | Pads  #: Shapes whose room has corners, where a shaft can rest.
#: Distance of a point beyond the walls, over the clearance: loads so much smaller than others do not move.
_FAR: Final = 1.0e3


def resting(shape: Cornered, loads: FloatArray) -> FloatArray:
    """Return displacement and rotation of a smooth, rigid shaft that loads hold against walls, (n, 6).

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
