"""The bounce test of a case: which restitution every law and damping factor really gives on its surfaces."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from tribodyn.contact import DAMPING_FACTORS, LAWS, RSDC
from tribodyn.contact.bounce import bounce
from tribodyn.joints import SURFACE, BushingJoint, EntryMemory, Grid, contact_table
from tribodyn.joints.drop import design_speed, drop
from tribodyn.joints.rows import resolving
from tribodyn.mechanisms.bushing import Bearing

_FINER: Final = 6  #: Refinement of the grid around; along the axis nothing changes.


@dataclass(frozen=True)
class BounceRow:
    """Restitution wanted and realised, of one law with one damping factor."""

    #: Their names.
    law: str
    factor: str
    wanted: float  #: Restitution given to the factor [1].
    #: What one impact of a point gives, F = K δⁿ (1 + a δ̇/δ̇₋), or K δ + D δ̇ of ``kelvin-voigt`` [1].
    point: float
    #: What a plate and a shaft give on these surfaces [1].
    plate: float
    shaft: float


def bounces(bearing: Bearing, names: Iterable[str] = LAWS, *, mass: float = 0.253) -> Iterator[BounceRow]:
    """Drop a plate and a shaft on laws with every damping factor, on the surfaces of a joint.

    Both arrive with the energy that takes them to ``contact.design_pressure`` without damping.

    ``bearing``: the joint. Without a ``contact.restitution`` that of ``rsdc`` at the design pressure is given
    to all factors. ``names``: names of the laws, all by default. ``mass``: mass of the shaft [kg]; it matters
    by its speed alone, which meets the least entry velocity.
    """
    wanted = bearing.contact.restitution or _own_restitution(bearing)
    for name in names:
        for factor in DAMPING_FACTORS:
            yield _row(bearing, name, factor, wanted, mass)


def _own_restitution(bearing: Bearing) -> float:
    law = RSDC(bearing.pair, design_pressure=bearing.contact.design_pressure)
    return float(law.meant_restitution(np.array([law.design_separation()]))[0])


def _row(bearing: Bearing, name: str, factor: str, wanted: float, mass: float) -> BounceRow:
    changes = {"law": name, "damping_factor": factor, "restitution": wanted, "loss_coefficient": None}
    contact = bearing.contact.model_copy(update=changes)
    onset, pressure = contact.onset_separation, contact.design_pressure
    chosen, width = contact.law_of(bearing.pair), contact.smoothing_width
    geometry, roughness = bearing.geometry, bearing.pair.roughness_rms
    table = contact_table(SURFACE, chosen, geometry, onset=onset, smoothing_width=width, liner=bearing.liner)
    joint = BushingJoint(
        geometry=geometry,
        friction=replace(bearing.friction, coefficient=0.0),
        entry=EntryMemory(onset, contact.minimum_entry_velocity, contact.tensile_clip),
        grid=Grid(_FINER * resolving(geometry.clearance, roughness)[0], 2),
        roughness=roughness,
        table=table,
    )
    speed = design_speed(joint, mass=mass, pressure=pressure)
    return BounceRow(
        law=name,
        factor=factor,
        wanted=wanted,
        point=float(DAMPING_FACTORS[factor].realised(np.array(wanted))),
        plate=bounce(table, onset=onset, design_pressure=pressure, clip=contact.tensile_clip).restitution,
        shaft=drop(joint, mass=mass, speed=speed).restitution,
    )
