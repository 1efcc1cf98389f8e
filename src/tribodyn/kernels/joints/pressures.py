"""Contact pressures of the nodes in a list."""

from tribodyn.core.arrays import FloatArray
from tribodyn.kernels.jit import kernel
from tribodyn.kernels.joints.columns import (
    APPROACH,
    DAMPING,
    ENTRY,
    FRACTION,
    INTERVAL,
    PRESSURE,
    RESISTANCE,
    RIGID,
    STIFFNESS,
    whole,
)
from tribodyn.kernels.joints.pressure import reference_velocity, slopes, total_pressure
from tribodyn.kernels.lanes import WIDTH, load, rows, store, total, zeros


@kernel
def fill_pressures(
    cubics: FloatArray, v_min: float, clip: float, most: float, work: FloatArray, n: int
) -> None:
    """Fill ``RIGID``, ``DAMPING`` and ``PRESSURE`` of the ``n`` nodes in the list.

    Parameters
    ----------
    cubics
        Coefficients of the contact table.
    v_min
        Lower bound of entry velocities [m/s].
    clip
        1 if the total pressure must not be tensile.
    most
        Largest pressure [Pa].
    work
        Columns of the list.
    n
        Number of nodes.
    """
    for k in range(0, n, WIDTH):
        x = load(work, FRACTION + k)
        k_0, k_1, k_2, k_3, c_0, c_1, c_2, c_3 = rows(cubics, load(work, INTERVAL + k))
        store(work, RIGID + k, k_0 + x * (k_1 + x * (k_2 + x * k_3)))
        store(work, DAMPING + k, c_0 + x * (c_1 + x * (c_2 + x * c_3)))
    for k in range(whole(n)):
        reference = reference_velocity(work[ENTRY + k], work[APPROACH + k], v_min)
        ratio = work[APPROACH + k] / reference
        pressure = total_pressure(work[RIGID + k], work[DAMPING + k], ratio, clip)
        work[PRESSURE + k] = most if pressure > most else pressure


@kernel
def fill_slopes(
    cubics: FloatArray, scale: float, v_min: float, clip: float, most: float, work: FloatArray, n: int
) -> None:
    """Fill ``STIFFNESS`` and ``RESISTANCE`` of the ``n`` nodes in the list, whose pressures are filled.

    ``scale`` is the number of intervals of the table per gap [1/m].
    """
    for k in range(0, n, WIDTH):
        x = load(work, FRACTION + k)
        _, k_1, k_2, k_3, _, c_1, c_2, c_3 = rows(cubics, load(work, INTERVAL + k))
        store(work, STIFFNESS + k, k_1 + x * (k_2 + k_2 + x * (k_3 + k_3 + k_3)))
        store(work, RESISTANCE + k, c_1 + x * (c_2 + c_2 + x * (c_3 + c_3 + c_3)))
    for k in range(whole(n)):
        work[STIFFNESS + k], work[RESISTANCE + k] = slopes(
            scale * work[STIFFNESS + k],
            work[DAMPING + k],
            scale * work[RESISTANCE + k],
            work[PRESSURE + k],
            work[APPROACH + k],
            work[ENTRY + k],
            v_min,
            clip,
        )
        if work[PRESSURE + k] >= most:
            work[STIFFNESS + k] = work[RESISTANCE + k] = 0.0


@kernel
def weighted_sum(work: FloatArray, weight: int, column: int, n: int) -> float:
    """Return the sum of the products of two columns over the ``n`` nodes in the list."""
    added = zeros()
    for k in range(0, n, WIDTH):
        added += load(work, weight + k) * load(work, column + k)
    return total(added)
