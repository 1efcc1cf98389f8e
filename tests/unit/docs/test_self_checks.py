"""The page on warnings names the thresholds that are built in, and every attribute it points to is stored."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from tribodyn.core.quantities import names
from tribodyn.kernels.joints import collar, quantities
from tribodyn.simulation import checks

PAGE = Path(__file__).parents[3] / "docs" / "guide" / "self_checks.md"
LIMITS = {name: value for name, value in vars(checks).items() if name.endswith("_LIMIT")}


@pytest.mark.parametrize("name", LIMITS)
def test_every_threshold_stands_in_the_table(name: str) -> None:
    rows = {
        "ENERGY_LIMIT": "energy is missed",
        "GRID_LIMIT": "the contact force is off",
        "CLIP_LIMIT": "the clip of tensile pressure",
        "REJECTED_LIMIT": "the integrator threw away",
        "RESTART_LIMIT": "the integration started anew",
    }
    row = next(line for line in PAGE.read_text(encoding="utf-8").splitlines() if rows[name] in line)
    assert f"more than {100.0 * LIMITS[name]:g} %" in row


def test_the_attributes_of_the_table_are_those_of_a_run() -> None:
    lines = PAGE.read_text(encoding="utf-8").splitlines()
    cells = [line.split("|")[3] for line in lines if line.startswith("| ")][1:]
    named = set(re.findall(r"`(\w+)`", " ".join(cells)))
    stored = {
        *names((*quantities.PEAKS, *collar.PEAKS)),
        "energy_residual",
        "clearance_energy_residual",
        "grid_force_error",
        "solver",
    }
    assert len(named) >= 6
    assert named <= stored
