"""Equation 46 found anew: Eqs. 26-43 solved for the reactions, with the printed entries put in one by one.

Nothing here comes from the kernels but the ideal motion (angles of crank, ring and vane and the direction of
the drag link, with two derivatives) and the forces of the joint. Angles of the drag link, inertia forces,
arms and the elimination are written from the paper. What is in ``mended`` is right, all else as printed.
"""

from types import SimpleNamespace

import numpy as np

from tribodyn.kernels.vsv import data as layout
from tribodyn.kernels.vsv import functions
from tribodyn.kernels.vsv.data import AIR_M, AIR_X, AIR_Y

#: What ``paper`` mends of Eq. 46 and Appendix 2, as the table of the manual calls it.
MENDED = (
    "A_12",
    "A_42",
    "Par_x2",
    "z_O2",
    "M_2yi",
    "arm of G_3",
    "M_2zi",
    "B_41, Par",
    "B_41, l_v/2",
    "B_41, F_airx",
    "joints of rod 3",
    "vane centre",
)
LARGE = 2.0**20
F32, F21, BX, BZ, F43Y = 0, 3, 6, 7, 8  #: Columns of the unknown reactions.


def instant(vsv, data, memory, t, y):
    """Return motion, forces and constants of one instant, in the paper's symbols."""
    functions.enter(t, y, data, memory)
    functions.rhs(t, y, data, memory, np.empty(8))
    scratch = memory.scratch
    motion = scratch.motion
    now = SimpleNamespace(vsv=vsv, y=y, wrench=scratch.wrench.copy(), air=scratch.air.copy())
    for name, row in (("a", layout.THETA_A), ("b", layout.THETA_B), ("v", layout.THETA_V)):
        setattr(now, name, motion[row, [layout.VALUE, layout.VELOCITY, layout.BIAS]].copy())
    rod = slice(layout.N_X, layout.N_Z + 1)
    now.n = motion[rod][:, [layout.VALUE, layout.VELOCITY, layout.BIAS]].T.copy()
    now.collar = scratch.collar[[layout.PHI_X, layout.PHI_Y, layout.THETA_V]] * vsv.inertias.m_v * vsv.gravity
    return now


def link_angles(now):
    """Return (θ_sz, θ_sx) of Eq. 54, their rates and accelerations, from n in the frame of the crank."""
    angle, rate, bend = now.a
    c, s = np.cos(angle), np.sin(angle)
    frame = np.array([[c, 0.0, s], [0.0, 1.0, 0.0], [-s, 0.0, c]])
    turn = np.array([[-s, 0.0, c], [0.0, 0.0, 0.0], [-c, 0.0, -s]])
    back = np.array([[-c, 0.0, -s], [0.0, 0.0, 0.0], [s, 0.0, -c]])
    first, second = turn * rate, turn * bend + back * rate**2
    m = frame @ now.n[0]
    m_1 = frame @ now.n[1] + first @ now.n[0]
    m_2 = frame @ now.n[2] + 2.0 * first @ now.n[1] + second @ now.n[0]
    x = np.arctan(m[1] / m[0])
    z = np.arctan2(m[0] / np.cos(x), m[2])
    cz, sz, cx, sx = np.cos(z), np.sin(z), np.cos(x), np.sin(x)
    jacobian = np.array([[cz * cx, -sz * sx], [cz * sx, sz * cx], [-sz, 0.0]])
    rates = np.linalg.lstsq(jacobian, m_1, rcond=None)[0]
    zz, zx, xx = np.array([-sz * cx, -sz * sx, -cz]), np.array([-cz * sx, cz * cx, 0.0]), np.zeros(3)
    xx[:2] = -sz * cx, -sz * sx
    curved = zz * rates[0] ** 2 + 2.0 * zx * rates[0] * rates[1] + xx * rates[1] ** 2
    return np.array([[z, x], rates, np.linalg.lstsq(jacobian, m_2 - curved, rcond=None)[0]])


