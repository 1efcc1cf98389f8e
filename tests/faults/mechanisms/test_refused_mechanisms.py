"""Mechanisms that are refused, and those that every analysis answers."""

from __future__ import annotations

import re
import time
import tomllib
from pathlib import Path

import pytest
from tests.unit.mechanism.slider_crank import FILE, IDEAL, parsed

import tribodyn as td
from tribodyn.core.errors import InputError
from tribodyn.mechanism.builder.mechanism_builder import Mechanism
from tribodyn.mechanism.joints import JOINTS
from tribodyn.mechanism.system import MechanismSystem
from tribodyn.mechanisms.catalogue import load_case, template, templates

REFUSED = tomllib.loads(Path(__file__).with_name("refused_mechanisms.toml").read_text(encoding="utf-8"))
REAL = [name for name, kind in JOINTS.items() if kind.SHAPE]


def test_the_slider_crank_itself_is_sound() -> None:
    for text in (FILE, IDEAL):
        assert MechanismSystem(parsed(text)).check()


@pytest.mark.parametrize("name", REFUSED)
def test_a_mechanism_that_cannot_be_is_refused_in_words(name: str) -> None:
    change = REFUSED[name]
    text = IDEAL if change.get("ideal") else FILE
    assert text.count(change["old"]) >= 1
    with pytest.raises(InputError) as caught:
        MechanismSystem(parsed(text.replace(change["old"], change["new"], change.get("times", 1)))).check()
    # How near to closing an iteration comes that has no solution is a matter of rounding.
    message = change["message"].replace("JOINTS", ", ".join(JOINTS)).replace("REAL", ", ".join(REAL))
    assert re.sub(r"[\d.]+ mm are left", "N mm are left", str(caught.value)) == message


def rssr(crank: float, real: bool) -> Mechanism:
    """Return a crank about z, a coupler between two balls and a rocker about x; lengths in mm."""
    small, chance = "1e-4, 1e-4, 1e-4 kg m^2", {"radius": "8 mm", "radial": "20 um"}
    drawn = (
        Mechanism("RSSR", run={"cycles": 1})
        .body("crank", mass="0.3 kg", centre="0, 0, 0 mm", inertia=small)
        .body("coupler", mass="0.2 kg", centre=f"{crank / 2 + 50}, 40, 20 mm", inertia=small)
        .body("rocker", mass="0.3 kg", centre="100, 40, 40 mm", inertia=small)
        .revolute("main", "ground", "crank", point="0, 0, 0 mm", axis=[0, 0, 1])
        .spherical("ball", "crank", "coupler", point=f"{crank}, 0, 0 mm")
        .spherical("socket", "coupler", "rocker", point="100, 40, 80 mm")
        .revolute("pivot", "rocker", "ground", point="100, 40, 0 mm", axis=[1, 0, 0])
        .drive("motor", "main", speed="600 rpm")
    )
    return drawn.clearance("ball", **chance).clearance("socket", **chance) if real else drawn


@pytest.mark.parametrize("real", [False, True], ids=["ideal", "real"])
def test_a_spatial_crank_that_cannot_turn_is_refused_although_its_coupler_spins_freely(real: bool) -> None:
    assert MechanismSystem(rssr(10.0, real).case()).check()
    begin = time.process_time()
    with pytest.raises(InputError, match=r"at t = .*, with drive motor at .*°, joint \w+ .* does not close"):
        MechanismSystem(rssr(70.0, real).case()).check()
    assert time.process_time() - begin < 10.0


def test_a_run_refuses_what_check_refuses() -> None:
    with pytest.raises(InputError, match="does not close"):
        td.simulate(rssr(70.0, True).case())


POSITIONS = "5"
#: What is said of those that have none.
NO_ANSWER = {
    ("latch", "kinematic"): "no drive prescribes a motion",
    ("pendulum", "kinematic"): "no drive prescribes a motion",
    ("slider-crank-3d", "kinematic"): "no drive prescribes a motion",
    ("slider-crank-oil", "static"): "carries by motion alone",
    ("slider-crank-oil", "vibrations"): "carries by motion alone",
}
#: All but models with an analysis of their own, and one of wear, which follows cycles.
DRAWN = sorted({*templates()} - {"vsv", "vsv-engine", "journal-dry", "journal-oil", "four-bar-wear"})


@pytest.mark.parametrize("analysis", ["static", "kinematic", "vibrations"])
@pytest.mark.parametrize(
    "name",
    [
        pytest.param(name, marks=pytest.mark.long) if name in ("vsv-joints", "vsv-ring") else name
        for name in DRAWN
    ],
)
def test_a_built_in_mechanism_has_an_answer_in_every_analysis(name, analysis, tmp_path):
    path = tmp_path / "case.toml"
    path.write_text(template(name), encoding="utf-8")
    case = load_case(path)
    words = NO_ANSWER.get((name, analysis), "")
    changes = {"run.analysis": analysis, "run.positions": POSITIONS}
    try:
        failure = str(td.simulate(case.replace(changes)).attrs["failure"])
    except InputError as error:
        failure = str(error)
    assert words in failure
    assert words or not failure
