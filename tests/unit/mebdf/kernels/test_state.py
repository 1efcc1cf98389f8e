"""The record of an integration."""

from __future__ import annotations

import numpy as np
import pytest

from mebdf.kernels.state import NUMBERS, Numbers, Settings, new_state


def test_each_number_and_setting_is_a_field_with_its_default() -> None:
    record = new_state(0.0, np.ones(2), 1.0, 1e-3, np.ones(2)).numbers[0]
    assert NUMBERS.names == tuple(Numbers.__annotations__)
    for name in Settings.__annotations__:
        np.testing.assert_array_equal(getattr(record.settings, name), getattr(Settings, name))


@pytest.mark.parametrize("kind", [NUMBERS, NUMBERS["settings"]], ids=["numbers", "settings"])
def test_no_field_hides_behind_an_attribute_of_records(kind: np.dtype[np.void]) -> None:
    """Uncompiled code would read the attribute, compiled code the field."""
    assert kind.names is not None
    assert not set(kind.names) & set(dir(np.record))
