"""From plain arrays to the dataset a run returns, with units and meanings attached."""

from __future__ import annotations

import json
from collections.abc import Container, Mapping
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from tribodyn.results.variables import COORDINATES, VARIABLES


def build(
    *,
    coordinates: Mapping[str, ArrayLike],
    columns: Mapping[str, ArrayLike],
    fields: Mapping[str, ArrayLike] | None = None,
    attributes: Mapping[str, object] | None = None,
) -> xr.Dataset:
    """Assemble a result.

    Parameters
    ----------
    coordinates
        Values of names in :data:`~tribodyn.results.variables.COORDINATES`, SI; ``time`` of shape (n_t,) at
        least.
    columns
        Values over ``time``, each of shape (n_t,), SI. Where there is a coordinate ``law``, all values
        that are no coordinates run over it first.
    fields
        Values over other dimensions, shaped as the variable table says, SI.
    attributes
        Facts about the run. NetCDF knows numbers and text only: truth values become 0 or 1, ``None`` becomes
        an empty text, lists and mappings become JSON (read back by :func:`json_attribute`).

    Returns
    -------
    xarray.Dataset
        Each variable with ``units`` and ``long_name``.
    """
    data = {**columns, **(fields or {})}
    return xr.Dataset(
        data_vars={name: _variable(name, values, coordinates) for name, values in data.items()},
        coords={name: _variable(name, values, coordinates) for name, values in coordinates.items()},
        attrs={name: plain_attribute(value) for name, value in (attributes or {}).items()},
    )


def dims_of(name: str, coordinates: Container[str]) -> tuple[str, ...]:
    """Return the dimensions of a variable of the table in a result.

    Parameters
    ----------
    name
        Of the variable.
    coordinates
        Names of the coordinates of the result: where ``law`` is one, all that is no coordinate runs over it
        first.
    """
    first = ("law",) if "law" in coordinates and name not in COORDINATES else ()
    return first + VARIABLES[name].dims


def _variable(name: str, values: ArrayLike, coordinates: Container[str]) -> xr.Variable:
    """Return the values as a variable described by the table."""
    if name not in VARIABLES:
        raise KeyError(f"{name!r} is not in tribodyn.results.variables.VARIABLES: add its line there")
    about, dims = VARIABLES[name], dims_of(name, coordinates)
    array = np.asarray(values)
    if array.ndim != len(dims):
        raise ValueError(f"{name} has shape {array.shape} but the table says it runs over {dims}")
    return xr.Variable(dims, array, {"units": about.units, "long_name": about.long_name})


def plain_attribute(value: object) -> str | int | float:
    """Return an attribute value as NetCDF can store it and read it back unchanged.

    Parameters
    ----------
    value
        Text, number, truth value, ``None``, or something JSON can hold.
    """
    if isinstance(value, np.generic):
        value = value.item()
    if value is None:
        return ""
    if isinstance(value, bool):
        return int(value)
    if isinstance(value, str | int | float):
        return value
    return json.dumps(value, ensure_ascii=False)


def json_attribute(dataset: xr.Dataset, name: str, default: Any) -> Any:
    """Return an attribute that was stored as JSON, or ``default`` where it is missing or empty.

    Parameters
    ----------
    dataset
        A result.
    name
        ``"solver"`` (mapping of statistics) or ``"warnings"`` (list of texts).
    default
        Returned when there is nothing to read.
    """
    text = dataset.attrs.get(name) or ""
    return json.loads(text) if text else default
