"""Claims on functions that a process compiles, where several fill one folder of machine code."""

from __future__ import annotations

import hashlib
import os
from contextlib import suppress
from pathlib import Path
from typing import Final

_NAME: Final = ".claims"


class Claims:
    """Functions that this process compiles; other processes that want them wait.

    No wait is for ever: a process that waits for a function holds only functions that call it. What is
    claimed is free when a process ends, however it ends. Without locks every process compiles for itself.
    """

    def __init__(self, folder: Path) -> None:
        self._file = os.open(folder / _NAME, os.O_RDWR | os.O_CREAT, 0o600)

    def take(self, name: str) -> None:
        """Claim a function; wait where another process has it."""
        with suppress(ImportError, OSError):
            import fcntl

            fcntl.lockf(self._file, fcntl.LOCK_EX, 1, _place_of(name))

    def give_back(self, name: str) -> None:
        """Let others have a function."""
        with suppress(ImportError, OSError):
            import fcntl

            fcntl.lockf(self._file, fcntl.LOCK_UN, 1, _place_of(name))


shared: Final[dict[str, Claims]] = {}
"""By the folders of machine code that this process fills together with others."""


def share(folder: Path) -> None:
    """Fill a folder together with other processes from now on."""
    if str(folder) not in shared:
        with suppress(OSError):
            shared[str(folder)] = Claims(folder)


def _place_of(name: str) -> int:
    """Return the byte of the file of claims that stands for a function."""
    return int.from_bytes(hashlib.sha256(name.encode()).digest()[:7], "little")
