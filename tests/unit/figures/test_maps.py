import numpy as np
import pytest

from tribodyn.results import build
from tribodyn.views.bushing import CUTS, best_cut, shares
from tribodyn.views.bushing_sections import centre
from tribodyn.views.wear import fitting_unit

THETA = np.linspace(0.0, 2 * np.pi, 96, endpoint=False)


def _hump(*centres_deg):
    distance = [np.abs((np.rad2deg(THETA) - c + 180.0) % 360.0 - 180.0) for c in centres_deg]
    return np.exp(-((np.min(distance, axis=0) / 15.0) ** 2))


@pytest.mark.parametrize(("centres", "cut"), [((0, 180), 90.0), ((270, 10, 170), 90.0), ((90, 0), 270.0)])
def test_the_cut_avoids_the_load(centres, cut):
    assert best_cut(THETA, _hump(*centres)) == cut


def test_a_worn_bushing_is_not_cut_where_it_carries():
    # All four quarters carry, as in a bushing that has worn in; between two of them is room.
    load = _hump(0, 90, 180, 270, 315)
    cut = best_cut(THETA, load)
    near = np.abs((np.rad2deg(THETA) - cut + 180.0) % 360.0 - 180.0) <= 5.0
    assert load[near].max() <= 0.01


def _at(cut, frames, theta=THETA):
    """Return the share of its peak that each frame has at a cut."""
    near = np.abs((np.rad2deg(theta) - cut + 180.0) % 360.0 - 180.0) <= 5.0
    return frames[:, near].max(axis=(1, 2)) / frames.max(axis=(1, 2))


def test_no_frame_is_cut_through_its_load():
    # Loads of the smooth motion, and an impact ten times as large; then, small beside it, the rebound that
    # goes round the worn bushing and leaves free none of the preferred cuts, but what lies between two.
    small = [0.1 * _hump(0), 0.1 * _hump(270), _hump(300), 0.005 * _hump(*CUTS) ** 9]
    frames = np.array(small)[:, :, None] * np.ones(3)
    cut = best_cut(THETA, shares(frames))
    assert cut not in CUTS
    assert _at(cut, frames).max() < 0.02
    assert np.array_equal(shares(np.zeros((2, 96, 3))), np.zeros(96))


@pytest.mark.parametrize(("depth", "unit"), [(2e-6, "µm"), (2e-9, "nm"), (1.5e-10, "nm"), (0.0, "nm")])
def test_depth_is_given_in_a_readable_unit(depth, unit):
    assert fitting_unit(depth)[0] == unit


def test_centres_of_a_tilted_trunnion():
    # The axis at height z lies at (e_x - z tan phi_y, e_y - z tan phi_x).
    result = build(
        coordinates={"time": [0.0]}, columns={"e_x": [1e-6], "e_y": [2e-6], "phi_x": [1e-3], "phi_y": [-5e-4]}
    )
    x, y = centre(result, 10e-3)
    assert (x[0], y[0]) == (pytest.approx(1.0 + 5.0, rel=1e-5), pytest.approx(2.0 - 10.0, rel=1e-5))
