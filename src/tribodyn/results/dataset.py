"""From plain arrays to the dataset a run returns, with units and meanings attached."""

from __future__ import annotations

import json
from collections.abc import Mapping
from types import MappingProxyType
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr
from numpy.typing import ArrayLike

from tribodyn.results.variables import VARIABLES, Variable


def build(
    *,
    coordinates: Mapping[str, ArrayLike],
    columns: Mapping[str, ArrayLike],
    fields: Mapping[str, ArrayLike] | None = None,
    attributes: Mapping[str, object] | None = None,
    variables: Mapping[str, Variable] = MappingProxyType({}),
) -> xr.Dataset:
    """Assemble a result.

    Parameters
    ----------
    coordinates
        Values of names in :data:`~tribodyn.results.variables.COORDINATES`, SI; ``time`` of shape (n_t,) at
        least.
    columns
        Values over ``time``, each of shape (n_t,), SI.
    fields
        Values over other dimensions, shaped as the variable table says, SI.
    attributes
        Facts about the run. NetCDF knows numbers and text only: truth values become 0 or 1, ``None`` becomes
        an empty text, lists and mappings become JSON (read back by :func:`json_attribute`).
    variables
        What is known of variables beside those that mechanisms share.

    Returns
    -------
    xarray.Dataset
        Each variable with ``units`` and ``long_name``.
    """
    data = {**columns, **(fields or {})}
    known = {**VARIABLES, **variables}
    return xr.Dataset(
        data_vars={name: _variable(name, values, known) for name, values in data.items()},
        coords={name: _variable(name, values, known) for name, values in coordinates.items()},
        attrs={name: plain_attribute(value) for name, value in (attributes or {}).items()},
    )


def _variable(name: str, values: ArrayLike, known: Mapping[str, Variable]) -> xr.Variable:
    """Return the values as a variable described by its line."""
    if name not in known:
        raise KeyError(f"{name!r} has no line in the variables of its mechanism, nor in results.variables")
    about = known[name]
    array = np.asarray(values)
    if array.ndim != len(about.dims):
        raise ValueError(f"{name} has shape {array.shape} but its line says it runs over {about.dims}")
    # Of an array xarray would make the index itself, but import all of pint to see what kind of array it is.
    counts = about.dims == (name,) and not about.named
    held = pd.Index(array) if counts else array
    return xr.Variable(about.dims, held, {"units": about.units, "long_name": about.long_name})


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
        ``"solver"`` (mapping of statistics) or ``"warnings"`` or ``"notes"`` (lists of texts).
    default
        Returned when there is nothing to read.
    """
    text = dataset.attrs.get(name) or ""
    return json.loads(text) if text else default
