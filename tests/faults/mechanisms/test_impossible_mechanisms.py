"""Random mechanisms of which half cannot be: those are refused, the others run with reasonable forces."""

import math
import sys
import time
from collections.abc import Sequence
from typing import Any

import numpy as np
import pytest
import xarray as xr
from tests.faults.mechanisms.impossible_mechanisms import IMPOSSIBLE, RIGHT, WORDS, applied, twins
from tests.faults.mechanisms.random_mechanisms import Drawing
from tests.faults.mechanisms.test_random_mechanisms import BEYOND
from tests.faults.mechanisms.test_random_physics import chunks

from tribodyn.core.errors import InputError
from tribodyn.mechanism.assembly import decompositions
from tribodyn.mechanism.assembly.assembly import assemble
from tribodyn.mechanism.assembly.clearance_surfaces import clearances_of
from tribodyn.mechanism.assembly.parts_by_number import model_of
from tribodyn.simulation import simulate

PATIENCE = 60.0  #: Computing time in which there must be an answer [s].
MOST = 1e6  #: Largest force over the applied ones.
#: Pressure on the projected area, with that of the moment at its end, of a bearing that is too small [Pa]. A
#: right mechanism may stop in its joint, beyond the range of the contact law, and in no other. The number was
#: chosen when such stops had been seen: all but one had 14 MPa or more.
OVERLOAD = 5e6
RANGE = 4.0  #: Depth below which the contact law ends, over the roughness.
BALANCE = 0.05  #: What the energy balance may miss until a stop, over the energy.
DURATION = 4e-3  #: Longest run of a mechanism that is right [s].
#: Each kind at least once, and rows that depend on each other to the last bit once scaled by mass.
FEW = (*range(max(len(RIGHT), len(IMPOSSIBLE))), 63, 1141, 1713)


def outcome(drawing: Drawing) -> tuple[xr.Dataset | None, str]:
    """Run a mechanism; return its result, if there is one, and the refusal or what else took its place."""
    begin = time.process_time()
    try:
        result = simulate(drawing.case(), stop=lambda: time.process_time() - begin > PATIENCE)
    except InputError as error:
        return None, f"refused: {error}"
    took = time.process_time() - begin
    return (result, "") if took <= PATIENCE else (None, f"no answer in {took:.0f} s")


def pressures(drawing: Drawing, ideal: xr.Dataset) -> dict[str, float]:
    """Return the nominal pressures of joints with clearance under the forces of the ideal mechanism [Pa]."""
    found = {}
    for name, joint in drawing.joints.items():
        if "clearance" in joint:
            sizes = joint["clearance"]
            radius = 1e-3 * float(sizes["radius"].split()[0])
            long = 1e-3 * float(sizes["length"].split()[0]) if "length" in sizes else 0.5 * math.pi * radius
            force, moment = (
                float(np.linalg.norm(ideal[f"reaction_{of}"].sel(joint=name), axis=-1).max())
                for of in ("force", "moment")
            )
            found[name] = (force + 6.0 * moment / long) / (2.0 * radius * long)
    return found


def impact_factors(drawing: Drawing) -> dict[str, float]:
    """Return by how much a force that first drives a pin across its clearance exceeds the force at rest.

    1 + √(1 + 2 h/δ), for a weight that falls through h onto a spring that it compresses by δ at rest: h is
    the clearance, δ the range of the contact law.
    """
    return {
        name: 1.0 + math.sqrt(1.0 + 2.0 * of.shape.clearance / (RANGE * of.roughness))
        for name, of in clearances_of(drawing.case()).items()
    }


def is_honest(failure: str, drawing: Drawing, result: xr.Dataset, ideal: dict[str, float]) -> bool:
    """Return whether a right mechanism with clearance stopped because a joint is too small for its load."""
    factors = impact_factors(drawing) if result.attrs["start"] != "equilibrium" else {}
    overloaded = [name for name, of in ideal.items() if of * factors.get(name, 1.0) > OVERLOAD]
    named = any(f"joint {name} (" in failure for name in overloaded)
    return BEYOND in failure and named and float(result.attrs["energy_residual"]) < BALANCE


def complaint(drawing: Drawing, right: bool, ideal: dict[str, float] | None = None) -> tuple[str, Any]:
    """Return what is wrong with the answer for a mechanism, empty if nothing is, and the result if any."""
    result, said = outcome(drawing)
    if result is None:
        known = said.startswith("refused") and any(words in said for words in WORDS)
        return ("" if known and not right else said), None
    failure = str(result.attrs["failure"])
    if failure:
        honest = ideal is not None and is_honest(failure, drawing, result, ideal)
        return (f"stopped: {failure}" if right and not honest else ""), result
    ratio = float(np.abs(result["reaction_force"]).max()) / applied(drawing)
    words = f"complete with {ratio:.1e} times the applied forces"
    return ("" if right and ratio <= MOST else words), result


def complaints(seed: int) -> dict[str, str]:
    """Return what is wrong with the twins of a seed."""
    right, ideal, real = twins(seed, DURATION)
    of_ideal, result = complaint(ideal, right)
    loads = pressures(real, result) if right and result is not None else None
    found = {"ideal": of_ideal, "real": complaint(real, right, loads)[0]}
    return {name: text for name, text in found.items() if text}


@pytest.mark.parametrize("seeds", [pytest.param(FEW, id="few"), *chunks(2000)])
def test_what_cannot_be_is_refused_and_what_is_right_is_not(seeds: Sequence[int]) -> None:
    found = {seed: complaints(seed) for seed in seeds}
    assert not {seed: text for seed, text in found.items() if text}


def put_together(drawing: Drawing, large: int) -> tuple[object, ...]:
    """Return what assembly finds where mechanisms with ``large`` rows or unknowns are factorised."""
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(decompositions, "LARGE", large)
        try:
            found = assemble(model_of(drawing.case()))
        except InputError as error:
            return (str(error),)
    refused = [error.text for error in (*found.findings, *found.findings_if_ideal)]
    return found.freedoms, found.ideal_rank, found.redundancy, found.inexact, *refused


@pytest.mark.parametrize("seeds", [pytest.param(range(12), id="few"), *chunks(2000)])
def test_factors_find_what_singular_values_do(seeds: Sequence[int]) -> None:
    for drawing in (drawing for seed in seeds for drawing in twins(seed, DURATION)[1:]):
        assert put_together(drawing, 1) == put_together(drawing, sys.maxsize), drawing
