"""Numbers and units as a person reads them."""

import math

import pytest

from tribodyn.results.summary import KeyResult
from tribodyn.views.numbers import as_read, columns_of, fitting


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


@pytest.mark.parametrize(
    ("unit", "values", "shown", "number"),
    [
        ("nm", [31600.0], "µm", 31.6),
        ("nm", [3e-4], "nm", 3e-4),
        ("µm", [999.96], "mm", 0.99996),
        ("N", [12100.0, 3.0], "kN", 12.1),
        ("N m", [0.02], "mN m", 20.0),
        ("MPa", [0.004], "kPa", 4.0),
        ("nm per 1000 cycles", [5.7e4], "µm per 1000 cycles", 57.0),
        ("W", [0.0], "W", 0.0),
        ("J", [math.nan], "J", math.nan),
        ("°", [1e5], "°", 1e5),
    ],
)
def test_units_go_in_steps_of_a_thousand(unit: str, values: list[float], shown: str, number: float) -> None:
    fitted, factor = fitting(unit, values)
    assert fitted == shown
    assert values[0] * factor == pytest.approx(number, nan_ok=True)


def test_a_column_has_the_unit_of_its_largest_number() -> None:
    force = KeyResult("Force", "N", "Joints", "", lambda _: 0.0)
    numbers = {name: force.of_part(name) for name in ("wrist", "main")}
    (column,) = columns_of(numbers, {"wrist": 12.0, "main": 2500.0})
    assert (column.label, column.unit, column.factor, [*column.members]) == (
        "Force",
        "kN",
        1e-3,
        ["wrist", "main"],
    )
