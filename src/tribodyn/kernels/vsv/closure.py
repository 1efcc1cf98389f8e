"""Loop closure with the trunnion where it is, Eqs. 11-18, in a clearance that may follow temperatures."""

import math
from typing import Annotated, Final

from mebdf.arrays import FloatArray
from mebdf.kernels.elementary import cos, sin
from tribodyn.core.quantities import Record
from tribodyn.kernels.actions import NONE, evaluate, held
from tribodyn.kernels.jit import entry, inlined, kernel
from tribodyn.kernels.joints.pose import fill_pose
from tribodyn.kernels.vsv.data import TIME, Mechanism, VsvData, VsvMemory


@entry
def place(data: VsvData, t: float, y: FloatArray, omega: float, direction: float, memory: VsvMemory) -> None:
    """Fill the pose of the joint from the state ``y`` (8,), the speed ω_v [rad/s] and its direction."""
    pose, number = memory.joint.scratch.pose, int(data.mechanism.opening)
    fill_pose(y, omega, direction, pose)
    if number != NONE:
        within = held(memory.segment, TIME, t)
        pose.opening, pose.v_opening, _ = evaluate(data.actions.signals, number, t, within)


MAX_NEWTON = 30
#: Newton step after which another one would be below rounding: each is about the square of the last [rad].
CONVERGED = 1.0e-10
#: Newton step up to which few terms of the series of its sine and cosine are exact to rounding [rad].
SMALL_STEP: Final = 1.0e-2


@kernel
def sinusoid(mechanism: Record, t: float) -> tuple[float, float, float]:
    """Return crank angle [rad], speed [rad/s] and acceleration [rad/s²] of the paper's drive at ``t`` [s]."""
    nu = mechanism.angular_frequency
    cosine, sine = cos(nu * t), sin(nu * t)
    theta = mechanism.start_angle + mechanism.speed_amplitude / nu * (1.0 - cosine)
    return theta, mechanism.speed_amplitude * sine, mechanism.speed_amplitude * nu * cosine


@kernel
def ideal_guess(mechanism: Record, theta_a: float) -> float:
    """Return the tabulated vane angle of the ideal mechanism [rad], a start for Newton's method."""
    n = mechanism.ideal.shape[0]
    x = (theta_a - mechanism.ideal_first) * mechanism.ideal_inverse_step
    i = min(max(int(x), 0), n - 2)
    u = x - i
    p0, m0 = mechanism.ideal[i, 0], mechanism.ideal[i, 1]
    p1, m1 = mechanism.ideal[i + 1, 0], mechanism.ideal[i + 1, 1]
    return p0 + u * (m0 + u * (3.0 * (p1 - p0) - 2.0 * m0 - m1 + u * (2.0 * (p0 - p1) + m0 + m1)))


@entry
@inlined
def crank_end(mechanism: Annotated[Record, Mechanism], theta_a: float) -> tuple[float, float]:
    """Return x and z of S1 [m], the end of the crank."""
    s1_x = mechanism.pivot_x - mechanism.l_1 * sin(theta_a)
    s1_z = mechanism.pivot_z + mechanism.l_1 * cos(theta_a)
    return s1_x, s1_z


@inlined
def ring_end(mechanism: Record, x3: float, z3: float) -> tuple[float, float]:
    """Return x and z of S2 [m], the end of the ring's arm at the angle φ − θ_b, with S3 at (x3, z3)."""
    scale = mechanism.l_3 / math.sqrt(x3 * x3 + z3 * z3)
    s2_x = scale * (mechanism.ring_sin * z3 + mechanism.ring_cos * x3)
    s2_z = scale * (mechanism.ring_cos * z3 - mechanism.ring_sin * x3)
    return s2_x, s2_z


@entry
def closure_residual(
    mechanism: Annotated[Record, Mechanism],
    s1_x: float,
    s1_z: float,
    e_x: float,
    e_y: float,
    tan_x: float,
    tan_y: float,
    sin_v: float,
    cos_v: float,
) -> tuple[float, float]:
    """Return (|S1S2|² − l_2²)/2 [m²], S1 at (s1_x, s1_z), and its derivative in θ_v [m²/rad]."""
    x3 = e_x + mechanism.l_4 * cos_v - mechanism.half_length * tan_y
    y3 = e_y + mechanism.l_4 * sin_v - mechanism.half_length * tan_x
    z3 = mechanism.l_3 + mechanism.l_4 * (sin_v * tan_x + cos_v * tan_y)
    s2_x, s2_z = ring_end(mechanism, x3, z3)
    d_x, d_y, d_z = s2_x - s1_x, y3 - mechanism.l_4, s2_z - s1_z
    dx3 = -mechanism.l_4 * sin_v
    dz3 = mechanism.l_4 * (cos_v * tan_x - sin_v * tan_y)
    d_theta_b = (-z3 * dx3 + x3 * dz3) / (x3 * x3 + z3 * z3)
    residual = 0.5 * (d_x * d_x + d_y * d_y + d_z * d_z - mechanism.l_2 * mechanism.l_2)
    slope = (d_z * s2_x - d_x * s2_z) * d_theta_b + d_y * mechanism.l_4 * cos_v
    return residual, slope


@kernel
def ideal_vane(mechanism: Record, theta_a: float, s1_x: float, s1_z: float) -> tuple[float, float]:
    """Return θ_v [rad] without clearance, and dθ_v/dθ_a."""
    theta_v, sin_v, cos_v = vane_attitude(mechanism, theta_a, s1_x, s1_z, 0.0, 0.0, 0.0, 0.0)
    _, slope = closure_residual(mechanism, s1_x, s1_z, 0.0, 0.0, 0.0, 0.0, sin_v, cos_v)
    s2_x, s2_z = ring_end(mechanism, mechanism.l_4 * cos_v, mechanism.l_3)
    moved = (s2_z - s1_z) * (s1_x - mechanism.pivot_x) - (s2_x - s1_x) * (s1_z - mechanism.pivot_z)
    return theta_v, moved / slope


@inlined
def _turned_back(sine: float, cosine: float, step: float) -> tuple[float, float]:
    """Return sine and cosine of an angle less a step below :data:`SMALL_STEP` [rad]."""
    square = step * step
    sine_of_step = step * (1.0 - square * (1.0 / 6.0 - square / 120.0))
    less = square * (0.5 - square * (1.0 / 24.0 - square / 720.0))
    return sine - (sine * less + cosine * sine_of_step), cosine - (cosine * less - sine * sine_of_step)


@entry
def vane_attitude(
    mechanism: Annotated[Record, Mechanism],
    theta_a: float,
    s1_x: float,
    s1_z: float,
    e_x: float,
    e_y: float,
    tan_x: float,
    tan_y: float,
) -> tuple[float, float, float]:
    """Return θ_v [rad] in the assembly of the table, sin θ_v and cos θ_v; NaN out of reach.

    S1 is at (s1_x, s1_z).
    """
    theta_v = ideal_guess(mechanism, theta_a)
    sin_v, cos_v = sin(theta_v), cos(theta_v)
    for _ in range(MAX_NEWTON):
        residual, slope = closure_residual(mechanism, s1_x, s1_z, e_x, e_y, tan_x, tan_y, sin_v, cos_v)
        if slope == 0.0:
            break
        step = residual / slope
        theta_v -= step
        if abs(step) < SMALL_STEP:
            sin_v, cos_v = _turned_back(sin_v, cos_v, step)
        else:
            sin_v, cos_v = sin(theta_v), cos(theta_v)
        if abs(step) < CONVERGED:
            return theta_v, sin_v, cos_v
    return math.nan, math.nan, math.nan
