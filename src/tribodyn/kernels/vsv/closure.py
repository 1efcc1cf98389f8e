"""Loop closure of the mechanism with the trunnion where it is, Eqs. 11-18."""

from __future__ import annotations

import math

from tribodyn.kernels.jit import kernel
from tribodyn.kernels.vsv.data import VsvData

MAX_NEWTON = 30


@kernel
def drive(data: VsvData, t: float) -> tuple[float, float, float]:
    """Return crank angle [rad], speed [rad/s] and acceleration [rad/s²] at time ``t`` [s]."""
    nu = data.angular_frequency
    theta = data.start_angle + data.speed_amplitude / nu * (1.0 - math.cos(nu * t))
    return theta, data.speed_amplitude * math.sin(nu * t), data.speed_amplitude * nu * math.cos(nu * t)


@kernel
def ideal_guess(data: VsvData, theta_a: float) -> float:
    """Return the tabulated vane angle of the ideal mechanism [rad], a start for Newton's method."""
    n = data.ideal.shape[0]
    x = (theta_a - data.ideal_first) * data.ideal_inverse_step
    i = min(max(int(x), 0), n - 2)
    u = x - i
    p0, m0 = data.ideal[i, 0], data.ideal[i, 1]
    p1, m1 = data.ideal[i + 1, 0], data.ideal[i + 1, 1]
    return p0 + u * (m0 + u * (3.0 * (p1 - p0) - 2.0 * m0 - m1 + u * (2.0 * (p0 - p1) + m0 + m1)))


@kernel
def closure_residual(
    data: VsvData,
    theta_a: float,
    e_x: float,
    e_y: float,
    tan_x: float,
    tan_y: float,
    theta_v: float,
) -> tuple[float, float]:
    """Return (|S1S2|² − l_2²)/2 [m²] and its derivative with respect to θ_v [m²/rad]."""
    sin_v = math.sin(theta_v)
    cos_v = math.cos(theta_v)
    x3 = e_x + data.l_4 * cos_v - data.half_length * tan_y
    y3 = e_y + data.l_4 * sin_v - data.half_length * tan_x
    z3 = data.l_3 + data.l_4 * (sin_v * tan_x + cos_v * tan_y)
    beta = data.ring_angle - math.atan2(-x3, z3)
    s2_x = data.l_3 * math.sin(beta)
    s2_z = data.l_3 * math.cos(beta)
    d_x = s2_x - data.pivot_x + data.l_1 * math.sin(theta_a)
    d_y = y3 - data.l_4
    d_z = s2_z - data.pivot_z - data.l_1 * math.cos(theta_a)
    dx3 = -data.l_4 * sin_v
    dz3 = data.l_4 * (cos_v * tan_x - sin_v * tan_y)
    d_theta_b = (-z3 * dx3 + x3 * dz3) / (x3 * x3 + z3 * z3)
    residual = 0.5 * (d_x * d_x + d_y * d_y + d_z * d_z - data.l_2 * data.l_2)
    slope = (d_z * s2_x - d_x * s2_z) * d_theta_b + d_y * data.l_4 * cos_v
    return residual, slope


@kernel
def vane_angle(data: VsvData, theta_a: float, e_x: float, e_y: float, tan_x: float, tan_y: float) -> float:
    """Return θ_v [rad] in the assembly of the table, to machine precision; NaN out of reach."""
    theta_v = ideal_guess(data, theta_a)
    for _ in range(MAX_NEWTON):
        residual, slope = closure_residual(data, theta_a, e_x, e_y, tan_x, tan_y, theta_v)
        if slope == 0.0:
            return math.nan
        step = residual / slope
        theta_v -= step
        if abs(step) < 4.0e-16 * abs(theta_v) + 1.0e-15:
            return theta_v
        if abs(step) < 1.0e-9:
            # One more Newton step from here is below rounding.
            residual, slope = closure_residual(data, theta_a, e_x, e_y, tan_x, tan_y, theta_v)
            return theta_v - residual / slope
    return math.nan
