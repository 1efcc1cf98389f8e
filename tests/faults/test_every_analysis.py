"""Every built-in mechanism and template in every analysis: an answer, or a sentence on why there is none."""

from __future__ import annotations

from pathlib import Path

import pytest

import tribodyn as td
from tribodyn.core.errors import InputError
from tribodyn.mechanisms.catalogue import load_case, template, templates

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
@pytest.mark.parametrize("name", DRAWN)
def test_a_built_in_mechanism_has_an_answer_in_every_analysis(
    name: str, analysis: str, tmp_path: Path
) -> None:
    path = tmp_path / "case.toml"
    path.write_text(template(name), encoding="utf-8")
    case = load_case(path)
    words = NO_ANSWER.get((name, analysis), "")
    changes = {"run.analysis": analysis} | ({} if analysis == "kinematic" else {"run.positions": POSITIONS})
    try:
        failure = str(td.simulate(case.replace(changes)).attrs["failure"])
    except InputError as error:
        failure = str(error)
    assert words in failure
    assert words or not failure
