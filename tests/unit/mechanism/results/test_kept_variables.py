"""What results of large mechanisms hold and show: the same numbers, of fewer quantities and joints."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest
import xarray as xr

import tribodyn as td
from tribodyn.core.errors import InputError
from tribodyn.mechanism.figures.joints import draw_maps
from tribodyn.mechanism.mechanism_variables import BODIES, JOINTS, OIL
from tribodyn.mechanism.results.contacts import Contacts
from tribodyn.mechanism.results.kept_variables import OF_LARGE
from tribodyn.mechanism.sections import joints
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
        patch.setattr("tribodyn.mechanism.results.kept_variables.SMALL", 2)
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


NAMES = [f"pin{k}" for k in range(12)]


@pytest.fixture
def many() -> xr.Dataset:
    """Twelve joints, eleven of them with clearance; pressures and forces rise from the first to the last."""
    rising = np.arange(12.0)
    clearance = np.where(rising == 3.0, np.nan, 2e-5)
    return xr.Dataset(
        {
            "clearance": ("joint", clearance),
            "pressure_max": (("time", "joint"), np.stack([rising, 2.0 * rising])),
            "reaction_force": (
                ("time", "joint", "axis"),
                np.multiply.outer([1.0, 2.0], np.outer(rising, [1, 1, 0])),
            ),
            "wear_depth": (("surface", "row", "column"), np.ones((12, 2, 4))),
            "row_place": (("surface", "row"), np.tile([0.0, 0.01], (12, 1))),
            "column_angle": (("surface", "column"), np.tile(np.arange(4.0), (12, 1))),
        },
        {"joint": NAMES, "surface": [f"{name}:barrel" for name in NAMES]},
    )


def test_of_many_joints_those_loaded_most_are_shown(many: xr.Dataset) -> None:
    pressed, loaded = joints.real_joints(many), joints.loaded_joints(many)
    assert pressed.joints == loaded.joints == [4, 5, 6, 7, 8, 9, 10, 11]
    assert pressed.which == ", 8 joints of 11 with the largest pressures"
    assert loaded.which == ", 8 joints of 12 with the largest forces"
    assert [surface for surface, *_ in joints.surfaces(many, "wear_depth")] == [
        f"{n}:barrel" for n in NAMES[4:]
    ]


def test_the_same_note_of_many_surfaces_is_given_for_a_few_with_the_number_of_the_others() -> None:
    places = [SimpleNamespace(joint=joint) for joint in range(12)]
    contacts = Contacts((), (), tuple(NAMES), places)
    peaks = {"pressure_peak": np.arange(1.0, 13.0) * 1e6}
    notes = contacts.notes(peaks, {"pressure_at_rest": np.full(12, 0.5e6)})
    assert [note.split()[1] for note in notes[:-1]] == NAMES[-4:]
    assert notes[-1] == "The same of 8 more surfaces, where damping carries less."
    assert len(contacts.notes(peaks, {"pressure_at_rest": peaks["pressure_peak"]})) == 0
    # Two surfaces to a joint: at the attitude of the largest pressure in it the other one carries less.
    pairs = Contacts((), (), tuple(NAMES), [SimpleNamespace(joint=k // 2) for k in range(12)])
    notes = pairs.notes(peaks, {"pressure_at_rest": np.full(12, 0.5e6)})
    assert [note.split()[1] for note in notes[:-1]] == NAMES[5::2]


def test_a_figure_of_many_surfaces_shows_those_with_the_largest_values(many: xr.Dataset) -> None:
    faces = many.assign(wear_depth=many["wear_depth"] * 0.5).assign_coords(
        surface=[f"{n}:face" for n in NAMES]
    )
    both = xr.concat([many, faces], "surface", data_vars="minimal")
    figure = draw_maps(joints.WEAR, both.assign_attrs(title="Many"))
    captions = [axes.get_title(loc="left") for axes in figure.axes]
    assert {f"{name}:barrel" for name in NAMES[4:]} <= set(captions)
    assert not any("face" in text for text in captions)
    assert "8 surfaces of 24 with the largest values" in "".join(text.get_text() for text in figure.texts)


def test_an_unknown_quantity_is_refused():
    with pytest.raises(InputError, match=r"results\.quantities"):
        brief(**{"results.quantities": ["reaction"]})
