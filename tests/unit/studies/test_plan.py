"""Points of a sweep: what varies, samples of distributions, names of cases."""

from collections.abc import Mapping

import numpy as np
import pytest

import tribodyn.studies.plan
from tribodyn.cases import keys_of
from tribodyn.contact import LAWS
from tribodyn.core.errors import InputError
from tribodyn.mechanisms.catalogue import load_case, parse_case
from tribodyn.papers.cheng_2022.reduced.case import VsvCase
from tribodyn.studies import DISTRIBUTIONS, SAMPLERS, Sampling, make_plan
from tribodyn.studies.plan import POINT, Axis, plan_of_draws
from tribodyn.studies.variation import Levels, Scatter, variation, written

VSV = load_case("vsv")


def test_a_grid_has_every_combination_with_its_case() -> None:
    vary = {"joint.clearance": "20,30 um", "mechanism.formulation": "exact,paper"}
    plan = make_plan(VSV, vary)
    assert [axis.name for axis in plan.axes] == list(vary)
    assert [point.changes for point in plan.points] == [
        {"joint.clearance": c, "mechanism.formulation": f}
        for c in ("20 um", "30 um")
        for f in ("exact", "paper")
    ]
    for point in plan.points:
        assert parse_case(point.toml, "test") == VSV.replace(point.changes)
    # Defaults that follow from what varies are resolved.
    assert 'friction = "moment"' in plan.points[1].toml


def test_samples_come_after_the_grid_and_are_the_same_at_each_of_its_points() -> None:
    vary = {"joint.clearance": "normal(20 um, 1 um)", "contact.law": "ke,rsdc"}
    plan = make_plan(VSV, vary, Sampling(5, "sobol"))
    assert [axis.name for axis in plan.axes] == ["contact.law", "point"]
    clearances = [point.changes["joint.clearance"] for point in plan.points]
    assert clearances[:5] == clearances[5:]
    assert len(set(clearances)) == 5


def test_equal_cases_have_equal_names_however_they_are_spelled() -> None:
    names = [
        make_plan(VSV, {"joint.clearance": asked}).points[0].name for asked in ("20 um", "0.02 mm", "2e-5 m")
    ]
    assert len(set(names)) == 1


@pytest.mark.parametrize(
    ("vary", "sampling", "key", "said"),
    [
        ({}, Sampling(), "--vary", "nothing varies"),
        ({"joint.clearence": "20 um"}, Sampling(), "joint.clearence", "joint.clearance"),
        ({"joint": "20 um"}, Sampling(), "joint", "table"),
        ({"joint.clearance": "20,900 um"}, Sampling(), "joint.clearance", "point 2 of 2"),
        ({"run.cycles": "1", "run.duration": "1 s"}, Sampling(), "run.duration", "not both"),
        ({"joint.clearance": "normal(20, 2 um)"}, Sampling(), "--samples", "how many"),
        ({"joint.clearance": "normal(20, 2 um)"}, Sampling(0), "--samples", "how many"),
        ({"joint.clearance": "20 um"}, Sampling(8), "--samples", "nothing is drawn"),
        ({"joint.clearance": "normal(20, 2 um)"}, Sampling(8, "dice"), "--method", "lhs, sobol"),
        ({"joint.clearance": "normal(20, 2 um)"}, Sampling(8, seed=-1), "--seed", "0 or more"),
        ({"joint.clearance": "normal(20, 20 um)"}, Sampling(64), "joint.clearance", "of 64"),
        ({"joint.clearance": "normal(20, 2 um)"}, Sampling(1_000_000), "--vary", "at most"),
    ],
)
def test_what_cannot_be_is_refused_before_anything_runs(vary, sampling, key, said):
    with pytest.raises(InputError, match=said) as caught:
        make_plan(VSV, vary, sampling)
    assert caught.value.key == key


#: Probabilities whose quantiles have the moments of the distribution, but for what lies in the last tails.
MANY = (np.arange(200_000) + 0.5) / 200_000

ARGUMENTS = {
    "normal": ((20.0, 2.0), 20.0, 2.0),
    "lognormal": ((20.0, 5.0), 20.0, 5.0),
    "uniform": ((10.0, 30.0), 20.0, 20.0 / np.sqrt(12.0)),
    # Mean and variance of a triangular distribution: (a + b + c)/3 and (a² + b² + c² − ab − ac − bc)/18.
    "triangular": ((10.0, 12.0, 20.0), 14.0, np.sqrt((100 + 144 + 400 - 120 - 200 - 240) / 18)),
}


