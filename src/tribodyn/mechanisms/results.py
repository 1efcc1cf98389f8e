"""Results of any mechanism: read and checked, their key results, and peaks from the kernels."""

import re
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from fnmatch import fnmatchcase
from pathlib import Path
from typing import TYPE_CHECKING, Final

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.cases.case import Case
from tribodyn.core.errors import InputError
from tribodyn.core.quantities import Table, names
from tribodyn.kernels.peaks import Peaks
from tribodyn.mechanisms.catalogue import MECHANISMS
from tribodyn.mechanisms.mechanism_protocol import MechanismDescriptor
from tribodyn.results import json_attribute, store, summary
from tribodyn.results.dataset import NOT_KEPT
from tribodyn.results.reading import entries
from tribodyn.results.summary import KeyResult
from tribodyn.results.variables import PARTS, VARIABLES

if TYPE_CHECKING:
    import xarray as xr

#: Impacts, and the ringing that follows them, are over after this share of the time between two reversals of
#: the drive, half its cycle; the rest is smooth motion.
IMPACT_SHARE: Final = 0.1


def impact_time(period: float) -> float:
    """Return the length of impacts after a reversal [s] for a drive cycle of ``period`` [s]."""
    return IMPACT_SHARE * 0.5 * period


def of_run(peaks: Peaks, table: Table) -> dict[str, float]:
    """Return the largest value of each quantity and its time [s], by name; NaN where nothing was noted."""
    n = len(table)
    largest, when = peaks.largest.reshape(-1, n), peaks.when.reshape(-1, n)
    best = np.argmax(np.where(np.isnan(largest), -np.inf, largest), axis=0)
    found = {}
    for k, name in enumerate(names(table)):
        found[f"{name}_peak"] = float(largest[best[k], k])
        found[f"{name}_peak_time"] = float(when[best[k], k])
    return found


def of_reversals(peaks: Peaks, table: Table) -> dict[str, FloatArray]:
    """Return peaks and their times [s] over the start and the reversals that were reached, by name."""
    reached = int(peaks.course.stretch) + 1
    found = {}
    for k, name in enumerate(names(table)):
        for place, part in enumerate(PARTS):
            found[f"{name}_{part}"] = peaks.largest[:reached, place, k]
            found[f"{name}_{part}_time"] = peaks.when[:reached, place, k]
    return found


def of_rows(
    times: FloatArray, values: Mapping[str, FloatArray], begins: FloatArray, window: float
) -> dict[str, FloatArray]:
    """Return the same peaks and times [s] from rows that follow the steps, by name.

    ``times``: of the rows [s], shape (n_t,); ``values``: quantities by name, shape (n_t, n) each; their sizes
    are looked at; ``begins``: the start and the reversals that were reached [s], shape (n_reversals,);
    ``window``: how long impacts last after each [s]. Returns of shape (n_reversals, n) each, NaN where there
    is no finite value.
    """
    shape = (begins.size, next(iter(values.values())).shape[1])
    found = {f"{name}_{part}": np.full(shape, np.nan) for name in values for part in PARTS}
    found |= {f"{name}_time": np.full(shape, np.nan) for name in found}
    for k, (begin, end) in enumerate(zip(begins, np.append(begins[1:], np.inf), strict=True)):
        inside = (times >= begin) & (times <= end)
        impact = times <= begin + window
        for part, rows in zip(PARTS, (inside & impact, inside & ~impact), strict=True):
            for name, column in values.items():
                sizes = np.abs(column[rows])
                known = np.flatnonzero(np.isfinite(sizes).any(axis=0))
                if not known.size:
                    continue
                row = np.nanargmax(sizes[:, known], axis=0)
                found[f"{name}_{part}"][k, known] = sizes[row, known]
                found[f"{name}_{part}_time"][k, known] = times[rows][row]
    return found


def read(path: str | Path) -> "xr.Dataset":
    """Read a result into memory, and check it.

    Parameters
    ----------
    path
        Folder of a run, or a NetCDF file.

    Returns
    -------
    xarray.Dataset
        As it was written: times stay numbers of seconds.

    Raises
    ------
    InputError
        If there is no result, it cannot be read, or it is not what its kind says.

    Examples
    --------
    >>> import tribodyn as td
    >>> result = td.read("out/demo")  # doctest: +SKIP
    """
    return store.read(path, {kind: mechanism.variables for kind, mechanism in MECHANISMS.items()})


