"""What is shown and said of mechanisms with more joints than a person looks at."""

import numpy as np
import pytest
import xarray as xr

from tribodyn.mechanism.figures.joints import draw_maps
from tribodyn.mechanism.results.contacts import Contacts
from tribodyn.mechanism.sections import joints

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
    contacts = Contacts((), (), tuple(NAMES), ())
    peaks = {"pressure_peak": np.arange(1.0, 13.0) * 1e6}
    notes = contacts.notes(peaks, {"pressure_at_rest": np.full(12, 0.5e6)})
    assert [note.split()[1] for note in notes[:-1]] == NAMES[-4:]
    assert notes[-1] == "The same of 8 more surfaces, where damping carries less."
    assert len(contacts.notes(peaks, {"pressure_at_rest": peaks["pressure_peak"]})) == 0


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
