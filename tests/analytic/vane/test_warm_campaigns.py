"""Temperatures over a wear campaign: of the joint of a vane and of a user-defined mechanism."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import tribodyn as td

EXPANSIONS = {
    "surfaces.trunnion.thermal_expansion": "12e-6 1/K",
    "surfaces.bushing.thermal_expansion": "50e-6 1/K",
}
GAIN = 50e-6 * 6.02e-3  #: What a free bore of 6.02 mm gains for each kelvin [m/K].
TURN = 0.02  #: Time of a turn of the journal [s].


def journal(**changes: Any) -> td.Case:
    """Return a journal that turns in its bearing under a constant load."""
    drawn = td.Mechanism(
        "Journal",
        run={"cycles": 1, "period": f"{TURN} s", "output_interval": "1 ms"},
        wear={"specific_wear_rate": "1e-15 m^2/N"},
    )
    drawn.body("journal", mass="0.25 kg", centre="0, 0, 0 mm", inertia=["5e-4 kg m^2"] * 3)
    drawn.revolute("main", "ground", "journal", point="0, 0, 0 mm", axis=[0, 0, 1])
    sizes = {"radius": "6 mm", "radial": "20 um", "length": "20 mm", "axial": "50 um"}
    drawn.clearance("main", **sizes, nodes_around=48, nodes_along=4)
    drawn.load("weight", "journal", direction=[0.8, 0.6, 0], force="500 N")
    case: td.Case = drawn.drive("motor", "main", speed=f"{2.0 * np.pi / TURN!r} rad/s").case()
    return case.replace(EXPANSIONS | changes)


def warming(path: str, seconds: float, rise: float, time: float) -> dict[str, str]:
    """Return a table of a body that warms up: a lumped capacity behind a resistance, τ = RC [s]."""
    times = np.concatenate([np.linspace(0.0, 3.0 * time, 25), [10.0 * time]])
    times = np.unique(np.append(times[times < seconds], seconds))
    values = 20.0 + rise * (1.0 - np.exp(-times / time))
    return {
        f"{path}over_time.bushing.times": ", ".join(map(str, times.tolist())) + " s",
        f"{path}over_time.bushing.values": ", ".join(map(str, values.tolist())) + " degC",
    }


VANE = {
    "solver.grid.theta": 48,
    "solver.grid.z": 10,
    "run.output_interval": "50 ms",
    "run.impact_rows": 50,
    "run.cycles": 1,
    **EXPANSIONS,
}


@pytest.mark.parametrize("kind", ["journal", "vane"])
def test_the_clearance_of_each_cycle_is_that_of_the_temperature_of_its_time(kind: str) -> None:
    """T = T_0 + ΔT (1 − exp(−t/τ)) of a lumped capacity: a τ of 200 cycles, of which 300 are worn."""
    if kind == "journal":
        case, path, period = journal(), "joints.main.clearance.temperature.", TURN
    else:
        case = td.load_case("vsv").replace(VANE)
        path, period = "temperature.", 2.0 * np.pi
    table = warming(path, 400.0 * period, 40.0, 200.0 * period)
    run = td.simulate(case.replace(table | {"wear.cycles": 300, "wear.jump_depth": 1.0, "run.cycles": 2}))
    assert not run.attrs["failure"]
    # One cycle settles, 300 wear, and the last one is shown.
    time = 301.0 * period + run["time"].values
    wanted = 20e-6 + GAIN * 40.0 * (1.0 - np.exp(-time / (200.0 * period)))
    clearance = run["radial_clearance"].values.reshape(time.size, -1)[:, 0]
    assert clearance == pytest.approx(wanted, abs=1e-5 * 20e-6)
    # No jump passes a row of the table.
    cycles = run["wear_cycles"].values
    rows = np.ceil(np.linspace(0.0, 600.0, 25) - 1e-9) - 1.0
    assert set(rows[(rows > 0.0) & (rows < 300.0)]) <= set(cycles)


def test_a_campaign_in_single_cycles_is_one_long_run() -> None:
    """Cycle by cycle, while the bore warms up by 30 K in five cycles; wear is too slow to matter."""
    path = "joints.main.clearance.temperature."
    table = {
        f"{path}over_time.bushing.times": f"0, {2.0 * TURN}, {5.0 * TURN} s",
        f"{path}over_time.bushing.values": "20, 45, 50 degC",
        f"{path}over_time.bushing.interpolation": "linear",
    }
    long = td.simulate(journal(**table, **{"run.cycles": 5}))
    short = td.simulate(
        journal(**table, **{"wear.cycles": 4, "wear.jump_limit": 1e-6, "wear.jump_depth": 1e-9})
    )
    assert short["wear_jump_cycles"].values.tolist() == [1.0, 1.0, 1.0, 1.0, 0.0]
    last = long.interp(time=4.0 * TURN + short["time"].values)
    for name in ("radial_clearance", "displacement"):
        found, wanted = short[name].values, last[name].values
        assert found == pytest.approx(wanted, abs=2e-4 * np.abs(wanted).max()), name
    # The campaign wears by the first four cycles, the run by five.
    load = long["wear_depth"].values.max()
    assert short["wear_depth"].values.max() == pytest.approx(0.8 * load, rel=0.05)


def test_without_feedback_jumps_follow_temperatures_as_well() -> None:
    table = warming("joints.main.clearance.temperature.", 200.0 * TURN, 40.0, 50.0 * TURN)
    run = td.simulate(journal(**table, **{"wear.cycles": 150, "wear.feedback": False}))
    assert run.sizes["jump"] > 20
    assert run["radial_clearance"].values[0, 0] > 20e-6 + 0.9 * GAIN * 40.0


@pytest.mark.parametrize("kind", [pytest.param("journal", marks=pytest.mark.long), "vane"])
def test_a_warm_campaign_that_was_stopped_goes_on_to_the_same_bits(kind: str, tmp_path: Path) -> None:
    if kind == "journal":
        case, path, period = journal(), "joints.main.clearance.temperature.", TURN
    else:
        case, path, period = td.load_case("vsv").replace(VANE), "temperature.", 2.0 * np.pi
    case = case.replace(
        warming(path, 400.0 * period, 40.0, 50.0 * period) | {"wear.cycles": 60, "run.cycles": 2}
    )
    whole, reached = td.simulate(case), []

    def stop() -> bool:
        return bool(reached) and reached[-1] > 20.0

    parts = {"checkpoint": tmp_path / "kept.npz"}
    stopped = td.simulate(case, progress=reached.append, stop=stop, **parts)
    assert stopped.attrs["failure"] == "interrupted"
    assert 0 < stopped.attrs["wear_cycles_reached"] < 60
    resumed = td.simulate(case, **parts)
    assert resumed.attrs["rows_sha256"] == whole.attrs["rows_sha256"]
    np.testing.assert_array_equal(resumed["wear_depth"], whole["wear_depth"])
