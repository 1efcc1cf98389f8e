"""A dataset as the content of a NetCDF-4 file, and back."""

from __future__ import annotations

import math
import threading
import zlib
from os import PathLike
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from tribodyn.core.quoting import brief

if TYPE_CHECKING:
    import netCDF4
    import xarray as xr
    from numpy.typing import NDArray

_ONE_AT_A_TIME: Final = threading.Lock()
#: Stands behind the NetCDF file, before the checksum of all of it; what reads NetCDF does not look there.
_MARK: Final = b"\ntribodyn crc32 "
_FIRST_ROOM: Final = 1024  #: Initial size of a file in memory [bytes]; it grows.
#: Cache of an array that is written in one piece [bytes]; by default a copy of all arrays is kept.
_CACHE: Final = 1
_DIGITS: Final = 8
_CHARACTER: Final = 4  #: Bytes that a character of a text takes in an array.
#: Size up to which what a file declares need not be in it [bytes]; a run of two cycles takes 10 MB.
MOST_COMPRESSED: Final = 64_000_000
#: So many texts a variable may have, as many as a sweep may have points; each takes 85 µs to look at.
MOST_TEXTS: Final = 100_000


def netcdf_content(dataset: xr.Dataset) -> bytes:
    """Return the content of a NetCDF-4 file, see :func:`netcdf_parts`."""
    return b"".join(netcdf_parts(dataset))


def netcdf_parts(dataset: xr.Dataset) -> tuple[bytes | memoryview, ...]:
    """Return the content of a NetCDF-4 file, in parts that are not copied to be joined.

    Made in memory, because the HDF5 library crashes the process when a disk is full. Each array of numbers
    has a checksum, so that anything that reads it sees damage. What describes the arrays has none in this
    format: a checksum of the whole file follows it, for :func:`dataset_of`.

    ``dataset``: numbers and texts over named dimensions; the attributes are numbers and texts.
    """
    # Imported here: a run whose result is not written needs none of its 11 MB.
    import netCDF4

    # The NetCDF library is for one thread at a time.
    with _ONE_AT_A_TIME:
        file = netCDF4.Dataset("result", mode="w", memory=_FIRST_ROOM)
        try:
            _fill(file, dataset)
        finally:
            # Not when it is collected: that may be in another thread.
            content = file.close()
    return content, _MARK, _checksum(content)


def _fill(file: netCDF4.Dataset, dataset: xr.Dataset) -> None:
    """Write a dataset by the conventions of xarray's own writer, which imports all of dask and pint."""
    for name, size in dataset.sizes.items():
        file.createDimension(str(name), size)
    beside = sorted(str(name) for name in dataset.coords if name not in dataset.sizes)
    marked, defined = set(), []
    for name, variable in dataset.variables.items():
        attributes = dict(variable.attrs)
        if name not in beside and name not in variable.dims:
            coordinates = [each for each in beside if set(dataset.variables[each].dims) <= set(variable.dims)]
            attributes |= {"coordinates": " ".join(coordinates)} if coordinates else {}
            marked.update(coordinates)
        defined.append(_defined(file, str(name), variable, attributes))
    unmarked = {"coordinates": " ".join(sorted(set(beside) - marked))} if set(beside) - marked else {}
    file.setncatts({**dataset.attrs, **unmarked})
    # Once all are defined: the library writes down anew what it knows of the file when values follow.
    for written, values in defined:
        written[...] = values


def _defined(
    file: netCDF4.Dataset, name: str, variable: xr.Variable, attributes: dict[str, Any]
) -> tuple[netCDF4.Variable[Any], NDArray[Any]]:
    """Define an array of numbers, truth values or texts, with a checksum where HDF5 has one."""
    values = variable.values
    if values.dtype.kind == "b":
        values, attributes = values.astype("i1"), attributes | {"dtype": "bool"}
    kind = values.dtype.kind
    written = file.createVariable(
        name,
        values.dtype if kind in "fiu" else str,
        tuple(map(str, variable.dims)),
        fletcher32=values.ndim > 0 and values.size > 0 and kind in "fiu",
        fill_value=math.nan if kind == "f" else None,
        chunk_cache=_CACHE,
    )
    written.setncatts(attributes)
    written.set_auto_maskandscale(False)
    return written, values if kind in "fiu" else values.astype(object)


