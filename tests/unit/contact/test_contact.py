import numpy as np
import pytest

from tribodyn.contact import LAWS, SurfacePair, law
from tribodyn.core.errors import InputError


def test_unknown_law_names_the_known_ones(table_1_pair: SurfacePair) -> None:
    with pytest.raises(InputError, match="ke, rsdc") as caught:
        law("hertz", table_1_pair)
    assert caught.value.key == "contact.law"


def test_options_of_no_law_are_refused(table_1_pair: SurfacePair) -> None:
    with pytest.raises(InputError, match="dampng"):
        law("ke", table_1_pair, dampng="flores")


@pytest.mark.parametrize("name", LAWS)
def test_pressure_takes_a_gap_in_metres(table_1_pair: SurfacePair, name: str) -> None:
    found = law(name, table_1_pair)
    gap = np.array([[0.0, 1e-6], [2e-6, 5e-6]])
    expected = found.stiffness_pressure(gap / table_1_pair.roughness_rms)
    np.testing.assert_array_equal(found.pressure(gap), expected)
