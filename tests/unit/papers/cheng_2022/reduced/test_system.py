"""The reduced mechanism: equilibria, reach, runs and running-in."""

from dataclasses import replace

import numpy as np
import pytest
import xarray as xr

import tribodyn as td
from tribodyn.core.errors import InputError
from tribodyn.mechanisms.catalogue import load_case
from tribodyn.papers.cheng_2022.reduced.parameters import Lengths
from tribodyn.papers.cheng_2022.reduced.problem import initial_state, vsv_data, vsv_memory
from tribodyn.papers.cheng_2022.reduced.reach import check_reach, closure, ideal_vane_angle, reachable
from tribodyn.papers.cheng_2022.reduced.system import vsv_of


def test_a_valid_short_run_of_a_drive_that_would_go_out_of_reach_runs() -> None:
    # 190° of swing: the loop cannot close all the way, but does for the first degrees.
    changes = {"drive.speed_amplitude": "95 deg/s", "run.duration": "0.05 s"}
    result = td.simulate(td.load_case("vsv").replace(changes))
    assert not result.attrs["failure"]
    assert result.sizes["time"] > 5


#: Names that users may rely on, over time.
EVERY_MOMENT = [
    *("e_x", "e_y", "phi_x", "phi_y", "e_x_dot", "e_y_dot", "phi_x_dot", "phi_y_dot"),
    *("theta_a", "theta_b", "theta_v", "theta_v_ideal", "omega_v", "omega_v_ideal"),
    *("F_cx", "F_cy", "F_kx", "F_ky", "F_dx", "F_dy", "F_fx", "F_fy", "F_cz"),
    *("M_jcx", "M_jcy", "M_tcx", "M_tcy", "M_jf", "M_tf", "p_max", "F_21x", "F_32x", "F_43x", "F_bx", "M_d"),
]
FACTS = [
    "case",
    "tribodyn_version",
    "numpy_version",
    "python_version",
    "solver",
    "energy_residual",
    "warnings",
]


@pytest.fixture(scope="module")
def result() -> xr.Dataset:
    """Return a run that goes beyond the first reversal of the built-in drive, at t = π."""
    return td.simulate(td.load_case("vsv").replace({"run.duration": "3.3 s"}))


def test_the_names_of_a_result_can_be_relied_on(result: xr.Dataset) -> None:
    for name in EVERY_MOMENT:
        assert result[name].dims == ("time",), name
        assert np.isfinite(result[name].values).all(), name
    assert {"film_force_peak", "F_ox", "F_oy"}.isdisjoint(result.variables)
    assert any(str(name).startswith("energy_") for name in result.data_vars)
    assert result["pressure"].dims == ("snapshot", "theta", "z")
    assert result["wear_depth"].dims == ("theta", "z")
    assert result["time"].attrs["units"] == "s"
    for name, values in result.variables.items():
        assert values.attrs["long_name"], name
        assert values.attrs["units"] or values.dtype.kind in "UO", name
    assert set(FACTS) <= set(result.attrs)
    np.testing.assert_allclose(result["F_dx"], result["F_cx"] - result["F_kx"])


def test_rows_are_uniform_and_follow_the_steps_after_each_reversal(result: xr.Dataset) -> None:
    times = result["time"].values
    quiet = times[(times < np.pi) & (times > 0.0501)]
    np.testing.assert_allclose(np.diff(quiet), 5e-3, rtol=1e-9)
    reversal = np.abs(times - np.pi).min()
    assert reversal < 1e-9
    after = times[(times > np.pi + 1e-9) & (times < np.pi + 0.01)]
    # Uniform rows alone would be two here; every third of some 450 steps gives one.
    assert after.size > 75


def test_the_largest_rows_are_the_peaks(result: xr.Dataset) -> None:
    """Save what the parabola between two steps adds."""
    force = np.hypot(result["F_cx"], result["F_cy"]).values
    peak = result["contact_force_impact"].values[1]
    assert 0.98 * peak < force[result["time"].values > np.pi].max() <= peak
    assert result["contact_force_impact_time"].values[1] - np.pi < result.attrs["impact_time"]
    assert result["contact_force_outside"].values[0] < 0.5 * peak


@pytest.mark.parametrize("clearance", [5, 20, 100, 190, 500])
@pytest.mark.parametrize("friction", ["traction", "moment"])
def test_every_clearance_has_an_equilibrium(clearance, friction):
    case = load_case("vsv").replace({"joint.clearance": f"{clearance} um", "joint.friction": friction})
    vsv = vsv_of(case)
    data = vsv_data(vsv, duration=1.0)
    attitude = initial_state(data, vsv_memory(data), "equilibrium")
    # Some point of the axis lies within three σ of the wall, and none beyond it by more than that.
    ends = [
        np.hypot(attitude[0] - z * np.tan(attitude[3]), attitude[1] - z * np.tan(attitude[2]))
        for z in (-data.mechanism.half_length, data.mechanism.half_length)
    ]
    assert max(ends) == pytest.approx(data.joint.clearance, abs=3.0 * data.joint.roughness)