def par_x2(now, angles, mended):
    """Return ẍ_O2 without ë_x/2, as Par_x2 is printed or as it is."""
    l_1, half = now.vsv.lengths.l_1, 0.5 * now.vsv.lengths.l_2
    (z, x), (z_1, x_1), (z_2, x_2) = angles
    a, a_1, a_2 = now.a
    sz, cz, sx, cx, sa, ca = np.sin(z), np.cos(z), np.sin(x), np.cos(x), np.sin(a), np.cos(a)
    factor, twice = (half, 2.0) if mended else (1.0, 1.0)
    with_alpha, with_square = (l_1 * ca, -l_1 * sa) if mended else (-l_1 * sa, -l_1 * ca)
    return (
        -a_2 * (factor * (sa * sz * cx + cz * ca) + with_alpha)
        - a_1**2 * (factor * (sz * cx * ca - sa * cz) + with_square)
        + half * z_2 * (cz * cx * ca + sa * sz)
        - half * z_1 * a_1 * (2.0 * sa * cz * cx - twice * ca * sz)
        + half * (2.0 * x_1 * a_1 * sa * sz * sx - (z_1**2 + x_1**2) * sz * cx * ca + z_1**2 * sa * cz)
        - half * (2.0 * z_1 * x_1 * cz * sx * ca + x_2 * sz * sx * ca)
    )


def par_y2(now, angles):
    """Return ÿ_O2 without ë_y/2."""
    (z, x), (z_1, x_1), (z_2, x_2) = angles
    sz, cz, sx, cx = np.sin(z), np.cos(z), np.sin(x), np.cos(x)
    rest = (z_1**2 + x_1**2) * sz * sx - 2.0 * z_1 * x_1 * cz * cx
    return 0.5 * now.vsv.lengths.l_2 * (z_2 * cz * sx - rest + x_2 * sz * cx)


def height_of_link(now, angles, mended):
    """Return z̈_O2, as printed or as the third line of Eq. 54 gives it."""
    l_1, half = now.vsv.lengths.l_1, 0.5 * now.vsv.lengths.l_2
    (z, _), (z_1, _), (z_2, _) = angles
    a, a_1, a_2 = now.a
    crank = -l_1 * (a_2 * np.sin(a) + a_1**2 * np.cos(a))
    if mended:
        return crank + half * now.n[2, 2]
    return (
        crank
        - half * (a_2 + z_2) * np.sin(z + a)
        - half * (a_1**2 + z_1**2) * np.cos(z + a)
        - 2.0 * half * z_1 * a_1 * np.cos(z + a)
    )


def link_moments(now, angles, mended):
    """Return M_2yi and M_2zi [N m]: Eq. 30 is about −Y."""
    inertia = now.vsv.link_inertia
    _, y, z = np.cross(now.n[0], now.n[2])
    if mended:
        return inertia * y, -inertia * z
    (t, x), (z_1, x_1), (z_2, x_2) = angles
    swing, cone = 2.0 * z_1 * x_1 + x_2 * t, z_2 - t * x_1**2
    return -inertia * (swing * np.sin(x) - cone * np.cos(x)), -inertia * z


def ring_arms(now, mended):
    """Return (X, Z) of S_2, B and S_3 from the ring's mass centre, part 3 of Appendix 2."""
    l_3, phi, b = now.vsv.lengths.l_3, now.vsv.lengths.phi, now.b[0]

    def turned(angle):
        return np.array([-np.sin(angle), np.cos(angle)] if mended else [np.cos(angle), np.sin(angle)])

    centre = 0.5 * l_3 * np.cos(0.5 * phi) * turned(b - 0.5 * phi)
    reach = l_3 / np.cos(b) if mended else l_3
    return l_3 * turned(b - phi) - centre, -centre, reach * turned(b) - centre


def lever_force(now, f_2, f_3, m_2, f_43x, mended):
    """Return F_43y from Eqs. 26-28, 30, 31, 32-34 and 36."""
    s_2, b, s_3 = ring_arms(now, "joints of rod 3" in mended)
    arm = 0.5 * now.vsv.lengths.l_2 * now.n[0]
    weights = now.vsv.gravity * np.array([now.vsv.inertias.m_2, now.vsv.inertias.m_3])
    a, r = np.zeros((9, 9)), np.zeros(9)
    for k in range(3):
        a[k, [F32 + k, F21 + k]], r[k] = (1.0, -1.0), -f_2[k] + (weights[0] if k == 2 else 0.0)
    for row, other, moment in ((3, 2, m_2[0]), (4, 1, m_2[1])):
        a[row, [F32 + other, F32, F21 + other, F21]] = arm[0], -arm[other], arm[0], -arm[other]
        r[row] = -moment
    a[5, [F32, BX]], r[5] = (-1.0, 1.0), -f_43x - f_3[0]
    a[6, [F32 + 1, F43Y]], r[6] = (-1.0, 1.0), -f_3[1]
    a[7, [F32 + 2, BZ]], r[7] = (-1.0, 1.0), weights[1] - f_3[2]
    a[8, [F32, F32 + 2, BX, BZ]] = s_2[1], -s_2[0], -b[1], b[0]
    r[8] = s_3[1] * f_43x + now.vsv.ring_inertia * now.b[2]
    if "arm of G_3" not in mended:
        r[8] -= (b[1] - b[0]) * (weights[1] - f_3[2])
    return np.linalg.solve(a, r)[F43Y]


