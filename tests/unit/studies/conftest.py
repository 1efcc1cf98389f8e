"""A simulation that takes no time, for tests of what is around it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest
import xarray as xr

import tribodyn.simulation
from tribodyn.core.errors import IntegrationFailure


@pytest.fixture
def simulated(monkeypatch: pytest.MonkeyPatch, make_result: Callable[..., xr.Dataset]) -> list[Any]:
    """Replace the simulation in this process; the cases it is given are in the list.

    A clearance of 30 um stops midway, one of 35 um raises an error that we know, one of 40 um one that
    we do not.
    """
    seen: list[Any] = []

    def simulate(case: Any, **_: Any) -> xr.Dataset:
        seen.append(case)
        micrometres = round(case.joint.clearance * 1e6)
        if micrometres == 35:
            raise IntegrationFailure(0.0, "no equilibrium")
        if micrometres == 40:
            raise ZeroDivisionError("surprise")
        failure = "steps became too small" if micrometres == 30 else ""
        peak = micrometres * case.joint.friction_coefficient
        result = make_result(0.1, failure=failure, contact_force_peak=1e3 * peak, case=case.to_toml())
        # Few variables, because writing all of them takes longer than everything else here.
        return result[["F_cx", "F_cy", "p_max"]]

    monkeypatch.setattr(tribodyn.simulation, "simulate", simulate)
    return seen
