"""Contact pressure, its derivative and its stored energy from a :class:`ContactTable`.

Above the table everything is zero; below it the laws go on linearly with the value and slope of the first
node. A separation that is not a number gives results that are not numbers.
"""

from __future__ import annotations

from tribodyn.core.tables import ContactTable
from tribodyn.kernels.jit import inlined, kernel


@inlined
def pressure_and_damping(table: ContactTable, h_star: float) -> tuple[float, float, float, float]:
    """Return P_k, dP_k/dh*, C and dC/dh* [Pa] at the separation ``h_star`` [1].

    The derivatives are those of the interpolant, exactly.
    """
    if h_star >= table.h_last:
        return 0.0, 0.0, 0.0, 0.0
    nodes = table.nodes
    x = (h_star - table.h_first) * table.inverse_step
    if not x >= 0.0:  # also catches NaN, which must not become an index
        dp, dc = nodes[0, 1], nodes[0, 3]
        return (
            nodes[0, 0] + dp * x,
            dp * table.inverse_step,
            nodes[0, 2] + dc * x,
            dc * table.inverse_step,
        )
    i = min(int(x), nodes.shape[0] - 2)  # rounding may put x on the last node
    x -= i
    p_rise, c_rise = nodes[i + 1, 0] - nodes[i, 0], nodes[i + 1, 2] - nodes[i, 2]
    p_1, c_1 = nodes[i, 1], nodes[i, 3]
    p_3, c_3 = p_1 + nodes[i + 1, 1] - 2.0 * p_rise, c_1 + nodes[i + 1, 3] - 2.0 * c_rise
    p_2, c_2 = p_rise - p_1 - p_3, c_rise - c_1 - c_3
    return (
        nodes[i, 0] + x * (p_1 + x * (p_2 + x * p_3)),
        table.inverse_step * (p_1 + x * (2.0 * p_2 + 3.0 * x * p_3)),
        nodes[i, 2] + x * (c_1 + x * (c_2 + x * c_3)),
        table.inverse_step * (c_1 + x * (2.0 * c_2 + 3.0 * x * c_3)),
    )


@kernel
def stored_energy(table: ContactTable, h_star: float) -> float:
    """Return W_k = ∫_h*^∞ P_k dh* [Pa] at ``h_star`` [1]; times σ it is the stored energy per area [J/m²].

    The integral of the interpolant is taken exactly, so that dW_k/dh* is minus the pressure of
    :func:`pressure_and_damping` to rounding and an energy ledger sees no table error.
    """
    if h_star >= table.h_last:
        return 0.0
    nodes = table.nodes
    step = 1.0 / table.inverse_step
    x = (h_star - table.h_first) * table.inverse_step
    if not x >= 0.0:
        below: float = table.energy[0] - step * x * (nodes[0, 0] + 0.5 * x * nodes[0, 1])
        return below
    i = min(int(x), nodes.shape[0] - 2)
    x -= i
    rise = nodes[i + 1, 0] - nodes[i, 0]
    p_1 = nodes[i, 1]
    p_3 = p_1 + nodes[i + 1, 1] - 2.0 * rise
    p_2 = rise - p_1 - p_3
    mean = nodes[i, 0] + x * (p_1 / 2.0 + x * (p_2 / 3.0 + x * p_3 / 4.0))
    energy: float = table.energy[i] - step * x * mean
    return energy
