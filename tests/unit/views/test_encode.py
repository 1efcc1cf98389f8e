"""Numbers on their way to a page: encoded, with units, unrolled, and the instants that are shown."""

import base64
import gzip
import json
import math
import re
from typing import Any

import numpy as np
import pytest
import xarray as xr

from tribodyn.figures.chart import close_up
from tribodyn.mechanisms.catalogue import MECHANISMS
from tribodyn.results import build
from tribodyn.results.summary import KeyResult
from tribodyn.views.bushing import rolled, wall_angles
from tribodyn.views.bushing_sections import CONTACT_FORCE
from tribodyn.views.encode import inside_page, packed, quantised, stepped
from tribodyn.views.numbers import as_read, columns_of, fitting
from tribodyn.views.playback import reversal_times


def opened(text: str) -> tuple[dict[str, Any], bytes]:
    """Return header and arrays of what a page holds."""
    content = gzip.decompress(base64.b64decode(text, validate=True))
    end = 8 + int.from_bytes(content[:8], "little")
    return json.loads(content[8:end]), content[end:]


@pytest.mark.parametrize(("kind", "code"), [("float32", "f32"), ("float64", "f64"), ("uint8", "u8")])
def test_arrays_travel_as_their_bytes(kind, code):
    values = np.arange(6).reshape(2, 3)
    header, arrays = opened(inside_page({"y": packed([7.0]), "x": packed(values, kind)}))
    ((name, (offset, length)),) = header["x"].items()
    assert (name, offset % 8) == (code, 0)
    assert np.frombuffer(arrays, kind, length, offset).tolist() == [0, 1, 2, 3, 4, 5]


@pytest.mark.parametrize(("finest", "code"), [(1e-3, "q16"), (1e-6, "q32")])
def test_curves_keep_their_values_to_half_a_step(finest: float, code: str) -> None:
    values = np.array([-3.0, np.nan, 0.123456789, 7.0])
    header, arrays = opened(inside_page({"y": stepped(values, finest)}))
    ((name, (offset, length, low, step)),) = header["y"].items()
    codes = np.frombuffer(
        arrays, code.replace("q", "u").replace("16", "2").replace("32", "4"), length, offset
    )
    assert name == code
    assert codes[1] == np.iinfo(codes.dtype).max
    back = low + step * codes[[0, 2, 3]]
    assert step <= finest
    assert back == pytest.approx(values[[0, 2, 3]], rel=0.0, abs=0.500001 * step)


def test_pictures_keep_their_values_to_half_a_step_of_their_own_peak():
    rng = np.random.default_rng(1)
    fields = rng.uniform(size=(5, 7, 4)) * np.array([1.0, 1e-3, 50.0, 0.0, 2.0])[:, None, None]
    fields[0, 0, 0] = np.nan
    steps, largest = quantised(fields)
    back = steps / 255.0 * largest[:, None, None]
    error = np.abs(back - np.nan_to_num(fields)).max(axis=(1, 2))
    # Half a step, and rounding of the peak to single precision.
    assert np.all(error <= 0.5001 / 255.0 * largest)
    assert steps[3].max() == 0


def test_no_text_of_a_document_can_end_its_script_and_it_reads_back():
    document = {"name": "</script><!-- <script> & \u2028 \u2029 ]]>", "n": [1, 2.5, None]}
    text = inside_page(document)
    assert re.fullmatch("[A-Za-z0-9+/=]+", text)
    assert opened(text)[0] == document


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


def test_wall_angles_point_where_the_shaft_touches() -> None:
    """Check that the contact force at a node, along its theta, pushes away from its wall angle."""
    theta = np.linspace(0.0, 2.0 * np.pi, 12, endpoint=False)
    angles = wall_angles(xr.Dataset(coords={"theta": theta}))
    np.testing.assert_allclose(np.cos(angles), -np.cos(theta), atol=1e-15)
    np.testing.assert_allclose(np.sin(angles), -np.sin(theta), atol=1e-15)
    assert np.all((angles >= 0.0) & (angles < 2.0 * np.pi))


@pytest.mark.parametrize("cut", [90.0, 270.0])
def test_an_angle_at_the_cut_comes_first_whatever_its_rounding(cut: float) -> None:
    theta = np.deg2rad([0.0, 90.0, 180.0, 270.0]) * (1.0 - 1e-15)
    angle, values = rolled(theta, np.arange(4.0), cut)
    assert angle[1] - angle[0] == pytest.approx(90.0)
    assert values[0] == values[-1] == cut / 90.0


VSV = MECHANISMS["vsv"]


def _speeds(time, speed):
    return build(coordinates={"time": time}, columns={"omega_v_ideal": speed}, variables=VSV.variables)


def test_reversals_of_a_sine():
    time = np.arange(0.0, 12.5, 5e-3)
    assert reversal_times(_speeds(time, np.sin(time))) == pytest.approx(np.pi * np.array([1, 2, 3]), abs=1e-5)


def test_the_close_up_starts_at_the_hardest_reversal(make_result):
    result = make_result()
    after = (result["time"] > np.pi) & (result["time"] < np.pi + 0.02)
    result["F_cx"].values[after.values] += 500.0
    start, end = close_up(result, CONTACT_FORCE)
    assert start == pytest.approx(np.pi, abs=5e-3)
    assert 0.03 <= end - start <= 0.3


def test_without_reversal_the_close_up_shows_the_largest_force(make_result):
    result = make_result(1.0)
    result["F_cx"].values[100] = 1e3
    assert close_up(result, CONTACT_FORCE)[0] == pytest.approx(0.5)


def test_a_header_holds_no_nan():
    with pytest.raises(ValueError, match="not JSON compliant"):
        inside_page({"x": float("nan")})
