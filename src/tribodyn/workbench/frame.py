"""A result on its way to the page: a header in JSON, then the arrays as they stand in memory.

Sixteen bytes begin a frame: a magic number, the number of the request that it answers, the length of the
header and flags, each an unsigned integer of 32 bits, little-endian as all of it. All but these sixteen bytes
can be kept and sent again.
"""

import json
import struct
from collections.abc import Mapping
from typing import Any, Final

from tribodyn.views.encode import block

MAGIC: Final = 0x31464254
KEPT: Final = 1
"""Flag of a frame that was computed for an earlier request."""
_START: Final = struct.Struct("<IIII")


def body(header: Mapping[str, Any]) -> bytes:
    """Return all of a frame but its first sixteen bytes, after the length of its header.

    Parameters
    ----------
    header
        What the page reads. Arrays in it, at any depth, become their kind with offset and length.
    """
    length, content = block(header)
    return struct.pack("<I", length) + content


def addressed(content: bytes, number: int, flags: int) -> bytes:
    """Return the frame that answers a request with a body."""
    (length,) = struct.unpack_from("<I", content)
    return _START.pack(MAGIC, number, length, flags) + memoryview(content)[4:]


def header(content: bytes) -> dict[str, Any]:
    """Return the header of a body."""
    (length,) = struct.unpack_from("<I", content)
    return dict(json.loads(content[4 : 4 + length]))
