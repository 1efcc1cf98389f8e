"""The cheapest tolerances, around simulations whose numbers are known functions of the keys."""

import itertools
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
import xarray as xr
from scipy import stats

from tribodyn.cli.main import main
from tribodyn.core.errors import InputError, TribodynError
from tribodyn.mechanisms.catalogue import load_case, parse_case
from tribodyn.mechanisms.results import summarise
from tribodyn.simulation import simulate
from tribodyn.studies import allocate
from tribodyn.studies.tolerances import standard_width

CASE, NUMBER = "slider-crank", "error_rms_um_slider"
MASSES = ("bodies.crank.mass", "bodies.rod.mass", "bodies.slider.mass")
STEPS = ({"80 g": 1.0, "40 g": 2.0, "20 g": 4.0, "10 g": 9.0},) * 2 + (
    {"60 g": 1.0, "30 g": 2.5, "15 g": 4.0, "5 g": 7.0},
)


def costs(tmp_path: Path, steps: Any = STEPS, kind: str = "widths", more: str = "") -> str:
    """Write a file of tolerances of the masses of the three bodies."""
    tables = [
        f"[{path.split('.')[1]}]\n{more if 'key' in more else f'key = {path!r}{chr(10)}{more}'}\n{kind} = {{"
        + ", ".join(f'"{label}" = {value}' for label, value in of.items())
        + "}\n"
        for path, of in zip(MASSES, steps, strict=False)
    ]
    path = tmp_path / "costs.toml"
    path.write_text("\n".join(tables))
    return str(path)


@pytest.fixture
def linear(monkeypatch: pytest.MonkeyPatch) -> Callable[..., None]:
    """Replace the simulations by a function of the masses of the three bodies."""

    def replace(function: Callable[..., Any]) -> None:
        def run(plan: Any, *_: Any) -> xr.Dataset:
            columns = {key.path: np.array(values) for key, values in plan.axes[0].columns.items()}
            values = function(*(columns[path] for path in MASSES))
            return xr.Dataset({NUMBER: ("run", values), "failure": ("run", [""] * len(values))})

        monkeypatch.setattr("tribodyn.studies.allocation.run", run)
        # Cases of thousands of points are not made: that takes longer than everything else here.
        monkeypatch.setattr("tribodyn.studies.allocation.plan_of", lambda _, axes: SimpleNamespace(axes=axes))

    return replace


def grams(a: Any, b: Any, c: Any) -> Any:
    return 1000.0 * (a + b + c)


def exact(widths: tuple[float, ...], limit: float) -> float:
    """Return the probability of a sum of normal masses, whose widths are six deviations [g]."""
    deviation = np.sqrt(sum(w**2 for w in widths)) / 6.0
    return float(stats.norm.cdf((limit - 650.0) / deviation))


@pytest.mark.parametrize(
    ("limit", "probability"), [(670.0, 0.997), (680.0, 0.95), (668.0, 0.999), (661.0, 0.99)]
)
def test_cheapest_steps_are_those_of_a_full_enumeration(linear, tmp_path, limit, probability):
    linear(grams)
    found = allocate(CASE, [f"{NUMBER}={limit}"], probability, costs(tmp_path), samples=400)
    every = [
        (sum(cost for _, cost in chosen), exact(tuple(float(label[:-2]) for label, _ in chosen), limit))
        for chosen in itertools.product(*(of.items() for of in STEPS))
    ]
    # Of equal costs (two tie often here) the most probable one is taken.
    best = min((cost, -p) for cost, p in every if p >= probability)
    assert found.chosen.cost == best[0]
    assert found.chosen.probability == pytest.approx(-best[1], abs=5e-4)
    share = found.confirmed.within / found.confirmed.points
    error = np.sqrt(-best[1] * (1 + best[1]) / found.confirmed.points)
    assert abs(share + best[1]) <= 2.0 * error + 1e-12
    parts = np.array(found.chosen.widths) ** 2 / np.sum(np.array(found.chosen.widths) ** 2)
    assert found.contributions[0] == pytest.approx(parts, abs=0.01)