def dataset_of(content: bytes) -> xr.Dataset:
    """Return the dataset that a NetCDF-4 file holds; times stay numbers of seconds.

    ``content``: of a file; one that :func:`netcdf_content` did not make need not end in a checksum. Raises
    Exception if the file is damaged, or is none. The libraries that read it raise what they like.
    """
    netcdf, mark, checksum = content.rpartition(_MARK)
    if mark and len(checksum) == _DIGITS and checksum != _checksum(netcdf):
        raise ValueError("its checksum is wrong")
    with _ONE_AT_A_TIME:
        _refuse_bombs(content)
        import xarray as xr

        return xr.load_dataset(content, engine="netcdf4", decode_times=False, decode_timedelta=False)


def attributes_of(path: str | PathLike[str]) -> dict[str, Any]:
    """Return the global attributes of a NetCDF-4 file; as :func:`dataset_of` where it is damaged."""
    import netCDF4

    with _ONE_AT_A_TIME, netCDF4.Dataset(path) as file:
        return dict(file.__dict__)


def _refuse_bombs(content: bytes) -> None:
    """Refuse a file that declares far more than it holds, before anything is made room for.

    What this program writes is not compressed, so that a file is as large as its numbers; other programs may
    have compressed it since, by any factor, and up to a size that does no harm.
    """
    import netCDF4

    room = MOST_COMPRESSED + len(content)
    with netCDF4.Dataset("result", memory=content) as file:
        # Elements of variable length may all be the same one, which is made room for each time.
        if file.groups or any((file.vltypes, file.cmptypes, file.enumtypes)):
            raise ValueError("it has groups or types of its own; a result has numbers and texts only")
        for name, variable in file.variables.items():
            room -= _declared(variable) if variable.dtype is not str else _text_size(variable, room, content)
            if room < 0:
                limit = f"what is larger than {MOST_COMPRESSED // 10**6} MB must not be compressed"
                shape = brief(variable.shape)
                raise ValueError(f"it declares more than it holds, {brief(name)} of shape {shape}; {limit}")


def _declared(variable: netCDF4.Variable[Any]) -> int:
    """Return the room that a variable of numbers takes [bytes], that of its largest block at least."""
    if not isinstance(variable.dtype, np.dtype):
        raise ValueError(f"{brief(variable.name)} holds neither numbers nor texts")
    blocks = variable.chunking()
    block = math.prod(blocks) if isinstance(blocks, list) else 0
    scaled = {"scale_factor", "add_offset"}
    masked = {"_FillValue", "missing_value"} if variable.dtype.kind != "f" else set()
    # Such numbers become doubles, whatever their size.
    size = 8 if (scaled | masked) & {*variable.ncattrs()} else 0
    return max(math.prod(variable.shape), block) * max(variable.dtype.itemsize, size)


def _text_size(variable: netCDF4.Variable[Any], room: int, content: bytes) -> int:
    """Return the room that texts take, each as much as the longest [bytes].

    A file may name the same long text many times, so they are read a few at a time.

    Raises ValueError if there are too many to look at.
    """
    shape = variable.shape
    if math.prod(shape) > MOST_TEXTS:
        raise ValueError(f"{brief(variable.name)} holds more than {MOST_TEXTS} texts")
    size = math.prod(shape) * _CHARACTER
    if not shape or size > room:
        return size
    few = max(room // (4 * len(content)), 1)
    longest = 0
    for place in np.ndindex(*shape[:-1]):
        for start in range(0, shape[-1], few):
            texts = variable[(*place, slice(start, start + few))]
            longest = max(longest, *map(len, texts))
            if longest * size > room:
                return longest * size
    return longest * size


def _checksum(content: bytes | memoryview) -> bytes:
    return f"{zlib.crc32(content):0{_DIGITS}x}".encode()
