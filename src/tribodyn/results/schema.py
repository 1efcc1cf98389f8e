"""Schema of results: checked once, when a result is read.

The variable and attribute tables say it; what reads a result afterwards need not ask again.
"""

from __future__ import annotations

import json
from collections.abc import Container, Mapping
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from tribodyn.core import files
from tribodyn.core.quantities import TIME
from tribodyn.core.quoting import brief
from tribodyn.results.dataset import (
    ATTRIBUTES,
    FACTS,
    GAPS,
    NUMBER,
    OUTCOME,
    SIZE,
    SWEEP,
    TEXT,
    TEXTS,
    VARIABLE_ATTRIBUTES,
)
from tribodyn.results.variables import (
    COORDINATES,
    EVENTS,
    POINT_TEXTS,
    REVERSAL,
    VARIABLES,
    Variable,
    in_output_unit,
)

if TYPE_CHECKING:
    import xarray as xr

LARGEST: Final = 1e60  #: Size of a number, at most: products and squares of numbers are numbers, too.
LONGEST: Final = 1_000_000  #: Length of a text, at most.
LISTS: Final = ("warnings", "notes", "assumed")  #: Keys of a summary that hold lists.
INTERVALS: Final = "intervals"  #: Key of a summary that holds the ends of intervals, by key result.
MOST_VARIABLES: Final = 200  #: Variables of a sweep, at most: each is drawn.
_ADDED: Final = ("doubtful",)  #: Texts of points that sweeps of earlier versions lack.


Kinds = Mapping[str, Mapping[str, Variable]]  #: Content of the results of each kind beside the common one.


def check(dataset: xr.Dataset, kinds: Kinds) -> None:
    """Refuse files that no run and no sweep writes.

    ``dataset``: as it was read; values in memory; ``kinds``: what is known of each kind of result. Raises
    ValueError if names, dimensions, types or values are not those of a result; the message says which.
    """
    _check_attributes("the result", dataset.attrs, ATTRIBUTES)
    for name, variable in dataset.variables.items():
        _check_attributes(brief(name), variable.attrs, VARIABLE_ATTRIBUTES)
    if dataset.attrs.get("kind") == SWEEP:
        _check_sweep(dataset)
    else:
        known = {**VARIABLES, **_variables_of(dataset, _tables(dataset, "case"), kinds)}
        _check_run(dataset, known)
        _check_names(dataset, known, _tables(dataset, "case"))


def is_summary(content: object) -> bool:
    """Tell whether something read as JSON is the summary of a run: texts and finite numbers by name.

    Its ``warnings`` are a list of texts, its ``intervals`` pairs of numbers by name.
    """
    return (
        isinstance(content, dict)
        and "status" in content
        and all(isinstance(content.get(name, ""), str) for name in ("title", "status", "failure"))
        and all(isinstance(content.get(name, []), list) for name in LISTS)
        and all(_of_form(value, TEXT) for name in LISTS for value in content.get(name, []))
        and _are_intervals(content.get(INTERVALS, {}))
        and all(
            _of_form(value, TEXT) or _is_number(value, NUMBER)
            for name, value in content.items()
            if name not in (*LISTS, INTERVALS)
        )
    )


def _are_intervals(content: object) -> bool:
    return isinstance(content, dict) and all(
        isinstance(ends, list) and len(ends) == 2 and all(_is_number(end, NUMBER) for end in ends)
        for ends in content.values()
    )


def _check_attributes(owner: str, attributes: Mapping[Any, Any], table: Mapping[str, str]) -> None:
    for name, value in attributes.items():
        form = TEXT if str(name).endswith("_version") else table.get(str(name))
        fits = _of_form(value, form) if form else _of_form(value, TEXT) or _of_form(value, OUTCOME)
        if not fits:
            raise ValueError(f"the attribute {brief(name)} of {owner} is not a {form or 'text or a number'}")


def _of_form(value: object, form: str) -> bool:
    """Tell whether an attribute has one of the forms of the attribute table."""
    if form in (OUTCOME, NUMBER, SIZE):
        return _is_number(value, form)
    if not isinstance(value, str) or len(value) > LONGEST:
        return False
    return form == TEXT or value == "" or _is_json(value, form)


def _is_number(value: object, form: str) -> bool:
    if isinstance(value, bool) or not isinstance(value, int | float | np.number):
        return False
    return _in_bounds(np.float64(value), form) and (form != SIZE or float(value) > 0.0)


def _is_json(text: str, form: str) -> bool:
    try:
        found = json.loads(text)
    except (ValueError, RecursionError):
        return False
    if form == TEXTS:
        return isinstance(found, list) and all(isinstance(entry, str) for entry in found)
    return (
        form == FACTS
        and isinstance(found, dict)
        and all(isinstance(value, str) or _is_number(value, OUTCOME) for value in found.values())
    )


def _in_bounds(values: Any, form: str) -> bool:
    """Tell whether numbers are finite, as far as they must be, and none of the finite ones is too large."""
    array = np.asarray(values)
    good = np.isfinite(array)
    allowed = good | np.isnan(array) if form == GAPS else good
    whole = form == OUTCOME or bool(allowed.all())
    return whole and float(np.abs(array[good]).max(initial=0.0)) <= LARGEST


def _tables(dataset: xr.Dataset, *names: str) -> Mapping[str, Any]:
    """Return the tables of the first text that a result has of these; nothing where it cannot be read."""
    text = next((dataset.attrs[name] for name in names if name in dataset.attrs), "")
    try:
        return files.parse(str(text))
    except ValueError:
        return {}