QUICK = {
    "run.cycles": 1.0,
    "run.output_interval": "50 ms",
    "run.impact_window": "0 s",
    "wear.specific_wear_rate": "1.1e-12 m^2/N",
    "wear.cycles": 60,
    "wear.jump_limit": 0.5,
    "solver.grid.theta": 48,
    "solver.grid.z": 8,
}


def campaign(**changes: object) -> xr.Dataset:
    return td.simulate(td.load_case("vsv").replace({**QUICK, **changes}))


def test_the_bushing_runs_in_to_the_roughness_of_its_trunnion() -> None:
    worn = campaign(**{"wear.running_in": True})
    assert not worn.attrs["failure"]
    sigma = worn["wear_roughness"].values
    trunnion, bushing = 0.392e-6, 1.586e-6
    assert sigma[0] == pytest.approx(np.hypot(trunnion, bushing), rel=1e-12)
    assert np.all(np.diff(sigma) <= 0.0)
    assert sigma[-1] < 0.9 * sigma[0]
    assert sigma[-1] >= np.hypot(trunnion, trunnion) * (1.0 - 1e-12)
    # The smoother joint carries the same load, closer.
    force = worn["wear_force_mean"].values
    assert force[-1] == pytest.approx(force[0], rel=0.05)
    assert worn.attrs["clearance_energy_residual"] < 0.01


def test_both_wear_in_proportion() -> None:
    both = campaign(**{"wear.specific_wear_rate": "0.8e-12 m^2/N", "wear.partner_wear_rate": "0.3e-12 m^2/N"})
    one = campaign()
    np.testing.assert_allclose(both["wear_depth"], one["wear_depth"], rtol=1e-9)
    assert "27.3 % are worn off the partner" in str(both.attrs["notes"])
    assert "partner" not in str(one.attrs["notes"])
    np.testing.assert_array_equal(one["wear_roughness"], one["wear_roughness"][0])


def test_a_smooth_trunnion_leaves_nothing_to_run_in_to() -> None:
    with pytest.raises(InputError, match="say what the bushing runs in to"):
        td.load_case("vsv").replace({"surfaces.trunnion.roughness": "0 um", "wear.running_in": True})


FEW = range(12)
SEEDS = [*FEW, *(pytest.param(seed, marks=pytest.mark.long) for seed in range(12, 24))]


def varied(lengths: Lengths, seed: int) -> Lengths:
    """Return a mechanism with lengths 20 % and angles 15° off at most."""
    chance = np.random.default_rng(seed)
    names = ("l_1", "l_2", "l_3", "l_4", "l_m")
    changes = {name: getattr(lengths, name) * chance.uniform(0.8, 1.2) for name in names}
    turned = {name: getattr(lengths, name) + chance.uniform(-0.26, 0.26) for name in ("gamma", "phi")}
    return replace(lengths, **changes, **turned)


def test_most_of_these_mechanisms_can_be_assembled(make_vsv):
    reaches = [reachable(varied(make_vsv().lengths, seed), 0.0, 0.0) for seed in FEW]
    assert sum(reach is not None for reach in reaches) > len(reaches) / 2


@pytest.mark.parametrize("seed", SEEDS)
def test_the_vane_angle_follows_the_crank_without_a_jump(make_vsv, seed):
    lengths = varied(make_vsv().lengths, seed)
    reach = reachable(lengths, 0.0, 0.0)
    if reach is None:
        return
    theta_a = np.linspace(*reach, 1001)
    theta_v = np.unwrap(ideal_vane_angle(lengths, theta_a))
    # Where the assemblies merge θ_v changes like a square root, by 0.1 rad here. A jump has 1 or more.
    assert np.abs(np.diff(theta_v)).max(initial=0.0) < 0.3
    np.testing.assert_allclose(closure(lengths, theta_a, theta_v), 0.0, atol=1e-15)


def test_the_other_assembly_passing_straight_down_changes_nothing(make_vsv):
    # Of this mechanism the smaller vane angle falls through −90° while the larger one is at 150°.
    lengths = replace(make_vsv().lengths, l_1=0.0491, l_2=0.1441, l_3=0.4196, l_4=0.0486, l_m=0.483)
    crank = np.radians(np.linspace(-10.0, 15.4, 200))
    check_reach(lengths, crank[0], crank[-1])
    vane = np.degrees(ideal_vane_angle(lengths, crank))
    assert 2.0 > np.diff(vane).max() > np.diff(vane).min() > 0.0
    assert vane[-1] == pytest.approx(159.9, abs=0.05)
