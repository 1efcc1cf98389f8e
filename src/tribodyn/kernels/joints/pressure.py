"""Pressure at one node of a joint, Eqs. 1 and 10 with the memory of entry velocities.

Without branches, as the look-up: loops over nodes are to take four at once.
"""

from tribodyn.core.remembered import ContactTable
from tribodyn.kernels.jit import inlined
from tribodyn.kernels.lookup import pressure_and_damping


@inlined
def reference_velocity(entry_velocity: float, approach: float, minimum: float) -> float:
    """Return δ̇₋ [m/s]: the remembered entry velocity, or max(|δ̇|, v_min) where there is none yet."""
    fresh = max(abs(approach), minimum)
    return entry_velocity if entry_velocity > 0.0 else fresh


@inlined
def total_pressure(rigid: float, damping: float, ratio: float, clip: float) -> float:
    """Return P_c [Pa] from P_k, C and δ̇/δ̇₋, kept from becoming tensile if ``clip`` is 1."""
    total = rigid + damping * ratio
    return 0.0 if clip > 0.0 and total <= 0.0 else total  # this way round for NaN


@inlined
def slopes(
    d_rigid: float,
    damping: float,
    d_damping: float,
    total: float,
    approach: float,
    entry_velocity: float,
    minimum: float,
    clip: float,
) -> tuple[float, float]:
    """Return ∂P_c/∂h [Pa/m] and ∂P_c/∂δ̇ [Pa s/m] from ∂P_k/∂h, C, ∂C/∂h and P_c."""
    reference = reference_velocity(entry_velocity, approach, minimum)
    whole = 0.0 if clip > 0.0 and total == 0.0 else 1.0
    # Without memory and faster than the least velocity, the ratio is ±1 whatever the speed.
    follows = 1.0 if entry_velocity > 0.0 or abs(approach) < minimum else 0.0
    return whole * (d_rigid + d_damping * (approach / reference)), whole * follows * damping / reference


@inlined
def node_pressure(
    table: ContactTable,
    roughness: float,
    minimum_entry_velocity: float,
    clip: float,
    gap: float,
    approach: float,
    entry_velocity: float,
) -> tuple[float, float, float, float]:
    """Return the pressures at a node and the derivatives of the total.

    Parameters
    ----------
    table
        Tabulated contact law.
    roughness
        σ [m].
    minimum_entry_velocity
        v_min [m/s].
    clip
        1 if the total pressure must not be tensile.
    gap
        Gap between the mean planes [m].
    approach
        Approach speed δ̇ = −∂h/∂t [m/s].
    entry_velocity
        Approach speed at which contact began [m/s]; 0 where the node has no memory.

    Returns
    -------
    rigid : float
        P_k [Pa].
    total : float
        P_c [Pa].
    d_gap : float
        ∂P_c/∂h [Pa/m].
    d_approach : float
        ∂P_c/∂δ̇ [Pa s/m].
    """
    rigid, d_rigid, damping, d_damping = pressure_and_damping(table, gap / roughness)
    reference = reference_velocity(entry_velocity, approach, minimum_entry_velocity)
    total = total_pressure(rigid, damping, approach / reference, clip)
    d_gap, d_approach = slopes(
        d_rigid / roughness,
        damping,
        d_damping / roughness,
        total,
        approach,
        entry_velocity,
        minimum_entry_velocity,
        clip,
    )
    return rigid, total, d_gap, d_approach
