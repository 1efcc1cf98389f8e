"""The numbers of a surface: what each is called, in which unit it is shown, where it comes from."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.surfaces.analysis import MeasuredSurface

#: Sections of a profile whose heights from the lowest to the highest point Rz is the mean of.
SECTIONS: Final = 5


def arithmetic_mean(heights: FloatArray) -> float:
    """Return the mean magnitude of heights about their mean [m], Ra or Sa; NaN where one is missing."""
    return float(np.nanmean(np.abs(heights - np.nanmean(heights))))


def mean_total_height(heights: FloatArray) -> float:
    """Return Rz [m] of a profile: the mean height of its sections, each from lowest to highest point."""
    sections = [part for part in np.array_split(heights, SECTIONS) if np.isfinite(part).any()]
    return float(np.mean([np.nanmax(part) - np.nanmin(part) for part in sections]))


@dataclass(frozen=True)
class SurfaceParameter:
    """One number of a surface."""

    #: As a person reads them.
    label: str
    unit: str
    value: Callable[[MeasuredSurface], float]  #: The number in that unit, of a surface that has it.
    of_maps: bool | None = None  #: Whether only maps have it, or only profiles; None where both do.


def _directional(name: str, factor: float = 1.0) -> Callable[[MeasuredSurface], float]:
    return lambda surface: factor * float(getattr(surface.moments.directional, name))


def _heights(surface: MeasuredSurface) -> FloatArray:
    return surface.surface.heights


#: All of them, in the order of reading; names carry the unit.
PARAMETERS: Final[dict[str, SurfaceParameter]] = {
    "sigma_um": SurfaceParameter("roughness sigma", "um", lambda s: s.sigma * 1e6),
    "Ra_um": SurfaceParameter(
        "mean height Ra", "um", lambda s: 1e6 * arithmetic_mean(_heights(s)), of_maps=False
    ),
    "Rq_um": SurfaceParameter("root mean square height Rq", "um", lambda s: s.sigma * 1e6, of_maps=False),
    "Rz_um": SurfaceParameter(
        "mean total height Rz", "um", lambda s: 1e6 * mean_total_height(_heights(s)), of_maps=False
    ),
    "Sa_um": SurfaceParameter(
        "mean height Sa", "um", lambda s: 1e6 * arithmetic_mean(_heights(s)), of_maps=True
    ),
    "Sq_um": SurfaceParameter("root mean square height Sq", "um", lambda s: s.sigma * 1e6, of_maps=True),
    "skewness": SurfaceParameter("skewness of the heights", "", lambda s: s.skewness),
    "kurtosis": SurfaceParameter("kurtosis of the heights (Gaussian: 3)", "", lambda s: s.kurtosis),
    "m0_um2": SurfaceParameter("spectral moment m0", "um^2", lambda s: s.moments.m0 * 1e12),
    "m2": SurfaceParameter("spectral moment m2", "", lambda s: s.moments.m2),
    "m4_per_um2": SurfaceParameter("spectral moment m4", "1/um^2", lambda s: s.moments.m4 * 1e-12),
    "m2_x": SurfaceParameter("m2 along x", "", _directional("m2_x"), of_maps=True),
    "m2_y": SurfaceParameter("m2 along y", "", _directional("m2_y"), of_maps=True),
    "m4_x_per_um2": SurfaceParameter("m4 along x", "1/um^2", _directional("m4_x", 1e-12), of_maps=True),
    "m4_y_per_um2": SurfaceParameter("m4 along y", "1/um^2", _directional("m4_y", 1e-12), of_maps=True),
    "texture": SurfaceParameter("slope along over across the lay", "", _directional("texture"), of_maps=True),
    "lay_deg": SurfaceParameter(
        "direction of the lay, from x", "deg", _directional("lay", float(np.rad2deg(1.0))), of_maps=True
    ),
    "bandwidth_alpha": SurfaceParameter("bandwidth parameter alpha", "", lambda s: s.asperities.bandwidth),
    "asperity_density_per_um2": SurfaceParameter(
        "asperities per area xi", "1/um^2", lambda s: s.asperities.density * 1e-12
    ),
    "asperity_radius_um": SurfaceParameter(
        "mean asperity radius beta", "um", lambda s: s.asperities.radius * 1e6
    ),
    "asperity_parameter": SurfaceParameter(
        "xi beta sigma", "", lambda s: s.asperities.density * s.asperities.radius * s.sigma
    ),
    "summit_rms_um": SurfaceParameter(
        "roughness of the summits", "um", lambda s: s.asperities.summit_rms * 1e6
    ),
    "summit_offset_um": SurfaceParameter(
        "mean height of the summits", "um", lambda s: s.asperities.summit_offset * 1e6
    ),
}


def numbers(surface: MeasuredSurface) -> dict[str, float]:
    """Return every number that a surface has, by name."""
    is_map = surface.moments.directional is not None
    return {
        name: parameter.value(surface)
        for name, parameter in PARAMETERS.items()
        if parameter.of_maps in (None, is_map)
    }


def document(surface: MeasuredSurface, others: list[MeasuredSurface]) -> dict[str, Any]:
    """Return the stored data of a surface: numbers, treatment, remarks, and the numbers at other cut-offs.

    ``others``: the same scan with other cut-offs.
    """
    return {
        "file": surface.surface.source,
        "kind": "map" if surface.surface.is_map else "profile",
        **_treatment(surface),
        **numbers(surface),
        "warnings": list(surface.warnings),
        "cutoffs": [{**_treatment(other), **numbers(other)} for other in others],
    }


def _treatment(surface: MeasuredSurface) -> dict[str, Any]:
    treatment = surface.treatment
    return {
        "level": treatment.level,
        "filter": treatment.filter,
        "short_cutoff_um": _micrometres(treatment.short_cutoff),
        "long_cutoff_um": _micrometres(treatment.long_cutoff),
    }


def _micrometres(length: float | None) -> float | None:
    return None if length is None else length * 1e6
