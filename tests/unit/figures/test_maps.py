import numpy as np
import pytest

import tribodyn as td
from tribodyn.figures.pressure import _places
from tribodyn.results import build
from tribodyn.views.bushing import CUTS, best_cut, rolled, shares, unloaded_middle
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


@pytest.mark.long
def test_the_map_of_a_worn_bushing_is_not_cut_through_its_load():
    worn = td.simulate(td.load_case("vsv").replace({"wear.cycles": 100_000}))
    frames = np.nan_to_num(worn["pressure_cycle"].values)
    cut = best_cut(worn["theta"].values, shares(frames))
    # In the milliseconds after a reversal the shaft bounces all around: no cut is free then.
    since = worn["frame_time"].values % np.pi
    smooth = frames[since > 0.1 * np.pi]
    assert len(smooth) > 100
    assert _at(cut, smooth, worn["theta"].values).max() == 0.0


def test_the_cut_of_nothing_is_the_preferred_one():
    assert best_cut(THETA, np.zeros_like(THETA)) == 90.0


@pytest.mark.parametrize("cut", [0.0, 90.0, 180.0, 270.0])
def test_rolling_keeps_each_value_at_its_angle(cut):
    field = np.rad2deg(THETA)[:, None] * np.ones((1, 3))
    angle, values = rolled(THETA, field, cut)
    assert np.all(np.diff(angle) > 0.0)
    assert angle[-1] - angle[0] == pytest.approx(360.0)
    assert angle % 360.0 == pytest.approx(values[:, 0] % 360.0, abs=1e-9)
    assert angle[0] % 360.0 == pytest.approx(cut)


@pytest.mark.parametrize(("reach", "height"), [(2.0, 7.5), (4.5, 5.0), (9.0, 0.0)])
def test_an_empty_middle_is_found(reach, height):
    z = np.linspace(-10e-3, 10e-3, 41)
    result = build(coordinates={"time": [0.0], "theta": THETA, "z": z}, columns={})
    load = np.outer(_hump(0), np.abs(z) >= (10.0 - reach - 1e-9) * 1e-3).astype(float)
    assert unloaded_middle(result, load) == height


def test_no_load_at_all_shortens_nothing(make_result):
    result = make_result(0.1)
    assert unloaded_middle(result, np.zeros((96, 18))) == 0.0


def test_a_row_of_maps_compares_directions(make_result):
    assert _places(make_result()) == [(0, 0), (1, 0), (2, 0), (2, 1), (1, 1), (0, 1)]
    assert _places(make_result(3.5)) == [(0, 0), (1, 0), (2, 0), (2, 1)]
    assert _places(make_result(0.1)) == []


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
