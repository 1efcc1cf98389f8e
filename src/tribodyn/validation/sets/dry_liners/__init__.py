"""Inputs of the package against ranges of dry bearing liners."""

from dataclasses import replace
from typing import Final, cast

from tribodyn.cases.materials import MATERIALS
from tribodyn.mechanisms.catalogue import load_case
from tribodyn.mechanisms.self_checks import HARDNESS_LIMIT, of_load
from tribodyn.papers.cheng_2022.reduced.case import VsvCase
from tribodyn.simulation import simulate
from tribodyn.validation.base import Band, Comparison, Curve, Outcome, Plot
from tribodyn.validation.catalogue import ValidationSet

LINER: Final = "ptfe-liner"
DEPTH_LIMIT: Final = "0.1 mm"  #: Depth at which a life ends; the factor stated with it does not depend on it.
_WEAR_UNIT: Final = 1e-15  #: 1e-6 mm³/(N m) [m²/N].


def compare(one: ValidationSet) -> Outcome:
    """Return inputs beside the ranges, ratio of lives and pressure of the warning."""
    wear, friction = _range(one, "specific wear rate"), _range(one, "friction coefficient")
    inside = one.bands["inside"]
    of_wear = replace(inside, at_least=round(wear[0] * 1e6, 9), at_most=round(wear[1] * 1e6, 9))
    of_friction = replace(inside, at_least=friction[0], at_most=friction[1])
    case = cast(VsvCase, load_case("vsv"))
    liner = MATERIALS[LINER].properties
    rates, coefficients = liner["specific_wear_rate"].spread, liner["friction_coefficient"].spread
    assert rates is not None
    assert coefficients is not None
    rows = [
        _wear("ptfe-liner, lower end", rates[0], of_wear),
        _wear("ptfe-liner, upper end", rates[1], of_wear),
        _wear("ptfe-liner, value of a case", liner["specific_wear_rate"].at(), of_wear),
        _wear("polyimide-cheng", MATERIALS["polyimide-cheng"].specific_wear_rate, of_wear),
        _wear("default of the vane mechanism", case.wear.specific_wear_rate, of_wear),
        Comparison("friction, ptfe-liner, lower end", "", coefficients[0], band=of_friction),
        Comparison("friction, ptfe-liner, upper end", "", coefficients[1], band=of_friction),
        Comparison(
            "friction, ptfe-liner, value of a case", "", liner["friction_coefficient"].at(), band=of_friction
        ),
        Comparison(
            "friction, default of the vane mechanism", "", case.joint.friction_coefficient, band=of_friction
        ),
        *_lives(case, rates, one.bands["life"]),
    ]
    warned = warned_pressure(case.surfaces.bushing.hardness) * 1e-6
    for name in ("thin", "ball"):
        label = "thin liner" if name == "thin" else name
        rows.append(Comparison(f"overload warning, {label}", "MPa", warned, band=one.bands[name]))
    return Outcome(tuple(rows), _plot(one, rows))


def warned_pressure(hardness: float) -> float:
    """Return the contact pressure from which on a run warns of overload [Pa]."""
    loading = {"hardness_share": HARDNESS_LIMIT * (1.0 + 1e-9), "real_area_share": 0.0}
    below = {"hardness_share": HARDNESS_LIMIT, "real_area_share": 0.0}
    if not any(of_load(loading, "")) or any(of_load(below, "")):
        raise AssertionError("the overload warning is not given at the limit of hardness")
    return HARDNESS_LIMIT * hardness


def _wear(name: str, rate: float, band: Band) -> Comparison:
    return Comparison(f"wear rate, {name}", "1e-6 mm3/(N m)", round(rate / _WEAR_UNIT, 9), band=band)


def _lives(case: VsvCase, rates: tuple[float, float], band: Band) -> list[Comparison]:
    """Return the factor stated with a life, and the ratio of the depths of two runs with both ends."""
    keys = [{"wear.specific_wear_rate": f"{rate} m^2/N", "run.cycles": 1} for rate in rates]
    least, most = (float(simulate(case.replace(one))["wear_depth"].max()) for one in keys)
    limited = simulate(case.replace({"wear.depth_limit": DEPTH_LIMIT, "run.cycles": 1}))
    stated = float(limited.attrs["wear_life_factor"])
    return [
        Comparison("factor stated with a life", "", stated, 80.0, null=1.0, band=band),
        Comparison(
            "lives at both ends of the wear rate, ratio", "", most / least, 80.0, null=rates[1] / rates[0]
        ),
    ]


def _range(one: ValidationSet, quantity: str) -> tuple[float, float]:
    rows = [row for row in one.rows("ranges.csv") if row["quantity"] == quantity]
    return min(float(row["low"]) for row in rows), max(float(row["high"]) for row in rows)


def _plot(one: ValidationSet, rows: list[Comparison]) -> Plot:
    ranges = [row for row in one.rows("ranges.csv") if row["quantity"] == "friction coefficient"]
    middles = [0.5 * (float(row["low"]) + float(row["high"])) for row in ranges]
    halves = [0.5 * (float(row["high"]) - float(row["low"])) for row in ranges]
    places = [float(k) for k in range(len(ranges))]
    computed = [row.computed for row in rows if row.name.startswith("friction")]
    after = [float(len(ranges) + k) for k in range(len(computed))]
    return Plot(
        "report (row of the table), then inputs of the package",
        "friction coefficient",
        (
            Curve("ranges of the reports", "measured", places, middles, halves),
            Curve("inputs of the package", "computed", after, computed),
        ),
    )
