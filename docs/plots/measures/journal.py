"""Numbers of the pages on the journal bearing and its Stribeck curve."""

from __future__ import annotations

from functools import cache, partial
from typing import Final

import numpy as np

import tribodyn as td
from measures.base import Numbers, key_result, keys
from tribodyn.core.arrays import FloatArray
from tribodyn.papers.cheng_2022.runs import Runs


def journal(runs: Runs, *, name: str, digits: str, **changes: object) -> str:
    """Return a key result of the dry journal."""
    return format(key_result(runs.run("journal-dry", keys(changes)), name), digits)


def balance(runs: Runs, axis: str) -> str:
    """Return the place of the static equilibrium [µm]."""
    return f"{1e6 * float(runs.run('journal-dry')[f'e_{axis}_balance']):.4f}"


def turning(runs: Runs) -> FloatArray:
    """Return the eccentricities [µm] at which the undamped dry journal turns back, the first ten."""
    fine = {"contact.law": "ke", "run.output_interval": "1 us", "run.duration": "6 ms"}
    run = runs.run("journal-dry", fine)
    e = 1e6 * np.hypot(run["e_x"].values, run["e_y"].values)
    top = np.flatnonzero((e[1:-1] > e[:-2]) & (e[1:-1] >= e[2:]) & (e[1:-1] > 15.0)) + 1
    return np.asarray(e[top][:10])


def oil_apart(runs: Runs, floor: str) -> FloatArray:
    """Return the largest distance of the two laws in oil [µm], and the time of first contact [ms]."""
    shared = {"contact.minimum_entry_velocity": floor}
    rsdc, ke = (runs.run("journal-oil", {"contact.law": name, **shared}) for name in ("rsdc", "ke"))
    apart = np.hypot(*(rsdc[f"e_{axis}"].values - ke[f"e_{axis}"].values for axis in "xy"))
    return np.array([1e6 * float(apart.max()), key_result(rsdc, "contact_start_ms")])


def from_balance(runs: Runs) -> str:
    """Return the distance of the oiled journal from equilibrium at 30 ms, the larger of both laws [nm]."""
    found = []
    for name in ("rsdc", "ke"):
        run = runs.run("journal-oil", {"contact.law": name})
        at = [float(np.interp(0.03, run["time"].values, run[f"e_{axis}"].values)) for axis in "xy"]
        off = [place - float(run[f"e_{axis}_balance"]) for place, axis in zip(at, "xy", strict=True)]
        found.append(1e9 * float(np.hypot(*off)))
    return f"{max(found):.1g}"


@cache
def least_friction() -> tuple[float, float, float]:
    """Return speed [rad/s], friction coefficient and contact share [%] where friction is least."""
    case = td.load_case("journal-oil").replace({"joint.friction_coefficient": 0.1})
    curve = td.stribeck(case, np.geomspace(250.0, 450.0, 60), viscosity=["10 mPa s"]).isel(viscosity=0)
    at = int(curve["friction_coefficient"].values.argmin())
    contact = 100.0 * float(curve["contact_share"].values[at])
    return float(curve["speed"].values[at]), float(curve["friction_coefficient"].values[at]), contact


#: Numbers by name.
NUMBERS: Final[Numbers] = {
    "dry equilibrium, x [µm]": partial(balance, axis="x"),
    "dry equilibrium, y [µm]": partial(balance, axis="y"),
    "dry journal, rebounds": partial(journal, name="rebounds", digits=".0f"),
    "dry journal settles [ms]": partial(journal, name="settling_time_ms", digits=".2f"),
    "undamped journal, rebounds": partial(journal, name="rebounds", digits=".0f", contact__law="ke"),
    "undamped journal, mebdf residual [%]": partial(
        journal, name="energy_residual_percent", digits=".2g", contact__law="ke"
    ),
    "undamped journal, mebdf residual, rtol 1e-4 [%]": partial(
        journal, name="energy_residual_percent", digits=".1g", contact__law="ke", solver__rtol=1e-4
    ),
    "undamped journal, radau residual [%]": partial(
        journal, name="energy_residual_percent", digits=".1g", contact__law="ke", solver__name="radau"
    ),
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
