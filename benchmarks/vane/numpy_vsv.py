"""The vane mechanism as a user of NumPy and SciPy would write it: the same equations, without compiled code.

Joint integral over arrays of all nodes, mechanism with small matrices, SciPy's BDF stepped with the memory of
entry velocities between its steps, its Jacobian by differences. No balances, no reactions, no sliding loads.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import BDF

from benchmarks.vane.numpy_joint import arrays_of, numpy_update, numpy_wrench
from benchmarks.vane.vsv_case import constants
from tribodyn.core.problem import Problem
from tribodyn.joints import BushingJoint
from tribodyn.kernels.vsv.data import O2_X, O3_Z, OV_X, OV_Y, PHI_X, PHI_Y, THETA_B, THETA_V, VsvData

FloatArray = NDArray[np.float64]


UP: Final = np.array([0.0, 1.0, 0.0])  #: Along the casing axis, the direction in which the ring slides.


@dataclass(frozen=True)
class Motion:
    """Kinematics of an instant."""

    #: Vane and ring angle [rad], vane speed [rad/s].
    theta_v: float
    theta_b: float
    omega_v: float
    #: Derivatives of O2, n, O3, θ_b, θ_v, O_v (x, y), φ_x, φ_y by (θ_a, e_x, e_y, φ_x, φ_y), shape (15, 5).
    rows: FloatArray
    bias: FloatArray  #: Their accelerations with the clearance accelerations zero, shape (15,).


class NumpyVsv:
    """Right-hand side of the formulation ``exact`` with traction.

    Parameters
    ----------
    data
        The constants, as the kernels have them.
    joint
        The bushing.
    entry
        Entry velocities at the nodes [m/s]: the memory, shape (n_z + 2, n_theta).
    """

    def __init__(self, data: VsvData, joint: BushingJoint, entry: FloatArray) -> None:
        self.data, self.joint = constants(data), arrays_of(joint)
        self.ring_angle = float(np.arctan2(self.data.ring_sin, self.data.ring_cos))
        self.entry = entry
        self.direction = 1.0
        self.theta_v = float(self.data.ideal[0, 0])
        rows = np.r_[O2_X : O3_Z + 1, THETA_B, THETA_V, OV_X, OV_Y, PHI_X, PHI_Y]
        self.inertia, self.force = self.data.inertia[rows], self.data.weight[rows]

    def closed(self, theta_a: float, e: FloatArray, tan: FloatArray) -> tuple[float, FloatArray, FloatArray]:
        """Solve the closure; return θ_v, S3 and S1 [m]."""
        d = self.data
        s_1 = np.array([d.pivot_x - d.l_1 * np.sin(theta_a), d.l_4, d.pivot_z + d.l_1 * np.cos(theta_a)])
        for _ in range(30):
            s, c = np.sin(self.theta_v), np.cos(self.theta_v)
            s_3 = np.array(
                [
                    e[0] + d.l_4 * c - d.half_length * tan[1],
                    e[1] + d.l_4 * s - d.half_length * tan[0],
                    d.l_3 + d.l_4 * (s * tan[0] + c * tan[1]),
                ]
            )
            along = d.l_4 * np.array([-s, c, c * tan[0] - s * tan[1]])
            s_2, s_2_v = self.ring(s_3, along)
            g = s_2 - s_1
            step = 0.5 * (g @ g - d.l_2**2) / (g @ s_2_v)
            if abs(step) < 1e-15:
                break
            self.theta_v -= step
        return self.theta_v, s_3, s_1

    def ring(self, s_3: FloatArray, along: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return S2 and its derivative where S3 moves by ``along``."""
        beta = self.ring_angle - np.arctan2(-s_3[0], s_3[2])
        s_2 = np.array([self.data.l_3 * np.sin(beta), s_3[1], self.data.l_3 * np.cos(beta)])
        turn = (-s_3[2] * along[0] + s_3[0] * along[2]) / (s_3[0] ** 2 + s_3[2] ** 2)
        return s_2, np.array([-s_2[2] * turn, along[1], s_2[0] * turn])

    def rhs(self, t: float, y: FloatArray) -> FloatArray:
        """Return dy/dt, shape (8,)."""
        return np.concatenate([y[4:], self.accelerations(t, y)[0]])

    def accelerations(self, t: float, y: FloatArray) -> tuple[FloatArray, float, FloatArray]:
        """Return the clearance accelerations (4,), θ_v [rad] and the normal force on the trunnion (2,)."""
        d = self.data
        m = self.motion(t, y)
        jacobian, sec = m.rows[:, 1:], 1.0 + np.tan(y[2:4]) ** 2
        wrench, normal = numpy_wrench(self.joint, self.entry, y, m.omega_v)
        air_x = d.air_force_x * np.tanh((m.theta_v - d.switch_angle) / d.switch_width)
        force = self.force.copy()
        force[10] = wrench[4] - self.direction * d.air_moment
        force[11], force[12] = air_x, d.air_force_y
        force[13], force[14] = sec * wrench[2:4]
        load = jacobian.T @ (force - self.inertia * m.bias)
        load[:2] += wrench[:2]
        mass = jacobian.T @ (self.inertia[:, None] * jacobian)

        # The thrust collar, whose force depends on the acceleration of the vane centre.
        tilt = np.sqrt(y[2] ** 2 + y[3] ** 2 + 1e-12)
        share = -self.direction * self.joint.friction_coefficient * d.collar_radius * jacobian[10]
        share[2:] -= d.collar_radius * y[2:4] / tilt
        slope = np.tan(m.theta_b)
        at_rest = d.vane_weight + slope * (wrench[0] + air_x - d.m_v * m.bias[11])
        with_collar = mass + np.outer(share, slope * d.m_v * jacobian[11])
        found = np.linalg.solve(with_collar, load + share * at_rest)
        if at_rest - slope * d.m_v * jacobian[11] @ found < 0.0:
            found = np.linalg.solve(mass, load)
        return found, m.theta_v, normal

    def motion(self, t: float, y: FloatArray) -> Motion:
        """Return derivatives and remaining accelerations of every coordinate that has inertia."""
        d = self.data
        nu, l_4, half = d.angular_frequency, d.l_4, d.half_length
        theta_a = d.start_angle + d.speed_amplitude / nu * (1.0 - np.cos(nu * t))
        omega_a, alpha_a = d.speed_amplitude * np.sin(nu * t), d.speed_amplitude * nu * np.cos(nu * t)
        tan = np.tan(y[2:4])
        sec = 1.0 + tan**2
        theta_v, s_3, s_1 = self.closed(theta_a, y[:2], tan)
        s, c = np.sin(theta_v), np.cos(theta_v)
        rates = np.array([omega_a, *y[4:]])

        # Partial derivatives by (θ_a, e_x, e_y, φ_x, φ_y): with θ_v held, then with the closure.
        crank = np.array([-d.l_1 * np.cos(theta_a), 0.0, -d.l_1 * np.sin(theta_a)])
        along = l_4 * np.array([-s, c, c * tan[0] - s * tan[1]])
        s_3_u = np.zeros((3, 5))
        s_3_u[0, 1], s_3_u[0, 4] = 1.0, -half * sec[1]
        s_3_u[1, 2], s_3_u[1, 3] = 1.0, -half * sec[0]
        s_3_u[2, 3], s_3_u[2, 4] = l_4 * s * sec[0], l_4 * c * sec[1]
        radius2 = s_3[0] ** 2 + s_3[2] ** 2
        turn = np.array([-s_3[2], 0.0, s_3[0]]) / radius2
        s_2, _ = self.ring(s_3, along)
        swing = np.array([-s_2[2], 0.0, s_2[0]])
        to_s_2 = np.outer(swing, turn) + np.outer(UP, UP)  # dS2/dS3
        g = s_2 - s_1
        g_v = g @ to_s_2 @ along
        g_u = g @ to_s_2 @ s_3_u
        g_u[0] -= g @ crank
        theta_v_u = -g_u / g_v
        s_3_u = s_3_u + np.outer(along, theta_v_u)
        theta_b_u, s_2_u, s_1_u = turn @ s_3_u, to_s_2 @ s_3_u, np.zeros((3, 5))
        s_1_u[:, 0] = crank

        # Accelerations without clearance accelerations: with θ̈_v = 0 first, then from the closure.
        omega_v, omega_b, v_3 = theta_v_u @ rates, theta_b_u @ rates, s_3_u @ rates
        tan_1 = sec * y[6:8]
        tan_2 = 2.0 * tan * tan_1 * y[6:8]
        held_z = 2.0 * omega_v * (c * tan_1[0] - s * tan_1[1]) + s * tan_2[0] + c * tan_2[1]
        held = -l_4 * omega_v**2 * np.array([c, s, s * tan[0] + c * tan[1]])
        held += np.array([-half * tan_2[1], -half * tan_2[0], l_4 * held_z])
        turn_held = turn @ held - 2.0 * omega_b * (s_3[0] * v_3[0] + s_3[2] * v_3[2]) / radius2
        a_1 = crank * alpha_a + d.l_1 * omega_a**2 * np.array([np.sin(theta_a), 0.0, -np.cos(theta_a)])
        a_2 = swing * turn_held + UP * held[1] - np.array([s_2[0], 0.0, s_2[2]]) * omega_b**2
        relative = s_2_u @ rates - crank * omega_a
        theta_v_b = -(g @ (a_2 - a_1) + relative @ relative) / g_v
        theta_b_b = turn_held + turn @ along * theta_v_b
        a_2 = a_2 + to_s_2 @ along * theta_v_b
        a_3y = held[1] + along[1] * theta_v_b

        theta_b = np.arctan2(-s_3[0], s_3[2])
        middle, arm = theta_b - 0.5 * self.ring_angle, 0.5 * d.l_3 * np.cos(0.5 * self.ring_angle)
        o_3 = arm * np.array([-np.sin(middle), 0.0, np.cos(middle)])
        o_swing = np.array([-o_3[2], 0.0, o_3[0]])
        rows, bias = np.zeros((15, 5)), np.zeros(15)
        rows[0:3], bias[0:3] = 0.5 * (s_1_u + s_2_u), 0.5 * (a_1 + a_2)
        rows[3:6], bias[3:6] = (s_2_u - s_1_u) / d.l_2, (a_2 - a_1) / d.l_2
        rows[6:9] = np.outer(o_swing, theta_b_u) + np.outer(UP, s_3_u[1])
        bias[6:9] = o_swing * theta_b_b + UP * a_3y - o_3 * omega_b**2
        rows[9], bias[9], rows[10], bias[10] = theta_b_u, theta_b_b, theta_v_u, theta_v_b
        rows[11, 1], rows[11, 4], bias[11] = 1.0, d.vane_arm * sec[1], d.vane_arm * tan_2[1]
        rows[12, 2], rows[12, 3], bias[12] = 1.0, d.vane_arm * sec[0], d.vane_arm * tan_2[0]
        rows[13, 3] = rows[14, 4] = 1.0
        return Motion(theta_v, theta_b, omega_v, rows, bias)


