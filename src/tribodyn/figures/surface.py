"""A measured surface: its heights, their distribution and spectrum, and what the cut-offs do."""

import math
from collections.abc import Sequence
from typing import Final

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from tribodyn.figures import style
from tribodyn.surfaces import MeasuredSurface
from tribodyn.surfaces.analysis import in_bands, spectra

TITLE: Final = "Measured surface"
_MICRO: Final = 1e6
_MOST_PIXELS: Final = 800
_BINS: Final = 60
_WIDEST: Final = 6.0  #: Heights shown [σ]; what stands beyond is in the kurtosis.


def draw(surface: MeasuredSurface, others: Sequence[MeasuredSurface]) -> Figure:
    """Draw a surface.

    ``others``: the same scan with other cut-offs, see :func:`tribodyn.surfaces.dependence`.
    """
    name = surface.surface.source.replace("\\", "/").rpartition("/")[2]
    figure = style.sheet(xr.Dataset(attrs={"title": name}), TITLE, 8.2)
    grid = figure.add_gridspec(3, 2)
    heights, distribution, spectrum, short, long = (
        figure.add_subplot(place) for place in (grid[0, 0], grid[0, 1], grid[1, :], grid[2, 0], grid[2, 1])
    )
    _heights(heights, surface)
    _distribution(distribution, surface)
    _spectrum(spectrum, surface)
    base = surface.treatment
    _cutoffs(
        short,
        [(o.treatment.short_cutoff, o) for o in others if o.treatment.long_cutoff == base.long_cutoff],
        "shortest wavelength kept [µm]",
    )
    _cutoffs(
        long,
        [(o.treatment.long_cutoff, o) for o in others if o.treatment.short_cutoff == base.short_cutoff],
        "longest wavelength kept [µm]",
    )
    return figure


def _heights(axes: Axes, surface: MeasuredSurface) -> None:
    """Draw the profile, or the map with a bar of its heights."""
    scan = surface.surface
    if not scan.is_map:
        x = np.arange(scan.heights.size) * scan.spacing[0] * 1e3
        axes.plot(x, scan.heights * _MICRO, color=style.BLUE, linewidth=0.6)
        style.finish(axes, "x [mm]", "height [µm]")
        style.caption(axes, "profile, levelled and filtered")
        return
    thin = tuple(slice(None, None, math.ceil(n / _MOST_PIXELS)) for n in scan.heights.shape)
    height, width = (_MICRO * length for length in scan.extent)
    reach = 3.0 * surface.sigma * _MICRO
    image = axes.imshow(
        scan.heights[thin] * _MICRO,
        extent=(0.0, width, 0.0, height),
        origin="lower",
        cmap="viridis",
        vmin=-reach,
        vmax=reach,
        interpolation="nearest",
    )
    axes.set_facecolor(style.PALE)
    style.finish(axes, "x [µm]", "y [µm]")
    axes.grid(False)
    style.caption(axes, "heights [µm], levelled and filtered")
    bar = axes.figure.colorbar(image, ax=axes, shrink=0.9, pad=0.02)
    bar.ax.tick_params(labelsize=style.SMALL)
    bar.outline.set_visible(False)


def _distribution(axes: Axes, surface: MeasuredSurface) -> None:
    """Draw the density of the heights beside that of a Gaussian."""
    heights = surface.surface.heights[~np.isnan(surface.surface.heights)] / surface.sigma
    density, edges = np.histogram(heights, bins=_BINS, range=(-_WIDEST, _WIDEST), density=True)
    axes.stairs(
        np.where(density > 0.0, density, np.nan), edges, color=style.BLUE, linewidth=1.2, label="measured"
    )
    z = np.linspace(-_WIDEST, _WIDEST, 241)
    gaussian = np.exp(-0.5 * z**2) / math.sqrt(2.0 * math.pi)
    axes.plot(z, gaussian, color=style.VERMILION, linestyle=style.DASHED, linewidth=1.2, label="Gaussian")
    axes.set_yscale("log")
    axes.set_ylim(1e-5, 1.5)
    style.finish(axes, "height over σ", "density")
    style.caption(axes, f"skewness {surface.skewness:.2f}, kurtosis {surface.kurtosis:.2f}")
    axes.legend(loc="lower center", frameon=False, fontsize=style.SMALL)


def _spectrum(axes: Axes, surface: MeasuredSurface) -> None:
    """Draw the densities of profiles along the axes over the wavelength, long waves at the left."""
    dashes = {"x": (style.BLUE, style.SOLID), "y": (style.VERMILION, style.DASHED)}
    top = 0.0
    for name, whole in spectra(surface.surface).items():
        found = in_bands(whole)
        colour, dash = dashes[name]
        wave = _MICRO / found.frequency
        density = found.density * _MICRO**3
        top = max(top, float(density.max()))
        axes.loglog(wave, density, color=colour, linestyle=dash, linewidth=1.2, label=f"along {name}")
    axes.set_ylim(bottom=max(1e-9 * top, axes.get_ylim()[0]))
    axes.invert_xaxis()
    for cutoff in (surface.treatment.short_cutoff, surface.treatment.long_cutoff):
        if cutoff is not None:
            axes.axvline(cutoff * _MICRO, color=style.GREY, linestyle=style.DOTTED, linewidth=1.0)
    style.finish(axes, "wavelength [µm]", "spectral density [µm³]")
    style.caption(axes, "spectrum; dotted: cut-offs")
    axes.legend(loc="lower left", frameon=False, fontsize=style.SMALL)


def _cutoffs(axes: Axes, cases: Sequence[tuple[float | None, MeasuredSurface]], label: str) -> None:
    """Draw σ, β and the distance of asperities over a cut-off."""
    style.finish(axes, label, "length [µm]")
    if not cases:
        style.note(axes, "the scan is too short to vary this")
        return
    wave = np.array([cutoff or np.nan for cutoff, _ in cases]) * _MICRO
    lengths: style.Curves = [
        (np.array([s.sigma for _, s in cases]), "σ", style.BLUE, style.SOLID),
        (np.array([s.asperities.radius for _, s in cases]), "β", style.VERMILION, style.DASHED),
        (np.array([s.asperities.density**-0.5 for _, s in cases]), "1/√ξ", style.GREEN, style.DASHDOT),
    ]
    for values, name, colour, dash in lengths:
        axes.loglog(wave, values * _MICRO, color=colour, linestyle=dash, linewidth=1.3, label=name)
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
        axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
        axis.set_minor_formatter(NullFormatter())
    style.legend(axes, 3)
