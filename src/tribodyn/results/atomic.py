"""Writing files whole or not at all."""

import os
import secrets
import time
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Final

from tribodyn.core.platforms import flush_folder

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
