"""A dataset as the content of a NetCDF-4 file, and back."""

from __future__ import annotations

import threading
import zlib
from typing import Final

import xarray as xr

_ONE_AT_A_TIME: Final = threading.Lock()
_MARK: Final = b"\ntribodyn crc32 "
"""Stands behind the NetCDF file, before the checksum of all of it; what reads NetCDF does not look there."""
_DIGITS: Final = 8


def netcdf_content(dataset: xr.Dataset) -> bytes:
    """Return the content of a NetCDF-4 file.

    Made in memory, because the HDF5 library crashes the process when a disk is full. Each array of numbers
    has a checksum, so that anything that reads it sees damage. What describes the arrays has none in this
    format: a checksum of the whole file follows it, for :func:`dataset_of`.

    Parameters
    ----------
    dataset
        Numbers and texts over named dimensions; the attributes are numbers and texts.
    """
    encoding = {name: {"fletcher32": True} for name, values in dataset.variables.items() if _summable(values)}
    # The NetCDF library is for one thread at a time, and xarray does not see to that for a file in memory.
    with _ONE_AT_A_TIME:
        content = bytes(dataset.to_netcdf(engine="netcdf4", encoding=encoding))
    return content + _MARK + _checksum(content)


def dataset_of(content: bytes) -> xr.Dataset:
    """Return the dataset that a NetCDF-4 file holds; times stay numbers of seconds.

    Parameters
    ----------
    content
        Of a file; one that :func:`netcdf_content` did not make need not end in a checksum.

    Raises
    ------
    Exception
        The file is damaged, or is none. The libraries that read it raise what they like.
    """
    netcdf, mark, checksum = content.rpartition(_MARK)
    if mark and len(checksum) == _DIGITS and checksum != _checksum(netcdf):
        raise ValueError("its checksum is wrong")
    with _ONE_AT_A_TIME:
        return xr.load_dataset(content, engine="netcdf4", decode_times=False, decode_timedelta=False)


def _checksum(content: bytes) -> bytes:
    return f"{zlib.crc32(content):0{_DIGITS}x}".encode()


def _summable(values: xr.Variable) -> bool:
    """Tell whether HDF5 can hold a checksum of an array: of numbers, and not of none."""
    return values.ndim > 0 and values.size > 0 and values.dtype.kind in "fiu"
