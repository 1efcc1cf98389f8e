"""The Jacobian that the integrators are given, against differences of the right-hand side.

It is exact in the joint and the collar and leaves out how arms and masses change with the clearance
coordinates, which is small against the contact stiffness; an integrator needs no more.
"""

import math

import numpy as np
import pytest

from tribodyn.kernels.vsv import functions
from tribodyn.kernels.vsv.quantities import OBSERVED
from tribodyn.papers.cheng_2022.reduced.problem import vsv_data, vsv_memory

#: What makes about the same difference in each state, see the test of the joint's Jacobian.
SCALE = np.array([1.6e-6, 1.6e-6, 1.6e-4, 1.6e-4, 1e-3, 1e-3, 0.1, 0.1])
STEP = SCALE * np.array([1e-4] * 4 + [1e-3] * 4)
#: Of the largest entry of a row in those units, and of the acceleration itself: tilted by 1.6e-4 rad, forces
#: turn by as much, and that is what is missing.
LEFT_OUT = 5e-4
WEIGHTS = np.array([-1.0, 9.0, -45.0, 0.0, 45.0, -9.0, 1.0]) / 60.0


def draw(data, seed):
    """Return a time, a state in light to hard contact without rates at kinks, and entry velocities."""
    random = np.random.default_rng(seed)
    y = random.uniform(-1.0, 1.0, 8) * [0, 0, 1e-3, 1e-3, 1e-4, 1e-4, 1e-2, 1e-2]
    eccentricity = data.joint.clearance - random.uniform(0.0, 3.0) * data.joint.roughness
    angle = random.uniform(0.0, 2.0 * math.pi)
    eccentricity -= 0.01 * np.hypot(*y[2:4])
    y[:2] = eccentricity * math.cos(angle), eccentricity * math.sin(angle)
    return random.uniform(0.0, 2.0 * math.pi), y, random.choice([1e-3, 5e-3], size=data.joint.wear.shape)


@pytest.mark.parametrize("friction", ["traction", "moment"])
@pytest.mark.parametrize("formulation", ["exact", "paper", "printed"])
def test_jacobian_of_the_accelerations(make_vsv, formulation, friction):
    data = vsv_data(make_vsv(formulation, friction=friction))
    lifted = 0
    for seed in range(20):
        t, y, entry = draw(data, seed)
        memory = vsv_memory(data)
        memory.regime[0] = math.copysign(1.0, math.sin(t))
        memory.joint.entry_velocity[:, :] = entry
        f, jacobian, row, columns = np.empty(8), np.empty((8, 8)), np.zeros(len(OBSERVED)), []
        for k in range(8):
            points = y + np.outer(np.arange(-3.0, 4.0) * STEP[k], np.eye(8)[k])
            rates = []
            for point in points:
                functions.rhs(t, point, data, memory, f)
                rates.append(f.copy())
            columns.append(WEIGHTS @ np.array(rates) / STEP[k])
        expected = np.array(columns).T * SCALE
        functions.jac(t, y, data, memory, f, jacobian)
        functions.observe(t, y, data, memory, row)
        lifted += row[OBSERVED.index("F_cz")] == 0.0
        size = np.abs(expected).max(axis=1) + np.abs(f)
        error = np.abs(jacobian * SCALE - expected).max(axis=1)
        assert (error <= LEFT_OUT * size).all(), f"state {seed}: {error / size}"
    assert lifted < 20
    assert (lifted > 0) == (formulation == "exact")


def test_jacobian_brings_the_same_rates(make_vsv):
    data = vsv_data(make_vsv())
    t, y, entry = draw(data, 0)
    memory = vsv_memory(data)
    memory.joint.entry_velocity[:, :] = entry
    alone, together, jacobian = np.empty(8), np.empty(8), np.empty((8, 8))
    functions.rhs(t, y, data, memory, alone)
    functions.jac(t, y, data, memory, together, jacobian)
    # Two orders of the same sums over some hundred nodes.
    np.testing.assert_allclose(together, alone, rtol=0.0, atol=1e-13 * np.abs(alone).max())
    np.testing.assert_array_equal(jacobian[:4], np.eye(8)[4:])
