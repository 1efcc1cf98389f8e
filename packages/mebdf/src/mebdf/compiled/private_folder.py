"""Folders for what only this user may have written, such as code that is loaded without a look at it."""

from __future__ import annotations

import os
import shutil
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Final

_WRITABLE_BY_OTHERS: Final = 0o022
_KEPT: Final = 4
_MOST: Final = 16
_DAY: Final = 86400.0
_LOCK: Final = ".lock"


class NotPrivate(Exception):
    """Somebody else could have written what is in a folder."""


def private_folder(path: Path) -> Path:
    """Return a folder of this user's, made with its parents where it is missing.

    Raises
    ------
    NotPrivate
        If the folder, or the link that stands in its place, belongs to somebody else, or if others may write.
    OSError
        If it is not there and cannot be made, or cannot be written to.
    """
    path.parent.mkdir(parents=True, exist_ok=True)
    path.mkdir(mode=0o700, exist_ok=True)
    if hasattr(os, "geteuid"):
        status = path.stat()
        if {status.st_uid, path.lstat().st_uid} != {os.geteuid()}:
            raise NotPrivate(f"{path} belongs to another user")
        if status.st_mode & _WRITABLE_BY_OTHERS:
            raise NotPrivate(f"others may write to {path}; chmod go-w mends it")
    if not os.access(path, os.W_OK | os.X_OK):
        raise PermissionError(f"{path} cannot be written to")
    return path


@contextmanager
def locked(folder: Path) -> Iterator[None]:
    """Keep others who ask out of a folder; where there are no locks, everyone is let in."""
    handle = os.open(folder / _LOCK, os.O_RDWR | os.O_CREAT, 0o600)
    try:
        with suppress(ImportError, OSError):
            import fcntl

            fcntl.flock(handle, fcntl.LOCK_EX)
        yield
    finally:
        os.close(handle)


def mark_used(folder: Path) -> None:
    """Note that a folder is in use now, for :func:`prune`."""
    with suppress(OSError):
        os.utime(folder)


def prune(parent: Path, pattern: str) -> None:
    """Remove the folders that were used longest ago.

    The four used last stay, and up to sixteen of those that were used within a day. Several processes may do
    so at once.

    Parameters
    ----------
    parent
        Where the folders are.
    pattern
        What their names match, as :meth:`pathlib.Path.glob` has it.
    """
    used = {path: _last_use(path) for path in parent.glob(pattern) if path.is_dir() and not path.is_symlink()}
    latest_first = sorted(used, key=lambda path: used[path], reverse=True)
    for place, path in enumerate(latest_first):
        if place >= _MOST or (place >= _KEPT and time.time() - used[path] > _DAY):
            shutil.rmtree(path, ignore_errors=True)


def _last_use(folder: Path) -> float:
    """Return the time at which a folder was marked last [s], 0 if it is gone meanwhile."""
    with suppress(OSError):
        return folder.stat().st_mtime
    return 0.0
