"""A run that stops before the crank gets where the mechanism cannot go."""

from __future__ import annotations

import tribodyn as td


def test_a_valid_short_run_of_a_drive_that_would_go_out_of_reach_runs() -> None:
    # 190° of swing: the loop cannot close all the way, but does for the first degrees.
    changes = {"drive.speed_amplitude": "95 deg/s", "run.duration": "0.05 s"}
    result = td.simulate(td.load_case("vsv").replace(changes))
    assert not result.attrs["failure"]
    assert result.sizes["time"] > 5