def test_curves_give_equal_cost_of_a_little_more_of_the_limit(linear, tmp_path, monkeypatch):
    """At the optimum of costs a/w the width is as a^(1/3), by a multiplier of Lagrange."""
    linear(grams)
    monkeypatch.setattr("tribodyn.studies.quadratic_model._DRAWN", 2**14)
    factors = (1.0, 8.0, 27.0)
    more = "cost = {{a = {}, k = 1.0, least = '1 g', most = '200 g'}}"
    text = "\n".join(
        f'[m{i}]\nkey = "{path}"\n{more.format(a)}'
        for i, (path, a) in enumerate(zip(MASSES, factors, strict=True))
    )
    (path := tmp_path / "costs.toml").write_text(text)
    found = allocate(CASE, [f"{NUMBER}=670"], 0.99, path, samples=200)
    assert exact(tuple(1e3 * np.array(found.chosen.widths)), 670.0) == pytest.approx(0.99, abs=1e-3)
    widths = np.array([1.0, 2.0, 3.0]) * 20.0 * 6.0 / (stats.norm.ppf(0.99) * np.sqrt(14.0))
    # The optimum is flat: costs agree better than widths.
    assert found.chosen.cost == pytest.approx(sum(np.array(factors) / widths), rel=0.01)
    assert 1e3 * np.array(found.chosen.widths) == pytest.approx(widths, rel=0.1)


def test_both_sides_of_a_limit_count(linear: Callable[..., None], tmp_path: Path) -> None:
    linear(grams)
    one, two = (
        allocate(CASE, limits, 0.95, costs(tmp_path), samples=100).chosen
        for limits in ([f"{NUMBER}=670"], [f"{NUMBER}=670", f"{NUMBER}>=640"])
    )
    assert two.cost > one.cost
    assert two.probability < exact(tuple(1e3 * np.array(two.widths)), 670.0)


def test_limits_that_are_never_or_always_kept(linear, tmp_path, capsys):
    linear(grams)
    with pytest.raises(TribodynError, match="not even the finest tolerances keep the limits"):
        allocate(CASE, [f"{NUMBER}=649"], 0.9, costs(tmp_path))
    found = allocate(CASE, [f"{NUMBER}=2000"], 0.9, costs(tmp_path), samples=50)
    assert found.chosen.labels == ("80 g", "80 g", "60 g")
    asked = ["allocate", CASE, "--limit", f"{NUMBER}=2000", "--probability", "0.9", "--samples", "50"]
    assert main([*asked, "--cost", costs(tmp_path), "-o", str(tmp_path / "out")]) == 0
    assert "the widest tolerances do" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("steps", "kind", "more", "words"),
    [
        (({"80 g": 1.0, "40 g": 0.5},), "widths", "", "a wider tolerance must not cost more"),
        (({"IT7": 1.0},), "grades", 'key = "joints.wrist.clearance.radial"\nsize = "2 m"', "at most 500 mm"),
        (({"IT99": 1.0},), "grades", 'key = "joints.wrist.clearance.radial"\nsize = "2 mm"', "allowed: IT5"),
        (({"IT7": 1.0},), "grades", 'size = "2 mm"', "grades are of lengths"),
        (({"IT7": 1.0},), "grades", 'key = "joints.wrist.clearance.radial"', "grades are of a nominal size"),
        (({"80 g": -1.0},), "widths", "", "allowed: a number above 0"),
        (({"80 g": 1.0},), "widths", 'law = "nonsense"', "allowed: normal, uniform"),
        (({"80 g": 1.0},), "width", "", "allowed: key, law"),
        (({"80 mm": 1.0},), "widths", "", "'mm' is not a unit of mass"),
    ],
)
def test_impossible_tolerances_are_refused_in_a_sentence(tmp_path, steps, kind, more, words):
    with pytest.raises(InputError, match=words):
        allocate(CASE, [f"{NUMBER}=1"], 0.9, costs(tmp_path, steps, kind, more))


def test_widths_of_grades_follow_the_unit_of_tolerance() -> None:
    """ISO 286-1: IT6 to IT12 are 10, 16, 25, 40, 64, 100, 160 times 0.45 D^(1/3) + 0.001 D, rounded."""
    ranges = [(6, 10), (10, 18), (18, 30), (30, 50), (50, 80), (80, 120), (120, 180), (180, 250), (400, 500)]
    for factor, grade in zip((10, 16, 25, 40, 64, 100, 160), range(6, 13), strict=True):
        for low, high in ranges:
            d = np.sqrt(low * high)
            unit = 1e-6 * factor * (0.45 * np.cbrt(d) + 0.001 * d)
            assert standard_width(f"IT{grade}", high * 1e-3) == pytest.approx(unit, rel=0.05)


