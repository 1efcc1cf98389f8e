"""Data on their way into the page: compact arrays, and JSON that cannot end the script it stands in."""

from __future__ import annotations

import base64
import json
from collections.abc import Mapping
from dataclasses import dataclass
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


@dataclass(frozen=True)
class Packed:
    """An array on its way into a page.

    Attributes
    ----------
    array
        Little-endian, flat and contiguous.
    """

    array: NDArray[Any]

    @property
    def code(self) -> str:
        """Name of its kind, as scripts know it."""
        return _CODES[self.array.dtype.name]


def packed(values: ArrayLike, kind: str = "float32") -> Packed:
    """Return an array as pages hold it: flattened, of a kind that scripts know.

    Parameters
    ----------
    values
        Numbers of any shape.
    kind
        ``float32`` (7 digits: enough to draw), ``float64`` (times) or ``uint8`` (pictures).
    """
    return Packed(np.ascontiguousarray(values, dtype=np.dtype(kind).newbyteorder("<")).reshape(-1))


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
    """Return JSON that may stand inside a script element, whatever its texts hold; arrays stand as base64."""
    text = json.dumps(document, default=_as_text, ensure_ascii=False, allow_nan=False, separators=(",", ":"))
    for character, escape in _ESCAPES.items():
        text = text.replace(character, escape)
    return text


def _as_text(value: object) -> dict[str, str]:
    """Return an array as the base64 of its bytes."""
    if not isinstance(value, Packed):
        raise TypeError(f"{type(value).__name__} has no place in a page")
    return {value.code: base64.b64encode(value.array.tobytes()).decode("ascii")}
