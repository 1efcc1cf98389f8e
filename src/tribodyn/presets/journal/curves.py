"""Stribeck curves of a case, as a dataset."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Final

import numpy as np
import xarray as xr

from tribodyn.cases.case import Case
from tribodyn.cases.units import from_si
from tribodyn.core.arrays import FloatArray
from tribodyn.core.errors import InputError
from tribodyn.presets.journal.case import JournalCase
from tribodyn.presets.journal.stribeck import stribeck as curve_of
from tribodyn.presets.journal.system import journal_of

VISCOSITY: Final = "film.viscosity"
_SPEEDS: Final = np.geomspace(1.0, 1000.0, 31)
_COLUMNS: Final = {
    "friction_coefficient": ("1", "friction moment over radius and load"),
    "film_share": ("1", "share of the load that the film carries"),
    "contact_share": ("1", "share of the load that asperities carry"),
    "eccentricity": ("m", "distance of the centre from the axis of the bushing"),
}


def stribeck(
    case: Case, speeds: Iterable[float] | None = None, *, viscosity: Sequence[object] = ()
) -> xr.Dataset:
    """Return the friction of a loaded journal in oil over its speed, and who carries the load.

    Parameters
    ----------
    case
        A lubricated journal with friction: ``journal-oil`` with a ``joint.friction_coefficient``.
    speeds
        Speeds of rotation [rad/s], neighbours near each other; by default 31 from 1 to 1000.
    viscosity
        Viscosities to draw a curve for, as a case file has them; by default that of the case.

    Returns
    -------
    xarray.Dataset
        Friction coefficient, shares of film and asperities and eccentricity over ``viscosity`` [Pa s] and
        ``speed`` [rad/s].

    Raises
    ------
    InputError
        The case has no film, no friction or no load, or there is no equilibrium at one of the speeds.
    """
    if not isinstance(case, JournalCase) or not case.film.lubricated:
        raise InputError(
            "a Stribeck curve needs a journal in oil: journal-oil, or film.lubricated = true", key="case"
        )
    if case.joint.friction_coefficient == 0.0:
        raise InputError(
            "without friction of the asperities there is no Stribeck curve: give one, such as 0.1",
            key="joint.friction_coefficient",
        )
    places: FloatArray = _SPEEDS if speeds is None else np.array(list(speeds), dtype=np.float64)
    cases = [case.replace({VISCOSITY: value}) for value in viscosity] or [case]
    curves = [curve_of(journal_of(one), places) for one in cases]
    columns = {
        name: (("viscosity", "speed"), np.array([getattr(curve, name) for curve in curves]), _about(name))
        for name in _COLUMNS
    }
    coordinates = {
        "speed": ("speed", places, {"units": "rad/s", "long_name": "speed of rotation"}),
        "viscosity": (
            "viscosity",
            [one.film.viscosity for one in cases],
            {"units": "Pa s", "long_name": "viscosity"},
        ),
    }
    names = [from_si(one.film.viscosity, "mPa s") for one in cases]
    return xr.Dataset(columns, coordinates, {"title": f"{case.title}: Stribeck curve", "viscosity": names})


def _about(name: str) -> dict[str, str]:
    unit, words = _COLUMNS[name]
    return {"units": unit, "long_name": words}
