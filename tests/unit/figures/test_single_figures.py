"""Single figures: maps of a bushing, of a scan, of contributions, and the history of a campaign."""

import io
from pathlib import Path

import numpy as np
import pytest
from matplotlib.figure import Figure

from tribodyn.figures.builds import TOGETHER, Shares, draw_shares
from tribodyn.figures.surface import draw
from tribodyn.papers.cheng_2022.reduced.figures import FIGURES
from tribodyn.results import build
from tribodyn.surfaces import Scan, SelfAffine, Treatment, analyse, dependence, generate
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


JOINTS = ("small", "large", "against")
SIMULATED = np.array([0.3, 0.9, -0.3])


@pytest.mark.parametrize("causes", [("clearance", "tilt", "friction", "bending"), ()])
def test_bars_are_sorted_and_causes_add_up(causes: tuple[str, ...]) -> None:
    estimate = np.outer(SIMULATED, [0.4, 0.3, 0.2, 0.1])[:, : len(causes)]
    figure = draw_shares(Shares("Shares", "Case", JOINTS, SIMULATED, 0.1, estimate, causes))
    (axes,) = figure.axes
    assert [text.get_text() for text in axes.get_yticklabels()] == ["large", "small", "against", TOGETHER]
    simulated, *parts = axes.containers
    assert [bar.get_width() for bar in simulated] == pytest.approx([90.0, 30.0, -30.0, 10.0])
    assert len(parts) == len(causes)
    if causes:
        ends = [bar.get_x() + bar.get_width() for bar in parts[-1]]
        assert ends == pytest.approx([90.0, 30.0, -30.0])


@pytest.mark.parametrize("n_jumps", [pytest.param(0, marks=pytest.mark.long), 60])
def test_every_figure_of_a_campaign_alone_is_drawn_however_far_it_came(n_jumps, make_campaign, make_result):
    result, plain = make_campaign(n_jumps), make_result(0.4)
    for family in (one for one in FIGURES.values() if not one.drawable(plain)):
        figure = family.draw(result)
        figure.savefig(io.BytesIO(), format="png", dpi=20)
        assert family.title in [text.get_text() for text in figure.texts]


def test_the_history_has_a_point_a_stop(make_campaign):
    # Depth beside its straight line, and the largest pressure beside the mean.
    for axes in FIGURES["wear_history"].draw(make_campaign(60)).axes:
        assert [line.get_xdata().size for line in axes.lines] == [60, 60]


@pytest.mark.parametrize(("n_jumps", "note"), [(0, "nothing computed"), (1, "nothing varies")])
def test_a_history_without_two_stops_says_so(n_jumps, note, make_campaign):
    for axes in FIGURES["wear_history"].draw(make_campaign(n_jumps)).axes:
        assert note in [text.get_text() for text in axes.texts]


SPECTRUM = SelfAffine(1e-6, 0.8, 24e-6, 8e-6)


def drawn(scan: Scan, treatment: Treatment) -> Figure:
    surface = analyse(scan, treatment)
    return draw(surface, dependence(surface, scan))


@pytest.mark.parametrize(
    "shape",
    [(96, 128), (2000,), *(pytest.param(shape, marks=pytest.mark.long) for shape in ((32, 32), (32,)))],
)
def test_maps_and_profiles_are_drawn(shape: tuple[int, ...], tmp_path: Path) -> None:
    scan = generate(SPECTRUM, shape, 1e-6, 1)
    figure = drawn(Scan(scan.heights, scan.spacing, "a/$cost$_{x}.csv"), Treatment())
    figure.savefig(tmp_path / "surface.png")
    assert (tmp_path / "surface.png").stat().st_size > 10_000


def test_lengths_over_the_cut_offs_are_those_measured() -> None:
    scan = generate(SPECTRUM, (128, 128), 1e-6, 1)
    figure = drawn(scan, Treatment(short_cutoff=4e-6))
    short = next(axes for axes in figure.axes if "shortest" in axes.get_xlabel())
    cutoff, sigma = short.get_lines()[0].get_data()
    for wave, value in zip(cutoff, sigma, strict=True):
        found = analyse(scan, Treatment(short_cutoff=float(wave) * 1e-6))
        assert value == pytest.approx(found.sigma * 1e6, rel=1e-9)


def test_holes_are_left_open() -> None:
    scan = generate(SPECTRUM, (64, 64), 1e-6, 1)
    heights = scan.heights.copy()
    heights[20:24, 30:40] = np.nan
    figure = drawn(Scan(heights, scan.spacing), Treatment())
    image = figure.axes[0].get_images()[0].get_array()
    assert np.sum(np.ma.getmaskarray(image) | np.isnan(np.ma.getdata(image))) == 40
