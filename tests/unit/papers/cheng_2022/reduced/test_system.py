"""The run of the vane mechanism: what its result holds, and a drive that would go too far if it went on."""

import numpy as np
import pytest
import xarray as xr

import tribodyn as td


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
