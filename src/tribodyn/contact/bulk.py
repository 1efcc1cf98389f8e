"""Elastic bodies under the asperities: a contact law at levels of compliance, for kernels to go between.

How the compliance follows a contact is in ``kernels/joints/surface/bulk.py``. Each level is the law on a
liner of its stiffness: pressure, damping and energy are those of asperities and a foundation in series.
"""

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Final

from tribodyn.contact.liner import lined
from tribodyn.core.remembered import ContactTable
from tribodyn.kernels.joints.surface.bulk import ARC, KAPPA, ROUNDING, WIDEST

LEVELS: Final = 16  #: Intervals between levels, equal in the square root of the compliance.
DEEP: Final = 48.0  #: Depth of the tables of levels below a gap of zero, in σ; below it they go on linearly.
STRIDE: Final = 8  #: Nodes of the contact table to one of a level.


@dataclass(frozen=True)
class Bulk:
    """Two elastic bodies under a contact law."""

    table: ContactTable  #: The contact law, tabulated over the separation.
    roughness: float  #: Combined rms roughness σ [m].
    modulus: float  #: Composite modulus E of both bodies [Pa].
    size: float  #: Largest radius of a bore, or half width of a face, under this law [m].

    def compliance(self, half_width: float) -> float:
        """Return depth over pressure of a long contact, from half its width [m], in [m/Pa]."""
        return half_width / (KAPPA * self.modulus)

    def on(self, compliance: float) -> ContactTable:
        """Return the table over the gap where the bodies give way by a compliance [m/Pa]."""
        stiffness = self.roughness / compliance if compliance > 0.0 else math.inf
        return lined(self.table, stiffness, depth=DEEP, stride=STRIDE)

    @property
    def softest(self) -> float:
        """Compliance of the last level [m/Pa]."""
        return self.compliance(self.size)

    @cached_property
    def levels(self) -> tuple[ContactTable, ...]:
        """The tables of all levels."""
        return tuple(self.on(self.softest * (k / LEVELS) ** 2) for k in range(LEVELS + 1))

    def of_arc(self, gap: float, clearance: float, radius: float) -> float:
        """Return the compliance of an untilted shaft in its bore [m/Pa].

        Parameters
        ----------
        gap
            Least gap between the undeformed surfaces [m].
        clearance, radius
            Radial clearance and radius of the bore [m].
        """
        overlap = 0.5 * (math.hypot(gap, 2.0 * ROUNDING * self.roughness) - gap)
        y = min(overlap / (clearance + overlap), WIDEST)
        fit = sum(a * y**k for k, a in enumerate(ARC))
        return radius * math.sqrt(2.0 * y) * fit / self.modulus
