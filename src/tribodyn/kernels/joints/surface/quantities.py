"""Quantities of a surface of a clearance joint: its report of an instant, its peaks.

On the shaft, in the socket's frame, moments about the shaft's origin.
"""

from typing import Final

from tribodyn.core.quantities import Quantity, of_table


def _wrench(force: str, moment: str, meaning: str) -> tuple[Quantity, ...]:
    """Return a force and a moment by components."""
    return (
        *(Quantity(force + axis.lower(), "N", f"{meaning} along {axis}") for axis in "XYZ"),
        *(Quantity(moment + axis.lower(), "N m", f"moment of the {meaning} about {axis}") for axis in "XYZ"),
    )


#: The report of an instant.
REPORTED: Final = (
    *_wrench("F_c", "M_c", "normal contact force"),
    *_wrench("F_k", "M_k", "rigid (asperity stiffness) part of the contact force"),
    *_wrench("F_f", "M_f", "friction force"),
    Quantity("damping_power", "W", "power of the damping pressure, turned into heat"),
    Quantity("friction_power", "W", "power of friction, negative: turned into heat"),
    Quantity("energy_contact", "J", "energy stored in the contact"),
    Quantity("expansion_power", "W", "power of an opening clearance on what the contact stores"),
    Quantity("p_max", "Pa", "peak contact pressure, edges included"),
    Quantity("separation_min", "m", "smallest gap, negative where mean surfaces overlap"),
    Quantity("tensile_clip_share", "1", "share of the contact area where the clip of tensile pressure acts"),
    Quantity("contact_fraction", "1", "share of the surface in contact"),
)

#: At an instant, and the largest of a run.
PLASTIC: Final = Quantity("plastic_share", "1", "share of the contact area that carries the hardness", ())

#: Over all accepted steps; output times would miss them.
PEAKS: Final = (
    Quantity("contact_force_peak", "N", "largest contact force at any accepted step", ()),
    Quantity("contact_force_peak_time", "s", "when the contact force was largest", ()),
    Quantity("pressure_peak", "Pa", "largest contact pressure at any accepted step", ()),
    Quantity("pressure_peak_time", "s", "when the contact pressure was largest", ()),
    Quantity("separation_least", "m", "smallest gap at any accepted step", ()),
    Quantity("tensile_clip_time", "s", "time integral of the share of the contact where the clip acts", ()),
)

Report = of_table((*REPORTED, PLASTIC))
Peaks = of_table((*PEAKS, PLASTIC))
