"""Reading of a surface from a file of any format; of some by SurfaceTopography (extra ``surfaces``)."""

import importlib
import os
import warnings
from pathlib import Path
from typing import Any, BinaryIO, Final

import numpy as np

from tribodyn.core.errors import InputError
from tribodyn.core.files import open_regular
from tribodyn.core.quoting import LONGEST, as_given, brief
from tribodyn.surfaces.scan import MOST_POINTS, Length, Scan, from_columns
from tribodyn.surfaces.text import Scale, parse_spacing, read_text, unit_size

#: Formats whose files carry no mark: taken only from a file whose name ends so.
_WITHOUT_MARK: Final = ("hgt", "nms")


def read_instrument(
    stream: BinaryIO, source: str, length: Length, given: Scale, file_format: str | None, channel: int
) -> Scan:
    """Return the heights in a file that SurfaceTopography reads.

    ``stream``: an open file; ``length``: reads a length with its unit; ``given``: unit and spacing for files
    that carry none; ``file_format``: name of the format in SurfaceTopography; by default it is found from the
    file; ``channel``: which of the file's channels of heights, counted from 1. Raises InputError if the extra
    is missing, the file cannot be read, or lacks or repeats what ``given`` says.
    """
    try:
        # What the package has to say about itself is not for a user of ours.
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return _scan(_package(), stream, source, length, given, file_format, channel)
    except (InputError, MemoryError):
        raise
    except Exception as error:
        # Forty readers of other people's formats: whatever they raise means that the file is not good.
        raise InputError(f"the file cannot be read: {_in_short(error)}", source=source) from None


def _package() -> Any:
    try:
        return importlib.import_module("SurfaceTopography.IO")
    except ImportError:
        raise InputError(
            "this format needs the extra `surfaces` (pip install 'tribodyn[surfaces]'); "
            "plain CSV is read without it"
        ) from None


def _scan(
    package: Any,
    stream: BinaryIO,
    source: str,
    length: Length,
    given: Scale,
    file_format: str | None,
    channel: int,
) -> Scan:
    if file_format is not None and file_format not in package.lookup_reader_by_format:
        known = ", ".join(["csv", *sorted(package.lookup_reader_by_format)])
        raise InputError(f"{as_given(file_format)}; allowed: {known}", key="format", source=source)
    try:
        reader = package.open_topography(stream, format=file_format)
    except package.CannotDetectFileFormat:
        raise InputError(
            "this is in no format of a surface that is known here, or cut short", source=source
        ) from None
    with reader:
        if (
            file_format is None
            and reader.format() in _WITHOUT_MARK
            and Path(source).suffix[1:] != reader.format()
        ):
            raise InputError(
                "this is in no format of a surface that is known here, or cut short", source=source
            )
        if reader.format() == "npy":
            # Of a file cut short the package returns whatever the memory held; mapping it fails.
            np.load(source, mmap_mode="r", allow_pickle=False)
        heights = _channel(reader, channel, source)
        if np.prod(heights.nb_grid_pts or 1, dtype=float) > MOST_POINTS:
            raise InputError(f"the scan has more than {MOST_POINTS} points; cut out a part", source=source)
        return _read(heights, length, given, source)


def _channel(reader: Any, channel: int, source: str) -> Any:
    channels = reader.height_channels
    if not 1 <= channel <= len(channels):
        names = brief(", ".join(f"{k} {entry.name}" for k, entry in enumerate(channels, start=1)) or "none")
        raise InputError(f"given {channel}; channels of heights: {names}", key="channel", source=source)
    return channels[channel - 1]


def _spacing_given(channel: Any, given: Scale, length: Length, source: str) -> tuple[float, ...] | None:
    """Return the spacing (dx, dy) [m] that was given, None where the file has positions itself."""
    if channel.physical_sizes is not None or channel.is_uniform is False:
        if given.spacing is not None:
            raise InputError("the file says it itself; leave it out", key="spacing", source=source)
        return None
    if given.spacing is None:
        raise InputError("the file does not say it; give it", key="spacing", source=source)
    return parse_spacing(given.spacing, channel.dim, length)[::-1]


def _unit(channel: Any, given: Scale, length: Length, source: str) -> float:
    """Return the size of the numbers in the file [m]."""
    if channel.unit is None:
        if given.unit is None:
            raise InputError("the file does not say it; give it", key="unit", source=source)
        return unit_size(given.unit, length)
    if given.unit is not None:
        raise InputError("the file says it itself; leave it out", key="unit", source=source)
    return unit_size(str(channel.unit).replace("Å", "angstrom"), length)


def _read(channel: Any, length: Length, given: Scale, source: str) -> Scan:
    """Return our surface; SurfaceTopography counts x first, we count lines first."""
    spacing = _spacing_given(channel, given, length, source)
    size = _unit(channel, given, length, source)
    sizes = None if spacing is None else tuple(np.multiply(channel.nb_grid_pts, spacing))
    topography = channel.topography(physical_sizes=sizes)
    heights = size * np.ma.filled(np.ma.asarray(topography.heights(), dtype=np.float64), np.nan)
    if topography.dim == 1 and not topography.is_uniform:
        return from_columns(size * np.asarray(topography.positions(), dtype=np.float64), heights, source)
    if spacing is None:
        spacing = tuple(size * float(step) for step in np.ravel(topography.pixel_size))
    if heights.ndim == 2 and 1 in heights.shape:
        return Scan(heights.ravel(), (spacing[int(heights.shape[0] == 1)],), source)
    return Scan(np.ascontiguousarray(heights.T), spacing[::-1], source)


def _in_short(error: Exception) -> str:
    lines = [line.strip() for line in str(error).splitlines() if line.strip()]
    reason = lines[0] if lines else type(error).__name__
    return brief(reason, 2 * LONGEST)


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
