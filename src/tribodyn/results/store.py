"""A run on disk: ``result.nc``, ``summary.json`` and ``case.toml`` in one folder."""

from __future__ import annotations

import json
import os
import tempfile
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from tribodyn.core.errors import InputError
from tribodyn.core.files import read_regular
from tribodyn.core.platforms import provenance
from tribodyn.core.quoting import LONGEST, brief
from tribodyn.results.atomic import write_together
from tribodyn.results.netcdf import attributes_of, dataset_of, netcdf_parts
from tribodyn.results.schema import Kinds, check
from tribodyn.results.summary import Summary

if TYPE_CHECKING:
    import xarray as xr

RESULT: Final = "result.nc"
#: Folder of a sweep that holds one folder for each point whose whole result is kept.
POINTS: Final = "points"
#: Points of a sweep up to which each keeps its result and gets its report without being asked: 3 MB each.
FEW_POINTS: Final = 24
SUMMARY: Final = "summary.json"
CASE: Final = "case.toml"
#: Size of a result that is read, at most [bytes]: it is held in memory, several times over.
LARGEST: Final = 4_000_000_000


def prepare_directory(directory: str | Path) -> Path:
    """Make sure that results can be written to a folder, before anything is computed.

    Parameters
    ----------
    directory
        Folder for the results; made if missing.

    Returns
    -------
    pathlib.Path
        The folder.

    Raises
    ------
    InputError
        If the folder cannot be made or written to.
    """
    folder = Path(directory)
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder):
            return folder
    except OSError as error:
        reason = error.strerror or str(error)
        raise InputError(
            f"cannot write results to {brief(folder)} ({reason}); choose another folder"
        ) from error


def write_run(
    dataset: xr.Dataset, directory: str | Path, summary: Summary, stale: Iterable[Path] = ()
) -> list[Path]:
    """Write a run; summary and case of an earlier one never remain with its result.

    ``dataset``: a result; ``attrs["case"]`` is the text of the case file; ``directory``: folder to write to;
    made if missing; ``summary``: its key results; ``stale``: what else was made from the earlier result;
    removed once the new one is on the disk. Returns the files written.
    """
    folder = Path(directory)
    folder.mkdir(parents=True, exist_ok=True)
    contents = {
        RESULT: netcdf_parts(dataset),
        CASE: (case_text(dataset).encode(),),
        SUMMARY: (summary_text(summary).encode(),),
    }
    write_together({folder / name: content for name, content in contents.items()}, stale)
    return [folder / name for name in contents]


def case_text(dataset: xr.Dataset) -> str:
    """Return the content of ``case.toml``."""
    return str(dataset.attrs.get("case", ""))


def summary_text(summary: Summary) -> str:
    """Return the content of ``summary.json``."""
    return json.dumps(summary, indent=2, ensure_ascii=False, allow_nan=False) + "\n"


def finished_case(directory: str | Path) -> str | None:
    """Return the text of the case whose finished run a folder holds, None where there is none."""
    attributes = _finished(directory)
    return None if attributes is None else str(attributes.get("case", ""))


def holds_run(directory: str | Path, case: str) -> bool:
    """Return whether a folder holds the finished run of a case, made by the installed versions.

    ``directory``: a folder, which may be missing; ``case``: text of the case.
    """
    attributes = _finished(directory) or {}
    return attributes.get("case") == case and attributes.items() >= provenance().items()


def _finished(directory: str | Path) -> dict[str, Any] | None:
    """Return the attributes of the finished run that a folder holds, None where there is none."""
    file = Path(directory) / RESULT
    if not os.path.isfile(file):
        return None
    try:
        attributes = attributes_of(file)
    except Exception:  # a damaged file makes its readers raise what they like, and is no result
        return None
    return None if attributes.get("failure") else attributes


def read(path: str | Path, kinds: Kinds) -> xr.Dataset:
    """Read a result into memory.

    ``path``: folder of a run, or a NetCDF file; ``kinds``: what is known of each kind of result. Returns as
    it was written: times stay numbers of seconds. Raises InputError if there is no result or it cannot be
    read.
    """
    file = Path(path)
    file = file / RESULT if file.is_dir() else file
    try:
        dataset = dataset_of(read_regular(file, LARGEST))
        dataset.attrs = {name: _python(value) for name, value in dataset.attrs.items()}
        check(dataset, kinds)
    except FileNotFoundError as error:
        hint = f"run a case with `-o {brief(file.parent)}` first"
        raise InputError(f"there is no result at {brief(file)}; {hint}") from error
    # A damaged file makes its readers raise what they like, AttributeError among it.
    except Exception as error:
        reason = getattr(error, "strerror", None) or str(error) or type(error).__name__
        reason = brief(reason, 3 * LONGEST)
        text = f"cannot read the result in {brief(file)}; it is damaged or no result: {reason}"
        raise InputError(text) from error
    return dataset


def _python(value: object) -> object:
    """Return a number as Python holds it."""
    return value.item() if isinstance(value, np.generic) else value
