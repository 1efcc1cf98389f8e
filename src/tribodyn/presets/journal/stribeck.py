"""The Stribeck curve: friction of a loaded journal over its speed, and who carries the load.

At low speed asperities carry the load and friction is theirs; at high speed the film does and friction grows
with speed as its shear does. In between, in mixed lubrication, friction is least.
"""

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
from tribodyn.presets.journal.equilibrium import Equilibrium, Journal, equilibrium
from tribodyn.presets.journal.system import journal_of

VISCOSITY: Final = "film.viscosity"
_SPEEDS: Final = np.geomspace(1.0, 1000.0, 31)
_COLUMNS: Final = {
    "friction_coefficient": ("1", "friction moment over radius and load"),
    "film_share": ("1", "share of the load that the film carries"),
    "contact_share": ("1", "share of the load that asperities carry"),
    "eccentricity": ("m", "distance of the centre from the axis of the bushing"),
}


def equilibria(journal: Journal, speeds: Iterable[float]) -> list[Equilibrium]:
    """Return the static equilibria of a journal over its speed; each starts from the one before.

    Parameters
    ----------
    journal
        The journal, its load and its film.
    speeds
        Speeds of rotation [rad/s], in an order in which neighbours are near.

    Raises
    ------
    InputError
        If there is no load, or no equilibrium at one of the speeds.
    """
    if journal.loads.force == 0.0:
        raise InputError("a Stribeck curve needs a load", key="loads.force_x")
    if journal.changes:
        raise InputError("a Stribeck curve needs loads and speeds that no table changes", key="loads.more")
    points: list[Equilibrium] = []
    for speed in speeds:
        guess = points[-1].attitude if points else None
        points.append(equilibrium(journal, speed=float(speed), guess=guess))
    return points


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
    curves = [equilibria(journal_of(one), places) for one in cases]
    columns = {
        name: (
            ("viscosity", "speed"),
            np.array([[getattr(point, name) for point in points] for points in curves]),
            {"units": unit, "long_name": words},
        )
        for name, (unit, words) in _COLUMNS.items()
    }
    viscosities = [one.film.viscosity for one in cases]
    coordinates = {
        "speed": ("speed", places, {"units": "rad/s", "long_name": "speed of rotation"}),
        "viscosity": ("viscosity", viscosities, {"units": "Pa s", "long_name": "viscosity"}),
    }
    names = [from_si(value, "mPa s") for value in viscosities]
    return xr.Dataset(columns, coordinates, {"title": f"{case.title}: Stribeck curve", "viscosity": names})