#: A model of one's own: a press with its slide upright.
PRESS = """
case = "mechanism"
gravity = "0, -9.81, 0 m/s^2"
run.cycles = 1
run.analysis = "kinematic"
drives.motor = { joint = "main", speed = "300 rpm" }
[bodies]
crank = { mass = "0.4 kg", centre = "20, 0, 0 mm", inertia = "2e-4, 3e-4, 4e-4 kg m^2" }
rod = { mass = "0.3 kg", centre = "30, 60, 0 mm", inertia = "5e-4, 1e-5, 5e-4 kg m^2" }
slider = { mass = "0.9 kg", centre = "0, 150, 0 mm", inertia = "1e-4, 1e-4, 1e-4 kg m^2" }
[joints]
main = { type = "revolute", between = ["ground", "crank"], point = "0, 0, 0 mm", axis = [0, 0, 1] }
pin = { type = "revolute", between = ["crank", "rod"], point = "40, 0, 0 mm", axis = [0, 0, 1] }
wrist = { type = "revolute", between = ["rod", "slider"], point = "0, 150, 0 mm", axis = [0, 0, 1] }
guide = { type = "prismatic", between = ["ground", "slider"], point = "0, 150, 0 mm", axis = [0, 1, 0] }
"""


@pytest.mark.parametrize("model", [pytest.param(CASE, marks=pytest.mark.long), "press"])
def test_optimum_of_machines_is_that_of_a_full_enumeration(model: str, tmp_path: Path) -> None:
    """Inverse dynamics: the moment is nearly linear in the masses, so that a choice has a normal law."""
    case = parse_case(PRESS, "press") if model == "press" else load_case(model)
    case = case.replace({"run.analysis": "kinematic", "run.positions": 10})
    name = "drive_moment_rms_Nm"

    def number(path: str, change: float) -> float:
        return float(summarise(simulate(case.replace({path: f"{case.at(path) + change!r} kg"})))[name])

    slopes = [(number(path, 0.01) - number(path, -0.01)) / 20.0 for path in MASSES]
    every = [
        (
            sum(cost for _, cost in one),
            np.hypot.reduce([s * float(w[:-2]) / 6.0 for s, (w, _) in zip(slopes, one, strict=True)]),
        )
        for one in itertools.product(*(of.items() for of in STEPS))
    ]
    # Halfway between two choices that differ most, so that no choice is a near miss.
    deviations = np.sort([deviation for _, deviation in every])[16:48]
    k = int(np.argmax(np.diff(deviations)))
    room = stats.norm.ppf(0.95) * deviations[k : k + 2].mean()
    cost, probable = min(
        (cost, -stats.norm.cdf(room / deviation)) for cost, deviation in every if deviation <= deviations[k]
    )
    limit = number(MASSES[0], 0.0) + room
    found = allocate(case, [f"{name}={float(limit)!r}"], 0.95, costs(tmp_path), samples=30, workers=0)
    assert found.chosen.cost == cost
    assert found.chosen.probability == pytest.approx(-probable, abs=5e-3)
    chance = found.chosen.probability
    share, error = found.confirmed.within / 30, np.sqrt(chance * (1.0 - chance) / 30)
    assert abs(share - chance) <= 2.0 * error


def test_a_number_that_jumps_is_refused(linear: Callable[..., None], tmp_path: Path) -> None:
    linear(lambda a, b, c: np.sin(1e6 * (a + b + c)))
    with pytest.raises(TribodynError, match="follows no quadratic of the keys"):
        allocate(CASE, [f"{NUMBER}=1"], 0.9, costs(tmp_path))


def test_probability_one_and_files_that_are_none(tmp_path: Path) -> None:
    asked = ["allocate", CASE, "--limit", f"{NUMBER}=20", "-o", str(tmp_path / "out"), "--cost"]
    assert main([*asked, costs(tmp_path), "--probability", "1"]) == 2
    assert main([*asked, str(tmp_path), "--probability", "0.9"]) == 2
    (tmp_path / "bad.toml").write_text("a = = 3")
    assert main([*asked, str(tmp_path / "bad.toml"), "--probability", "0.9"]) == 2
