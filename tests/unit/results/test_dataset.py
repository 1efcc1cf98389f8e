"""Variables of results: units and meanings, the list in the manual, pictures without times."""

from pathlib import Path

import pytest

from tribodyn.mechanisms.catalogue import MECHANISMS
from tribodyn.results import VARIABLES, build
from tribodyn.results.schema import check
from tribodyn.results.summary import EFFORT
from tribodyn.results.variables import OUTPUTS, OUTPUTS_OF_CYCLE

KNOWN = {**VARIABLES, **MECHANISMS["vsv"].variables}
#: What only results of wear campaigns hold.
OF_A_CAMPAIGN = {name for name, variable in KNOWN.items() if {"jump", "stage_cycles"} & set(variable.dims)}
OF_OUTPUTS = OUTPUTS.keys() | OUTPUTS_OF_CYCLE.keys()


def test_every_variable_carries_unit_and_meaning(make_result, make_campaign):
    assert set(make_result(0.5).variables) == set(KNOWN) - OF_A_CAMPAIGN - OF_OUTPUTS
    result = make_campaign(5)
    assert set(result.variables) == set(KNOWN) - OF_OUTPUTS
    for name, variable in result.variables.items():
        assert variable.attrs["units"] == KNOWN[name].units
        assert variable.attrs["long_name"]


@pytest.mark.parametrize("mechanism", MECHANISMS.values(), ids=MECHANISMS)
def test_no_mechanism_says_again_what_all_share_and_long_names_are_unique(mechanism):
    both = mechanism.variables.keys() & VARIABLES.keys()
    assert not {name for name in both if mechanism.variables[name] == VARIABLES[name]}
    names = [variable.long_name for variable in (VARIABLES | mechanism.variables).values()]
    assert len(set(names)) == len(names)


PAGE = Path(__file__).parents[3] / "docs" / "guide" / "results.md"


LISTS = [VARIABLES, EFFORT]
for _mechanism in MECHANISMS.values():
    LISTS += [_mechanism.variables, _mechanism.key_results, [f"{name}.png" for name in _mechanism.figures]]


@pytest.mark.parametrize("names", LISTS)
def test_the_manual_lists_everything_a_result_may_hold(names):
    text = PAGE.read_text(encoding="utf-8")
    assert [name for name in names if f"`{name}`" not in text] == []


KINDS = {kind: mechanism.variables for kind, mechanism in MECHANISMS.items()}


@pytest.mark.parametrize("pictures", ["snapshot", "frame"])
def test_pictures_of_a_motion_without_times_are_refused(pictures, make_result):
    whole = make_result(1.0)
    check(whole, KINDS)
    with pytest.raises(ValueError, match=f"values of {pictures}, but none of time"):
        check(
            whole.isel(time=slice(0, 0), **{"snapshot": slice(0, 0), "frame": slice(0, 0), pictures: [0]}),
            KINDS,
        )
    check(whole.isel(time=slice(0, 0), snapshot=slice(0, 0), frame=slice(0, 0)), KINDS)


def test_a_wrong_number_of_dimensions_is_refused():
    with pytest.raises(ValueError, match="e_x has shape"):
        build(coordinates={"time": [0.0]}, columns={"e_x": [[1.0]]})
