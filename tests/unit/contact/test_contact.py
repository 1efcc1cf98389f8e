import types

import numpy as np
import pytest

from tribodyn.contact import LAWS, RSDC, SurfacePair, law
from tribodyn.core.errors import InputError


@pytest.mark.parametrize("name", LAWS)
def test_every_law_is_found_by_its_name(table_1_pair: SurfacePair, name: str) -> None:
    found = law(name, table_1_pair)
    assert type(found) is LAWS[name]
    assert found.name == name


def test_unknown_law_names_the_known_ones(table_1_pair: SurfacePair) -> None:
    with pytest.raises(InputError, match="ke, rsdc") as caught:
        law("hertz", table_1_pair)
    assert caught.value.key == "contact.law"


def test_a_case_lends_its_surfaces(table_1_pair: SurfacePair) -> None:
    case = types.SimpleNamespace(surface_pair=table_1_pair)
    assert law("rsdc", case) == RSDC(table_1_pair)


def test_options_reach_the_law(table_1_pair: SurfacePair) -> None:
    assert law("rsdc", table_1_pair, damping_factor="flores") == RSDC(table_1_pair, "flores")


def test_options_of_other_laws_are_passed_over(table_1_pair: SurfacePair) -> None:
    assert law("ke", table_1_pair, penalty_stiffness=1e13) == law("ke", table_1_pair)


def test_options_of_no_law_are_refused(table_1_pair: SurfacePair) -> None:
    with pytest.raises(InputError, match="dampng"):
        law("ke", table_1_pair, dampng="flores")


@pytest.mark.parametrize("name", LAWS)
def test_pressure_takes_a_gap_in_metres(table_1_pair: SurfacePair, name: str) -> None:
    found = law(name, table_1_pair)
    gap = np.array([[0.0, 1e-6], [2e-6, 5e-6]])
    expected = found.stiffness_pressure(gap / table_1_pair.roughness_rms)
    np.testing.assert_array_equal(found.pressure(gap), expected)
