"""The numbers of a surface: what each is called, in which unit it is shown, where it comes from."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from tribodyn.core.arrays import FloatArray
from tribodyn.surfaces.amplitudes import arithmetic_mean, mean_total_height
from tribodyn.surfaces.analysis import Roughness


@dataclass(frozen=True)
class Parameter:
    """One number of a surface.

    Attributes
    ----------
    label, unit
        As a person reads them.
    value
        The number in that unit, of a surface that has it.
    of_maps
        Whether only maps have it, or only profiles; None where both do.
    """

    label: str
    unit: str
    value: Callable[[Roughness], float]
    of_maps: bool | None = None


def _directional(name: str, factor: float = 1.0) -> Callable[[Roughness], float]:
    return lambda surface: factor * float(getattr(surface.moments.directional, name))


def _heights(surface: Roughness) -> FloatArray:
    return surface.surface.heights


PARAMETERS: Final[dict[str, Parameter]] = {
    "sigma_um": Parameter("roughness sigma", "um", lambda s: s.sigma * 1e6),
    "Ra_um": Parameter("mean height Ra", "um", lambda s: 1e6 * arithmetic_mean(_heights(s)), of_maps=False),
    "Rq_um": Parameter("root mean square height Rq", "um", lambda s: s.sigma * 1e6, of_maps=False),
    "Rz_um": Parameter(
        "mean total height Rz", "um", lambda s: 1e6 * mean_total_height(_heights(s)), of_maps=False
    ),
    "Sa_um": Parameter("mean height Sa", "um", lambda s: 1e6 * arithmetic_mean(_heights(s)), of_maps=True),
    "Sq_um": Parameter("root mean square height Sq", "um", lambda s: s.sigma * 1e6, of_maps=True),
    "skewness": Parameter("skewness of the heights", "", lambda s: s.skewness),
    "kurtosis": Parameter("kurtosis of the heights (Gaussian: 3)", "", lambda s: s.kurtosis),
    "m0_um2": Parameter("spectral moment m0", "um^2", lambda s: s.moments.m0 * 1e12),
    "m2": Parameter("spectral moment m2", "", lambda s: s.moments.m2),
    "m4_per_um2": Parameter("spectral moment m4", "1/um^2", lambda s: s.moments.m4 * 1e-12),
    "m2_x": Parameter("m2 along x", "", _directional("m2_x"), of_maps=True),
    "m2_y": Parameter("m2 along y", "", _directional("m2_y"), of_maps=True),
    "m4_x_per_um2": Parameter("m4 along x", "1/um^2", _directional("m4_x", 1e-12), of_maps=True),
    "m4_y_per_um2": Parameter("m4 along y", "1/um^2", _directional("m4_y", 1e-12), of_maps=True),
    "texture": Parameter("slope along over across the lay", "", _directional("texture"), of_maps=True),
    "lay_deg": Parameter(
        "direction of the lay, from x", "deg", _directional("lay", float(np.rad2deg(1.0))), of_maps=True
    ),
    "bandwidth_alpha": Parameter("bandwidth parameter alpha", "", lambda s: s.asperities.bandwidth),
    "asperity_density_per_um2": Parameter(
        "asperities per area xi", "1/um^2", lambda s: s.asperities.density * 1e-12
    ),
    "asperity_radius_um": Parameter("mean asperity radius beta", "um", lambda s: s.asperities.radius * 1e6),
    "asperity_parameter": Parameter(
        "xi beta sigma", "", lambda s: s.asperities.density * s.asperities.radius * s.sigma
    ),
    "summit_rms_um": Parameter("roughness of the summits", "um", lambda s: s.asperities.summit_rms * 1e6),
    "summit_offset_um": Parameter(
        "mean height of the summits", "um", lambda s: s.asperities.summit_offset * 1e6
    ),
}
"""All of them, in the order of reading; names carry the unit."""


def numbers(surface: Roughness) -> dict[str, float]:
    """Return every number that a surface has, by name."""
    is_map = surface.moments.directional is not None
    return {
        name: parameter.value(surface)
        for name, parameter in PARAMETERS.items()
        if parameter.of_maps in (None, is_map)
    }


def document(surface: Roughness, others: list[Roughness]) -> dict[str, Any]:
    """Return what is stored of a surface: numbers, treatment, remarks, and the numbers at other cut-offs.

    Parameters
    ----------
    surface
        The surface.
    others
        The same scan with other cut-offs.
    """
    return {
        "file": surface.surface.source,
        "kind": "map" if surface.surface.is_map else "profile",
        **_treatment(surface),
        **numbers(surface),
        "warnings": list(surface.warnings),
        "cutoffs": [{**_treatment(other), **numbers(other)} for other in others],
    }


def _treatment(surface: Roughness) -> dict[str, Any]:
    treatment = surface.treatment
    return {
        "level": treatment.level,
        "filter": treatment.filter,
        "short_cutoff_um": _micrometres(treatment.short_cutoff),
        "long_cutoff_um": _micrometres(treatment.long_cutoff),
    }


def _micrometres(length: float | None) -> float | None:
    return None if length is None else length * 1e6
