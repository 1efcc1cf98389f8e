"""Columns of a result over time: a variable's name with labels of bodies, joints and axes after points.

``reaction_force.wrist.x [N]`` is the name of one in files that a fit reads and that an export writes.
"""

import re
from collections.abc import Iterator, Sequence
from itertools import product
from typing import Final

import numpy as np
import pandas as pd
import xarray as xr

from mebdf.arrays import FloatArray
from tribodyn.core.errors import InputError
from tribodyn.core.quoting import as_given, meant

#: Groups of variables by their unit; outputs and motions of bodies have several.
GROUPS: Final = {
    "outputs": "",
    "motion": "",
    "forces": "N",
    "moments": "N m",
    "pressures": "Pa",
    "energies": "J",
    "powers": "W",
}
_OF: Final = {"outputs": "output", "motion": "body"}
_POWER: Final = re.compile(r"([A-Za-z]+)-([0-9])")
_DEGREE: Final = np.pi / 180.0


def variable(run: xr.Dataset, name: str, key: str) -> FloatArray:
    """Return a variable of a result over time by the name of a column, SI units, shape (n,).

    Raises InputError if there is no such variable or label, or a label is missing. The message names ``key``.
    """
    first, *labels = name.split(".")
    found = run[_known(run, first, key)]
    for label in labels:
        dims = [dim for dim in found.dims[1:] if label in found[dim].values.tolist()]
        if not dims:
            raise InputError(f"{as_given(name)}: no label {as_given(label)} in {_labels(found)}", key=key)
        found = found.sel({dims[0]: label})
    if found.ndim != 1:
        raise InputError(f"{as_given(name)}: add a label for each of {_labels(found)}", key=key)
    return np.asarray(found.values, dtype=np.float64)


def unit_of(run: xr.Dataset, name: str) -> str:
    """Return the SI unit of a column as in case files: ``m/s^2`` for ``m s-2``; empty for plain numbers."""
    first, *labels = name.split(".")
    if "output" in run[first].dims and "output_unit" in run:
        return str(run["output_unit"].sel(output=labels[0]).item())
    units = str(run[first].attrs.get("units", "1"))
    return "" if units == "1" else _POWER.sub(r"/\1^\2", units).replace("^1", "").replace(" /", "/")


def table(
    run: xr.Dataset,
    names: Sequence[str],
    *,
    over: str | None = None,
    keys: tuple[str, str] = ("names", "over"),
) -> pd.DataFrame:
    """Return columns of a result as a table: a row for each time, the unit of each column in its header.

    ``names``: groups (:data:`GROUPS`), of which columns of zeros are left out, variables, or variables with
    labels after points; ``over``: a joint, whose angle [deg] comes first, or the name of a column; none else;
    ``keys``: names of both arguments in messages. Raises InputError if the result has no such group, variable
    or label.
    """
    import pandas as pd

    data = {} if over is None else _coordinate(run, over, keys[1])
    data[_with_unit("time", "s")] = run["time"].values
    for name in names:
        for column in _columns(run, name, keys[0]):
            values = variable(run, column, keys[0])
            if name not in GROUPS or np.nan_to_num(values).any():
                data[_with_unit(column, unit_of(run, column))] = values
    return pd.DataFrame(data)


def _coordinate(run: xr.Dataset, over: str, key: str) -> dict[str, FloatArray]:
    """Return the column that others are shown over."""
    joints = [str(name) for name in run["joint"].values] if "joint" in run.coords else []
    column = f"joint_angle.{over}" if over in joints else over
    if "." not in column and column not in _over_time(run) and joints:
        allowed = f"a joint, {', '.join(joints)}, or a variable with labels{meant(over, joints)}"
        raise InputError(f"{as_given(over)}; allowed: {allowed}", key=key)
    values, unit = variable(run, column, key), unit_of(run, column)
    if unit == "rad":
        values, unit = values / _DEGREE, "deg"
    return {_with_unit(column, unit): values}


def _columns(run: xr.Dataset, name: str, key: str) -> Iterator[str]:
    """Yield the names of all columns of a group, of a variable, or of a variable with some labels."""
    first, *labels = name.split(".")
    for one in _of_group(run, name) if name in GROUPS else [_known(run, first, key)]:
        rest = [[str(label) for label in run[dim].values] for dim in run[one].dims[1:]]
        for label in labels:
            if not any(label in some for some in rest):
                place = _labels(run[one])
                raise InputError(f"{as_given(name)}: no label {as_given(label)} in {place}", key=key)
            rest = [[label] if label in some else some for some in rest]
        yield from (".".join((one, *chosen)) for chosen in product(*rest))


def _of_group(run: xr.Dataset, name: str) -> list[str]:
    unit, dim = GROUPS[name], _OF.get(name)
    return [
        one
        for one in _over_time(run)
        if (dim in run[one].dims if dim else str(run[one].attrs.get("units")) == unit)
    ]


def _known(run: xr.Dataset, name: str, key: str) -> str:
    known = _over_time(run)
    if name not in known:
        listed = ", ".join(known)
        raise InputError(
            f"no variable {as_given(name)} over time; allowed: {listed}{meant(name, (*GROUPS, *known))}",
            key=key,
        )
    return name


def _over_time(run: xr.Dataset) -> list[str]:
    return [str(one) for one in run.data_vars if run[one].dims[:1] == ("time",)]


def _with_unit(name: str, unit: str) -> str:
    return f"{name} [{unit or '1'}]"


def _labels(found: xr.DataArray) -> str:
    labels = {str(dim): found[dim].values.tolist() for dim in found.dims[1:]}
    return "; ".join(f"{dim}: {', '.join(map(str, some[:12]))}" for dim, some in labels.items()) or "none"
