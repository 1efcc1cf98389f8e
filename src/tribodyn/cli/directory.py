"""The directory that results go to: checked before anything is computed."""

import contextlib
import os
from argparse import Namespace
from collections.abc import Iterator
from pathlib import Path
from typing import Final

from tribodyn.cli.interrupt import Interruption, last_words, on_leaving
from tribodyn.core import platforms
from tribodyn.core.errors import InputError
from tribodyn.core.quoting import as_given

CHECKPOINT: Final = "checkpoint.npz"  #: Folder of a wear campaign until its result is written.
RESULT: Final = "result.nc"
FILES: Final = (RESULT, "summary.json", "case.toml", "report.html", CHECKPOINT)
FIGURES: Final = "figures"
POINTS: Final = "points"
REPORT: Final = "report.html"


class OutputDirectory:
    """A directory that can be written to.

    ``path``: where results go; made with its parents if missing. Raises InputError if results cannot be
    written there. Nothing is left behind.
    """

    def __init__(self, path: str) -> None:
        self.path = Path(path)
        if not path:
            raise _refused(path, "the name is empty")
        self._made = _missing_parents(self.path)
        self._reserved = False
        on_leaving(self._abandon)
        # os.path, because pathlib's own tests fail on names that are too long.
        if os.path.isfile(self.path):
            raise _refused(path, "it is a file")
        self._make()
        self._check_names()

    def _make(self) -> None:
        from tribodyn.results.store import prepare_directory

        try:
            prepare_directory(self.path)
        except (InputError, OSError, ValueError) as error:
            self._forget()
            cause = error.__cause__ or error
            reason = cause.strerror if isinstance(cause, OSError) else None
            raise _refused(os.fspath(self.path), (reason or str(cause)).lower()) from None

    def _check_names(self) -> None:
        """Refuse a directory in which a result could not take its name."""
        for name in FILES:
            if (self.path / name).is_dir():
                raise _refused(os.fspath(self.path), f"{name} in it is a directory")
        figures = self.path / FIGURES
        if figures.exists() and not figures.is_dir():
            raise _refused(os.fspath(self.path), f"{FIGURES} in it is a file")
        # A folder of results may come from elsewhere: what is written into it stays in it. A file that is
        # a link is replaced, never written through.
        for name in (FIGURES, POINTS):
            if not (self.path / name).resolve().is_relative_to(self.path.resolve()):
                raise _refused(os.fspath(self.path), f"{name} in it is a link that leads out of it")

    @contextlib.contextmanager
    def reserved(self) -> Iterator[None]:
        """Keep other processes from writing here while the block runs; a killed process keeps nobody out.

        When the block raises, what was made for it and is still empty goes.

        Raises InputError if another process has reserved it.
        """
        from tribodyn.results.atomic import remove_stale_parts

        with platforms.locked(self.path) as mine:
            if mine is False:
                raise _refused(os.fspath(self.path), "another tribodyn is writing results there")
            self._reserved = True
            try:
                for folder in self._written():
                    remove_stale_parts(folder, alone=bool(mine))
                yield
            except BaseException:
                self._forget()
                raise
            finally:
                self._reserved = False

    @property
    def checkpoint(self) -> Path:
        """File in which a wear campaign is kept."""
        return self.path / CHECKPOINT

    def _forget(self) -> None:
        """Remove new folders, as far as they are still empty."""
        for path in self._made:
            with contextlib.suppress(OSError, ValueError):
                path.rmdir()

    def _abandon(self) -> None:
        """Leave nothing that is not whole behind, as this process is about to end."""
        if self._reserved:
            for folder in self._written():
                for part in folder.glob(".*.part"):
                    part.unlink(missing_ok=True)
        self._forget()

    def _written(self) -> Iterator[Path]:
        """Yield the folders in which files are replaced."""
        yield from (self.path, self.path / FIGURES, self.path / POINTS)

    def pictures(self) -> list[Path]:
        """Return report and figures that are there."""
        figures = self.path / FIGURES
        return [*self.path.glob(REPORT), *figures.glob("*.png"), *figures.glob("*.pdf")]


def _missing_parents(path: Path) -> list[Path]:
    """Return the folders that making `path` will make, innermost first."""
    with contextlib.suppress(OSError, ValueError):
        return [place for place in (path, *path.parents) if not place.exists()]
    return []


def _refused(path: str, reason: str) -> InputError:
    return InputError(
        f"{as_given(path)}: results cannot be written there ({reason}); allowed: a directory that can be "
        "written to, or a new name in one",
        key="--output",
    )


@contextlib.contextmanager
def kept_runs(command: str, args: Namespace) -> Iterator[tuple[Path, Interruption]]:
    """Reserve the directory of a command that keeps finished runs, and listen for a request to stop."""
    directory = OutputDirectory(f"{command}-{Path(args.case).stem}" if args.output is None else args.output)
    message = "stopping; finished runs are kept; interrupt again to leave at once"
    with directory.reserved(), Interruption(message) as stop:
        last_words(f"aborted; runs that had finished are kept in {os.fspath(directory.path)}")
        yield directory.path, stop
