"""Where on its axis the shaft is looked at, and what that does to forces and derivatives.

A shaft that slides through its socket meets it with ever other parts of itself, while nodes stay with the
socket. So on a surface that slides, motion is taken at Q, where the axis of the shaft crosses the plane z = 0
of the socket. With u = (φ_y, −φ_x, 1) along the axis and z = d_z,

    d_Q = d − z u,   d/dt d_Q = v − v_z u − z φ̇ × ẑ,   v_Q = v − z ω × u,

the second of the place where the axis is, for gaps, the third of the material there, for slip. On (δd, δφ)
and (δv, δφ̇) that is a matrix T, on (v, ω) another one, U. Forces and moments come back with their
transposes: the pressure is then normal to the axis, F·a = 0, as it must be where the shaft may slide without
any gap changing.
"""

from __future__ import annotations

from typing import Final

from tribodyn.core.arrays import FloatArray
from tribodyn.core.quantities import Record, record_type
from tribodyn.kernels.arrays import clear
from tribodyn.kernels.jit import kernel

Station: Final = record_type(
    *((name, "f8", (3,)) for name in ("d", "v", "slip", "w", "axis")),
    *((name, "f8") for name in ("height", "opening", "v_opening", "direction")),
)
"""d_Q [m], its rate, v_Q [m/s], ω [rad/s], u, z [m]; without sliding those of P, and nothing. ``opening`` is
what gaps and clearances have more than as drawn [m], where a bore follows its temperature, then its rate;
``direction`` is that of the rotation which a friction torque opposes."""

Maps: Final = record_type(
    *((name, "f8", (6, 6)) for name in ("place", "slip", "rate_place", "slip_place", "product"))
)
"""T, U, ∂(T (v, φ̇))/∂(d, φ), ∂(U (v, ω))/∂(d, φ), and a place for products."""


@kernel
def fill_station(slides: float, pose: Record, tilt: Record, station: Record) -> None:
    """Fill ``station`` of a surface that slides (1) or does not (0)."""
    phi, rate, w = tilt.phi, tilt.rate, pose.w
    d, v, slip, u = station.d, station.v, station.slip, station.axis
    z, v_z = slides * pose.d[2], slides * pose.v[2]
    station.height = z
    u[0], u[1], u[2] = slides * phi[1], -slides * phi[0], slides
    turning = (rate[1], -rate[0], 0.0)
    for i in range(3):
        a, b = (i + 1) % 3, (i + 2) % 3
        station.w[i] = w[i]
        d[i] = pose.d[i] - z * u[i]
        v[i] = pose.v[i] - v_z * u[i] - z * turning[i]
        slip[i] = pose.v[i] - z * (w[a] * u[b] - w[b] * u[a])


@kernel
def pressure_at_origin(station: Record, normal: FloatArray) -> None:
    """Turn force and moment of the pressure at Q (6,) into those at P, by the transpose of T."""
    u, z = station.axis, station.height
    normal[3] += z * normal[1]
    normal[4] -= z * normal[0]
    normal[2] -= u[0] * normal[0] + u[1] * normal[1] + u[2] * normal[2]


@kernel
def friction_at_origin(station: Record, friction: FloatArray) -> None:
    """Turn force and moment of friction at Q (6,) into those at P, by the transpose of U."""
    u, z = station.axis, station.height
    for i in range(3):
        a, b = (i + 1) % 3, (i + 2) % 3
        friction[3 + i] -= z * (u[a] * friction[b] - u[b] * friction[a])


@kernel
def _fill_maps(station: Record, pose: Record, tilt: Record, maps: Record) -> None:
    """Fill the maps of a surface that slides."""
    u, z, w, rate, v_z = station.axis, station.height, station.w, tilt.rate, pose.v[2]
    clear(maps.place)
    clear(maps.slip)
    clear(maps.rate_place)
    clear(maps.slip_place)
    for i in range(6):
        maps.place[i, i] = maps.slip[i, i] = 1.0
    for i in range(3):
        a, b = (i + 1) % 3, (i + 2) % 3
        maps.place[i, 2] -= u[i]
        maps.slip[i, 3 + a], maps.slip[i, 3 + b] = -z * u[b], z * u[a]
        maps.slip_place[i, 2] = -(w[a] * u[b] - w[b] * u[a])
    # δu = δφ × ẑ = (δφ_y, −δφ_x, 0)
    maps.place[0, 4], maps.place[1, 3] = -z, z
    maps.rate_place[0, 2], maps.rate_place[1, 2] = -rate[1], rate[0]
    maps.rate_place[0, 4], maps.rate_place[1, 3] = -v_z, v_z
    # ω × (δφ × ẑ) = δφ ω_z − ẑ (ω·δφ)
    maps.slip_place[0, 3], maps.slip_place[1, 4] = -z * w[2], -z * w[2]
    maps.slip_place[2, 3], maps.slip_place[2, 4] = z * w[0], z * w[1]


@kernel
def _add_product(left: FloatArray, right: FloatArray, out: FloatArray) -> None:
    """Add the product of two matrices (6, 6) to ``out``."""
    for i in range(6):
        for m in range(6):
            entry = left[i, m]
            if entry != 0.0:
                for k in range(6):
                    out[i, k] += entry * right[m, k]


@kernel
def _put_back(into: FloatArray, product: FloatArray, out: FloatArray) -> None:
    """Fill ``out`` with ``into``ᵀ ``product`` and clear ``product``, all (6, 6)."""
    for i in range(6):
        for k in range(6):
            total = 0.0
            for m in range(6):
                total += into[m, i] * product[m, k]
            out[i, k] = total
    clear(product)


@kernel
def derivatives_at_origin(scratch: Record, pose: Record) -> None:
    """Turn derivatives of a surface that slides into those at P; wrenches of the scratch are still at Q."""
    maps, product = scratch.maps, scratch.maps.product
    _fill_maps(scratch.station, pose, scratch.tilt, maps)
    clear(product)
    _add_product(scratch.normal_place, maps.place, product)
    _add_product(scratch.normal_rate, maps.rate_place, product)
    _put_back(maps.place, product, scratch.normal_place)
    _add_product(scratch.normal_rate, maps.place, product)
    _put_back(maps.place, product, scratch.normal_rate)
    _add_product(scratch.friction_place, maps.place, product)
    _add_product(scratch.friction_rate, maps.rate_place, product)
    _add_product(scratch.friction_slip, maps.slip_place, product)
    _put_back(maps.slip, product, scratch.friction_place)
    _add_product(scratch.friction_rate, maps.place, product)
    _put_back(maps.slip, product, scratch.friction_rate)
    _add_product(scratch.friction_slip, maps.slip, product)
    _put_back(maps.slip, product, scratch.friction_slip)
    _add_turning_back(scratch)


@kernel
def _add_turning_back(scratch: Record) -> None:
    """Add what the transposes of T and U change by, with the wrenches at Q held fixed."""
    u, z, force, pull = scratch.station.axis, scratch.station.height, scratch.normal, scratch.friction
    normal, friction = scratch.normal_place, scratch.friction_place
    normal[2, 4] -= force[0]
    normal[2, 3] += force[1]
    normal[3, 2] += force[1]
    normal[4, 2] -= force[0]
    for i in range(3):
        a, b = (i + 1) % 3, (i + 2) % 3
        friction[3 + i, 2] -= u[a] * pull[b] - u[b] * pull[a]
    friction[3, 3] += z * pull[2]
    friction[4, 4] += z * pull[2]
    friction[5, 3] -= z * pull[0]
    friction[5, 4] -= z * pull[1]