def equations(now, mended=MENDED):
    """Return A and B of Eq. 46, rows in the paper's order."""
    vsv, m, y = now.vsv, now.vsv.inertias, now.y
    angles, arm, air = link_angles(now), 0.5 * vsv.lengths.l_v, now.air
    x_2, y_2 = par_x2(now, angles, "Par_x2" in mended), par_y2(now, angles)
    z_2 = height_of_link(now, angles, "z_O2" in mended)
    about_y = link_moments(now, angles, "M_2yi" in mended)[0]
    about_z = link_moments(now, angles, True)[1] if "M_2zi" in mended else 0.0
    out, angle, l_4 = 0.5 * vsv.lengths.l_3 * np.cos(0.5 * vsv.lengths.phi), vsv.lengths.phi, vsv.lengths.l_4
    half = now.b[0] - 0.5 * angle
    x_3 = -out * (now.b[2] * np.cos(half) - now.b[1] ** 2 * np.sin(half))
    z_3 = -out * (now.b[2] * np.sin(half) + now.b[1] ** 2 * np.cos(half))
    v, v_1, v_2 = now.v
    y_3 = l_4 * (v_2 * np.cos(v) - v_1**2 * np.sin(v))
    if "vane centre" in mended:
        slope = 1.0 + np.tan(y[2:4]) ** 2
        curve, along = 2.0 * slope * np.tan(y[2:4]), slope
    else:
        slope, curve, along = np.cos(y[2:4]), -np.sin(y[2:4]), np.ones(2)
    turned = curve * y[6:8] ** 2

    def rows(q):
        x_v = q[0] + arm * (slope[1] * q[3] + turned[1])
        y_v = q[1] + arm * (slope[0] * q[2] + turned[0])
        f_43x = now.wrench[0] + air[AIR_X] - m.m_v * x_v
        f_2 = -m.m_2 * np.array([0.5 * q[0] + x_2, 0.5 * q[1] + y_2, z_2])
        f_3 = -m.m_3 * np.array([0.5 * q[0] + x_3, q[1] + y_3, z_3])
        f_43y = lever_force(now, f_2, f_3, (about_y, about_z), f_43x, mended)
        up_y, up_x = air[AIR_Y] - m.m_v * y_v, air[AIR_X] - m.m_v * x_v
        return np.array(
            [
                now.wrench[1] - f_43y + up_y,
                along[0] * (now.wrench[2] + arm * up_y) + now.collar[0] - m.J_v * q[2],
                along[1] * (now.wrench[3] + arm * up_x) + now.collar[1] - m.J_v * q[3],
                l_4 * (np.sin(v) * f_43x - np.cos(v) * f_43y)
                + now.wrench[4]
                + now.collar[2]
                + air[AIR_M]
                - m.J_vz * v_2,
            ]
        )

    rest = rows(np.zeros(4))
    # Affine: accelerations as large as those of an impact lose no digits beside its forces.
    a, b = np.array([(rows(LARGE * q) - rest) / LARGE for q in np.eye(4)]).T, -rest
    s3_x, s3_y = l_4 * np.cos(v), l_4 * np.sin(v)
    if "A_12" not in mended:
        a[0, 1] += m.m_3 - 0.5 * m.m_2
    if "A_42" not in mended:
        a[3, 1] += 0.5 * m.m_3 * s3_x
    if "B_41, Par" not in mended:
        b[3] += s3_x * (0.5 * m.m_2 * (x_2 - y_2) + m.m_3 * (x_3 - y_3))
    if "B_41, l_v/2" not in mended:
        b[3] += m.m_v * s3_y * (-np.sin(y[3]) * y[7] ** 2 - arm * turned[1])
    if "B_41, F_airx" not in mended:
        b[3] += s3_y * air[AIR_X]
    return a, b
