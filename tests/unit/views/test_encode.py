import base64
import gzip
import json
import re
from typing import Any

import numpy as np
import pytest

from tribodyn.views.encode import inside_page, packed, quantised, stepped


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
