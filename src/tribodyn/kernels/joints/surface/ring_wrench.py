"""Wrench of a surface of revolution: sums over the nodes of its rings, in lanes, carried to the origin."""

from typing import Any, NamedTuple

from mebdf.arrays import FloatArray
from tribodyn.core.quantities import Record
from tribodyn.kernels.jit import inlined, kernel
from tribodyn.kernels.joints.surface.block import fill_windows, groups_of, rings_from
from tribodyn.kernels.joints.surface.bulk import fill_block
from tribodyn.kernels.joints.surface.data import (
    ARM,
    HEIGHT,
    N_AXIAL,
    N_RADIAL,
    NODE_AREA,
    RADIUS,
    SurfaceData,
)
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
from tribodyn.kernels.lanes import WIDTH, load, spread, total, zeros


class Ring(NamedTuple):
    """Common data of the nodes of a ring: area of a node [m²], n_r, n_z, radius, height and arm [m]."""

    area: Any
    n_r: Any
    n_z: Any
    radius: Any
    z: Any
    arm: Any


@inlined
def one_ring(rings: FloatArray, r: int) -> Ring:
    """Return the numbers of ring ``r``, each in all lanes."""
    return Ring(
        spread(rings[NODE_AREA, r]),
        spread(rings[N_RADIAL, r]),
        spread(rings[N_AXIAL, r]),
        spread(rings[RADIUS, r]),
        spread(rings[HEIGHT, r]),
        spread(rings[ARM, r]),
    )


@inlined
def four_rings(rings: FloatArray, r: int, area: Any) -> Ring:
    """Return the numbers of the four rings from ``r`` on, one in each lane, for sums times ``area``."""
    return Ring(
        area,
        load(rings[N_RADIAL], r),
        load(rings[N_AXIAL], r),
        load(rings[RADIUS], r),
        load(rings[HEIGHT], r),
        load(rings[ARM], r),
    )


Pressures = tuple[Any, Any, Any, Any, Any]
Tractions = tuple[Any, Any, Any, Any, Any, Any]


@inlined
def no_pressure() -> Pressures:
    """Return empty sums of pressures."""
    return zeros(), zeros(), zeros(), zeros(), zeros()


@inlined
def with_pressure(sums: Pressures, p: Any, bends: float, c: Any, s: Any) -> Pressures:
    """Return the sums of p (1, c, s) with four more nodes, if ``bends`` those of p (c c, c s), too."""
    p_c = p * c
    if bends > 0.0:
        return sums[0] + p, sums[1] + p_c, sums[2] + p * s, sums[3] + p_c * c, sums[4] + p_c * s
    return sums[0] + p, sums[1] + p_c, sums[2] + p * s, sums[3], sums[4]


@inlined
def with_pressures_of(sums: Pressures, ring: Ring, lean: float, phi: FloatArray, own: Pressures) -> Pressures:
    """Return −F and (M_x, −M_y) of the pressures of rings with those of one, or four, from their ``own``."""
    p, p_c, p_s, p_cc, p_cs = own
    area, n_r, lever = ring.area, ring.n_r, ring.arm
    radial, bent = area * n_r, spread(lean) * n_r * n_r
    x, y = bent * spread(phi[0]), bent * spread(phi[1])
    return (
        sums[0] + radial * p_c,
        sums[1] + radial * p_s,
        sums[2] + area * (ring.n_z * p),
        sums[3] + area * (lever * p_s + (y * p_cs - x * (p - p_cc))),
        sums[4] + area * (lever * p_c + (y * p_cc - x * p_cs)),
    )


@inlined
def put_pressures(sums: Pressures, out: FloatArray) -> None:
    """Fill ``out`` (6,) with force and moment of the pressures of all rings."""
    out[0], out[1], out[2] = -total(sums[0]), -total(sums[1]), -total(sums[2])
    out[3], out[4], out[5] = total(sums[3]), -total(sums[4]), 0.0


@inlined
def no_traction() -> Tractions:
    """Return empty sums of tractions."""
    return zeros(), zeros(), zeros(), zeros(), zeros(), zeros()


@inlined
def with_traction(sums: Tractions, t: Any, b: Any, c: Any, s: Any) -> Tractions:
    """Return the sums of tractions t around and b along (1, c, s) with those of four more nodes."""
    t_1, t_c, t_s, b_1, b_c, b_s = sums
    return t_1 + t, t_c + t * c, t_s + t * s, b_1 + b, b_c + b * c, b_s + b * s


@inlined
def with_tractions_of(sums: Tractions, ring: Ring, own: Tractions) -> Tractions:
    """Return (−F_x, F_y, F_z, M_x, −M_y, M_z) of tractions with those of a ring, or four, from their own."""
    t, t_c, t_s, b, b_c, b_s = own
    area, n_r, n_z, radius, z = ring.area, ring.n_r, ring.n_z, ring.radius, ring.z
    lever = radius * n_r + z * n_z
    return (
        sums[0] + area * (t_s + n_z * b_c),
        sums[1] + area * (t_c - n_z * b_s),
        sums[2] + area * (n_r * b),
        sums[3] + area * (lever * b_s - z * t_c),
        sums[4] + area * (lever * b_c + z * t_s),
        sums[5] + area * (radius * t),
    )


@inlined
def put_tractions(surface: Record, direction: float, load: Any, sums: Tractions, out: FloatArray) -> None:
    """Fill ``out`` (6,) with force and moment of friction on all rings.

    Tractions are given over −μ, ``load`` is ∫P_c dA [N].
    """
    factor = -surface.friction_coefficient
    for k in range(6):
        out[k] = 0.0
    if surface.torque_radius > 0.0:
        out[5] = factor * direction * surface.torque_radius * total(load)
    else:
        out[0], out[1], out[2] = -factor * total(sums[0]), factor * total(sums[1]), factor * total(sums[2])
        out[3], out[4], out[5] = factor * total(sums[3]), -factor * total(sums[4]), factor * total(sums[5])


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
