import pytest

from tribodyn.core.errors import InputError
from tribodyn.mechanisms.catalogue import load_case, parse_case
from tribodyn.studies import Sampling, make_plan

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
def test_what_cannot_be_is_refused_before_anything_runs(
    vary: dict[str, str], sampling: Sampling, key: str, said: str
) -> None:
    with pytest.raises(InputError, match=said) as caught:
        make_plan(VSV, vary, sampling)
    assert caught.value.key == key
