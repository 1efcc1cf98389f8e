"""A shaft that touches at points, smooth surfaces, as multibody programs have it.

Each of some circles of radius r_j + c about the axis of a cylinder, or the one sphere, has its centre at z on
the axis of the socket; the shaft's centre is off it by e = d + φ × z ẑ, in the plane of the circle. Where ρ
= |e| > c they overlap by ρ − c, and a force acts along n = e/ρ at x = r_j n + z ẑ. So the formulas are those
of a node whose place and normal follow from the state. The contact table holds the force of a point [N]
instead of a pressure times an area, over (c − ρ)/σ; there is no pressure field and no wear. As in the
literature, the cross-sections are circles: the ellipse of a tilted shaft is neglected.
"""

import math

from mebdf.arrays import FloatArray
from tribodyn.core.quantities import Record
from tribodyn.kernels.jit import inlined, kernel
from tribodyn.kernels.joints.pressure import node_pressure, reference_velocity
from tribodyn.kernels.joints.surface.data import SurfaceData, table_of
from tribodyn.kernels.joints.surface.jacobian import clear_sums, slip_square
from tribodyn.kernels.joints.surface.memory import SurfaceMemory
from tribodyn.kernels.joints.surface.tilt import NO_TILT
from tribodyn.kernels.lookup import stored_energy

Vector = tuple[float, float, float]


@inlined
def _dot(a: Vector, b: Vector) -> float:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@inlined
def _cross(a: Vector, b: Vector) -> Vector:
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


@inlined
def _sum(a: Vector, factor: float, b: Vector) -> Vector:
    return a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]


@inlined
def _vector(a: FloatArray) -> Vector:
    return a[0], a[1], a[2]


@inlined
def _unit(k: int) -> Vector:
    return (1.0 if k == 0 else 0.0), (1.0 if k == 1 else 0.0), (1.0 if k == 2 else 0.0)


@inlined
def _offset(surface: Record, z: float, d: Vector, phi: Vector) -> Vector:
    """Return e = d + φ × z ẑ, in the plane of the circle or in space for a sphere; of velocities its rate."""
    along = d[2] if surface.tilt == NO_TILT else 0.0
    return d[0] + z * phi[1], d[1] - z * phi[0], along


@inlined
def _rubbing(surface: Record, slip: Vector) -> Vector:
    """Return the part of a slip that friction opposes: all, or that around the axis of a cylinder."""
    return slip[0], slip[1], surface.along * slip[2]


@kernel
def add_points(
    data: SurfaceData, s: int, memory: SurfaceMemory, station: Record, derivatives: float, told: float
) -> None:
    """Fill ``normal`` and ``friction`` of the scratch; their derivatives, the report where these are 1."""
    surface, scratch = data.surfaces[s], memory.scratch
    clear_sums(scratch)
    clearance = surface.clearance + station.opening
    if told > 0.0:
        memory.n_touched[s], scratch.rigid_load = 0, 0.0
        for i in range(6):
            scratch.rigid[i] = 0.0
        memory.reports[s].separation_min = clearance
    for k in range(int(surface.points)):
        z = surface.heights[k]
        e = _offset(surface, z, _vector(station.d), _vector(scratch.tilt.phi))
        rho = math.sqrt(_dot(e, e))
        if told > 0.0:
            out = memory.reports[s]
            out.separation_min = min(out.separation_min, clearance - rho)
        if rho > clearance:
            _add_point(data, s, memory, station, k, e, rho, derivatives, told)
    if told > 0.0:
        out = memory.reports[s]
        out.tensile_clip_share /= max(out.contact_fraction, 1.0)
        out.contact_fraction = 0.0


@inlined
def _force(
    data: SurfaceData, surface: Record, memory: SurfaceMemory, k: int, gap: float, approach: float
) -> tuple[float, float, float, float]:
    """Return rigid force, total force [N] and the derivatives of the total in gap and approach speed."""
    return node_pressure(
        table_of(data, surface),
        surface.roughness,
        surface.minimum_entry_velocity,
        surface.tensile_clip,
        gap,
        approach,
        memory.entry_velocity[surface.first_node + k],
    )


