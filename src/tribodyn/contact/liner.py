"""An elastic liner under the asperities: a thin layer bonded to a rigid base.

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

from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

import numpy as np

from tribodyn.contact.table import table_of_nodes
from tribodyn.core.arrays import FloatArray
from tribodyn.core.remembered import ContactTable

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
