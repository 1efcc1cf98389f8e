"""Oblique impact of a sphere on a plate with friction, with and without tangential compliance.

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
from dataclasses import dataclass
from typing import Final, Literal, Protocol

import numpy as np

from tribodyn.contact.damping_factors import DAMPING_FACTORS

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
