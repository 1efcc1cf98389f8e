"""Wrench of a surface of revolution: sums over the nodes of a ring, carried to the origin once a ring."""

from typing import Any

from tribodyn.core.arrays import FloatArray
from tribodyn.core.quantities import Record
from tribodyn.kernels.jit import inlined, kernel
from tribodyn.kernels.joints.surface.block import fill_windows, groups_of, rings_from
from tribodyn.kernels.joints.surface.data import SurfaceData
from tribodyn.kernels.joints.surface.levels import fill_block
from tribodyn.kernels.joints.surface.memory import BLOCK_GROUPS, SurfaceMemory
from tribodyn.kernels.joints.surface.ring import (
    ALONG_UNIT,
    AROUND_UNIT,
    COSINE,
    PRESSURE,
    SINE,
    STRIDE,
    WRENCH,
    does_bend,
)
from tribodyn.kernels.joints.surface.ring_sums import (
    Pressures,
    Ring,
    Tractions,
    no_pressure,
    no_traction,
    one_ring,
    put_pressures,
    put_tractions,
    with_pressure,
    with_pressures_of,
    with_traction,
    with_tractions_of,
)
from tribodyn.kernels.lanes import WIDTH, load, zeros

Forces = tuple[Pressures, Tractions, Any]  #: Sums of pressures and of tractions, and ∫P_c dA.


@kernel
def wrench(data: SurfaceData, surface: Record, memory: SurfaceMemory, station: Record) -> None:
    """Fill ``normal`` and ``friction`` of the scratch."""
    limit, forces = surface.h_last * surface.roughness, no_forces()
    for r in range(surface.first_row, surface.last_row, WIDTH):
        if fill_windows(data, surface, memory, station, r, limit, 0.0) > 0:
            fill_block(data, surface, memory, station, r, WRENCH)
            forces = with_forces_of(forces, data.rings, surface, memory, r)
    put_forces(surface, station, forces, memory.scratch)


@inlined
def no_forces() -> Forces:
    """Return empty sums."""
    return no_pressure(), no_traction(), zeros()


@inlined
def with_forces_of(
    forces: Forces, rings: FloatArray, surface: Record, memory: SurfaceMemory, r: int
) -> Forces:
    """Return the sums with those of the block of rings that begins at row ``r``."""
    block, at, bends = memory.block, BLOCK_GROUPS, does_bend(surface)
    for k in range(rings_from(surface, r)):
        pressures, tractions, begin = no_pressure(), no_traction(), at
        at += STRIDE * groups_of(block, k)[1]
        for group in range(begin, at, STRIDE):
            c, s, p = load(block, group + COSINE), load(block, group + SINE), load(block, group + PRESSURE)
            t, b = p * load(block, group + AROUND_UNIT), p * load(block, group + ALONG_UNIT)
            pressures = with_pressure(pressures, p, bends, c, s)
            tractions = with_traction(tractions, t, b, c, s)
        ring, phi = one_ring(rings, r + k), memory.scratch.tilt.phi
        forces = with_ring(forces, ring, surface.lean, phi, pressures, tractions)
    return forces


@inlined
def with_ring(
    forces: Forces, ring: Ring, lean: float, phi: FloatArray, pressures: Pressures, tractions: Tractions
) -> Forces:
    """Return the sums with those of a ring, or of four."""
    return (
        with_pressures_of(forces[0], ring, lean, phi, pressures),
        with_tractions_of(forces[1], ring, tractions),
        forces[2] + ring.area * pressures[0],
    )


@inlined
def put_forces(surface: Record, station: Record, forces: Forces, scratch: Record) -> None:
    """Fill ``normal`` and ``friction`` of the scratch."""
    put_pressures(forces[0], scratch.normal)
    put_tractions(surface, station.direction, forces[2], forces[1], scratch.friction)
