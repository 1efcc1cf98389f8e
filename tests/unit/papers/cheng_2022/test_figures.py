"""Figures of the paper are drawn where its claims are judged; ``make check`` draws and judges all of them."""

import numpy as np
import xarray as xr
from matplotlib.collections import QuadMesh

from tribodyn.papers.cheng_2022.claims.pressure import contact_arc
from tribodyn.papers.cheng_2022.figures import FIGURES, Runs
from tribodyn.papers.cheng_2022.runs import CLEARANCES, on_grid

ENDS = (CLEARANCES[0], CLEARANCES[-1])
COARSE = {"solver.grid.theta": 32, "solver.grid.z": 6}
#: Each vane on its default grid, which follows the clearance, so that joining has to bring them together.
RUNS = Runs(clearances=ENDS, changes={"vsv-joints": {**COARSE, "run.cycles": 1}})


def test_pressure_and_wear_are_drawn_at_the_angles_that_claims_are_judged_on():
    pressure, wear = FIGURES["fig15"], FIGURES["fig19"]
    data = pressure.data(RUNS, "exact")
    maps = pressure.draw(data).axes[:6]
    fields = data["pressure"].values
    for axes, order in zip(maps, (0, 5, 1, 4, 2, 3), strict=True):
        theta = _peak_of_map(axes)
        direct = np.degrees(data["theta"].values[fields[order].max(axis=1).argmax()])
        assert _apart(theta, direct) < 1e-9
        first, last = contact_arc(data["theta"].values, fields[order].max(axis=1), direct)
        assert first < direct < last
        # Eq. 44: the force on the trunnion points from the contact along θ, forward along +X.
        assert (np.cos(np.radians(theta)) > 0.0) == (order < 3)
    worn = wear.data(RUNS, "exact")
    drawn = wear.draw(worn)
    for i in range(len(ENDS)):
        plan, profile = drawn.axes[2 * i : 2 * i + 2]
        last = profile.lines[-1]
        assert _apart(_peak_of_map(plan), float(last.get_xdata()[np.argmax(last.get_ydata())])) < 1e-9
        deepest = worn["wear_depth"].values[i, -1].max(axis=1).argmax()
        assert _apart(_peak_of_map(plan), float(np.degrees(worn["theta"].values[deepest]))) < 1e-9


def _peak_of_map(axes) -> float:
    """Return the angle of the largest value that a map shows [deg]."""
    [mesh] = [one for one in axes.collections if isinstance(one, QuadMesh)]
    values = np.asarray(mesh.get_array())
    place = np.unravel_index(int(values.argmax()), values.shape)
    return float(mesh.get_coordinates()[place][0])


def _apart(one: float, other: float) -> float:
    """Return the distance of two angles [deg]."""
    return abs((one - other + 180.0) % 360.0 - 180.0)


def test_fields_at_other_nodes_are_linear_between_their_own():

    theta, z = np.linspace(0.0, 2.0 * np.pi, 8, endpoint=False), np.array([-1.0, 0.0, 1.0])
    run = xr.Dataset(
        {"depth": (("theta", "z"), np.outer(np.arange(8.0), z + 2.0))}, coords={"theta": theta, "z": z}
    )
    np.testing.assert_allclose(on_grid(run, theta, z)["depth"], run["depth"], atol=1e-14)
    # Half a step behind the last node, where the first comes again: half of both.
    other = on_grid(run, np.array([theta[1] / 2.0, theta[-1] + theta[1] / 2.0]), np.array([0.5]))
    np.testing.assert_allclose(other["depth"].values.ravel(), [0.5 * 2.5, 3.5 * 2.5])


def test_a_figure_leaves_the_runs_that_claims_are_judged_on():
    run = RUNS.vsv("paper", 20e-6)
    of_the_run = run["pressure"].values.copy()
    drawn = FIGURES["fig15"].data(RUNS, "paper")
    assert np.array_equal(run["pressure"].values, of_the_run)
    # The figure shows static equilibrium, which is another field.
    assert not np.allclose(drawn["pressure"].values, of_the_run, rtol=0.01)
