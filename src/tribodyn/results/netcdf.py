"""A dataset as the content of a NetCDF-4 file."""

from __future__ import annotations

import threading
from typing import Final

import xarray as xr

_ONE_AT_A_TIME: Final = threading.Lock()


def netcdf_content(dataset: xr.Dataset) -> bytes:
    """Return the content of a NetCDF-4 file.

    Made in memory, because the HDF5 library crashes the process when a disk is full. Each array of numbers
    has a checksum, so that damage is seen when it is read.

    Parameters
    ----------
    dataset
        Numbers and texts over named dimensions; the attributes are numbers and texts.
    """
    import dask

    encoding = {name: {"fletcher32": True} for name, values in dataset.variables.items() if _summable(values)}
    # On a worker xarray would ask the scheduler to lock the file, and a file in memory has no name to lock.
    with _ONE_AT_A_TIME, dask.config.set(scheduler="synchronous"):
        return bytes(dataset.to_netcdf(engine="h5netcdf", encoding=encoding))


def _summable(values: xr.Variable) -> bool:
    """Tell whether HDF5 can hold a checksum of an array: of numbers, and not of none."""
    return values.ndim > 0 and values.size > 0 and values.dtype.kind in "fiu"
