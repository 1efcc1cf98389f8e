"""Contact pressures of nodes, Eqs. 1 and 10 with the memory of entry velocities: of one, and of a list.

Without branches, as the look-up: loops over nodes are to take four at once.
"""

from mebdf.arrays import FloatArray
from tribodyn.core.remembered import ContactTable
from tribodyn.kernels.jit import inlined, kernel
from tribodyn.kernels.joints import columns
from tribodyn.kernels.joints.columns import whole
from tribodyn.kernels.lanes import WIDTH, load, rows, store, total, zeros
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
    """Return P_k and P_c [Pa] at a node, ∂P_c/∂h [Pa/m] and ∂P_c/∂δ̇ [Pa s/m].

    The gap is that of the mean planes [m]; the entry velocity [m/s] is 0 where the node has no memory.
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


@kernel
def fill_pressures(
    cubics: FloatArray, v_min: float, clip: float, most: float, work: FloatArray, n: int
) -> None:
    """Fill ``RIGID``, ``DAMPING`` and ``PRESSURE``, at most ``most`` [Pa], of ``n`` nodes in the list."""
    for k in range(0, n, WIDTH):
        x = load(work, columns.FRACTION + k)
        k_0, k_1, k_2, k_3, c_0, c_1, c_2, c_3 = rows(cubics, load(work, columns.INTERVAL + k))
        store(work, columns.RIGID + k, k_0 + x * (k_1 + x * (k_2 + x * k_3)))
        store(work, columns.DAMPING + k, c_0 + x * (c_1 + x * (c_2 + x * c_3)))
    for k in range(whole(n)):
        reference = reference_velocity(work[columns.ENTRY + k], work[columns.APPROACH + k], v_min)
        ratio = work[columns.APPROACH + k] / reference
        pressure = total_pressure(work[columns.RIGID + k], work[columns.DAMPING + k], ratio, clip)
        work[columns.PRESSURE + k] = most if pressure > most else pressure


@kernel
def fill_slopes(
    cubics: FloatArray, scale: float, v_min: float, clip: float, most: float, work: FloatArray, n: int
) -> None:
    """Fill ``STIFFNESS`` and ``RESISTANCE`` of the ``n`` nodes in the list, whose pressures are filled.

    ``scale`` is the number of intervals of the table per gap [1/m].
    """
    for k in range(0, n, WIDTH):
        x = load(work, columns.FRACTION + k)
        _, k_1, k_2, k_3, _, c_1, c_2, c_3 = rows(cubics, load(work, columns.INTERVAL + k))
        store(work, columns.STIFFNESS + k, k_1 + x * (k_2 + k_2 + x * (k_3 + k_3 + k_3)))
        store(work, columns.RESISTANCE + k, c_1 + x * (c_2 + c_2 + x * (c_3 + c_3 + c_3)))
    for k in range(whole(n)):
        work[columns.STIFFNESS + k], work[columns.RESISTANCE + k] = slopes(
            scale * work[columns.STIFFNESS + k],
            work[columns.DAMPING + k],
            scale * work[columns.RESISTANCE + k],
            work[columns.PRESSURE + k],
            work[columns.APPROACH + k],
            work[columns.ENTRY + k],
            v_min,
            clip,
        )
        if work[columns.PRESSURE + k] >= most:
            work[columns.STIFFNESS + k] = work[columns.RESISTANCE + k] = 0.0


@kernel
def weighted_sum(work: FloatArray, weight: int, column: int, n: int) -> float:
    """Return the sum of the products of two columns over the ``n`` nodes in the list."""
    added = zeros()
    for k in range(0, n, WIDTH):
        added += load(work, weight + k) * load(work, column + k)
    return total(added)
