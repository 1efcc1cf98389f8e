"""Reading files that somebody named: regular files only, none larger than what reads it expects.

A pipe keeps its reader waiting, a device never ends, and either may stand behind a link. So a file is opened
without waiting, and what was opened is looked at before anything is read from it.
"""

import errno
import os
import stat
from typing import BinaryIO, Final

_FLAGS: Final = os.O_RDONLY | sum(
    getattr(os, name, 0) for name in ("O_NONBLOCK", "O_NOCTTY", "O_CLOEXEC", "O_BINARY")
)
_UNITS: Final = ((10**9, "GB"), (10**6, "MB"), (10**3, "kB"), (1, "bytes"))


def open_regular(path: str | os.PathLike[str], most: int) -> BinaryIO:
    """Open a regular file for reading.

    Parameters
    ----------
    path
        Its name; links are followed.
    most
        Size that it may have [bytes].

    Returns
    -------
    BinaryIO
        The open file; the caller closes it.

    Raises
    ------
    OSError
        There is no such file, it is no regular one, it is too large, or it cannot be opened; ``strerror``
        says which.
    """
    try:
        # Asked first because to open a device may act upon it; asked again because names can change hands.
        _refuse(os.stat(path), most)
        stream = os.fdopen(os.open(path, _FLAGS), "rb")
    except ValueError as error:
        raise FileNotFoundError(errno.ENOENT, str(error)) from None
    except OSError as error:
        if error.errno != errno.ENAMETOOLONG:
            raise
        raise FileNotFoundError(errno.ENOENT, error.strerror) from None
    try:
        _refuse(os.fstat(stream.fileno()), most)
    except OSError:
        stream.close()
        raise
    return stream


def read_regular(path: str | os.PathLike[str], most: int) -> bytes:
    """Return the content of a regular file; parameters and errors are those of :func:`open_regular`."""
    with open_regular(path, most) as stream:
        size = os.fstat(stream.fileno()).st_size
        content = stream.read(size + 1)
    if len(content) > size:
        raise OSError(errno.EBUSY, "the file grows while it is read")
    return content


def _refuse(found: os.stat_result, most: int) -> None:
    if stat.S_ISDIR(found.st_mode):
        raise IsADirectoryError(errno.EISDIR, "this is a directory")
    if not stat.S_ISREG(found.st_mode):
        raise OSError(errno.EINVAL, "this is a pipe, a device or a socket, not a regular file")
    if found.st_size > most:
        raise _too_large(most)


def _too_large(most: int) -> OSError:
    size, unit = next((size, unit) for size, unit in _UNITS if most >= size)
    return OSError(errno.EFBIG, f"the file is larger than {most / size:g} {unit}")
