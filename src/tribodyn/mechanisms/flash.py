"""Flash temperature of a clearance joint: an estimate where the conductors of heat are known."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np

from tribodyn.cases.groups import Bushing, Trunnion
from tribodyn.contact.flash_temperature import Conductor, flash_temperature
from tribodyn.core.arrays import FloatArray
from tribodyn.joints import SURFACE, BushingJoint
from tribodyn.mechanisms.bushing import HasBushing


def flash_of(
    case: HasBushing, joint: BushingJoint, rows: Mapping[str, FloatArray], speed: FloatArray
) -> dict[str, float]:
    """Return the flash temperature where pressure times speed was largest, by name; else nothing.

    The heat μ p V of a pressure p is spread over the real area of contact that the law has at the smallest
    gap of that time, or over p/H where it has none, in as many equal spots as asperities touch. They belong
    to the rougher surface and pass over the other.

    Parameters
    ----------
    case, joint
        The case and its joint.
    rows
        Columns of the run, of which pressures and gaps are used.
    speed
        Of sliding at each row [m/s], shape (n_t,).
    """
    trunnion, bushing = _conductor(case.surfaces.trunnion), _conductor(case.surfaces.bushing)
    if trunnion is None or bushing is None or joint.contact != SURFACE or not speed.size:
        return {}
    row = int(np.argmax(rows["p_max"] * np.abs(speed)))
    pressure, sliding = float(rows["p_max"][row]), abs(float(speed[row]))
    pair = case.surface_pair
    law = case.contact.law_of(pair)
    gap = np.array([joint.touch.asperity_separation(float(rows["separation_min"][row]))])
    real, count = float(law.real_area_fraction(gap)[0]), float(law.contact_count(gap)[0])
    real = pressure / pair.hardness if math.isnan(real) else real
    count = pair.asperity_density * float(law.touching_share(gap)[0]) if math.isnan(count) else count
    if not (real > 0.0 and count > 0.0):
        return {"flash_temperature": 0.0}
    rougher = case.surfaces.bushing.roughness >= case.surfaces.trunnion.roughness
    standing, passing = (bushing, trunnion) if rougher else (trunnion, bushing)
    flux = joint.friction.coefficient * pressure * sliding / real
    radius = math.sqrt(real / (math.pi * count))
    return {"flash_temperature": flash_temperature(flux, radius, sliding, standing, passing)}


def _conductor(surface: Trunnion | Bushing) -> Conductor | None:
    """Return what a body does with heat; None where that is not given."""
    if surface.conductivity is None or surface.diffusivity is None:
        return None
    return Conductor(surface.conductivity, surface.diffusivity)
