"""Elastic bodies under the asperities: a contact law at levels of compliance, for kernels to go between.

How the compliance follows a contact is in ``kernels/joints/surface/bulk.py``. Each level is the law on a
liner of its stiffness: pressure, damping and energy are those of asperities and a foundation in series.
"""

import math
from dataclasses import dataclass
from typing import Final

import numpy as np

from mebdf.kernels.elementary import portable
from tribodyn.contact.contact_law import MEMORYLESS, ContactLaw
from tribodyn.contact.damping_factors import calibrated
from tribodyn.contact.liner import lined
from tribodyn.core.remembered import ContactTable, Remembered
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
    loss: float = 0.0  #: Damping over pressure of the bodies, see ``liner`` [1].

    def compliance(self, half_width: float) -> float:
        """Return depth over pressure of a long contact, from half its width [m], in [m/Pa]."""
        return half_width / (KAPPA * self.modulus)

    def on(self, compliance: float) -> ContactTable:
        """Return the table over the gap where the bodies give way by a compliance [m/Pa]."""
        stiffness = self.roughness / compliance if compliance > 0.0 else math.inf
        return lined(self.table, stiffness, depth=DEEP, stride=STRIDE, loss=self.loss)

    @property
    def softest(self) -> float:
        """Compliance of the last level [m/Pa]."""
        return self.compliance(self.size)

    @property
    def levels(self) -> tuple[ContactTable, ...]:
        """The tables of all levels, made once for equal bodies."""
        key = id(self.table), self.roughness, self.softest, self.loss
        return _levels.made(key, lambda: (self.table, self._made_levels()))[1]

    def _made_levels(self) -> tuple[ContactTable, ...]:
        return tuple(self.on(self.softest * (k / LEVELS) ** 2) for k in range(LEVELS + 1))

    def of_arc(self, gap: float, clearance: float, radius: float) -> float:
        """Return the compliance of an untilted shaft in its bore [m/Pa].

        ``gap``: least gap between the undeformed surfaces [m]; ``clearance``, ``radius``: radial clearance
        and radius of the bore [m].
        """
        overlap = 0.5 * (math.hypot(gap, 2.0 * ROUNDING * self.roughness) - gap)
        y = min(overlap / (clearance + overlap), WIDEST)
        fit = sum(a * y**k for k, a in enumerate(ARC))
        return radius * math.sqrt(2.0 * y) * fit / self.modulus


#: Levels with the contact table that they are made of: as long as it is kept, no other has its address.
_levels: Final[Remembered[tuple[ContactTable, tuple[ContactTable, ...]]]] = Remembered(16)


def elastic_bodies(table: ContactTable, law: ContactLaw, size: float) -> Bulk:
    """Return the bodies of a tabulated contact law, up to a radius or half width [m].

    They lose what the law says of all contacts, or by their loss factor η: πη of the stored energy in half a
    cycle, which makes the restitution exp(−πη/2). Sizes are rounded up to powers of two, so that joints share
    their levels.
    """
    pair, at_least = law.pair, 2.0 ** math.ceil(math.log2(size))
    if law.loss_coefficient is not None:
        loss = 1.5 * law.loss_coefficient * MEMORYLESS
    else:
        loss = float(calibrated(portable.exp(np.array([-0.5 * math.pi * pair.composite_loss])))[0])
    return Bulk(table, pair.roughness_rms, pair.composite_modulus, at_least, loss)
