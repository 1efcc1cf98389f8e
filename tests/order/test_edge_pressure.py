"""The peak pressure of an impact at the edge of the bushing, over three grids.

The pressure at a point is a function of the gap there, so it converges with the forces that make the gap,
at a sharp edge, too. What does not is the damping pressure of points that enter contact slowly and are then
approached faster: each has an entry velocity of its own, and the finer the grid, the slower the slowest.
Without that memory, or with a least entry velocity above those of the impact, the peak is one number.
"""

import pytest

import tribodyn as td

GRIDS = ((96, 16), (192, 16), (192, 32))


def run(case, theta, z):
    return td.simulate(case.replace({"solver.grid.theta": theta, "solver.grid.z": z}))


@pytest.mark.parametrize(
    "damping", [{"contact.loss_coefficient": "100 s/m"}, {"contact.minimum_entry_velocity": "20 mm/s"}]
)
def test_peak_pressure_converges_without_slow_entries(damping):
    case = td.load_case("vsv").replace({"run.duration": "3.16 s", "solver.rtol": 1e-4} | damping)
    peaks = [float(run(case, theta, z).pressure_impact.max()) for theta, z in GRIDS]
    # Measured: 0.5 %, most of it the angle between two nodes, which the finer grid halves.
    assert peaks == pytest.approx([peaks[-1]] * 3, rel=0.01)