@pytest.mark.parametrize("name", DISTRIBUTIONS)
def test_mean_and_deviation_are_those_asked_for(name: str) -> None:
    arguments, mean, deviation = ARGUMENTS[name]
    values = DISTRIBUTIONS[name].quantiles(arguments, MANY)
    # The tails beyond the outermost of the probabilities hold less than 1e-4 of the deviation.
    assert values.mean() == pytest.approx(mean, rel=1e-4)
    assert values.std() == pytest.approx(deviation, rel=1e-3)


def test_a_truncated_normal_stays_inside() -> None:
    values = DISTRIBUTIONS["normal"].quantiles((20.0, 10.0, 15.0, 22.0), MANY)
    assert values.min() >= 15.0
    assert values.max() <= 22.0


@pytest.mark.parametrize("name", SAMPLERS)
@pytest.mark.parametrize("samples", [1, 5, 64])
def test_samples_lie_in_the_cube_and_repeat_with_their_seed(name: str, samples: int) -> None:
    cube = SAMPLERS[name](samples, 3, 7)
    assert cube.shape == (5 * samples if name == "saltelli" else samples, 3)
    assert ((cube >= 0.0) & (cube < 1.0)).all()
    assert (SAMPLERS[name](samples, 3, 7) == cube).all()
    assert (SAMPLERS[name](samples, 3, 8) != cube).any()


@pytest.mark.parametrize("name", SAMPLERS)
def test_each_stratum_holds_one_sample(name: str) -> None:
    # By construction of a Latin hypercube; of 2^n points of a Sobol sequence since it is a (t, s)-sequence
    # whose coordinates are each a (0, 1)-sequence, which scrambling keeps.
    cube = SAMPLERS[name](32, 2, 0)[:32]
    for column in cube.T:
        assert sorted(np.floor(32 * column)) == list(range(32))


KEYS = keys_of(VsvCase)


def levels(path: str, asked: object) -> tuple[object, ...]:
    found = variation(KEYS[path], asked)
    assert isinstance(found, Levels)
    return found.values


@pytest.mark.parametrize(
    ("path", "asked", "expected"),
    [
        ("joint.clearance", "20 um,30 um", (2e-5, 3e-5)),
        ("joint.clearance", "20, 25, 0.03 mm", (2e-2, 2.5e-2, 3e-5)),
        ("joint.clearance", "20,25 um", (2e-5, 2.5e-5)),
        ("joint.clearance", "20 um", (2e-5,)),
        ("joint.clearance", ["20 um", "1 thou"], (2e-5, 2.54e-5)),
        ("joint.friction_coefficient", "0.05,0.1", (0.05, 0.1)),
        ("joint.friction_coefficient", np.array([0.05, 0.1]), (0.05, 0.1)),
        ("solver.grid.theta", "48,96", (48, 96)),
        ("solver.grid.theta", np.array([48, 96]), (48, 96)),
        ("contact.law", "ke, rsdc", ("ke", "rsdc")),
        ("contact.tensile_clip", "true,false", (True, False)),
        ("contact.tensile_clip", [True, False], (True, False)),
        ("title", "one,two", ("one", "two")),
    ],
)
def test_a_list_is_read_as_its_key_reads_values(path: str, asked: object, expected: object) -> None:
    assert levels(path, asked) == expected


@pytest.mark.parametrize(
    ("path", "asked", "same_as"),
    [
        ("joint.clearance", "20 um:40 um:5 um", "20 um,25 um,30 um,35 um,40 um"),
        ("joint.clearance", "20:40:5 um", "20 um,25 um,30 um,35 um,40 um"),
        ("joint.clearance", "0.02 mm:30 um:5 um", "20 um,25 um,30 um"),
        ("joint.clearance", "40:20:-10 um", "40 um,30 um,20 um"),
        ("joint.clearance", "20:34:5 um", "20 um,25 um,30 um"),
        ("mechanism.ring_angle", "10 deg:70 deg:20 deg", "10 deg,30 deg,50 deg,70 deg"),
        ("joint.friction_coefficient", "0:0.3:0.1", "0,0.1,0.2,0.3"),
        ("solver.grid.z", "8:24:8", "8,16,24"),
    ],
)
def test_a_range_holds_what_the_list_of_its_values_holds(path: str, asked: str, same_as: str) -> None:
    assert levels(path, asked) == levels(path, same_as)


@pytest.mark.parametrize("path", ["joint.clearance", "mechanism.ring_angle", "joint.friction_coefficient"])
def test_written_values_read_back(path: str) -> None:
    key = KEYS[path]
    for value in np.random.default_rng(1).uniform(1e-5, 1e-4, 20).tolist():
        assert key.read(written(key, value), text=True) == value


