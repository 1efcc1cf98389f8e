"""Tangential restitution of an oblique impact of a sphere, with and without tangential compliance.

The normal force is Hertz's with a damping factor, N = K δ^1.5 (1 + a δ̇/δ̇₋). The tangential force T on the
sphere follows from the slip velocity u = v_t + R ω of the contact point by one of two laws:

- ``regularised``: T = −μ N u/√(u² + u_s²), as in the joints of a mechanism; the contact has no tangential
  compliance.
- ``compliant``: Coulomb friction at every place of an elastic contact, so that its edge slips while its
  centre sticks (Cattaneo 1938, Mindlin 1949). It is solved by the method of dimensionality reduction (V. L.
  Popov, M. Heß, "Method of Dimensionality Reduction in Contact Mechanics and Friction", 2015): independent
  springs under a parabola x²/R with the stiffness E per length across the plate and G along it, which slip
  one by one. For a sphere this gives the forces of the half-space for any history of the load.

Sphere and plate are rigid but for the contact; gravity is left out.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial
from typing import Final, Literal, Protocol

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.contact.damping_factors import DAMPING_FACTORS
from tribodyn.validation.base import Band, Comparison, Curve, Outcome, Plot
from tribodyn.validation.catalogue import ValidationSet, varied

TangentialLaw = Literal["regularised", "compliant"]
STEPS: Final = 2000  #: Steps per duration of the undamped impact.
_SPRINGS: Final = 200
#: Duration of Hertz's impact in units of the largest penetration over the speed of approach.
_DURATION: Final = 2.9432752
_INERTIA: Final = 0.4  #: Moment of inertia of a homogeneous sphere over m R².
_DEEPER: Final = 1.05  #: Room for the penetration of a damped impact, over that of the undamped one.


@dataclass(frozen=True)
class ImpactingSphere:
    """A sphere, the plate that it hits and the contact between them."""

    #: Of the sphere [m, kg/m³].
    radius: float
    density: float
    #: Of sphere and plate [Pa, 1].
    young_modulus: tuple[float, float]
    poisson_ratio: tuple[float, float]
    #: Coefficient of friction μ and normal restitution e [1].
    friction: float
    restitution: float
    slip_velocity: float = 1.0e-3  #: Slip u_s at which regularised friction is developed to 71 % [m/s].

    @property
    def mass(self) -> float:
        """Mass [kg]."""
        return 4.0 / 3.0 * math.pi * self.radius**3 * self.density

    @property
    def normal_modulus(self) -> float:
        """Composite modulus E, 1/E = Σ (1 − ν²)/E_i [Pa]."""
        pairs = zip(self.young_modulus, self.poisson_ratio, strict=True)
        return 1.0 / sum((1.0 - nu**2) / young for young, nu in pairs)

    @property
    def tangential_modulus(self) -> float:
        """Composite modulus G, 1/G = Σ (2 − ν)(1 + ν)/(2 E_i) [Pa]."""
        pairs = zip(self.young_modulus, self.poisson_ratio, strict=True)
        return 1.0 / sum((2.0 - nu) * (1.0 + nu) / (2.0 * young) for young, nu in pairs)

    @property
    def mobility(self) -> float:
        """Change of the slip velocity per tangential impulse [1/kg]."""
        return (1.0 + 1.0 / _INERTIA) / self.mass


@dataclass(frozen=True)
class Rebound:
    """State after an impact."""

    #: Velocities of the centre after over before the impact [1].
    normal: float
    tangential: float
    #: Angular velocity [rad/s], positive where the contact point moves against the tangential velocity.
    spin: float

    def angle(self, incidence: float) -> float:
        """Return the angle of the rebound from the normal [rad] for an angle of incidence [rad]."""
        return math.atan2(self.tangential * math.sin(incidence), self.normal * math.cos(incidence))


def rebound(
    sphere: ImpactingSphere, speed: float, incidence: float, law: TangentialLaw, *, steps: int = STEPS
) -> Rebound:
    """Return the motion of a sphere without spin after it leaves a plate.

    ``sphere``: sphere and contact; ``speed``: speed before the impact [m/s]; ``incidence``: angle from the
    normal, between 0 and π/2 [rad]; ``steps``: steps per duration of the undamped impact.
    """
    approach, slide = speed * math.cos(incidence), speed * math.sin(incidence)
    stiffness = 4.0 / 3.0 * sphere.normal_modulus * math.sqrt(sphere.radius)
    deepest = (1.25 * sphere.mass * approach**2 / stiffness) ** 0.4
    damping = float(DAMPING_FACTORS["calibrated"](np.array(sphere.restitution)))
    step = _DURATION * deepest / approach / steps
    contact = _CONTACTS[law](sphere, deepest, step)
    depth, sinking, impulse = 0.0, approach, 0.0
    while (depth := depth + step * sinking) > 0.0:
        damped = max(1.0 + damping * sinking / approach, 0.0)
        impulse += contact.impulse(depth, damped, slide + impulse * sphere.mobility)
        sinking -= step * stiffness * depth**1.5 * damped / sphere.mass
    spin = -impulse / (_INERTIA * sphere.mass * sphere.radius)
    return Rebound(-sinking / approach, 1.0 + impulse / (sphere.mass * slide), spin)


class _ContactForce(Protocol):
    """A tangential law in steps of time."""

    def __init__(self, sphere: ImpactingSphere, deepest: float, step: float) -> None: ...

    def impulse(self, depth: float, damped: float, slip: float) -> float:
        """Return the tangential impulse of a step [N s] at a penetration [m] and slip velocity [m/s]."""


class _Regularised:
    """Regularised Coulomb friction, solved implicitly because it is stiff."""

    def __init__(self, sphere: ImpactingSphere, deepest: float, step: float) -> None:
        self.sphere, self.step = sphere, step

    def impulse(self, depth: float, damped: float, slip: float) -> float:
        sphere = self.sphere
        normal = 4.0 / 3.0 * sphere.normal_modulus * math.sqrt(sphere.radius) * depth**1.5 * damped
        largest = self.step * sphere.friction * normal * sphere.mobility
        size = abs(slip)
        low, high = max(size - largest, 0.0), size
        for _ in range(60):
            middle = 0.5 * (low + high)
            if middle + largest * middle / math.hypot(middle, sphere.slip_velocity) > size:
                high = middle
            else:
                low = middle
        return math.copysign(size - low, -slip) / sphere.mobility


class _Compliant:
    """Springs along a parabola, each with Coulomb friction."""

    def __init__(self, sphere: ImpactingSphere, deepest: float, step: float) -> None:
        self.sphere, self.step = sphere, step
        radius = math.sqrt(sphere.radius * deepest * _DEEPER)
        self.gap = (radius * (np.arange(_SPRINGS) + 0.5) / _SPRINGS) ** 2 / sphere.radius
        self.width = 2.0 * radius / _SPRINGS
        self.stretch = np.zeros(_SPRINGS)

    def impulse(self, depth: float, damped: float, slip: float) -> float:
        sphere, modulus = self.sphere, self.sphere.tangential_modulus
        pressed = np.maximum(depth - self.gap, 0.0) * sphere.normal_modulus * damped
        largest = sphere.friction * pressed / modulus
        self.stretch = np.clip(self.stretch + slip * self.step, -largest, largest)
        return -self.step * modulus * self.width * float(self.stretch.sum())


_CONTACTS: Final[dict[TangentialLaw, type[_ContactForce]]] = {
    "regularised": _Regularised,
    "compliant": _Compliant,
}


LAWS: Final[tuple[TangentialLaw, ...]] = ("regularised", "compliant")
SLIDING: Final = 30.0  #: Angle from which both laws are judged alike [deg].
STICKING: Final = 25.0  #: Angle below which the contact sticks for a part of the time [deg].
PLAIN_FAILS: Final = 10.0  #: Angle below which regularised friction must be shown failing [deg].


def compare(one: ValidationSet) -> Outcome:
    """Return the tangential restitution at every angle by both laws."""
    points = one.rows("tangential_restitution.csv")
    angles = [float(row["impact_angle_from_normal_deg"]) for row in points]
    measured = [float(row["tangential_restitution"]) for row in points]
    rows, curves = [], []
    for law in LAWS:
        result = varied(partial(restitutions, angles, law), one.inputs.values())
        curves.append(Curve(f"{law} friction", "computed", angles, result.values))
        for k, angle in enumerate(angles):
            name, widths = f"{law}, {angle:.1f} deg", (result.sides_at(k), one.value("reading"))
            by_hand, band = null_model(one, angle), _band(one, law, angle)
            rows.append(Comparison(name, "", result.values[k], measured[k], *widths, by_hand, band))
    width = [one.value("reading")] * len(angles)
    points_of = Curve("measured", "measured", angles, measured, width)
    null = Curve("momentum and Coulomb", "null", angles, [null_model(one, angle) for angle in angles])
    return Outcome(
        tuple(rows), Plot("angle from the normal [deg]", "tangential restitution", (points_of, *curves, null))
    )


def impact(given: Mapping[str, float], angle: float, law: TangentialLaw) -> Rebound:
    """Return the rebound at an angle of incidence [deg]."""
    sphere = ImpactingSphere(
        radius=0.5 * given["diameter"],
        density=given["density"],
        young_modulus=(given["young_sphere"], given["young_plate"]),
        poisson_ratio=(given["poisson_sphere"], given["poisson_plate"]),
        friction=given["friction"],
        restitution=given["restitution"],
        slip_velocity=given["slip_velocity"],
    )
    return rebound(sphere, given["speed"], math.radians(angle), law, steps=int(given["steps"]))


def restitutions(angles: list[float], law: TangentialLaw, given: Mapping[str, float]) -> FloatArray:
    """Return the tangential restitution at angles of incidence [deg], shape (n,)."""
    return np.array([impact(given, angle, law).tangential for angle in angles])


def null_model(one: ValidationSet, angle: float) -> float:
    """Return the restitution by momentum and Coulomb's law [1] at an angle of incidence [deg]."""
    return by_momentum({name: given.value for name, given in one.inputs.items()}, angle)


def by_momentum(given: Mapping[str, float], angle: float) -> float:
    """Return the restitution by momentum and Coulomb's law [1] for inputs; see :func:`null_model`."""
    lost = given["friction"] * (1.0 + given["restitution"]) / math.tan(math.radians(angle))
    return max(1.0 - lost, 5.0 / 7.0) if angle < SLIDING else 1.0 - lost


def _band(one: ValidationSet, law: TangentialLaw, angle: float) -> Band | None:
    if angle >= SLIDING:
        return one.bands["sliding"]
    if law == "compliant":
        return one.bands["compliant"] if angle < STICKING else None
    return one.bands["plain"] if angle < PLAIN_FAILS else None
