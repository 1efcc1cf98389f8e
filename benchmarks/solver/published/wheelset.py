"""A wheelset that hunts on a straight track, index 2, 17 equations: Test Set for IVP Solvers (CWI), 1995.

B. Simeon, C. Führer, P. Rentrop, Surv. Math. Ind. 1 (1991) 1-37. Wheels are cones, rails are circles, and the
forces of creep follow Kalker's linear law, limited by a hyperbolic tangent.
"""

import numba as nb
import numpy as np

from benchmarks.solver.published.definitions import Published

_MASS, _SPIN, _TILT, _STIFF, _ARM = 16.08, 0.0605, 0.366, 6400.0, 0.19
_CONE, _RADIUS, _HALF, _RAIL, _SPEED, _FRICTION = 0.0262, 0.1, 0.1506, 0.06, 30.0, 0.12
_SHEAR, _POISSON, _KALKER = 7.92e10, 0.28, (4.72772197, 4.27526987, 1.97203505)
_HERTZ = 1.3537956 / np.sqrt(0.7115218)


@nb.njit
def _contact(y, psi, xi, side):
    """Return radius and slope of a wheel, slope and curvature of its rail, and the angle of their contact."""
    st, ct, sp, cp = np.sin(y[3]), np.cos(y[3]), np.sin(y[4]), np.cos(y[4])
    radius, slope = _RADIUS + np.tan(_CONE) * (_HALF - abs(xi)), -np.sign(xi) * np.tan(_CONE)
    place = y[0] + xi * ct * cp + radius * (ct * sp * np.cos(psi) - st * np.sin(psi))
    off = abs(place) - _HALF - np.sin(_CONE) * _RAIL
    depth = np.sqrt(_RAIL**2 - off**2)
    rail, curvature = -np.sign(place) * off / depth, -(_RAIL**2) / depth**3
    along = (slope * cp - sp * np.cos(psi)) * ct + np.sin(psi) * st
    angle = np.arctan(along / (side * (slope * sp + np.cos(psi) * cp)))
    return radius, slope, rail, curvature, angle


@nb.njit
def _normal(y, psi, xi, radius, rail):
    """Return the derivative of the gap of a wheel by the five coordinates."""
    st, ct, sp, cp = np.sin(y[3]), np.cos(y[3]), np.sin(y[4]), np.cos(y[4])
    by_yaw = rail * (-radius * (ct * np.sin(psi) + np.cos(psi) * sp * st) - cp * st * xi)
    by_roll = -np.cos(psi) * radius * sp - cp * xi + rail * (cp * np.cos(psi) * ct * radius - ct * sp * xi)
    return np.array([rail, -1.0, 0.0, by_yaw, by_roll])


@nb.njit
def _creep(y, psi, xi, radius, slope, rail, curvature, angle, force, side):
    """Return the force of creep on a wheel."""
    sp, cp, spin, sd, cd = np.sin(y[4]), np.cos(y[4]), _SPEED / _RADIUS + y[10], np.sin(angle), np.cos(angle)
    sa, ca, sx, cx = np.sin(y[3] / cd), np.cos(y[3] / cd), np.sin(psi), np.cos(psi)
    mean = 0.5 / (radius * np.sqrt(1.0 + slope**2)) - 0.5 * curvature / (1.0 + rail**2) ** 1.5
    size = (abs(force) * 3.0 * (1.0 - _POISSON) * _HERTZ / (2.0 * 3.1415926 * mean * _SHEAR)) ** (1.0 / 3.0)
    up = xi * sp - radius * cp * cx
    slide = np.array([
        -spin * radius * (sa * cx + ca * sp * sx) + y[5]
        - y[8] * (radius * (sa * sp * cx + ca * sx) + xi * sa * cp) - y[9] * ca * up,
        spin * radius * cp * sx + y[6] + y[9] * (xi * cp + radius * sp * cx),
        -spin * radius * (ca * cx - sa * sp * sx) + _SPEED + y[7]
        - y[8] * (xi * ca * cp + radius * (ca * sp * cx - sa * sx)) + y[9] * sa * up,
    ])  # fmt: skip
    roll = slide - 2.0 * np.array([y[5], y[6], y[7] + _SPEED])
    speed, tilt = 0.5 * np.sqrt(np.sum(roll**2)), -side * sd
    ahead, across = np.array([sa, 0.0, ca]), np.array([ca * cd, tilt, -sa * cd])
    turn, limit, area = (cd * y[8] - tilt * spin) / speed, _FRICTION * force, _SHEAR * size**2
    x = -limit * np.tanh(area * _KALKER[0] * np.sum(ahead * slide) / speed / limit)
    drift = area * _KALKER[1] * np.sum(across * slide) / speed + area * size * _KALKER[2] * turn
    z = -limit * np.tanh(drift / limit)
    share = min(1.0, abs(limit) / np.sqrt(x * x + z * z))
    return share * (x * ahead + z * across)


