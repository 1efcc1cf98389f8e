"""What results of large mechanisms hold over time: the same numbers as a result that holds everything."""

from __future__ import annotations

import numpy as np
import pytest

import tribodyn as td
from tribodyn.core.errors import InputError
from tribodyn.mechanism.mechanism_variables import BODIES, JOINTS, OIL
from tribodyn.mechanism.results.kept import OF_LARGE
from tribodyn.mechanism.sections.mechanism import data
from tribodyn.mechanisms.results import all_there, summarise
from tribodyn.results import json_attribute
from tribodyn.views.playback import playback_times

BRIEF = {"run.cycles": 0.02}
EFFORT = ("wall_time_s", "real_time_factor")


def brief(**more: object) -> td.Case:
    return td.load_case("vsv-free").replace({**BRIEF, **more})


@pytest.fixture(scope="module")
def whole():
    return td.simulate(brief())


@pytest.fixture(scope="module")
def large():
    """The same mechanism, taken for a large one, with as many pressure fields."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("tribodyn.mechanism.results.kept.SMALL", 2)
        return td.simulate(brief(**{"results.frames": 120}))


def test_what_is_kept_has_the_same_bits(whole, large):
    left_out = set(whole.variables) - set(large.variables)
    # A load opposes the motion: its arrow follows the angular velocity.
    assert left_out == {*BODIES, *JOINTS} - {*OF_LARGE, *OIL, "angular_velocity"}
    for name in large.variables:
        np.testing.assert_array_equal(large[name].values, whole[name].values, err_msg=str(name))


def test_a_large_model_is_drawn_with_its_forces(whole, large):
    times = playback_times(whole)
    forces, of_whole = data(large)["forces"], data(whole)["forces"]
    assert {"force", "moment"} <= forces.keys() == of_whole.keys()
    for kind in ("force", "moment"):
        for name, arrow in forces[kind]["at"].items():
            known = whole[f"reaction_{kind}_global"].sel(joint=name).values
            expected = np.stack([np.interp(times, whole["time"].values, one) for one in known.T], axis=-1)
            np.testing.assert_allclose(arrow.array, expected.ravel(), atol=1e-5 * np.max(np.abs(known)))
    for kind in forces.keys() - {"force", "moment"}:
        for name, arrow in forces[kind]["at"].items():
            np.testing.assert_array_equal(arrow.array, of_whole[kind]["at"][name].array)


def test_key_results_are_the_same(whole, large):
    texts = ("notes", "rows_sha256", *EFFORT)
    first, second = ({k: v for k, v in summarise(d).items() if k not in texts} for d in (whole, large))
    assert first == second


def test_a_large_model_says_what_it_does_not_keep(whole, large):
    left_out = json_attribute(large, "not_kept", [])
    assert "relative_velocity" in left_out
    assert any(
        "does not keep" in note and "results.quantities" in note
        for note in json_attribute(large, "notes", [])
    )
    assert "not_kept" not in whole.attrs
    with (
        pytest.raises(InputError, match=r"does not keep relative_velocity: name it in results\.quantities"),
        all_there(large),
    ):
        large["relative_velocity"]


def test_chosen_quantities_are_kept_and_no_others(whole):
    chosen = ["position", "contact_force"]
    found = td.simulate(brief(**{"results.quantities": chosen, "results.frames": 2}))
    assert {name for name in found.variables if name in (*BODIES, *JOINTS)} == set(chosen)
    assert found.sizes["frame"] == 3
    np.testing.assert_array_equal(found["clearance"].values, whole["clearance"].values)
    # What it does not hold is left out of key results, and the rest is there.
    assert "joint_force_max_N" not in summarise(found)
    assert "energy_residual_percent" in summarise(found)
