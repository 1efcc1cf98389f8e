"""Two free bodies joined by nothing but a clearance joint keep their momenta and their energy."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import pytest
from scipy.integrate import DOP853
from scipy.spatial.transform import Rotation

from tribodyn.core.arrays import FloatArray
from tribodyn.core.quantities import Record
from tribodyn.joints.clearances import Clearance, assemble, pose_at
from tribodyn.kernels.joints.surface.data import SurfaceData
from tribodyn.kernels.joints.surface.joint import report, update_entry_velocity, wrench
from tribodyn.kernels.joints.surface.memory import SurfaceMemory, new_memory

MASS = np.array([0.8, 0.3])
#: Principal moments of the body with the socket and of the one with the shaft [kg m²].
INERTIA = np.array([[4e-4, 6e-4, 5e-4], [1e-4, 0.8e-4, 0.5e-4]])
#: From mass centres to the joint, in axes of the bodies [m].
ARM = np.array([[0.02, -0.01, 0.015], [-0.01, 0.02, -0.02]])


def turned(state: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the rotations of both bodies from their quaternions, which need not be quite of length one."""
    both = Rotation.from_quat(state[:, 3:7]).as_matrix()
    return both[0], both[1]


@dataclass
class Pair:
    """Both bodies: positions, quaternions (scalar last), velocities, and angular velocities, all global."""

    data: SurfaceData
    memory: SurfaceMemory

    def pose(self, state: FloatArray) -> Record:
        """Return the pose of the shaft in the socket."""
        rotation, moving = turned(state), []
        for body in range(2):
            arm = rotation[body] @ ARM[body]
            moving.append((state[body, :3] + arm, state[body, 7:10] + np.cross(state[body, 10:], arm)))
        (o, o_dot), (p, p_dot) = moving
        omega, socket = state[0, 10:], rotation[0].T
        return pose_at(
            socket @ (p - o),
            socket @ rotation[1],
            socket @ (p_dot - o_dot - np.cross(omega, p - o)),
            socket @ (state[1, 10:] - omega),
        )

    def loads(self, state: FloatArray) -> FloatArray:
        """Return forces and moments about the mass centres, global, shape (2, 6)."""
        out, rotation = np.empty(6), turned(state)
        wrench(self.data, self.memory, 0, self.pose(state), out)
        force, moment = rotation[0] @ out[:3], rotation[0] @ out[3:]
        p = state[1, :3] + rotation[1] @ ARM[1]
        loads = np.empty((2, 6))
        for body, sign in ((0, -1.0), (1, 1.0)):
            loads[body, :3] = sign * force
            loads[body, 3:] = sign * (moment + np.cross(p - state[body, :3], force))
        return loads

    def rates(self, _: float, y: FloatArray) -> FloatArray:
        """Return the time derivative of both states and of the heat."""
        state, rate = y[:-1].reshape(2, 13), np.empty((2, 13))
        loads, rotation = self.loads(state), turned(state)
        for body in range(2):
            omega = state[body, 10:]
            rate[body, :3] = state[body, 7:10]
            vector, scalar = state[body, 3:6], state[body, 6]
            rate[body, 3:6] = 0.5 * (scalar * omega + np.cross(omega, vector))
            rate[body, 6] = -0.5 * omega @ vector
            rate[body, 7:10] = loads[body, :3] / MASS[body]
            tensor = rotation[body] @ np.diag(INERTIA[body]) @ rotation[body].T
            rate[body, 10:] = np.linalg.solve(tensor, loads[body, 3:] - np.cross(omega, tensor @ omega))
        report(self.data, self.memory, 0, self.pose(state))
        heat = self.memory.reports["damping_power"].sum() - self.memory.reports["friction_power"].sum()
        return np.append(rate, heat)

    def totals(self, y: FloatArray) -> tuple[FloatArray, FloatArray, float]:
        """Return momentum, angular momentum about the origin, and energy with the heat."""
        state = y[:-1].reshape(2, 13)
        rotation, momentum, spin = turned(state), np.zeros(3), np.zeros(3)
        report(self.data, self.memory, 0, self.pose(state))
        energy = y[-1] + np.sum(self.memory.reports["energy_contact"])
        for body in range(2):
            own = MASS[body] * state[body, 7:10]
            turning = rotation[body] @ (INERTIA[body] * (rotation[body].T @ state[body, 10:]))
            momentum, spin = momentum + own, spin + np.cross(state[body, :3], own) + turning
            energy += 0.5 * own @ state[body, 7:10] + 0.5 * turning @ state[body, 10:]
        return momentum, spin, energy


