"""Measure the numbers that stand inside sentences of the manual, for the role ``number``.

python docs/plots/measured.py OUTPUT_DIRECTORY
"""

from __future__ import annotations

import json
import sys
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Final

import numpy as np
import xarray as xr

import tribodyn as td
from tribodyn.contact import law
from tribodyn.contact.kogut_etsion import KogutEtsion
from tribodyn.core.arrays import FloatArray
from tribodyn.mechanisms.results import summarise
from tribodyn.papers.cheng_2022 import Runs
from tribodyn.papers.cheng_2022.claims import all_joints
from tribodyn.papers.cheng_2022.claims.base import Trial

PEAK, ERROR = "contact_force_max_N", "vane_angle_error_outside_deg"
SOLVERS: Final = ("mebdf", "radau", "bdf", "cvode")


def vsv(runs: Runs, **changes: object) -> xr.Dataset:
    """Return the built-in mechanism with some keys changed; two underscores stand for a dot."""
    return runs.run("vsv", {key.replace("__", "."): value for key, value in changes.items()})


def result(name: str, digits: str, runs: Runs, **changes: object) -> str:
    """Return a key result of the built-in mechanism."""
    return format(float(summarise(vsv(runs, **changes))[name]), digits)


def by_cycle(runs: Runs, name: str, clearance: str) -> float:
    """Return what an energy grows by in the second cycle [J]."""
    run = vsv(runs, joint__clearance=clearance)
    period, energy = float(run.attrs["cycle_period"]), run[name].values
    first, second = np.interp([period, 2.0 * period], run["time"].values, energy)
    return float(second - first)


def damping_heat(runs: Runs, clearance: str) -> str:
    """Return the heat of contact damping in a cycle [mJ]."""
    return f"{1e3 * by_cycle(runs, 'energy_damping', clearance):.2f}"


def journal(runs: Runs, name: str, digits: str, **changes: object) -> str:
    """Return a key result of the dry journal."""
    found = summarise(runs.run("journal-dry", {key.replace("__", "."): v for key, v in changes.items()}))
    return format(float(found[name]), digits)


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
    return np.array([1e6 * float(apart.max()), float(rsdc["contact_start"]) * 1e3])


def stiffness(runs: Runs, pressure: float) -> str:
    """Return the slope of the law of Kogut and Etsion at a pressure [Pa], in MPa/µm."""
    case = td.load_case("vsv")
    h = np.linspace(0.0, 4.0, 40_001)
    p = law("ke", case).stiffness_pressure(h)
    sigma = vsv(runs).attrs["roughness"]
    at = int(np.argmin(np.abs(p - pressure)))
    slope = (p[at - 1] - p[at + 1]) / ((h[at + 1] - h[at - 1]) * sigma)
    return f"{slope * 1e-12:.3g}"


def elastic_plastic(runs: Runs, h_star: float) -> str:
    """Return the share of the pressure that elastic-plastic asperities carry at a separation [%]."""
    rough = law("ke", td.load_case("vsv"))
    assert isinstance(rough, KogutEtsion)
    at = np.array([h_star])
    parts = [float(regime.integral(at)[0]) for regime in rough.regimes]
    return f"{100.0 * (parts[1] + parts[2]) / sum(parts):.1f}"


def over_solvers(runs: Runs, formulation: str) -> str:
    """Return the largest range of the peak force of a reversal over the solvers, over its mean [%]."""
    found = np.array(
        [
            vsv(runs, solver__name=name, mechanism__formulation=formulation)["contact_force_impact"].values[
                1:
            ]
            for name in SOLVERS
        ]
    )
    return f"{100.0 * float(np.max(np.ptp(found, axis=0) / found.mean(axis=0))):.0f}"


def factor(runs: Runs, clearance: float) -> str:
    """Return how many times as much all joints err as the trunnion."""
    return f"{all_joints.factor(Trial(runs, 'exact'), clearance).value:.1f}"


NUMBERS: Final[dict[str, Callable[[Runs], str]]] = {
    "damping heat, 20 µm [mJ]": partial(damping_heat, clearance="20 um"),
    "damping heat, 40 µm [mJ]": partial(damping_heat, clearance="40 um"),
    "work of the loads [J]": lambda runs: f"{abs(by_cycle(runs, 'energy_loads', '20 um')):.1f}",
    "elastic-plastic share, h* = 0 [%]": partial(elastic_plastic, h_star=0.0),
    "elastic-plastic share, h* = 2 [%]": partial(elastic_plastic, h_star=2.0),
    "dry journal, rebounds": lambda runs: journal(runs, "rebounds", ".0f"),
    "dry journal settles [ms]": lambda runs: journal(runs, "settling_time_ms", ".2f"),
    "undamped journal, mebdf residual [%]": lambda runs: journal(
        runs, "energy_residual_percent", ".2g", contact__law="ke"
    ),
    "undamped journal, radau residual [%]": lambda runs: journal(
        runs, "energy_residual_percent", ".1g", contact__law="ke", solver__name="radau"
    ),
    "undamped journal turns, least [µm]": lambda runs: f"{turning(runs).min():.3f}",
    "undamped journal turns, most [µm]": lambda runs: f"{turning(runs).max():.3f}",
    "oil, first contact [ms]": lambda runs: f"{oil_apart(runs, '1 mm/s')[1]:.1f}",
    "oil, laws apart [µm]": lambda runs: f"{oil_apart(runs, '1 mm/s')[0]:.3f}",
    "oil, laws apart, low floor [µm]": lambda runs: f"{oil_apart(runs, '0.01 mm/s')[0]:.3f}",
    **{
        f"peak, v_min {floor} [N]": partial(
            result, PEAK, ".0f", contact__minimum_entry_velocity=floor
        )
        for floor in ("0.1 mm/s", "1 mm/s", "5 mm/s")
    },
    **{
        f"peak, loss {loss:g} s/m [N]": partial(
            result, PEAK, ".0f", contact__law="ke", contact__loss_coefficient=f"{loss:g} s/m"
        )
        for loss in (0.02, 0.1, 0.3, 100.0)
    },
    **{
        f"error, {name} [deg]": partial(
            result, ERROR, ".4f", contact__law=name, contact__damping_factor="calibrated",
            contact__restitution=0.7,
        )
        for name in ("gt", "gw", "ke", "ceb", "jg", "linear")
    },
    **{
        f"error, {contact} [deg]": partial(result, ERROR, ".4f", joint__contact=contact)
        for contact in ("surface", "point-lankarani-nikravesh", "point-johnson")
    },
    "stiffness at 9 MPa [MPa/µm]": partial(stiffness, pressure=9e6),
    "stiffness at 33 MPa [MPa/µm]": partial(stiffness, pressure=33e6),
    "peaks over solvers, exact [%]": partial(over_solvers, formulation="exact"),
    "peaks over solvers, paper [%]": partial(over_solvers, formulation="paper"),
    "factor of all joints, 20 µm": partial(factor, clearance=20e-6),
    "factor of all joints, 40 µm": partial(factor, clearance=40e-6),
}  # fmt: skip
"""Numbers by name, with what measures them."""


def main() -> None:
    """Write all numbers."""
    target = Path(sys.argv[1])
    target.mkdir(parents=True, exist_ok=True)
    runs = Runs()
    found = {name: measure(runs) for name, measure in NUMBERS.items()}
    text = json.dumps(found, indent=2, ensure_ascii=False)
    (target / "numbers.json").write_text(text + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
