"""The clearance joint that a case describes."""

from __future__ import annotations

from tribodyn.cases.journal import Journal as JournalCase
from tribodyn.cases.vsv import Vsv as VsvCase
from tribodyn.joints import BushingGeometry, BushingJoint, EntryMemory, Friction, Grid, contact_table


def joint(case: VsvCase | JournalCase, law: str | None = None) -> BushingJoint:
    """Return the clearance joint of a case with its tabulated contact law.

    Parameters
    ----------
    case
        The case.
    law
        Name of a contact law to use instead of ``contact.law``, with the same options.
    """
    contact = case.contact
    geometry = BushingGeometry(case.joint.clearance, case.joint.radius, case.joint.length)
    return BushingJoint(
        geometry=geometry,
        friction=Friction(case.joint.friction_coefficient, case.joint.friction, case.joint.slip_velocity),
        entry=EntryMemory(contact.onset_separation, contact.minimum_entry_velocity, contact.tensile_clip),
        grid=Grid(case.solver.grid.theta, case.solver.grid.z),
        roughness=case.surface_pair.roughness_rms,
        table=contact_table(
            case.joint.contact,
            contact.law_of(case.surface_pair, law),
            geometry,
            onset=contact.onset_separation,
            smoothing_width=contact.smoothing_width,
        ),
        contact=case.joint.contact,
    )
