import numpy as np
import pytest

from tribodyn.mechanisms.catalogue import MECHANISMS
from tribodyn.results import VARIABLES, build, json_attribute
from tribodyn.results.dataset import plain_attribute
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


def test_a_name_without_a_line_is_refused():
    with pytest.raises(KeyError, match="has no line"):
        build(coordinates={"time": [0.0]}, columns={"nonsense": [1.0]})


def test_a_wrong_number_of_dimensions_is_refused():
    with pytest.raises(ValueError, match="e_x has shape"):
        build(coordinates={"time": [0.0]}, columns={"e_x": [[1.0]]})


@pytest.mark.parametrize(
    ("value", "stored"),
    [
        (True, 1),
        (np.True_, 1),
        (np.float64(0.1), 0.1),
        (np.int64(3), 3),
        (None, ""),
        (["µ", 1], '["µ", 1]'),
        ({"a": None}, '{"a": null}'),
    ],
)
def test_attributes_become_what_netcdf_holds(value, stored):
    plain = plain_attribute(value)
    assert plain == stored
    assert type(plain) is type(stored)


def test_json_attributes_read_back(make_result):
    result = make_result(0.5)
    assert json_attribute(result, "solver", {})["steps"] == 4321
    assert json_attribute(result, "absent", []) == []
