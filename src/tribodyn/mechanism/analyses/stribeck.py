"""The Stribeck curve: friction of a loaded shaft over its speed, and who carries the load.

At low speed asperities carry the load and friction is theirs; at high speed the film does and friction grows
with speed as its shear does. In between, in mixed lubrication, friction is least.
"""

from collections.abc import Iterable, Sequence
from typing import Final, cast

import numpy as np
import xarray as xr

from tribodyn.cases.case import Case
from tribodyn.cases.units import from_si
from tribodyn.core.arrays import FloatArray
from tribodyn.core.errors import InputError
from tribodyn.core.quoting import as_given
from tribodyn.mechanism.analyses.shaft_in_bore import Equilibrium, Journal, equilibrium, journal_of
from tribodyn.mechanism.mechanism_case import MechanismCase

_SPEEDS: Final = np.geomspace(1.0, 1000.0, 31)
_COLUMNS: Final = {
    "friction_coefficient": ("1", "friction moment over radius and load"),
    "film_share": ("1", "share of the load that the film carries"),
    "contact_share": ("1", "share of the load that asperities carry"),
    "eccentricity": ("m", "distance of the centre from the axis of the bore"),
}


def equilibria(journal: Journal, speeds: Iterable[float]) -> list[Equilibrium]:
    """Return the static equilibria of a shaft over its speed; each starts from the one before.

    ``journal``: the shaft, its load and its film; ``speeds``: speeds of rotation [rad/s], in an order in
    which neighbours are near. Raises InputError if there is no load, or no equilibrium at one of the speeds.
    """
    if journal.force == 0.0:
        raise InputError("a Stribeck curve needs a load", key="load")
    points: list[Equilibrium] = []
    for speed in speeds:
        guess = points[-1].centre if points else None
        points.append(equilibrium(journal, speed=float(speed), guess=guess))
    return points


def stribeck(
    case: Case,
    speeds: Iterable[float] | None = None,
    *,
    viscosity: Sequence[object] = (),
    joint: str = "",
    load: float | str | None = None,
) -> xr.Dataset:
    """Return the friction of a loaded shaft in oil over its speed, and who carries the load.

    Parameters
    ----------
    case
        A mechanism with an oil film in a joint that has friction, such as ``journal-oil`` with
        ``joints.bearing.clearance.friction_coefficient = 0.1``.
    speeds
        Speeds of rotation [rad/s], neighbours near each other; by default 31 from 1 to 1000.
    viscosity
        Viscosities to draw a curve for, as a case file has them; by default that of the case.
    joint
        Of several with an oil film, the joint.
    load
        Across the axis of the joint [N], or a text with its unit; by default the constant forces of a case
        with one body.

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
    oiled = case.oiled if isinstance(case, MechanismCase) else []
    if not oiled:
        raise InputError(
            "a Stribeck curve needs a shaft in oil: journal-oil, or a joint with a film", key="case"
        )
    if joint not in oiled and (joint or len(oiled) > 1):
        raise InputError(f"given {as_given(joint)}; joints with a film: {', '.join(oiled)}", key="joint")
    name = joint or oiled[0]
    film, friction = f"joints.{name}.film", f"joints.{name}.clearance.friction_coefficient"
    if case.at(friction) == 0.0:
        words = "without friction of the asperities there is no Stribeck curve: give one, such as 0.1"
        raise InputError(words, key=friction)
    places: FloatArray = _SPEEDS if speeds is None else np.array(list(speeds), dtype=np.float64)
    cases = [case.replace({f"{film}.viscosity": value}) for value in viscosity] or [case]
    curves = [equilibria(journal_of(one, name, load), places) for one in cases]
    columns = {
        name: (
            ("viscosity", "speed"),
            np.array([[getattr(point, name) for point in points] for points in curves]),
            {"units": unit, "long_name": words},
        )
        for name, (unit, words) in _COLUMNS.items()
    }
    viscosities = [float(cast(float, one.at(f"{film}.viscosity"))) for one in cases]
    coordinates = {
        "speed": ("speed", places, {"units": "rad/s", "long_name": "speed of rotation"}),
        "viscosity": ("viscosity", viscosities, {"units": "Pa s", "long_name": "viscosity"}),
    }
    names = [from_si(value, "mPa s") for value in viscosities]
    return xr.Dataset(columns, coordinates, {"title": f"{case.title}: Stribeck curve", "viscosity": names})
