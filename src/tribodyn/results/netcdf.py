"""A dataset as the content of a NetCDF-4 file.

NetCDF-4 is HDF5 whose dimensions are HDF5 dimension scales (NetCDF User's Guide, Interoperability with HDF5),
and h5py writes HDF5. h5netcdf, which reads our files and which xarray would have write them, spends ten times
as long on the many short variables of a result; the reference library in C does not run beside h5py.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Final

import h5py
import numpy as np
import xarray as xr

_NO_VARIABLE: Final = "This is a netCDF dimension but not a netCDF variable.{:10d}"
"""Name of a dimension scale without values, fixed by NetCDF."""


def netcdf_content(dataset: xr.Dataset) -> bytes:
    """Return the content of a NetCDF-4 file.

    Made in memory, because the HDF5 library crashes the process when a disk is full. Each array of numbers
    has a checksum, so that damage is seen when it is read.

    Parameters
    ----------
    dataset
        Numbers and texts over named dimensions; the attributes are numbers and texts.
    """
    variables, attributes = xr.conventions.cf_encoder(*xr.conventions.encode_dataset_coordinates(dataset))
    with h5py.File("dataset.nc", "w", driver="core", backing_store=False, track_order=True) as file:
        made = {name: _create(file, str(name), variable) for name, variable in variables.items()}
        scales = {name: _scale(file, str(name), size, made.get(name)) for name, size in dataset.sizes.items()}
        for name, variable in variables.items():
            _describe(made[name], variable.attrs)
            # One that is a dimension knows its own.
            for axis, dimension in enumerate(variable.dims if name not in scales else ()):
                made[name].dims[axis].attach_scale(scales[dimension])
        _describe(file, attributes)
        file.flush()
        content: bytes = file.id.get_file_image()
    return content


def _create(file: h5py.File, name: str, variable: xr.Variable) -> h5py.Dataset:
    """Write the values of a variable."""
    values = variable.values
    if values.dtype.kind in "OU":
        return file.create_dataset(name, data=values.astype(object), dtype=h5py.string_dtype())
    # HDF5 has no checksum of a single number, nor of none.
    return file.create_dataset(name, data=values, fletcher32=True if values.ndim and values.size else None)


def _describe(holder: h5py.File | h5py.Dataset, attributes: Mapping[Any, Any]) -> None:
    """Write attributes; a number is an array of one, as NetCDF has it."""
    for name, value in attributes.items():
        holder.attrs[name] = value if isinstance(value, str) else np.atleast_1d(value)


def _scale(file: h5py.File, name: str, size: int, variable: h5py.Dataset | None) -> h5py.Dataset:
    """Return a dimension, made of the variable that has its name or of one without values."""
    if variable is None:
        variable = file.create_dataset(name, shape=(size,), dtype=">f4")
        name = _NO_VARIABLE.format(size)
    variable.make_scale(name)
    return variable
