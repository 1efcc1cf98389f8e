"""Random mechanisms of which half cannot be: those are refused, the others run with reasonable forces."""

from __future__ import annotations

import time
from collections.abc import Sequence

import numpy as np
import pytest
from tests.faults.impossible_mechanisms import IMPOSSIBLE, RIGHT, WORDS, applied, twins
from tests.faults.random_mechanisms import Drawing
from tests.faults.test_random_physics import chunks

from tribodyn.core.errors import InputError
from tribodyn.simulation import simulate

PATIENCE = 60.0
"""Computing time in which there must be an answer [s]."""
MOST = 1e6
"""Largest force over the applied ones."""
DURATION = 4e-3
"""Longest run of a mechanism that is right [s]."""
FEW = range(2 * max(len(RIGHT), len(IMPOSSIBLE)))
"""Each kind at least once."""


def complaint(drawing: Drawing, right: bool) -> str:
    """Run a mechanism; return what is wrong with the answer, nothing where it is as it must be."""
    begin = time.process_time()
    try:
        result = simulate(drawing.case(), stop=lambda: time.process_time() - begin > PATIENCE)
    except InputError as error:
        known = any(words in str(error) for words in WORDS)
        return "" if known and not right else f"refused: {error}"
    took = time.process_time() - begin
    if took > PATIENCE:
        return f"no answer in {took:.0f} s"
    if result.attrs["failure"]:
        return f"stopped: {result.attrs['failure']}" if right else ""
    ratio = float(np.abs(result["reaction_force"]).max()) / applied(drawing)
    if ratio > MOST:
        return f"complete with {ratio:.1e} times the applied forces"
    return "" if right else f"complete, with {ratio:.1e} times the applied forces"


def complaints(seed: int) -> dict[str, str]:
    """Return what is wrong with the twins of a seed."""
    right, ideal, real = twins(seed, DURATION)
    found = {"ideal": complaint(ideal, right), "real": complaint(real, right)}
    return {name: text for name, text in found.items() if text}


@pytest.mark.parametrize("seeds", [pytest.param(FEW, id="few"), *chunks(2000)])
def test_what_cannot_be_is_refused_and_what_is_right_is_not(seeds: Sequence[int]) -> None:
    found = {seed: complaints(seed) for seed in seeds}
    assert not {seed: text for seed, text in found.items() if text}
