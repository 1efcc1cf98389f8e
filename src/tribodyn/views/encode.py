"""Data on their way into a page: arrays as they stand in memory, after what is to be known of them."""

import base64
import gzip
import json
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

_CODES: Final = {"float32": "f32", "float64": "f64", "uint8": "u8", "uint16": "q16", "uint32": "q32"}
_UNIT: Final = 8


@dataclass(frozen=True)
class Packed:
    """An array on its way into a page."""

    array: NDArray[Any]  #: Little-endian, flat and contiguous.
    #: Of numbers in equal steps, the lowest and the step; empty for numbers as they are.
    scale: tuple[float, ...] = ()

    @property
    def code(self) -> str:
        """Name of its kind, as scripts know it."""
        return _CODES[self.array.dtype.name]


def packed(values: ArrayLike, kind: str = "float32") -> Packed:
    """Return an array as pages hold it: flattened, of a kind that scripts know.

    ``values``: numbers of any shape; ``kind``: ``float32`` (7 digits: enough to draw), ``float64`` (times) or
    ``uint8`` (pictures).
    """
    return Packed(np.ascontiguousarray(values, dtype=np.dtype(kind).newbyteorder("<")).reshape(-1))


def stepped(values: ArrayLike, finest: float) -> Packed:
    """Return a curve in equal steps of its own range, in 16 bits where that is fine enough, else in 32.

    ``values``: numbers of any shape. What is not finite becomes NaN, which is the highest code. ``finest``:
    longest step allowed, in the unit of the values.
    """
    given = np.asarray(values, dtype=np.float64).reshape(-1)
    finite = given[np.isfinite(given)]
    low, high = (float(finite.min()), float(finite.max())) if finite.size else (0.0, 0.0)
    kind = np.uint16 if high - low <= finest * (np.iinfo(np.uint16).max - 1) else np.uint32
    gap = np.iinfo(kind).max
    step = (high - low) / (gap - 1) or 1.0
    codes = np.where(np.isfinite(given), np.rint((np.nan_to_num(given) - low) / step), gap)
    return Packed(codes.astype(np.dtype(kind).newbyteorder("<")), (low, step))


def quantised(fields: NDArray[np.floating[Any]]) -> tuple[NDArray[np.uint8], NDArray[np.float32]]:
    """Return pictures in 255 steps of their own largest value, and these largest values.

    ``fields``: values that are not negative, shape (n, ...); NaN counts as zero. Returns shapes of ``fields``
    and (n,): ``steps / 255 * largest`` is the field again, to half a step.
    """
    clean = np.nan_to_num(fields)
    largest = clean.reshape(clean.shape[0], -1).max(axis=1, initial=0.0)
    scale = np.where(largest > 0.0, largest, 1.0).reshape(-1, *(1,) * (clean.ndim - 1))
    return np.rint(255.0 * np.clip(clean / scale, 0.0, 1.0)).astype(np.uint8), largest.astype(np.float32)


def block(header: Mapping[str, Any]) -> tuple[int, bytes]:
    """Return a header in JSON and, after it, the arrays as they stand in memory, little-endian.

    Arrays begin at multiples of eight bytes, so that a browser views them where they are; equal ones, such as
    the times of all curves, stand there once.

    ``header``: what a page reads. Arrays in it, at any depth, become their kind with offset and length.
    Returns length of the header in bytes, and all bytes. Raises TypeError if something in the header is no
    text, number, list, mapping or array.
    """
    offsets: dict[bytes, int] = {}
    size = 0

    def placed(value: object) -> dict[str, list[float]]:
        nonlocal size
        if not isinstance(value, Packed):
            raise TypeError(f"{type(value).__name__} has no place in a page")
        content = value.array.tobytes()
        content += bytes(-len(content) % _UNIT)
        offset = offsets.setdefault(content, size)
        size += len(content) if offset == size else 0
        return {value.code: [offset, value.array.size, *value.scale]}

    text = json.dumps(header, default=placed, ensure_ascii=False, allow_nan=False, separators=(",", ":"))
    head = text.encode("utf-8", "replace")
    head += b" " * (-len(head) % _UNIT)
    return len(head), b"".join([head, *offsets])


def inside_page(document: Mapping[str, Any]) -> str:
    """Return a document as a page holds it: the length of the header and its block, compressed, as base64.

    No letter of base64 can end the script element that it stands in. The length is a number of eight bytes.
    """
    length, content = block(document)
    packed_block = gzip.compress(length.to_bytes(8, "little") + content, mtime=0)
    return base64.b64encode(packed_block).decode("ascii")