@kernel
def _add_point(
    data: SurfaceData,
    s: int,
    memory: SurfaceMemory,
    station: Record,
    k: int,
    e: Vector,
    rho: float,
    derivatives: float,
    told: float,
) -> None:
    """Add the point ``k`` that is off its centre by ``e``."""
    surface, scratch, z = data.surfaces[s], memory.scratch, data.surfaces[s].heights[k]
    n = (e[0] / rho, e[1] / rho, e[2] / rho)
    e_dot = _offset(surface, z, _vector(station.v), _vector(scratch.tilt.rate))
    approach, depth = _dot(n, e_dot) - station.v_opening, surface.clearance + station.opening - rho
    rigid, force, d_gap, d_approach = _force(data, surface, memory, k, depth, approach)
    height = (0.0, 0.0, z)
    x = _sum(height, surface.radius, n)
    moving = _sum(_vector(station.slip), 1.0, _cross(_vector(station.w), x))
    slip = _rubbing(surface, _sum(moving, -_dot(n, moving), n))
    norm = math.sqrt(_dot(slip, slip) + slip_square(surface))
    unit = (slip[0] / norm, slip[1] / norm, slip[2] / norm)
    arm, lever, drag = _cross(x, n), _cross(x, unit), surface.friction_coefficient * force
    power = _dot(unit, slip)
    if surface.torque_radius > 0.0:
        turn = surface.torque_radius * station.direction
        unit, lever, power = (0.0, 0.0, 0.0), (0.0, 0.0, turn), turn * station.w[2]
    for i in range(3):
        scratch.normal[i] -= force * n[i]
        scratch.normal[3 + i] -= force * arm[i]
        scratch.friction[i] -= drag * unit[i]
        scratch.friction[3 + i] -= drag * lever[i]
    if told > 0.0:
        out = memory.reports[s]
        for i in range(3):
            scratch.rigid[i] -= rigid * n[i]
            scratch.rigid[3 + i] -= rigid * arm[i]
        scratch.rigid_load += rigid
        stored = stored_energy(table_of(data, surface), depth / surface.roughness)
        out.energy_contact += surface.roughness * stored
        out.damping_power += (force - rigid) * approach
        out.friction_power -= drag * power
        out.contact_fraction += 1.0
        out.tensile_clip_share += 1.0 if force <= 0.0 else 0.0
    if derivatives > 0.0:
        for m in range(18):
            _add_column(
                surface,
                scratch,
                station,
                m,
                (z, rho, norm, force, d_gap, d_approach),
                (n, e_dot, x, moving, unit),
            )


@kernel
def _add_column(
    surface: Record,
    scratch: Record,
    station: Record,
    m: int,
    numbers: tuple[float, float, float, float, float, float],
    vectors: tuple[Vector, Vector, Vector, Vector, Vector],
) -> None:
    """Add the derivative in one of (d, φ), (v, φ̇) and (v, ω), in their order."""
    z, rho, norm, force, d_gap, d_approach = numbers
    n, e_dot, x, moving, unit = vectors
    zero, mu = (0.0, 0.0, 0.0), surface.friction_coefficient
    first, second = (_unit(m % 6), zero) if m % 6 < 3 else (zero, _unit(m % 6 - 3))
    part = m // 6
    turned = _offset(surface, z, first, second)
    placed, rated, slipped = 1.0 if part == 0 else 0.0, 1.0 if part == 1 else 0.0, 1.0 if part == 2 else 0.0
    along = _dot(n, turned)
    d_n = _sum(zero, placed / rho, _sum(turned, -along, n))
    d_x = _sum(zero, surface.radius, d_n)
    d_force = d_approach * (_dot(d_n, e_dot) + rated * along) - d_gap * placed * along
    own = _sum(first, 1.0, _cross(second, x))
    d_moving = _sum(_cross(_vector(station.w), d_x), slipped, own)
    d_slip = _sum(d_moving, -(_dot(d_n, moving) + _dot(n, d_moving)), n)
    d_slip = _rubbing(surface, _sum(d_slip, -_dot(n, moving), d_n))
    d_unit = _sum(zero, 1.0 / norm, _sum(d_slip, -_dot(unit, d_slip), unit))
    push, pull = _sum(_sum(zero, d_force, n), force, d_n), _sum(_sum(zero, d_force, unit), force, d_unit)
    arm = _sum(_cross(x, push), force, _cross(d_x, n))
    lever = _sum(_cross(x, pull), force, _cross(d_x, unit))
    if surface.torque_radius > 0.0:
        pull, lever = zero, (0.0, 0.0, surface.torque_radius * station.direction * d_force)
    column, normal, friction = m % 6, scratch.normal_place, scratch.friction_place
    if part > 0:  # the slip alone moves no normal force
        normal, friction = scratch.normal_rate, scratch.friction_rate if part == 1 else scratch.friction_slip
    for i in range(3):
        normal[i, column] -= push[i]
        normal[3 + i, column] -= arm[i]
        friction[i, column] -= mu * pull[i]
        friction[3 + i, column] -= mu * lever[i]


@kernel
def update_entry_velocity(
    data: SurfaceData, surface: Record, memory: SurfaceMemory, station: Record, at_start: float
) -> None:
    """Let points enter and leave contact at the end of an accepted step, where the surfaces meet."""
    entry_velocity, tilt = memory.entry_velocity, memory.scratch.tilt
    clearance = surface.clearance + station.opening
    for k in range(int(surface.points)):
        z, i = surface.heights[k], surface.first_node + k
        e = _offset(surface, z, _vector(station.d), _vector(tilt.phi))
        rho = math.sqrt(_dot(e, e))
        if rho <= clearance:
            entry_velocity[i] = 0.0
        elif entry_velocity[i] == 0.0:
            e_dot = _offset(surface, z, _vector(station.v), _vector(tilt.rate))
            heed = 0.0 if at_start > 0.0 else _dot(e, e_dot) / rho - station.v_opening
            entry_velocity[i] = reference_velocity(0.0, heed, surface.minimum_entry_velocity)