def test_a_distribution_takes_its_arguments_in_the_unit_of_the_key() -> None:
    found = variation(KEYS["joint.clearance"], "normal(20, 2 um)")
    assert isinstance(found, Scatter)
    assert found.arguments == (2e-5, 2e-6)
    assert found.values(np.array([0.5])) == pytest.approx([2e-5])


@pytest.mark.parametrize(
    ("path", "asked", "said"),
    [
        ("joint.clearance", "20,30", "unit is missing"),
        ("joint.clearance", "20 um,20 um", "twice"),
        ("joint.clearance", "20 um,0.02 mm", "twice"),
        ("joint.clearance", "20 um,30 kg", "kg"),
        ("joint.clearance", "", "unit|number"),
        ("joint.clearance", [], "no value"),
        ("joint.clearance", "20:10:1 um", "step"),
        ("joint.clearance", "10:20:0 um", "step"),
        ("joint.clearance", "10:20:1e-6 um", "at most"),
        ("joint.clearance", "10:20 um", "unit|number"),
        ("joint.clearance", "cauchy(20 um, 2 um)", "no distribution"),
        ("joint.clearance", "normal(20 um)", "1 arguments"),
        ("joint.clearance", "normal(20 um, 0 um)", "above 0"),
        ("joint.clearance", "uniform(30 um, 20 um)", "below"),
        ("contact.law", "ke,hertz", "hertz"),
        ("contact.law", "uniform(ke, rsdc)", "distribution"),
        ("contact.tensile_clip", "yes", "yes"),
        ("solver.grid.z", "8,9.5", "9.5"),
        ("solver.grid.z", "uniform(8, 16)", "distribution"),
    ],
)
def test_what_cannot_be_is_refused_and_names_the_key(path: str, asked: object, said: str) -> None:
    with pytest.raises(InputError, match=said) as caught:
        variation(KEYS[path], asked)
    assert caught.value.key == path


def test_another_version_has_other_names(monkeypatch: pytest.MonkeyPatch) -> None:
    before = make_plan(VSV, {"joint.clearance": "20 um"}).points[0].name
    monkeypatch.setattr(tribodyn.studies.plan, "version", lambda name: "99")
    assert make_plan(VSV, {"joint.clearance": "20 um"}).points[0].name != before


def test_everything_else_of_the_case_counts_too() -> None:
    other = VSV.replace({"solver.rtol": 1e-5})
    vary = {"joint.clearance": "20 um"}
    assert make_plan(VSV, vary).points[0].name != make_plan(other, vary).points[0].name


def test_every_contact_law_can_be_swept_in_both_formulations() -> None:
    vary = {"contact.law": ",".join(LAWS), "mechanism.formulation": "exact,paper"}
    assert len({point.name for point in make_plan(VSV, vary).points}) == 2 * len(LAWS)


def test_of_very_many_draws_only_the_outermost_cases_are_read(monkeypatch: pytest.MonkeyPatch) -> None:
    """4,000 copies of a build are planned in less than a second; each is read where it is computed."""
    key = keys_of(VsvCase)["joint.clearance"]
    clearances = (2e-5, *np.linspace(1e-5, 3e-5, 999).tolist())
    read = []

    def replace(case: VsvCase, changes: Mapping[str, object], *, source: str = "replace") -> VsvCase:
        read.append(changes["joint.clearance"])
        return plainly(case, changes, source=source)

    plainly = VsvCase.replace
    monkeypatch.setattr(VsvCase, "replace", replace)
    plan = plan_of_draws(VSV, Axis(POINT, {key: clearances}))
    assert read == ["10 um", "30 um"]
    assert [point.changes["joint.clearance"] for point in plan.points[:2]] == ["20 um", "10 um"]
    # Of the same case, draw and version alone names are the same.
    names = [point.name for point in plan.points]
    assert names == [point.name for point in plan_of_draws(VSV, plan.axes[0]).points]
    others = plan_of_draws(plainly(VSV, {"run.duration": "1 s"}), plan.axes[0])
    assert len({*names, *(point.name for point in others.points)}) == 2000


def test_a_draw_that_cannot_be_is_refused_before_any_runs() -> None:
    key = keys_of(VsvCase)["joint.clearance"]
    with pytest.raises(InputError, match="point 2 of 3"):
        plan_of_draws(VSV, Axis(POINT, {key: (2e-5, -1e-6, 1e-5)}))
