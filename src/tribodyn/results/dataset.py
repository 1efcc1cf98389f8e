"""From plain arrays to the dataset a run returns, with units, meanings and the table of attributes.

Here and in modules that every command imports, xarray is imported where it is used: it takes half a second.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from tribodyn.results.variables import VARIABLES, Variable, in_output_unit

if TYPE_CHECKING:
    import xarray as xr
    from numpy.typing import ArrayLike, NDArray


TEXT: Final = "text"
SIZE: Final = "finite number above zero"
NUMBER: Final = "finite number"
GAPS: Final = "finite number, or none (NaN)"
OUTCOME: Final = "number"  #: A number that may be missing (NaN) or beyond all bounds (infinite).
TEXTS: Final = "list of texts, as JSON"
FACTS: Final = "table of numbers and texts, as JSON"

CARRIED: Final = "carried on"  #: The ``start`` of a run that continues from where another one ended.
SWEEP: Final = "sweep"  #: The ``kind`` of a sweep; that of a run is the kind of its case.

DATA_HASH: Final = "data_sha256"  #: SHA-256 of all that a run was computed from.
ROWS_HASH: Final = "rows_sha256"  #: SHA-256 of its rows.
#: Joints, as in names of numbers, whose wear rate nobody chose; an empty name for all.
ASSUMED_WEAR: Final = "assumed_wear"
#: Least and largest wear of equal joints over that at the rate, by joint and an empty name for all.
WEAR_SCATTER: Final = ("wear_scatter_least", "wear_scatter_largest")
NOT_KEPT: Final = "not_kept"  #: Names of variables that the case did not ask for.

#: Attributes of a dataset by name.
ATTRIBUTES: Final[dict[str, str]] = {
    **dict.fromkeys(("kind", "title", "case", "failure", "formulation", "contact_law", "start"), TEXT),
    **dict.fromkeys(("clearance", "assembly_clearance", "joint_length", "cycle_period", "impact_time"), SIZE),
    **dict.fromkeys(("roughness", "friction_coefficient"), NUMBER),
    **dict.fromkeys(("energy_residual", "clearance_energy_residual", "grid_force_error"), OUTCOME),
    **dict.fromkeys(("separation_least", "collar_lift_off_time", "tensile_clip_time"), OUTCOME),
    "time_reached": OUTCOME,
    "wear_depth_limit": SIZE,
    **dict.fromkeys(("worn_volume", "wear_life_cycles", "wear_life_factor", "wear_cycles_reached"), OUTCOME),
    **dict.fromkeys(("points_in_all", "points_failed", "samples", "sampling_seed"), NUMBER),
    **dict.fromkeys(("sampling_method", DATA_HASH, ROWS_HASH), TEXT),
    "solver": FACTS,
    "warnings": TEXTS,
    "notes": TEXTS,
    "varied": TEXTS,
    ASSUMED_WEAR: TEXTS,
    **dict.fromkeys(WEAR_SCATTER, FACTS),
    NOT_KEPT: TEXTS,
}

#: Attributes of a variable by name.
VARIABLE_ATTRIBUTES: Final[dict[str, str]] = {
    **dict.fromkeys(("units", "long_name", "comment", "group", "shown_unit"), TEXT),
    "shown_scale": SIZE,
}


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
    known = in_output_unit({**VARIABLES, **variables}, coordinates.get("output_unit", ()))
    return assembled(
        {name: _variable(name, values, known) for name, values in data.items()},
        {name: _variable(name, values, known) for name, values in coordinates.items()},
        {name: plain_attribute(value) for name, value in (attributes or {}).items()},
    )


def variable(dims: tuple[str, ...], values: NDArray[Any], about: dict[str, Any]) -> xr.Variable:
    """Return an array with its dimensions and attributes, by the short way of xarray for plain arrays.

    The constructor of xarray imports pint and dask to check the type of the array, which takes half a second.
    """
    import xarray as xr

    return xr.Variable(dims, values, about, fastpath=True)


def assembled(
    data: Mapping[str, xr.Variable], coordinates: Mapping[str, xr.Variable], attributes: Mapping[str, Any]
) -> xr.Dataset:
    """Return variables of :func:`variable` and coordinates as a dataset, with an index of each dimension."""
    import pandas as pd
    import xarray as xr
    from xarray.indexes import PandasIndex

    indexes = {
        name: PandasIndex(pd.Index(values.values), name, values.dtype)
        for name, values in coordinates.items()
        if values.dims == (name,)
    }
    variables = dict(coordinates)
    for index in indexes.values():
        variables |= index.create_variables(coordinates)
    return xr.Dataset(data, xr.Coordinates(variables, indexes), attributes)


def _variable(name: str, values: ArrayLike, known: Mapping[str, Variable]) -> xr.Variable:
    """Return the values as a variable described by its line."""
    if name not in known:
        raise KeyError(f"{name!r} has no line in the variables of its mechanism, nor in results.variables")
    about = known[name]
    array = np.asarray(values)
    if array.ndim != len(about.dims):
        raise ValueError(f"{name} has shape {array.shape} but its line says it runs over {about.dims}")
    return variable(about.dims, array, {"units": about.units, "long_name": about.long_name})


def plain_attribute(value: object) -> str | int | float:
    """Return an attribute value as NetCDF can store it and read it back unchanged.

    ``value``: text, number, truth value, ``None``, or something JSON can hold.
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
