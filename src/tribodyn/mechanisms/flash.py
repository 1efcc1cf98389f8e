"""Flash temperature of a joint with clearance: an estimate where the conductors of heat are known."""

import math
from collections.abc import Mapping

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.cases.groups import Bushing, Surfaces, Trunnion
from tribodyn.contact.contact_law import ContactLaw
from tribodyn.contact.surface_pair import Conductor, flash_temperature
from tribodyn.joints import BushingJoint
from tribodyn.joints.point_contact import Touch


def has_conductors(surfaces: Surfaces) -> bool:
    """Return whether conductivity and diffusivity of both surfaces are given."""
    return all(_conductor(surface) is not None for surface in (surfaces.trunnion, surfaces.bushing))


def flash_of(
    surfaces: Surfaces,
    law: ContactLaw,
    touch: Touch,
    *,
    friction_coefficient: float,
    pressure: float,
    separation: float,
    speed: float,
) -> float:
    """Return the flash temperature of a contact at one instant [K]; NaN where it is not known.

    The heat μ p V is spread over the real area of contact that the law has at the smallest gap, or over p/H
    where it has none, in as many equal spots as asperities touch. They belong to the rougher surface and pass
    over the other.

    ``surfaces``, ``law``, ``touch``: both surfaces with what they do with heat, and their contact;
    ``friction_coefficient``: μ [1]; ``pressure``, ``separation``, ``speed``: largest pressure p [Pa],
    smallest gap [m], and speed of sliding V [m/s].
    """
    trunnion, bushing = _conductor(surfaces.trunnion), _conductor(surfaces.bushing)
    if trunnion is None or bushing is None or not touch.over_surface:
        return math.nan
    gap, pair = np.array([touch.asperity_separation(separation)]), law.pair
    real, count = float(law.real_area_fraction(gap)[0]), float(law.contact_count(gap)[0])
    real = pressure / pair.hardness if math.isnan(real) else real
    count = pair.asperity_density * float(law.touching_share(gap)[0]) if math.isnan(count) else count
    if not (real > 0.0 and count > 0.0):
        return 0.0
    rougher = surfaces.bushing.roughness >= surfaces.trunnion.roughness
    standing, passing = (bushing, trunnion) if rougher else (trunnion, bushing)
    radius = math.sqrt(real / (math.pi * count))
    return flash_temperature(friction_coefficient * pressure * speed / real, radius, speed, standing, passing)


def flash_of_bushing(
    surfaces: Surfaces,
    law: ContactLaw,
    joint: BushingJoint,
    rows: Mapping[str, FloatArray],
    speed: FloatArray,
) -> dict[str, float]:
    """Return the flash temperature of a bushing where pressure times speed was largest, by name.

    ``surfaces``, ``law``: as for :func:`flash_of`; ``rows``: columns of the run, of which pressures and gaps
    are used; ``speed``: of sliding at each row [m/s], shape (n_t,).
    """
    if not (has_conductors(surfaces) and joint.touch.over_surface and speed.size):
        return {}
    row = int(np.argmax(rows["p_max"] * np.abs(speed)))
    flash = flash_of(
        surfaces,
        law,
        joint.touch,
        friction_coefficient=joint.friction.coefficient,
        pressure=float(rows["p_max"][row]),
        separation=float(rows["separation_min"][row]),
        speed=abs(float(speed[row])),
    )
    return {"flash_temperature": flash}


def _conductor(surface: Trunnion | Bushing) -> Conductor | None:
    """Return the thermal properties of a body; None where they are not given."""
    if surface.conductivity is None or surface.diffusivity is None:
        return None
    return Conductor(surface.conductivity, surface.diffusivity)
