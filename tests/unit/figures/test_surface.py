"""The figure of a measured surface shows what was measured."""

from pathlib import Path

import numpy as np
import pytest
from matplotlib.figure import Figure

from tribodyn.figures.surface import draw
from tribodyn.surfaces import Scan, SelfAffine, Treatment, analyse, dependence, generate

SPECTRUM = SelfAffine(1e-6, 0.8, 24e-6, 8e-6)


def drawn(scan: Scan, treatment: Treatment) -> Figure:
    surface = analyse(scan, treatment)
    return draw(surface, dependence(surface, scan))


@pytest.mark.parametrize("shape", [(96, 128), (2000,), (32, 32), (32,)])
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