def write_run(dataset: "xr.Dataset", directory: str | Path, stale: Iterable[Path] = ()) -> list[Path]:
    """Write a run with its key results, see :func:`tribodyn.results.store.write_run`."""
    return store.write_run(dataset, directory, summarise(dataset), stale)


def mechanism_of(dataset: "xr.Dataset") -> MechanismDescriptor:
    """Return the mechanism that a result is of.

    Raises InputError if there is no such mechanism.
    """
    kind = str(dataset.attrs.get("kind", ""))
    if kind not in MECHANISMS:
        raise InputError(f"the result is of the kind {kind[:80]!r}; known: {', '.join(MECHANISMS)}")
    return MECHANISMS[kind]


@contextmanager
def all_there(*datasets: "xr.Dataset") -> Iterator[None]:
    """Refuse results that lack a variable which the block reads.

    Which variables a result holds depends on what was simulated, so that it shows only where one is used.
    """
    try:
        yield
    except KeyError as error:
        name = next(iter(re.findall(r"'(\w+)'", str(error))), "")
        known = any(name in mechanism.variables for mechanism in MECHANISMS.values()) or name in VARIABLES
        if not known or all(name in dataset.variables for dataset in datasets):
            raise
        reason = f"the result lacks the variable {name}; it is damaged: simulate the case again"
        if any(name in json_attribute(dataset, NOT_KEPT, []) for dataset in datasets):
            reason = f"the result does not keep {name}: name it in results.quantities and run the case again"
        raise InputError(reason) from error


def summarise(dataset: "xr.Dataset") -> summary.Summary:
    """Return the key results of a result, see :func:`tribodyn.results.summary.summarise`."""
    mechanism = mechanism_of(dataset)
    parts = {
        str(known.parts or known.names): entries(dataset, name).tolist()
        for name, known in mechanism.variables.items()
        if (known.parts or known.names) in mechanism.by_part and name in dataset.coords
    }
    with all_there(dataset):
        return summary.summarise(dataset, mechanism.key_results_of(parts))


def key_results_of(kind: str) -> dict[str, KeyResult]:
    """Return the key results of a kind of results, in reading order; of no kind, those of all kinds."""
    chosen = [MECHANISMS[kind]] if kind in MECHANISMS else list(MECHANISMS.values())
    own = {name: key_result for mechanism in chosen for name, key_result in mechanism.key_results.items()}
    return own | summary.EFFORT


def key_results_of_case(case: Case) -> dict[str, KeyResult]:
    """Return the key results of the results of a case, those of each of its parts among them."""
    mechanism = MECHANISMS[case.kind()]
    parts = {table: tuple(getattr(case, table)) for table in mechanism.by_part}
    return mechanism.key_results_of(parts) | summary.EFFORT


def key_numbers_of(kind: str, names: Iterable[str]) -> list[str]:
    """Return those of the names of a kind of results that a reader wants first, in that order."""
    given = list(names)
    wanted = MECHANISMS[kind].key_numbers if kind in MECHANISMS else ()
    return [name for pattern in wanted for name in given if fnmatchcase(name, pattern)]


def known(names: Iterable[str], kind: str) -> dict[str, KeyResult]:
    """Return the key results of a kind among some names, in reading order."""
    given = list(names)
    of_all = {name: key_result for name, key_result in key_results_of(kind).items() if name in given}
    own = {name: key_result for name, key_result in of_all.items() if name not in summary.EFFORT}
    return own | _of_parts([name for name in given if name not in of_all], kind) | of_all


def _of_parts(names: Iterable[str], kind: str) -> dict[str, KeyResult]:
    """Return those of the names that are numbers of one part, such as a joint."""
    by_part = MECHANISMS[kind].by_part if kind in MECHANISMS else {}
    return {
        name: made(name.removeprefix(f"{base}_"))
        for name in names
        for numbers in by_part.values()
        for base, made in numbers.items()
        if name.startswith(f"{base}_")
    }
