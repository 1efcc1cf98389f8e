"""A result on its way to the page: a header in JSON, then the arrays as they stand in memory.

Sixteen bytes begin a frame: a magic number, the number of the request that it answers, the length of the
header and flags, each an unsigned integer of 32 bits, little-endian as all of it. Arrays begin at multiples
of eight bytes, so that a browser views them where they are; equal ones, such as the times of all curves,
stand there once. All but these sixteen bytes can be kept and sent again.
"""

from __future__ import annotations

import json
import struct
from collections.abc import Mapping
from typing import Any, Final

from tribodyn.views.encode import Packed

MAGIC: Final = 0x31464254
KEPT: Final = 1
"""Flag of a frame that was computed for an earlier request."""
_UNIT: Final = 8
_START: Final = struct.Struct("<IIII")


def body(header: Mapping[str, Any]) -> bytes:
    """Return all of a frame but its first sixteen bytes, after the length of its header.

    Parameters
    ----------
    header
        What the page reads. Arrays in it, at any depth, become their kind with offset and length.
    """
    offsets: dict[bytes, int] = {}
    size = 0

    def placed(value: object) -> dict[str, list[int]]:
        nonlocal size
        if not isinstance(value, Packed):
            raise TypeError(f"{type(value).__name__} has no place in a frame")
        content = value.array.tobytes()
        content += bytes(-len(content) % _UNIT)
        offset = offsets.setdefault(content, size)
        size += len(content) if offset == size else 0
        return {value.code: [offset, value.array.size]}

    text = json.dumps(header, default=placed, ensure_ascii=False, allow_nan=False, separators=(",", ":"))
    head = text.encode("utf-8", "replace")
    head += b" " * (-len(head) % _UNIT)
    return struct.pack("<I", len(head)) + b"".join([head, *offsets])


def addressed(content: bytes, number: int, flags: int) -> bytes:
    """Return the frame that answers a request with a body."""
    (length,) = struct.unpack_from("<I", content)
    return _START.pack(MAGIC, number, length, flags) + memoryview(content)[4:]


def header(content: bytes) -> dict[str, Any]:
    """Return the header of a body."""
    (length,) = struct.unpack_from("<I", content)
    return dict(json.loads(content[4 : 4 + length]))