@nb.njit
def _wheelset(t, y):
    """Return the equations: places, speeds, spin, contact right and left, forces at the rails in 10 kN."""
    f, push = np.empty(17), np.zeros(5)
    st, ct, sp, cp = np.sin(y[3]), np.cos(y[3]), np.sin(y[4]), np.cos(y[4])
    left, right = _contact(y, y[13], y[14], -1.0), _contact(y, y[11], y[12], 1.0)
    normals = _normal(y, y[13], y[14], left[0], left[2]), _normal(y, y[11], y[12], right[0], right[2])
    forces = 1e4 * (normals[0] * y[15] + normals[1] * y[16])
    below = -np.sin(left[4] + right[4])
    loads = (
        (np.cos(right[4]) * forces[0] - np.sin(right[4]) * forces[1]) / below,
        (-np.cos(left[4]) * forces[0] - np.sin(left[4]) * forces[1]) / below,
    )
    spun = 0.0
    for k in range(2):
        wheel, psi, xi = (left if k == 0 else right), y[13 - 2 * k], y[14 - 2 * k]
        radius, slope, rail = wheel[0], wheel[1], wheel[2]
        sx, cx = np.sin(psi), np.cos(psi)
        creep = _creep(y, psi, xi, radius, slope, rail, wheel[3], wheel[4], loads[k], -1.0 if k == 0 else 1.0)
        push[:3] += creep
        push[3] += (
            -(xi * st + radius * sx * ct * cp) * creep[0]
            - radius * sx * sp * creep[1]
            + (radius * sx * st * cp - xi * ct) * creep[2]
        )
        push[4] += (
            (radius * cx * ct * cp - xi * ct * sp) * creep[0]
            + (xi * cp + radius * cx * sp) * creep[1]
            + (xi * st * sp - radius * cx * st * cp) * creep[2]
        )
        spun += radius * (
            sx * cp * creep[1] - (cx * st + sx * ct * sp) * creep[0] - (cx * ct - sx * st * sp) * creep[2]
        )
        f[15 + k] = np.sum(normals[k] * y[5:10])
        f[13 - 2 * k] = rail * (slope * sp + cp * cx) + slope * ct * cp - ct * sp * cx + st * sx
        f[14 - 2 * k] = slope * st * cp - st * sp * cx - ct * sx
    push += forces
    spring, spin = -2.0 * _ARM**2 * _STIFF * y[3], _SPIN * (_SPEED / _RADIUS + y[10])
    push[3] += _TILT * y[8] * y[9] * sp - spin * y[9] - (_SPIN - _TILT) * y[8] * sp * y[9] + cp * spring
    push[4] += spin * y[8] * cp + (_SPIN - _TILT) * y[8] * sp * y[8] * cp
    f[:5] = y[5:10]
    f[5] = (push[0] - 2.0 * _STIFF * y[0]) / _MASS
    f[6] = push[1] / _MASS - 9.81
    f[7] = (push[2] - 2.0 * _STIFF * y[2]) / _MASS
    f[8], f[9] = push[3] / (_TILT * cp), push[4] / _TILT
    f[10] = (spun + sp * spring) / _SPIN - y[8] * y[9] * cp - sp * f[8]
    return f


def wheelset() -> Published:
    """Return the wheelset; its motion becomes a limit cycle, and errors of phase add up over 10 s."""
    y0 = np.array([
        0.0014941, 4.0089e-7, 1.1241e-6, -2.8573e-4, 2.6459e-4, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0,
        -7.4122380357667139e-6, -0.1521364296121248, 7.563440639517294e-6, 0.1490635714733819,
        -0.0083593, -0.0074144,
    ])  # fmt: skip
    end = np.array([
        0.0086355386965811, 1.3038281022727e-5, -9.3635784016818e-5, -0.013642299804033, 0.0015292895005422,
        -0.076985374142666, -2.5151106429207e-4, 0.0020541188079539, -0.23904837703692, -0.013633468454173,
        -0.24421377661131, -3.3666751972196e-4, -0.15949425684022, 3.7839614386969e-4, 0.14173214964613,
    ])  # fmt: skip
    mass = np.append(np.ones(11), np.zeros(6))
    index = np.append(np.ones(15, dtype=int), [2, 2])
    return Published(_wheelset, y0, 10.0, np.arange(15), end, {"mass": mass, "index": index})
