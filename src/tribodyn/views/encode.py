"""Data on their way into the page: compact arrays, and JSON that cannot end the script it stands in."""

from __future__ import annotations

import base64
import json
from collections.abc import Mapping
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

_CODES: Final = {"float32": "f32", "float64": "f64", "uint8": "u8"}
# The script element ends at its end tag whatever the JSON around it says; none of these characters needs to
# stand in JSON as it is.
_ESCAPES: Final = {
    "<": "\\u003c",
    ">": "\\u003e",
    "&": "\\u0026",
    "\u2028": "\\u2028",
    "\u2029": "\\u2029",
}


def packed(values: ArrayLike, kind: str = "float32") -> dict[str, str]:
    """Return an array as the page stores it: base64 of its little-endian bytes, flattened.

    Parameters
    ----------
    values
        Numbers of any shape.
    kind
        ``float32`` (7 digits: enough to draw), ``float64`` (times) or ``uint8`` (pictures).
    """
    array = np.ascontiguousarray(values, dtype=np.dtype(kind).newbyteorder("<"))
    return {_CODES[kind]: base64.b64encode(array.tobytes()).decode("ascii")}


def quantised(fields: NDArray[np.floating[Any]]) -> tuple[NDArray[np.uint8], NDArray[np.float32]]:
    """Return pictures in 255 steps of their own largest value, and these largest values.

    Parameters
    ----------
    fields
        Values that are not negative, shape (n, ...); NaN counts as zero.

    Returns
    -------
    steps, largest
        Shapes of ``fields`` and (n,): ``steps / 255 * largest`` is the field again, to half a step.
    """
    clean = np.nan_to_num(fields)
    largest = clean.reshape(clean.shape[0], -1).max(axis=1, initial=0.0)
    scale = np.where(largest > 0.0, largest, 1.0).reshape(-1, *(1,) * (clean.ndim - 1))
    return np.rint(255.0 * np.clip(clean / scale, 0.0, 1.0)).astype(np.uint8), largest.astype(np.float32)


def safe_json(document: Mapping[str, Any]) -> str:
    """Return JSON that may stand inside a script element, whatever its texts hold."""
    text = json.dumps(document, ensure_ascii=False, allow_nan=False, separators=(",", ":"))
    for character, escape in _ESCAPES.items():
        text = text.replace(character, escape)
    return text