def integrate_with_scipy(
    problem: Problem, joint: BushingJoint, rtol: float, output_times: FloatArray
) -> dict[str, Any]:
    """Step SciPy's BDF over all segments; return vane angle and contact force at the output times."""
    model = NumpyVsv(problem.data, joint, problem.memory.joint.entry_velocity)
    y, rows, steps, calls = problem.y0, [], 0, 0
    edges = [problem.t_span[0], *problem.breakpoints, problem.t_span[1]]
    for start, end in pairwise(edges):
        model.direction = 1.0 if np.sin(model.data.angular_frequency * 0.5 * (start + end)) > 0.0 else -1.0
        solver = BDF(model.rhs, start, y, end, rtol=rtol, atol=problem.atol)
        while solver.status == "running":
            solver.step()
            inside = output_times[(output_times > solver.t_old) & (output_times <= solver.t)]
            if inside.size:
                dense = solver.dense_output()
                for t in inside:
                    _, theta_v, force = model.accelerations(t, dense(t))
                    rows.append((t, theta_v, *force))
            numpy_update(model.joint, solver.y, model.entry)
            steps += 1
        y, calls = solver.y, calls + solver.nfev
    t, theta_v, f_x, f_y = np.array(rows).T
    columns = {"theta_v": theta_v, "F_cx": f_x, "F_cy": f_y}
    return {"t": t, "columns": columns, "steps": steps, "rhs": calls}
