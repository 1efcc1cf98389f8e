"""Memory of pictures, given back to the system when they are forgotten."""

from __future__ import annotations

import ctypes
import sys
from contextlib import suppress
from typing import Final

_MMAP_THRESHOLD: Final = -3
"""What ``mallopt`` calls the size from which a block comes from the system and goes back there."""
_LARGE: Final = 131_072
"""The size that glibc begins with [bytes]."""


def give_back_large_blocks() -> None:
    """Have every large block of this process taken from the system, and given back when it is free.

    glibc raises this size to that of the largest block that was ever freed. From then on pictures share its
    heap, where those of other sizes do not fit into the gaps that forgotten ones leave: of 100 MB that are
    kept it made 190 MB. Elsewhere than with glibc nothing is done.
    """
    if sys.platform == "linux":
        with suppress(AttributeError, OSError):
            ctypes.CDLL(None).mallopt(_MMAP_THRESHOLD, _LARGE)