def _variables_of(dataset: xr.Dataset, case: Mapping[str, Any], kinds: Kinds) -> Mapping[str, Variable]:
    """Return the content of its kind of result; refuse a kind that is unknown, or not that of its case."""
    named = case.get("case")
    kind = str(dataset.attrs.get("kind", ""))
    if kind not in kinds:
        raise ValueError(f"its kind is {brief(kind)}; known: {', '.join(kinds)}")
    if isinstance(named, str) and kind != named:
        raise ValueError(f"its kind is {brief(kind)}, that of its case {brief(named)}")
    return kinds[kind]


def _check_run(dataset: xr.Dataset, known: Mapping[str, Variable]) -> None:
    """Compare the variables of a run with what is known of them."""
    if "time" not in dataset.variables:
        raise ValueError("it lacks the variable time")
    in_units = in_output_unit(known, dataset["output_unit"].values if "output_unit" in dataset else ())
    for name, variable in dataset.variables.items():
        about = known.get(str(name))
        if about is None:
            raise ValueError(f"no result has a variable {brief(name)}")
        if variable.dims != about.dims:
            raise ValueError(f"{name} runs over {brief(variable.dims)}, not over {about.dims}")
        if variable.attrs.get("units") not in (about.units, in_units[str(name)].units):
            raise ValueError(f"the unit of {name} is not {about.units}")
        _check_values(str(name), variable, text=about.named, form=_form_of(str(name), about))
    _check_coordinates(dataset, {name for name, about in known.items() if about.named})


def _form_of(name: str, about: Variable) -> str:
    """Return the numbers that a variable may hold: only single numbers of a run may be infinite."""
    if name in COORDINATES or (len(about.dims) > 1 and about.dims[:1] not in (TIME, REVERSAL)):
        return NUMBER
    return GAPS if about.dims else OUTCOME


def _check_values(name: str, variable: xr.Variable, *, text: bool, form: str) -> None:
    if text:
        if not _texts(variable.values):
            raise ValueError(f"{name} does not hold texts")
        return
    if variable.dtype.kind not in "fiu":
        raise ValueError(f"{name} does not hold numbers")
    if not _in_bounds(variable.values, form):
        raise ValueError(f"{name} holds numbers that cannot be")


def _texts(values: Any) -> bool:
    return values.dtype.kind == "U" or (
        values.dtype.kind == "O" and all(isinstance(value, str) for value in values.ravel())
    )


def _check_coordinates(dataset: xr.Dataset, named: Container[str]) -> None:
    """Each dimension has its coordinate; numbers along one grow, names are not given twice."""
    for dim in dataset.dims:
        if dim not in dataset.variables:
            raise ValueError(f"it lacks the coordinate {brief(dim)}")
        values = dataset.variables[dim].values
        if dim in named:
            if len(set(values.tolist())) < values.size:
                raise ValueError(f"a name of {dim} is given twice")
            continue
        if dim not in EVENTS and values.size < 2:
            raise ValueError(f"it holds too few values of {dim}")
        steps = np.diff(values)
        if np.any(steps < 0.0) or (dim not in EVENTS and np.any(steps == 0.0)):
            raise ValueError(f"{dim} does not grow")
    for pictures in ("snapshot", "frame"):
        if dataset.sizes.get(pictures) and not dataset.sizes["time"]:
            raise ValueError(f"it holds values of {pictures}, but none of time")


def _check_names(dataset: xr.Dataset, known: Mapping[str, Variable], case: Mapping[str, Any]) -> None:
    """Compare names along a dimension with those that it must have, in their order."""
    for dim in dataset.dims:
        names = known[str(dim)].names
        if isinstance(names, str):
            table = case.get(names)
            names = tuple(table) if isinstance(table, dict) else ()
        found = tuple(dataset.variables[dim].values.tolist()) if names else ()
        if found != names:
            raise ValueError(f"its names of {dim} are {brief(found)}, not {brief(names)}")


def _check_sweep(dataset: xr.Dataset) -> None:
    """Compare a sweep with what the merging of its points makes."""
    if len(dataset.variables) > MOST_VARIABLES:
        raise ValueError(f"a sweep of more than {MOST_VARIABLES} variables")
    lacking = [name for name in POINT_TEXTS if name not in (*dataset.data_vars, *_ADDED)]
    if lacking:
        raise ValueError(f"it lacks the variable {lacking[0]}")
    dims = dataset["failure"].dims
    if not dims or dataset["failure"].size == 0:
        raise ValueError("it holds no points")
    for name, values in dataset.data_vars.items():
        if values.dims != dims:
            raise ValueError(f"{brief(name)} runs over {brief(values.dims)}, not over {brief(dims)}")
        if not str(name).isidentifier():
            raise ValueError(f"{brief(name)} is no name of a number")
        _check_values(brief(name), values.variable, text=name in POINT_TEXTS, form=GAPS)
    _check_parameters(dataset)


def _check_parameters(dataset: xr.Dataset) -> None:
    """Check the values that the points of a sweep were computed with."""
    for name, values in dataset.coords.items():
        if values.ndim != 1:
            raise ValueError(f"{brief(name)} does not run over one dimension")
        if values.dtype.kind != "b":
            text = values.dtype.kind not in "fiu"
            _check_values(brief(name), values.variable, text=text, form=NUMBER)
    named = json.loads(dataset.attrs.get("varied") or "[]")
    lacking = [name for name in (*dataset.dims, *named) if name not in dataset.coords]
    if lacking:
        raise ValueError(f"it lacks the coordinate {brief(lacking[0])}")
    for count in ("points_in_all", "points_failed"):
        if not isinstance(dataset.attrs.get(count), int):
            raise ValueError(f"its attribute {count} is not a whole number")
