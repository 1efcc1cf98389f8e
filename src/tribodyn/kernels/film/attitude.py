"""From the eight states to coordinates in which the gap is linear, and back for the derivatives.

The chart is u = (e_x, e_y, t_x, t_y, v_x, v_y, w_x, w_y) with t = tan φ and w = φ̇ sec²φ. At height z the
shaft axis is displaced by a = e_x − z t_y, b = e_y − z t_x (Eq. 48), with the same for the velocities. The
cross-section of a tilted shaft is an ellipse. With s = t_y cos θ + t_x sin θ,

    h = c + a cos θ + b sin θ − ½ r s².

Except for the last term the gap is linear in the chart. The derivatives in t are those at the height z + r s.
"""

from mebdf.kernels.elementary import hypot, tan
from tribodyn.core.arrays import FloatArray
from tribodyn.kernels.jit import kernel


@kernel
def chart_of(y: FloatArray, u: FloatArray) -> None:
    """Fill ``u`` (8,) from the states ``y`` (8,)."""
    for k in range(2):
        u[k] = y[k]
        u[4 + k] = y[4 + k]
        t = tan(y[2 + k])
        u[2 + k] = t
        u[6 + k] = y[6 + k] * (1.0 + t * t)


@kernel
def from_chart(u: FloatArray, y: FloatArray, chart: FloatArray, jacobian: FloatArray) -> None:
    """Carry derivatives in the chart and ω to the states and ω, both of shape (5, 9)."""
    for k in range(5):
        for i in (0, 1, 4, 5, 8):
            jacobian[k, i] = chart[k, i]
        for i in (2, 3):
            t = u[i]
            secant = 1.0 + t * t
            jacobian[k, i] = secant * (chart[k, i] + 2.0 * y[4 + i] * t * chart[k, 4 + i])
            jacobian[k, 4 + i] = secant * chart[k, 4 + i]


@kernel
def groove_direction(u: FloatArray) -> tuple[float, float]:
    """Return cosine and sine of the angle of the largest gap in the middle; of angle 0 if centred."""
    e = hypot(u[0], u[1])
    if e == 0.0:
        return 1.0, 0.0
    return u[0] / e, u[1] / e


@kernel
def turn_with_groove(u: FloatArray, out: FloatArray, chart: FloatArray) -> None:
    """Add to the derivatives at a resting groove what its turning with the line of centres adds.

    Turning grid, state and wrench together changes nothing, so with G the generator of rotations the
    derivative of the wrench W by the angle ψ of the groove is G W − (∂W/∂u) G u, and ∂ψ/∂(e_x, e_y) =
    (−e_y, e_x)/e². Rotating pairs are (e_x, e_y), (t_y, t_x), their rates, (F_x, F_y) and (M_y, M_x).
    """
    e_2 = u[0] * u[0] + u[1] * u[1]
    if e_2 == 0.0:
        return
    for k in range(5):
        by_angle = 0.0
        for i in (0, 4):
            by_angle -= chart[k, i + 1] * u[i] - chart[k, i] * u[i + 1]
            by_angle -= chart[k, i + 2] * u[i + 3] - chart[k, i + 3] * u[i + 2]
        if k == 0:
            by_angle -= out[1]
        elif k == 1:
            by_angle += out[0]
        elif k == 2:
            by_angle += out[3]
        elif k == 3:
            by_angle -= out[2]
        d_x, d_y = -u[1] / e_2, u[0] / e_2
        chart[k, 0] += by_angle * d_x
        chart[k, 1] += by_angle * d_y
