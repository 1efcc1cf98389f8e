"""The bounce test on every shape: a shaft thrown against its socket comes back as was meant."""

import math
from collections.abc import Callable

import numpy as np
import pytest
from scipy.integrate import DOP853

from mebdf.arrays import FloatArray
from tribodyn.contact import law
from tribodyn.contact.bounce import undamped_depth
from tribodyn.joints.clearances import Clearance, assemble, contact_table, pose_at
from tribodyn.kernels.joints.surface.data import SurfaceData
from tribodyn.kernels.joints.surface.joint import report, update_entry_velocity, wrench
from tribodyn.kernels.joints.surface.memory import new_memory

MakeClearance = Callable[..., Clearance]
MASS = 0.25
X, Z = np.eye(3)[0], np.eye(3)[2]
#: Direction in which the shaft is thrown, 20 µm from its wall.
WALLS = {"cylinder": X, "annulus": -Z, "sphere": X, "mesh": X}
#: The damping is calibrated for points that reach the design pressure. On flat walls all do, and only the
#: step is felt at which nodes enter contact. On round ones the outer points stay shallower: 3.4e-3 are seen
#: on a cylinder, as on the bushing, and twice that on a ball, which is round both ways.
MISSES = {"cylinder": 6e-3, "sphere": 12e-3}
GAP = 20e-6
POINT = "point-lankarani-nikravesh"


def drop(data: SurfaceData, along: FloatArray, start: float, speed: float, sigma: float) -> float:
    """Return the speed on leaving the place ``start`` over that on arriving there."""
    memory, out = new_memory(data), np.empty(6)

    def motion(_: float, y: FloatArray) -> FloatArray:
        wrench(data, memory, 0, pose_at(y[0] * along, None, y[1] * along), out)
        return np.array([y[1], out[:3] @ along / MASS])

    # Nodes take the speed at the end of the step in which they enter contact.
    solver = DOP853(
        motion,
        0.0,
        np.array([start, speed]),
        1.0,
        rtol=1e-8,
        atol=np.array([1e-9 * sigma, 1e-9 * speed]),
        max_step=0.05 * sigma / speed,
        first_step=1e-3 * sigma / speed,
    )
    while solver.status == "running":
        solver.step()
        place, velocity = solver.y
        if place <= start:
            return float(-velocity / speed)
        update_entry_velocity(data, memory, 0, pose_at(place * along, None, velocity * along), 0.0)
    raise AssertionError("stuck")


@pytest.mark.parametrize("wanted", [0.5, 0.9])
@pytest.mark.parametrize("shape", WALLS)
def test_over_the_surface(shape, wanted, make_clearance, table_1_pair):
    chosen = law("rsdc", table_1_pair, damping_factor="calibrated", restitution=wanted)
    along, sigma = WALLS[shape], table_1_pair.roughness_rms
    clearance = make_clearance(
        shape,
        coefficient=0.0,
        table=contact_table("surface", chosen, make_clearance(shape).shape, onset=4.0, smoothing_width=1.0),
    )
    data = assemble([clearance])

    def energy(place: float) -> float:
        memory = new_memory(data)
        report(data, memory, 0, pose_at(place * along))
        return float(np.sum(memory.reports["energy_contact"]))

    onset = GAP - 4.0 * sigma
    deepest = GAP - undamped_depth(clearance.table, 50e6) * sigma
    speed = math.sqrt(2.0 * (energy(deepest) - energy(onset)) / MASS)
    made = drop(data, along, onset, speed, sigma)
    assert made == pytest.approx(wanted, abs=MISSES.get(shape, 1e-4))


@pytest.mark.parametrize("shape", ["cylinder", "sphere"])
@pytest.mark.parametrize("wanted", [0.5, 0.9])
def test_at_points(shape, wanted, make_clearance, table_1_pair):
    chosen = law("gw", table_1_pair, damping_factor="calibrated", restitution=wanted)
    table = contact_table(POINT, chosen, make_clearance(shape).shape, onset=4.0, smoothing_width=1.0)
    data = assemble([make_clearance(shape, contact=POINT, coefficient=0.0, table=table)])
    # The speed at the touch is taken at the end of a step: 1e-3.
    assert drop(data, X, GAP, 0.02, table_1_pair.roughness_rms) == pytest.approx(wanted, abs=1e-3)


def test_a_ball_at_a_point_has_the_force_of_hertz(make_clearance, table_1_pair):
    # F = (4/3) E √(R r/c) δ^1.5, whole at its one point.
    table = contact_table(
        POINT, law("ke", table_1_pair), make_clearance("sphere").shape, onset=4.0, smoothing_width=1.0
    )
    data, out = assemble([make_clearance("sphere", contact=POINT, table=table)]), np.empty(6)
    direction = np.array([0.6, 0.0, 0.8])
    wrench(data, new_memory(data), 0, pose_at(23e-6 * direction), out)
    stiffness = 4.0 / 3.0 * table_1_pair.composite_modulus * math.sqrt(8e-3 * 8.02e-3 / 20e-6)
    # Between nodes of the table, 5 nm apart.
    np.testing.assert_allclose(out[:3], -stiffness * 3e-6**1.5 * direction, rtol=1e-6)
