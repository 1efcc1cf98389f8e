import numpy as np
import pytest

from tribodyn.cases import keys_of
from tribodyn.core.errors import InputError
from tribodyn.papers.cheng_2022.reduced.case import VsvCase
from tribodyn.studies.variation import Levels, Scatter, variation, written

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
