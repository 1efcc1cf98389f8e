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
ARCHIVES: Final = (b"PK\x03\x04", b"\xd0\xcf\x11\xe0")
"""Beginnings of workbooks and documents of offices."""
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


def text_of(content: bytes, start: int = 0) -> str:
    """Return the text of a file, UTF-8 with or without its mark.

    Parameters
    ----------
    content
        Of the file, from byte ``start`` on.
    start
        Place of its beginning.

    Raises
    ------
    ValueError
        It is no such text; the message says what it is, or where it ends to be one, and what to do.
    """
    if content.startswith(ARCHIVES):
        raise ValueError("this is a workbook or a document of an office program: save the sheet as CSV")
    try:
        return content.decode("utf-8-sig" if start == 0 else "utf-8")
    except UnicodeDecodeError as error:
        line = content.count(b"\n", 0, error.start) + 1
        where = f"byte {start + error.start}" + ("" if start else f", line {line}")
        raise ValueError(f"the file is not UTF-8 text ({where}); save it with the encoding UTF-8") from None


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
