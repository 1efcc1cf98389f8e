"""Reading a surface from a file, whatever its format."""

import os
from pathlib import Path
from typing import Final

from tribodyn.core.errors import InputError
from tribodyn.core.files import open_regular
from tribodyn.surfaces.instrument import read_instrument
from tribodyn.surfaces.scan import Length, Scan
from tribodyn.surfaces.text import Scale, read_text

OWN: Final = "csv"
LARGEST_FILE: Final = 1_000_000_000
_NEEDED: Final = "a file with a measured profile or map is needed"
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

    Returns
    -------
    Scan
        Heights [m], shape (n,) of a profile or (n_y, n_x) of a map.

    Raises
    ------
    InputError
        There is no such file, or it does not hold a surface.
    """
    name = os.fspath(path)
    file = Path(name)
    own = file_format == OWN or (file_format is None and file.suffix.lower() == ".csv")
    try:
        with open_regular(name, LARGEST_FILE) as stream:
            if own:
                return read_text(stream, name, length, given)
            return read_instrument(stream, name, length, given, file_format, channel)
    except FileNotFoundError:
        raise InputError(f"there is no such file; {_NEEDED}", source=name) from None
    except OSError as error:
        reason = error.strerror or str(error)
        raise InputError(f"the file cannot be read: {reason}; {_NEEDED}", source=name) from None
