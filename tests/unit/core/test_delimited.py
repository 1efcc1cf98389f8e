"""Names and units of columns, as headers give them."""

import time

import pytest

from tribodyn.core.files import named

LONG = 100_000
QUICK = 1.0  #: Processor time of any header of this length [s]; a thousand times what it takes.


@pytest.mark.parametrize(
    ("cell", "expected"),
    [
        ("time [ms]", ("time", "ms")),
        ('"Position (mm)"', ("Position", "mm")),
        ("torque (net) [N m]", ("torque (net)", "N m")),
        ("torque (net) (N m)", ("torque (net)", "N m")),
        (" x ", ("x", None)),
        ("x ()", ("x ()", None)),
        ("x )", ("x )", None)),
        ("[m]", ("", "m")),
        ('" x [m] "', ("x", "m")),
        ("", ("", None)),
        ("x []", None),
        ("x [m", None),
        ("x m]", None),
        ("x [m]]", None),
        ("x [a] (m)", None),
        ('x "y" [m]', None),
    ],
)
def test_name_and_unit(cell: str, expected: tuple[str, str | None] | None) -> None:
    assert named(cell) == expected


@pytest.mark.parametrize(
    "cell",
    [
        "x" + " " * LONG + "[",
        "(" * LONG,
        ")" * LONG,
        "()" * LONG,
        '"' + " " * LONG + '"x',
        " (" * LONG + ")",
        "[" * LONG,
        "x" * LONG + "(",
    ],
)
def test_no_header_takes_long(cell: str) -> None:
    """A regular expression took 40 minutes for 10,000 blanks."""
    began = time.process_time()
    named(cell)
    assert time.process_time() - began < QUICK
