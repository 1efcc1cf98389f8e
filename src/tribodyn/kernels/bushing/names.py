"""Names of the states of a bushing joint and of what its report holds, in their order."""

from __future__ import annotations

from typing import Final

STATES: Final = ("e_x", "e_y", "phi_x", "phi_y", "e_x_dot", "e_y_dot", "phi_x_dot", "phi_y_dot")
REPORTED: Final = (
    "F_cx",
    "F_cy",
    "M_jcx",
    "M_jcy",
    "F_kx",
    "F_ky",
    "F_fx",
    "F_fy",
    "M_fx",
    "M_fy",
    "M_jf",
    "damping_power",
    "friction_power",
    "energy_contact",
    "p_max",
    "separation_min",
    "tensile_clip_share",
    "contact_fraction",
    "M_kx",
    "M_ky",
)
