"""The bounce test of a case: which restitution every law and damping factor really gives on its surfaces."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import numpy as np

from tribodyn.contact import DAMPING_FACTORS, LAWS, RSDC
from tribodyn.contact.bounce import bounce
from tribodyn.joints import SURFACE, BushingJoint, EntryMemory, Friction, Grid, contact_table
from tribodyn.joints.drop import design_speed, drop
from tribodyn.mechanisms.bushing import HasBushing


@dataclass(frozen=True)
class Row:
    """Restitution wanted and realised, of one law with one damping factor.

    Attributes
    ----------
    law, factor
        Their names.
    wanted
        Restitution given to the factor [1].
    point
        What one impact of a point gives, F = K δⁿ (1 + a δ̇/δ̇₋), or K δ + D δ̇ of ``kelvin-voigt`` [1].
    plate, shaft
        What a plate and a shaft give on these surfaces [1].
    """

    law: str
    factor: str
    wanted: float
    point: float
    plate: float
    shaft: float


def bounces(case: HasBushing, names: Iterable[str] = LAWS, *, mass: float = 0.253) -> Iterator[Row]:
    """Drop a plate and a shaft on laws with every damping factor, on the surfaces of a case.

    Both arrive with the energy that takes them to ``contact.design_pressure`` without damping.

    Parameters
    ----------
    case
        A case with one clearance joint. Without a ``contact.restitution`` that of ``rsdc`` at the design
        pressure is given to all factors.
    names
        Names of the laws, all by default.
    mass
        Mass of the shaft [kg]; it matters by its speed alone, which meets the least entry velocity.
    """
    wanted = case.contact.restitution or _own_restitution(case)
    for name in names:
        for factor in DAMPING_FACTORS:
            yield _row(case, name, factor, wanted, mass)


def _own_restitution(case: HasBushing) -> float:
    law = RSDC(case.surface_pair, design_pressure=case.contact.design_pressure)
    return float(law.meant_restitution(np.array([law.design_separation()]))[0])


def _row(case: HasBushing, name: str, factor: str, wanted: float, mass: float) -> Row:
    changes = {"law": name, "damping_factor": factor, "restitution": wanted, "loss_coefficient": None}
    contact = case.contact.model_copy(update=changes)
    onset, pressure = contact.onset_separation, contact.design_pressure
    chosen = contact.law_of(case.surface_pair)
    geometry = case.temperature.dimensions(case.joint, case.surfaces)
    liner = case.joint.liner.layer(case.surfaces.bushing)
    width = contact.smoothing_width
    table = contact_table(SURFACE, chosen, geometry, onset=onset, smoothing_width=width, liner=liner)
    joint = BushingJoint(
        geometry=geometry,
        friction=Friction(0.0, case.joint.friction, case.joint.slip_velocity),
        entry=EntryMemory(onset, contact.minimum_entry_velocity, contact.tensile_clip),
        grid=Grid(4 * case.solver.grid.theta, 2),
        roughness=case.surface_pair.roughness_rms,
        table=table,
    )
    speed = design_speed(joint, mass=mass, pressure=pressure)
    return Row(
        law=name,
        factor=factor,
        wanted=wanted,
        point=float(DAMPING_FACTORS[factor].realised(np.array(wanted))),
        plate=bounce(table, onset=onset, design_pressure=pressure, clip=contact.tensile_clip).restitution,
        shaft=drop(joint, mass=mass, speed=speed).restitution,
    )
