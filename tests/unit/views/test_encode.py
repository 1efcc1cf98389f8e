from __future__ import annotations

import base64
import json

import numpy as np
import pytest

from tribodyn.views.encode import packed, quantised, safe_json


@pytest.mark.parametrize(("kind", "code"), [("float32", "f32"), ("float64", "f64"), ("uint8", "u8")])
def test_arrays_travel_as_their_bytes(kind, code):
    values = np.arange(6).reshape(2, 3)
    ((name, text),) = json.loads(safe_json({"x": packed(values, kind)}))["x"].items()
    assert name == code
    assert np.frombuffer(base64.b64decode(text), dtype=kind).tolist() == [0, 1, 2, 3, 4, 5]


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


def test_json_cannot_end_its_script_and_reads_back():
    document = {"name": "</script><!-- <script> & \u2028 \u2029 ]]>", "n": [1, 2.5, None]}
    text = safe_json(document)
    assert not set("<>&\u2028\u2029") & set(text)
    assert json.loads(text) == document


def test_json_holds_no_nan():
    with pytest.raises(ValueError, match="not JSON compliant"):
        safe_json({"x": float("nan")})
