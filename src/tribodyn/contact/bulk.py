"""Elastic bodies under the asperities, and a thin elastic liner bonded to a rigid base.

How the compliance follows a contact is in ``kernels/joints/surface/bulk.py``. Each level is the law on a
liner of its stiffness: pressure, damping and energy are those of asperities and a foundation in series.

Where the layer is thin against the width of the contact, its surface sinks at each point in proportion to
the pressure there, and stretches nowhere: u = p/k_w with

    k_w = E(1 − ν) / [(1 + ν)(1 − 2ν) t].

Johnson (1985), Contact Mechanics, section 5.8; Meijers (1968), Appl. Sci. Res. 18, 353, for layers of any
thickness. Asperities and layer are springs in series: a gap h between the undeformed mean planes holds
asperities at the separation s with

    s = h + P_k(s)/k_w,    P(h) = P_k(s),    C(h) = C(s) (ds/dh)²,    ds/dh = 1/(1 − P_k'(s)/k_w).

The damping follows by virtual work: asperities dissipate C(s) ṡ²/δ̇₋ with ṡ = ḣ ds/dh. The energy under P(h)
is that of the asperities and P²/2k_w of the layer. A layer that loses energy itself, with the damping a times
its pressure, adds a P(h) (1 − ds/dh)² to C(h) by the same argument.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

import numpy as np

from mebdf.arrays import FloatArray
from mebdf.kernels.elementary import portable
from tribodyn.contact.contact_law import MEMORYLESS, ContactLaw
from tribodyn.contact.damping_factors import calibrated
from tribodyn.contact.table import table_of_nodes
from tribodyn.core.remembered import ContactTable, Remembered
from tribodyn.kernels.joints.surface.bulk import ARC, KAPPA, ROUNDING, WIDEST

if TYPE_CHECKING:
    from scipy.interpolate import CubicHermiteSpline


#: Largest range of the gap in a table, in σ: a soft layer sinks by more before asperities end.
DEEPEST: Final = 256.0
_ITERATIONS: Final = 50
_EXACT: Final = 1.0e-14
_FEW: Final = 5  #: Iterations from a neighbouring node that end within 1e-12 σ.


@dataclass(frozen=True)
class Liner:
    """A thin elastic layer bonded to a rigid base."""

    thickness: float  #: t [m].
    young_modulus: float  #: E [Pa].
    poisson_ratio: float  #: ν, below 1/2 [1].

    @property
    def stiffness(self) -> float:
        """k_w, pressure over the depth to which the surface sinks [Pa/m]."""
        nu = self.poisson_ratio
        confined = self.young_modulus * (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu))
        return confined / self.thickness

    def error(self, half_width: float) -> float:
        """Return by how much k_w overrates the peak pressure, as a fraction.

        To the next order in the thickness a wave e^{ikx} of pressure sinks by (p/k_w)(1 + β k²t²), by
        Meijers' layer with κ = 3 − 4ν: β = 2κ/3(κ − 1) − 4/(κ + 1). Under a load that a round body spreads
        over 2a the peak is then β(t/a)² lower.

        Parameters
        ----------
        half_width
            Half the width of the contact, a [m].

        Returns
        -------
        float
            Share of the peak pressure [1], above 0 where it is overrated.
        """
        kappa = 3.0 - 4.0 * self.poisson_ratio
        beta = 2.0 * kappa / (3.0 * (kappa - 1.0)) - 4.0 / (kappa + 1.0)
        return beta * (self.thickness / half_width) ** 2


def lined(
    table: ContactTable, stiffness: float, *, depth: float | None = None, stride: int = 1, loss: float = 0.0
) -> ContactTable:
    """Return the table over the gap of a contact whose asperities stand on a layer.

    Parameters
    ----------
    table
        Over the separation of the asperities.
    stiffness
        k_w σ: pressure that the layer takes for each σ [Pa].
    depth
        Depth of the table below a gap of zero [σ]; asperities go on linearly below their own table.
        Without it the table ends where they do.
    stride
        Nodes of the given table to one of the result.
    loss
        a, damping over pressure of the layer [1].

    Returns
    -------
    ContactTable
        Over the gap, which is the separation of the asperities less the depth that the layer sinks.
    """
    from scipy.interpolate import CubicHermiteSpline

    step, nodes = 1.0 / table.inverse_step, table.nodes
    separations: FloatArray = table.h_first + step * np.arange(len(nodes), dtype=np.float64)
    lowest = max(table.h_first - nodes[0, 0] / stiffness, table.h_last - DEEPEST)
    if depth is not None:
        lowest, further = -depth, (depth + table.h_first) / step
        below = [
            nodes[0, 0] - further * nodes[0, 1],
            nodes[0, 1],
            nodes[0, 2] - further * nodes[0, 3],
            nodes[0, 3],
        ]
        nodes, separations = np.vstack([below, nodes]), np.append(lowest, separations)
    pressure = CubicHermiteSpline(separations, nodes[:, 0], nodes[:, 1] / step)
    damping = CubicHermiteSpline(separations, nodes[:, 2], nodes[:, 3] / step)
    step *= stride
    count = int((table.h_last - lowest) * table.inverse_step / stride * (1.0 + _EXACT))
    gap: FloatArray = table.h_last - step * np.arange(count, -1, -1, dtype=np.float64)
    s = _separations(gap, separations, pressure, stiffness, _ITERATIONS if depth is None else _FEW)
    share = 1.0 / (1.0 - pressure(s, 1) / stiffness)
    cube = share * share * share
    bend = cube * pressure(s, 2) / stiffness
    carried, slope, sunk = pressure(s), step * share * pressure(s, 1), 1.0 - share
    lost, lost_slope = (
        loss * sunk * sunk * carried,
        loss * sunk * (sunk * slope - 2.0 * step * bend * carried),
    )
    rise = step * (cube * damping(s, 1) + 2.0 * share * bend * damping(s))
    nodes = np.column_stack([carried, slope, share**2 * damping(s) + lost, rise + lost_slope])
    return table_of_nodes(float(gap[0]), step, nodes)


def _separations(
    gap: FloatArray, nodes: FloatArray, pressure: CubicHermiteSpline, stiffness: float, most: int
) -> FloatArray:
    """Return s with s − P(s)/k = h for each gap h, both of shape (n,) [1], by at most ``most`` Newton steps.

    h grows at least as fast as s does, and no iterate leaves the two nodes around the solution.
    """
    at_nodes = nodes - pressure(nodes) / stiffness
    place = np.clip(np.searchsorted(at_nodes, gap, side="right"), 1, nodes.size - 1)
    low, high = nodes[place - 1], nodes[place]
    s = np.clip(np.interp(gap, at_nodes, nodes), low, high)
    for _ in range(most):
        change = (s - pressure(s) / stiffness - gap) / (1.0 - pressure(s, 1) / stiffness)
        s = np.clip(s - change, low, high)
        if np.all(np.abs(change) <= _EXACT * (1.0 + np.abs(s))):
            break
    return np.asarray(s)


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
        softest = (self.softest * (k / LEVELS) ** 2 for k in range(LEVELS + 1))
        return _levels.made(key, lambda: (self.table, tuple(map(self.on, softest))))[1]

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
