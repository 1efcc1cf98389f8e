"""Wear of the real mechanism over many cycles, on a coarse grid.

The specific wear rate is a thousand times that of the paper, so that hundreds of cycles wear the edges in.
Without wear two successive cycles differ by 1e-4 of their sliding load: impacts amplify rounding.
"""

from functools import cache

import numpy as np
import pytest

from tribodyn.mechanisms.catalogue import load_case
from tribodyn.mechanisms.results import summarise
from tribodyn.simulation import simulate, wear

COARSE = {"solver.grid.theta": 48, "solver.grid.z": 10, "run.output_interval": "20 ms", "run.impact_rows": 50}
FAST_WEAR = {"wear.specific_wear_rate": "1.1e-12 m^2/N", "wear.cycles": 400, "wear.jump_limit": 0.5}


def vane(**changes):
    return load_case("vsv").replace(
        COARSE | FAST_WEAR | {k.replace("__", "."): v for k, v in changes.items()}
    )


@cache
def campaign(**changes):
    result = simulate(vane(**changes))
    assert not result.attrs["failure"]
    return result


def deepest(result):
    return float(result["wear_depth"].max())


@pytest.mark.parametrize("formulation", ["exact", pytest.param("paper", marks=pytest.mark.long)])
def test_the_pressure_falls_as_the_edges_wear_in(formulation):
    result = campaign(mechanism__formulation=formulation)
    pressure = result["wear_pressure_mean"].values
    # Later, where it is a quarter, scatter may lift it from one stop to the next.
    assert (np.diff(pressure[:4]) < 0.0).all()
    assert pressure[-1] < 0.4 * pressure[0]
    # The rate falls with it, and depth stays below the line on which it would go on as it began.
    assert result["wear_rate"][-1] < 0.3 * result["wear_rate"][0]
    assert deepest(result) < 0.5 * 400 * float(result["wear_rate"][0])
    # The load on the joint is what it was: it is spread over more of the bushing. Over ten tolerances 1e-9
    # apart the mean over the later stops of `paper` exceeds the first one by 0.6 %, with a standard deviation
    # of 0.5 % and 1.2 % at most; the bound is three standard deviations from that mean.
    force = result["wear_force_mean"].values
    assert force[1:].mean() == pytest.approx(force[0], rel=0.02)


def test_wear_is_at_the_edges_and_makes_the_clearance_grow():
    result = campaign(mechanism__formulation="exact")
    depth, z = result["wear_depth"].values, result["z"].values
    assert np.abs(z[np.argmax(depth.max(axis=0))]) == z[-1]
    assert depth[:, np.abs(z) < 5e-3].max() < 0.01 * depth.max()
    error = result["wear_angle_error_rms"].values
    assert error[-1] > 1.05 * error[0]


def test_the_sliding_load_is_the_friction_moment_at_the_sliding_speed():
    # With friction as a moment |M_jf| = μ_f r_b ∬P_c dA, so that the integral of P_c |u| over time and area
    # is that of |M_jf ω_v| r_j/(μ_f r_b) over time.
    case = load_case("vsv").replace(
        {"mechanism.formulation": "paper", "run.cycles": 1, "run.output_interval": "1 ms"}
    )
    result = simulate(case)
    t, power = result["time"].values, np.abs(result["M_jf"].values * result["omega_v_ideal"].values)
    integral = 0.5 * float(np.sum((power[1:] + power[:-1]) * np.diff(t))) * 6e-3 / (0.1 * 6.02e-3)
    # The load is summed by the trapezoidal rule over the steps of the integration, this over 1 ms.
    assert result.attrs["worn_volume"] == pytest.approx(1.1e-15 * integral, rel=1e-3)


@pytest.mark.parametrize("cycles", [0, 30])
def test_the_worn_volume_is_that_of_the_depth_beside_it_in_a_run_and_in_a_campaign(cycles):
    result = simulate(vane(wear__cycles=cycles))
    area = 2.0 * np.pi / 48 * (6e-3 + 20e-6)
    weights = 0.5 * 20e-3 * np.polynomial.legendre.leggauss(10)[1] * area
    volume = float((result["wear_depth"].values[:, 1:-1] @ weights).sum())
    assert volume > 0.0
    assert result.attrs["worn_volume"] == pytest.approx(volume, rel=1e-12)
    assert summarise(result)["worn_volume_mm3"] == pytest.approx(1e9 * volume, rel=1e-12)
    assert "worn_volume" not in result.variables
    assert ("wear_volume" in result.variables) == (cycles > 0)


def test_halving_the_jump_changes_the_depth_by_less_than_two_percent():
    coarse = campaign(wear__jump_limit=0.2, wear__cycles=60)
    fine = campaign(wear__jump_limit=0.1, wear__cycles=60)
    assert fine.sizes["jump"] > 1.4 * coarse.sizes["jump"]
    assert deepest(coarse) == pytest.approx(deepest(fine), rel=0.02)
    volumes = [result.attrs["worn_volume"] for result in (coarse, fine)]
    assert volumes[0] == pytest.approx(volumes[1], rel=0.02)


