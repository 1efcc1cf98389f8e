"""Station on the axis of the shaft, and its effect on forces and derivatives.

A shaft that slides through its socket meets it with ever other parts of itself, while nodes stay with the
socket. So on a surface that slides, motion is taken at Q, where the axis of the shaft crosses the plane z = 0
of the socket. With u = (φ_y, −φ_x, 1) along the axis and z = d_z,

    d_Q = d − z u,   d/dt d_Q = v − v_z u − z φ̇ × ẑ,   v_Q = v − z ω × u,

the second of the place where the axis is, for gaps, the third of the material there, for slip. On (δd, δφ)
and (δv, δφ̇) that is a matrix T, on (v, ω) another one, U. Forces and moments come back with their
transposes: the pressure is then normal to the axis, F·a = 0, as it must be where the shaft may slide without
any gap changing.
"""

from typing import Final

from mebdf.arrays import FloatArray
from tribodyn.core.quantities import Record, record_type
from tribodyn.kernels.jit import kernel

#: d_Q [m], its rate, v_Q [m/s], ω [rad/s], u, z [m]; without sliding those of P, and nothing. ``opening`` is
#: what gaps and clearances have more than as drawn [m], where a bore follows its temperature, then its rate;
#: ``direction`` is that of the rotation which a friction torque opposes.
Station: Final = record_type(
    *((name, "f8", (3,)) for name in ("d", "v", "slip", "w", "axis")),
    *((name, "f8") for name in ("height", "opening", "v_opening", "direction")),
)


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
def _by_place(station: Record, matrix: FloatArray) -> None:
    """Multiply a matrix (6, 6) by T."""
    u, z = station.axis, station.height
    for i in range(6):
        x, y = matrix[i, 0], matrix[i, 1]
        matrix[i, 2] -= u[0] * x + u[1] * y + u[2] * matrix[i, 2]
        matrix[i, 3] += z * y
        matrix[i, 4] -= z * x


@kernel
def _by_slip(station: Record, matrix: FloatArray) -> None:
    """Multiply a matrix (6, 6) by U."""
    u, z = station.axis, station.height
    for i in range(6):
        x, y, along = matrix[i, 0], matrix[i, 1], matrix[i, 2]
        matrix[i, 3] += z * (u[2] * y - u[1] * along)
        matrix[i, 4] += z * (u[0] * along - u[2] * x)
        matrix[i, 5] += z * (u[1] * x - u[0] * y)


@kernel
def _add_moved(rate: FloatArray, v_z: float, tilt_rate: FloatArray, out: FloatArray) -> None:
    """Add the product of derivatives in (v, φ̇) and ∂(T (v, φ̇))/∂(d, φ), all (6, 6)."""
    for i in range(6):
        x, y = rate[i, 0], rate[i, 1]
        out[i, 2] += tilt_rate[0] * y - tilt_rate[1] * x
        out[i, 3] += v_z * y
        out[i, 4] -= v_z * x


@kernel
def _add_slipped(slip: FloatArray, station: Record, out: FloatArray) -> None:
    """Add the product of derivatives in (v, ω) and ∂(U (v, ω))/∂(d, φ), all (6, 6)."""
    u, z, w = station.axis, station.height, station.w
    for i in range(6):
        x, y, along = slip[i, 0], slip[i, 1], slip[i, 2]
        out[i, 2] -= x * (w[1] * u[2] - w[2] * u[1])
        out[i, 2] -= y * (w[2] * u[0] - w[0] * u[2]) + along * (w[0] * u[1] - w[1] * u[0])
        # ω × (δφ × ẑ) = δφ ω_z − ẑ (ω·δφ)
        out[i, 3] += z * (w[0] * along - w[2] * x)
        out[i, 4] += z * (w[1] * along - w[2] * y)


@kernel
def derivatives_at_origin(scratch: Record, pose: Record) -> None:
    """Turn derivatives of a surface that slides into those at P; wrenches of the scratch are still at Q."""
    station, rate, v_z = scratch.station, scratch.tilt.rate, pose.v[2]
    place, slip = scratch.normal_place, scratch.friction_slip
    _by_place(station, place)
    _add_moved(scratch.normal_rate, v_z, rate, place)
    _by_place(station, place.T)
    _by_place(station, scratch.normal_rate)
    _by_place(station, scratch.normal_rate.T)
    place = scratch.friction_place
    _by_place(station, place)
    _add_moved(scratch.friction_rate, v_z, rate, place)
    _add_slipped(slip, station, place)
    _by_slip(station, place.T)
    _by_place(station, scratch.friction_rate)
    _by_slip(station, scratch.friction_rate.T)
    _by_slip(station, slip)
    _by_slip(station, slip.T)
    _add_turning_back(scratch)


@kernel
def _add_turning_back(scratch: Record) -> None:
    """Add the changes of the transposes of T and U, with the wrenches at Q held fixed."""
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
