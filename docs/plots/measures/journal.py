"""Numbers of the pages on the journal bearing and its Stribeck curve."""

from __future__ import annotations

from functools import cache, partial
from typing import Final

import numpy as np
import xarray as xr
from numpy.typing import NDArray

import tribodyn as td
from measures.base import Numbers, keys
from mebdf.arrays import FloatArray
from tribodyn.mechanism.analyses.shaft_in_bore import equilibrium, journal_of
from tribodyn.papers.cheng_2022.journal import run_of
from tribodyn.papers.cheng_2022.runs import Runs

SETTLED: Final = (
    0.01  #: Distance from the static equilibrium, over the clearance, within which it has settled.
)

ONSET: Final = 4.0 * float(np.hypot(0.392e-6, 1.586e-6))  #: Separation at which asperities meet [m].


def residual(runs: Runs, *, digits: str, **changes: object) -> str:
    """Return the energy residual of the undamped dry journal [%]."""
    run = run_of(runs, "journal-dry", keys({"contact__law": "ke", **changes}))
    return format(100.0 * float(run.attrs["energy_residual"]), digits)


@cache
def balance() -> FloatArray:
    """Return the place of the static equilibrium [m], shape (2,); oil does not change it."""
    return equilibrium(journal_of(td.load_case("journal-dry"))).centre


def _size(run: xr.Dataset, name: str) -> FloatArray:
    return np.asarray(np.hypot(run[f"{name}x"].values, run[f"{name}y"].values))


def _off(run: xr.Dataset) -> FloatArray:
    """Return the distance from the static equilibrium [m], shape (n_t,)."""
    return np.hypot(*(run[f"e_{axis}"].values - place for axis, place in zip("xy", balance(), strict=True)))


def _touching(run: xr.Dataset) -> NDArray[np.bool_]:
    """Return at which times the first asperities meet."""
    return np.asarray(run["gap_min"].values < ONSET)


def rebounds(runs: Runs, law: str) -> str:
    """Return how often the dry journal left contact again altogether."""
    touching = _touching(run_of(runs, "journal-dry", {"contact.law": law}))
    return str(np.count_nonzero(touching[:-1] & ~touching[1:]))


def settles(runs: Runs) -> str:
    """Return the time after which the damped dry journal stays near its static equilibrium [ms]."""
    run = run_of(runs, "journal-dry", {})
    outside = np.flatnonzero(_off(run) > SETTLED * run.attrs["clearance"])
    return f"{1e3 * float(run['time'].values[outside[-1] + 1]):.2f}"


def turning(runs: Runs) -> FloatArray:
    """Return the eccentricities [µm] at which the undamped dry journal turns back, the first ten."""
    fine = {"contact.law": "ke", "run.output_interval": "1 us", "run.duration": "6 ms"}
    e = 1e6 * _size(run_of(runs, "journal-dry", fine), "e_")
    top = np.flatnonzero((e[1:-1] > e[:-2]) & (e[1:-1] >= e[2:]) & (e[1:-1] > 15.0)) + 1
    return np.asarray(e[top][:10])


def oil_apart(runs: Runs, floor: str) -> FloatArray:
    """Return the largest distance of the two laws in oil [µm], and the time of first contact [ms]."""
    shared = {"contact.minimum_entry_velocity": floor}
    rsdc, ke = (run_of(runs, "journal-oil", {"contact.law": name, **shared}) for name in ("rsdc", "ke"))
    apart = np.hypot(*(rsdc[f"e_{axis}"].values - ke[f"e_{axis}"].values for axis in "xy"))
    first = int(np.argmax(_touching(rsdc)))
    return np.array([1e6 * float(apart.max()), 1e3 * float(rsdc["time"].values[first])])


def from_balance(runs: Runs) -> str:
    """Return the distance of the oiled journal from equilibrium at 30 ms, the larger of both laws [nm]."""
    oiled = [run_of(runs, "journal-oil", {"contact.law": name}) for name in ("rsdc", "ke")]
    return f"{1e9 * max(float(np.interp(0.03, run['time'].values, _off(run))) for run in oiled):.1g}"


@cache
def least_friction() -> tuple[float, float, float]:
    """Return speed [rad/s], friction coefficient and contact share [%] where friction is least."""
    case = td.load_case("journal-oil").replace({"joints.bearing.clearance.friction_coefficient": 0.1})
    curve = td.stribeck(case, np.geomspace(250.0, 450.0, 60), viscosity=["10 mPa s"]).isel(viscosity=0)
    at = int(curve["friction_coefficient"].values.argmin())
    contact = 100.0 * float(curve["contact_share"].values[at])
    return float(curve["speed"].values[at]), float(curve["friction_coefficient"].values[at]), contact


#: Numbers by name.
NUMBERS: Final[Numbers] = {
    "dry equilibrium, x [µm]": lambda runs: f"{1e6 * balance()[0]:.4f}",
    "dry equilibrium, y [µm]": lambda runs: f"{1e6 * balance()[1]:.4f}",
    "dry journal, rebounds": partial(rebounds, law="rsdc"),
    "dry journal settles [ms]": settles,
    "undamped journal, rebounds": partial(rebounds, law="ke"),
    "undamped journal, mebdf residual [%]": partial(residual, digits=".2g"),
    "undamped journal, mebdf residual, rtol 1e-6 [%]": partial(residual, digits=".1g", solver__rtol=1e-6),
    "undamped journal, radau residual [%]": partial(residual, digits=".1g", solver__name="radau"),
    "undamped journal turns, least [µm]": lambda runs: f"{turning(runs).min():.3f}",
    "undamped journal turns, most [µm]": lambda runs: f"{turning(runs).max():.3f}",
    "oil, first contact [ms]": lambda runs: f"{oil_apart(runs, '1 mm/s')[1]:.1f}",
    "oil, laws apart [µm]": lambda runs: f"{oil_apart(runs, '1 mm/s')[0]:.3f}",
    "oil, laws apart, low floor [µm]": lambda runs: f"{oil_apart(runs, '0.01 mm/s')[0]:.3f}",
    "oil, from balance at 30 ms [nm]": from_balance,
    "least friction, speed [rad/s]": lambda runs: f"{least_friction()[0]:.0f}",
    "least friction": lambda runs: f"{least_friction()[1]:.3f}",
    "least friction, contact [%]": lambda runs: f"{least_friction()[2]:.2f}",
}
