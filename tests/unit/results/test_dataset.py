import pytest

from tribodyn.mechanisms.catalogue import MECHANISMS
from tribodyn.results import VARIABLES
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
