"""The page on warnings names the thresholds that are built in, and every attribute it points to is stored."""

import re
from pathlib import Path

import pytest

import tribodyn as td
from tribodyn.kernels.joints.surface.data import PLASTIC
from tribodyn.mechanisms import self_checks as checks

PAGE = Path(__file__).parents[3] / "docs" / "guide" / "self_checks.md"
LIMITS = {name: value for name, value in vars(checks).items() if name.endswith("_LIMIT")}


@pytest.mark.parametrize("name", LIMITS)
def test_every_threshold_stands_in_the_table(name: str) -> None:
    rows = {
        "ENERGY_LIMIT": "energy is missed",
        "GRID_LIMIT": "the contact force is off",
        "LINER_LIMIT": "as its liner is thick",
        "CLIP_LIMIT": "the tension cut-off acted",
        "HARDNESS_LIMIT": "the contact pressure reached",
        "AREA_LIMIT": "the real area of contact reached",
        "LIFT_OFF_LIMIT": "the thrust collar carried nothing",
        "REJECTED_LIMIT": "the integrator threw away",
        "RESTART_LIMIT": "the integration started anew",
        "ROUGH_LIMIT": "times the combined roughness",
    }
    row = next(line for line in PAGE.read_text(encoding="utf-8").splitlines() if rows[name] in line)
    others = {"HARDNESS_LIMIT": "more than a third", "ROUGH_LIMIT": f"below {LIMITS[name]:g}"}
    assert others.get(name, f"more than {100.0 * LIMITS[name]:g} %") in row


def test_the_attributes_of_the_table_are_those_of_a_run() -> None:
    paragraphs = PAGE.read_text(encoding="utf-8").split("\n\n")
    (table,) = [text for text in paragraphs if text.startswith("| warning says | when | from attribute |")]
    named = [re.findall(r"`(\w+)`", row.split("|")[3]) for row in table.splitlines()[2:]]
    # Each warning but the last, which has no threshold, points to what it was read from.
    assert len(named) > len(LIMITS)
    assert all(named[:-1])
    assert not named[-1]
    result = td.simulate(td.load_case("vsv").replace({"run.duration": "5 ms"}))
    assert {name for names in named for name in names} <= set(result.attrs) | {
        PLASTIC.name
    }  # that of a user-defined mechanism alone
