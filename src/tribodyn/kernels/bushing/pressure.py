"""Pressure at one node of the bushing, Eqs. 1 and 10 with the memory of entry velocities."""

from __future__ import annotations

from tribodyn.core.tables import ContactTable
from tribodyn.kernels.jit import inlined
from tribodyn.kernels.lookup import pressure_and_damping


@inlined
def reference_velocity(entry_velocity: float, approach: float, minimum: float) -> float:
    """Return δ̇₋ [m/s]: the remembered entry velocity, or max(|δ̇|, v_min) where there is none yet."""
    if entry_velocity > 0.0:
        return entry_velocity
    return max(abs(approach), minimum)


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
    if damping == 0.0:  # above the onset, and everywhere in a law without damping
        return rigid, rigid, d_rigid / roughness, 0.0
    reference = reference_velocity(entry_velocity, approach, minimum_entry_velocity)
    ratio = approach / reference
    total = rigid + damping * ratio
    if clip > 0.0 and total <= 0.0:
        return rigid, 0.0, 0.0, 0.0
    d_gap = (d_rigid + d_damping * ratio) / roughness
    if entry_velocity > 0.0 or abs(approach) < minimum_entry_velocity:
        d_approach = damping / reference
    else:
        d_approach = 0.0
    return rigid, total, d_gap, d_approach
