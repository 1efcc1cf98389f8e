"""Reading a surface from a file, whatever its format."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Final

from tribodyn.core.errors import InputError
from tribodyn.surfaces.instrument import read_instrument
from tribodyn.surfaces.scan import Length, Scan
from tribodyn.surfaces.text import Scale, read_text

OWN: Final = "csv"
_NO_SCALE: Final = Scale()


def read_scan(
    path: str | os.PathLike[str],
    length: Length,
    given: Scale = _NO_SCALE,
    *,
    file_format: str | None = None,
    channel: int = 1,
) -> Scan:
    """Return the surface in a file; the file is read and nothing in it is executed.

    Parameters
    ----------
    path
        A regular file.
    length
        Reads a length with its unit.
    given
        Unit and spacing, for files that do not say them.
    file_format
        ``csv`` for our own reader (:mod:`tribodyn.surfaces.text`) or a name of SurfaceTopography's; by
        default ``csv`` when the file's name ends so, else found from the content.
    channel
        Which of the file's channels of heights, counted from 1.

    Raises
    ------
    InputError
        There is no such file, or it does not hold a surface.
    """
    name = os.fspath(path)
    # os.path, because pathlib's own tests fail on names that are too long; pipes and devices never end.
    if not os.path.isfile(name):
        kind = "this is a directory or a device" if os.path.exists(name) else "there is no such file"
        raise InputError(f"{kind}; a file with a measured profile or map is needed", source=name[:200])
    file = Path(name)
    try:
        if file.stat().st_size == 0:
            raise InputError("the file is empty", source=name)
        own = file_format == OWN or (file_format is None and file.suffix.lower() == ".csv")
        if own:
            return read_text(file, length, given)
        return read_instrument(file, length, given, file_format, channel)
    except OSError as error:
        raise InputError(f"the file cannot be read: {error.strerror or error}", source=name) from None