def test_life_to_a_stated_depth():
    result = campaign(wear__depth_limit="1 um", wear__cycles=10**6)
    life = result.attrs["wear_life_cycles"]
    assert deepest(result) == pytest.approx(1e-6, rel=0.1)  # the last cycle may pass it
    assert deepest(result) >= 1e-6
    assert life <= result.attrs["wear_cycles_reached"] < life + 1.0
    other = campaign(wear__jump_limit=0.2, wear__cycles=60)
    # A campaign with shorter jumps passes that depth at about the same time; it is straight between stops.
    expected = np.interp(1e-6, other["wear_depth_max"], other["wear_cycles"])
    assert life == pytest.approx(float(expected), rel=0.06)


def test_a_run_without_a_campaign_estimates_its_life():
    case = vane(wear__cycles=0, wear__depth_limit="1 um", run__cycles=1)
    result = simulate(case)
    assert result.attrs["wear_life_cycles"] == pytest.approx(1e-6 / deepest(result), rel=1e-12)
    assert "wear_cycles" not in result


def test_what_one_cycle_hands_on_is_what_the_next_begins_with():
    # A campaign that does not wear is one long run of the mechanism, cut at the reversals.
    still = campaign(wear__specific_wear_rate="0 m^2/N", wear__cycles=100)
    long = simulate(load_case("vsv").replace(COARSE | {"run.cycles": 3}))
    last = long.isel(time=long["time"] >= 4.0 * np.pi - 1e-9)
    # Both are the third cycle; rounding of the time tells them apart at impacts, so it is the mean
    # that is compared: two successive cycles differ by 1e-4.
    t = last["time"].values
    force = np.hypot(last["F_cx"].values, last["F_cy"].values)
    mean = 0.5 * float(np.sum((force[1:] + force[:-1]) * np.diff(t))) / float(t[-1] - t[0])
    assert float(still["wear_force_mean"][-1]) == pytest.approx(mean, rel=2e-3)
    assert still["wear_load_change"][-1] < 1e-3
    assert not still["wear_depth"].values.any()


def test_volume_of_each_jump_is_the_rate_times_the_sliding_load(monkeypatch):
    loads = []

    class Watched(wear._Cycles):
        def cycle(self, depth, carried, done):
            found = super().cycle(depth, carried, done)
            loads.append(float((self.system.nodes.area * found.sliding_load).sum()))
            return found

    monkeypatch.setattr(wear, "_Cycles", Watched)
    case = vane(wear__cycles=60)
    result = simulate(case)
    jumps = result["wear_jump_cycles"].values
    assert jumps.size >= 3
    expected = case.wear.specific_wear_rate * jumps[:-1] * np.array(loads[1:-1])
    # To rounding; asked for are 1e-10.
    np.testing.assert_allclose(np.diff(result["wear_volume"].values), expected, rtol=1e-12)
    area = 2.0 * np.pi / 48 * (6e-3 + 20e-6)
    weights = 0.5 * 20e-3 * np.polynomial.legendre.leggauss(10)[1] * area
    volume = float((result["wear_depth"].values[:, 1:-1] @ weights).sum())
    assert volume == pytest.approx(float(result["wear_volume"][-1]), rel=1e-12)


def test_with_less_wear_the_feedback_matters_less():
    straight = campaign(wear__cycles=32, wear__feedback=False, wear__specific_wear_rate="1.1e-13 m^2/N")
    assert straight.sizes["jump"] == 2
    rate = deepest(straight) / 32
    # Depths of 0.15, 0.07 and 0.04 roughnesses at the straight line, each reached in as many jumps.
    shortfall = []
    for cycles, limit in ((32, 0.08), (16, 0.04), (8, 0.02)):
        worn = campaign(wear__cycles=cycles, wear__jump_limit=limit, wear__specific_wear_rate="1.1e-13 m^2/N")
        assert worn.sizes["jump"] >= 4
        shortfall.append(1.0 - deepest(worn) / (cycles * rate))
    # In proportion, as h = ℓ ln(1 + s/ℓ) would have it; jumps of whole cycles leave some.
    assert shortfall[0] / shortfall[1] == pytest.approx(2.0, rel=0.2)
    assert shortfall[1] / shortfall[2] == pytest.approx(2.0, rel=0.2)
    assert 0.0 < shortfall[2] < 0.03


def test_a_limit_that_is_not_reached_is_a_warning():
    result = campaign(wear__depth_limit="1 mm", wear__cycles=8)
    assert "wear_life_cycles" not in result.attrs
    assert "not worn out: at its last rate it would take" in result.attrs["warnings"]