def thrown(seed: int) -> FloatArray:
    """Return two moving bodies as drawn, the shaft in the middle of the socket, and no heat yet."""
    random = np.random.default_rng(seed)
    state = np.zeros((2, 13))
    state[:, :3] = -ARM
    state[:, 6] = 1.0
    common = random.normal(size=3)
    state[:, 10:] = common + 0.3 * random.normal(size=(2, 3))
    # Joint velocities of some cm/s against each other: they meet within a millisecond.
    for body in range(2):
        state[body, 7:10] = 0.05 * random.normal(size=3) - np.cross(state[body, 10:], ARM[body])
    return np.append(state, 0.0)


LONG = 3e-3
TOLERANCE = 1e-10


@pytest.mark.parametrize("shape", ["cylinder", "flanged", "sphere", "mesh", "guide"])
def test_momentum_and_energy(shape: str, make_clearance: Callable[..., Clearance]) -> None:
    # Several impacts, sliding and rattling. Axes of the bodies are those of the drawing as they start.
    data = assemble([make_clearance(shape, grid=(32, 6))])
    pair = Pair(data, new_memory(data))
    y = thrown(4)
    before, met = pair.totals(y), 0
    scale = np.tile([1e-6, 1e-6, 1e-6, 1e-4, 1e-4, 1e-4, 1e-4, *[1e-2] * 3, *[1.0] * 3], 2)
    atol = TOLERANCE * np.append(scale, 1e-3)
    solver = DOP853(pair.rates, 0.0, y, LONG, rtol=TOLERANCE, atol=atol, max_step=2e-4)
    touching = False
    while solver.status == "running":
        solver.step()
        pose = pair.pose(solver.y[:-1].reshape(2, 13))
        update_entry_velocity(data, pair.memory, 0, pose, 0.0)
        now = bool(pair.memory.entry_velocity.any())
        met, touching = met + (now and not touching), now
    after = pair.totals(solver.y)
    assert solver.status == "finished"
    assert met >= 2
    assert solver.y[-1] > 0.0
    # Forces are opposite to rounding and the method adds up linear momentum exactly.
    size = MASS @ np.linalg.norm(y[:-1].reshape(2, 13)[:, 7:10], axis=1)
    np.testing.assert_allclose(after[0], before[0], rtol=0.0, atol=1e-12 * size)
    # Angular momentum hangs on the tolerance, energy on that and on the corners of contact: seen up to 1e-14
    # and 5e-10.
    np.testing.assert_allclose(after[1], before[1], rtol=0.0, atol=1e-12 * np.linalg.norm(before[1]))
    assert after[2] == pytest.approx(before[2], rel=1e-8)


@pytest.mark.parametrize(
    "shape", ["cylinder", "flanged", "annulus", "sphere", "mesh", "guide", "dovetail", "slot"]
)
def test_action_is_reaction(shape: str, make_clearance: Callable[..., Clearance]) -> None:
    # About any point both wrenches add up to nothing, whatever the pose: here about the global origin.
    data = assemble([make_clearance(shape, grid=(32, 6))])
    pair, random = Pair(data, new_memory(data)), np.random.default_rng(2)
    for _ in range(5):
        state = thrown(int(random.integers(100)))[:-1].reshape(2, 13)
        state[1, :3] += 1.8e-5 * random.normal(size=3)
        loads = pair.loads(state)
        arms = np.cross(state[:, :3], loads[:, :3]) + loads[:, 3:]
        size = np.abs(np.cross(state[:, :3], loads[:, :3])).max() + np.abs(loads[:, 3:]).max()
        np.testing.assert_array_equal(loads[0, :3], -loads[1, :3])
        np.testing.assert_allclose(arms.sum(axis=0), 0.0, rtol=0.0, atol=1e-14 * size)
