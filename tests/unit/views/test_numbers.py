"""Numbers and units as a person reads them."""

import pytest

from tribodyn.views.numbers import as_read


@pytest.mark.parametrize(
    ("unit", "printed"),
    [
        ("um", "µm"),
        ("N/um", "N/µm"),
        ("1/um^2", "1/µm^2"),
        ("deg/s", "°/s"),
        ("degC", "degC"),
        ("lumen", "lumen"),
    ],
)
def test_units_are_printed_as_people_read_them(unit: str, printed: str) -> None:
    assert as_read(unit) == printed
