"""A run on disk, written whole or not at all: result.nc, summary.json and case.toml in one folder."""

from __future__ import annotations

import json
import os
import secrets
import tempfile
import time
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from tribodyn.core.errors import InputError
from tribodyn.core.files import read_regular
from tribodyn.core.platforms import flush_folder, provenance
from tribodyn.core.quoting import LONGEST, brief
from tribodyn.results.netcdf import attributes_of, dataset_of, netcdf_parts
from tribodyn.results.schema import Kinds, check
from tribodyn.results.summary import Summary

if TYPE_CHECKING:
    import xarray as xr

#: Age [s] from which a temporary file is what a killed process left: none takes so long to write.
_STALE: Final = 3600.0


@contextmanager
def replacing(path: Path) -> Iterator[Path]:
    """Give a temporary path beside ``path`` that becomes ``path`` when the block ends well.

    The temporary file is flushed to the disk before it takes the name, so that after a crash the name
    holds either the old file or the new one. When the block raises, the old file stays as it was.

    ``path``: file to write; its folder must exist.
    """
    part = _part(path)
    try:
        yield part
        _flush(part)
        os.replace(part, path)
    finally:
        part.unlink(missing_ok=True)
    flush_folder(path.parent)


def stage(path: Path, *content: bytes | memoryview) -> Path:
    """Write a future file's content to a temporary path beside it, on the disk when this returns.

    ``path``: any name in a folder that exists; ``content``: of the file, in parts that follow each other.
    Returns the temporary path, for :func:`adopt`; when the file cannot be written whole, it is gone.
    """
    part = _part(path)
    try:
        with part.open("wb") as stream:
            stream.writelines(content)
        _flush(part)
    except BaseException:
        part.unlink(missing_ok=True)
        raise
    return part


def adopt(part: Path, path: Path) -> None:
    """Give a file from :func:`stage` its name, of the same file system; where that fails, it is gone."""
    try:
        os.replace(part, path)
    finally:
        part.unlink(missing_ok=True)
    flush_folder(path.parent)


def write_bytes(path: Path, content: bytes) -> None:
    """Write a file whole or not at all.

    ``path``: file to write; its folder must exist; ``content``: its whole content.
    """
    adopt(stage(path, content), path)


def write_text(path: Path, text: str) -> None:
    """Write a UTF-8 text file whole or not at all.

    ``path``: file to write; its folder must exist; ``text``: its whole content.
    """
    write_bytes(path, text.encode())


def write_together(contents: Mapping[Path, Sequence[bytes | memoryview]], stale: Iterable[Path]) -> None:
    """Write files of one folder that belong together, the first of which the others follow from.

    All are on the disk before any takes its name. Then what belongs to the old first file goes, the new first
    file takes its name, and the others theirs: whenever the process is killed, none is there with a first
    file that it does not belong to.

    ``contents``: parts of the content of each file by its path, the one that all others follow from first;
    ``stale``: other files that belong to the old first file; they need not exist.
    """
    parts: dict[Path, Path] = {}
    folder = next(iter(contents)).parent
    try:
        for path, content in contents.items():
            parts[path] = stage(path, *content)
        for path in (*list(parts)[1:], *stale):
            path.unlink(missing_ok=True)
        flush_folder(folder)
        for path, part in parts.items():
            os.replace(part, path)
    finally:
        for part in parts.values():
            part.unlink(missing_ok=True)
    flush_folder(folder)


def remove_stale_parts(folder: Path, *, alone: bool = False) -> None:
    """Remove temporary files that a killed process left in a folder; those being written now stay.

    ``folder``: where to look; it need not exist; ``alone``: whether no other process writes there, so that
    all are left from a killed one.
    """
    for part in folder.glob(".*.part"):
        with suppress(OSError):
            if alone or time.time() - part.stat().st_mtime > _STALE:
                part.unlink()


def _part(path: Path) -> Path:
    """Return a name beside ``path`` for what is to become it."""
    # Opened by the writer itself rather than by tempfile, whose files only their owner may read.
    return path.with_name(f".{path.name}.{secrets.token_hex(4)}.part")


def _flush(path: Path) -> None:
    """Wait until the content of a file is on the disk."""
    with path.open("r+b") as stream:
        os.fsync(stream.fileno())


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
        held = dataset.attrs.items()
        dataset.attrs = {name: one.item() if isinstance(one, np.generic) else one for name, one in held}
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
