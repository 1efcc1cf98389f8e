"""Options that commands share: those that choose a case and change it, and the directory of results."""

from __future__ import annotations

import contextlib
import os
from argparse import ArgumentParser, Namespace
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Final

from tribodyn.cli.console import Console
from tribodyn.cli.interrupt import Interruption, last_words, on_leaving
from tribodyn.core import platforms
from tribodyn.core.errors import InputError
from tribodyn.core.quoting import as_given

if TYPE_CHECKING:
    from tribodyn.cases import Case
    from tribodyn.studies.sweep import Watcher, Where

    class KeptRuns(Where):
        """Options of a study that keeps its runs."""

        directory: Path
        watcher: Watcher


ANALYSES: Final = ("static", "kinematic", "vibrations")  #: Analyses that have an option of their own.


def add_case_arguments(parser: ArgumentParser, *, required: bool = True) -> None:
    """Add CASE and the options that change it."""
    parser.add_argument(
        "case",
        metavar="CASE",
        nargs=None if required else "?",
        help="a built-in case (see `tribodyn cases`) or a TOML file"
        + ("" if required else " (default: the first of the built-in ones)"),
    )
    add_changes(parser)


def add_changes(parser: ArgumentParser) -> None:
    """Add the options that change a case."""
    parser.add_argument(
        "--set",
        dest="changes",
        metavar="PATH=VALUE",
        action="append",
        default=[],
        help='change a key, with its unit: --set joint.clearance="25 um"; may be repeated',
    )
    parser.add_argument("--solver", metavar="NAME", help="short for --set solver.name=NAME")
    one = parser.add_mutually_exclusive_group()
    for name in ANALYSES:
        one.add_argument(
            f"--{name}",
            dest="analysis",
            action="store_const",
            const=name,
            help=f"short for --set run.analysis={name} of a user-defined mechanism",
        )


def add_study_arguments(parser: ArgumentParser, command: str, workers: int | None = None) -> None:
    """Add CASE, the options that change it, and where results are kept and computed."""
    add_case_arguments(parser)
    kept = f"where results go (default: {command}-CASE)"
    parser.add_argument("-o", "--output", metavar="DIR", help=kept)
    one = parser.add_mutually_exclusive_group()
    words = f"processes (default: {'' if workers == 0 else 'one a processor; 0: '}this one alone)"
    one.add_argument("--workers", metavar="N", type=int, default=workers, help=words)
    one.add_argument("--scheduler", metavar="ADDRESS", help="a Dask scheduler, such as tcp://10.0.0.1:8786")
    for name, meaning in (
        ("ca", "certificate of the authority that a scheduler at tls://... is known by, in PEM format"),
        ("cert", "certificate that the scheduler knows this command by"),
        ("key", "its private key, unless it stands in the same file"),
    ):
        parser.add_argument(f"--tls-{name}", metavar="FILE", help=meaning)


def where(args: Namespace) -> Where:
    """Return the processes or the cluster that a study computes on."""
    from tribodyn.studies import Tls

    files, tls = (args.tls_ca, args.tls_cert, args.tls_key), None
    if any(file is not None for file in files):
        if None in files[:2]:
            raise InputError("certificates need both --tls-ca and --tls-cert", key="--scheduler")
        tls = Tls(*files)
    return {"workers": args.workers, "scheduler": args.scheduler, "tls": tls}


def chosen_case(args: Namespace) -> Case:
    """Return the case that the arguments name, with the changes they ask for."""
    from tribodyn.mechanisms.catalogue import load_case

    options = {"--set": _set(args), "--solver": _solver(args), f"--{args.analysis}": _analysis(args)}
    given = [option for option, keys in options.items() if keys]
    return load_case(args.case, changes(args), source=" and ".join(given))


def changes(args: Namespace) -> dict[str, str]:
    """Return the changes that the arguments ask for, by dotted path."""
    return _set(args) | _solver(args) | _analysis(args)


def _set(args: Namespace) -> dict[str, str]:
    return dict(_change(text) for text in args.changes)


def _solver(args: Namespace) -> dict[str, str]:
    return {} if args.solver is None else {"solver.name": args.solver}


def _analysis(args: Namespace) -> dict[str, str]:
    return {} if args.analysis is None else {"run.analysis": args.analysis}


def typed(text: str) -> str:
    """Return an argument as it was typed: where Python knows no encoding, it is read as UTF-8."""
    try:
        return os.fsencode(text).decode()
    except UnicodeError:
        return text


def without_quotes(value: str) -> str:
    """Return a value without a pair of quotes that was left around it."""
    value = value.strip()
    quoted = len(value) > 1 and value[0] == value[-1] and value[0] in "\"'"
    return value[1:-1].strip() if quoted else value


def _change(text: str) -> tuple[str, str]:
    path, equals, value = typed(text).partition("=")
    if not (equals and path.strip()):
        raise InputError(
            f'{as_given(text)}; allowed: PATH=VALUE, such as joint.clearance="25 um"', key="--set"
        )
    return path.strip(), without_quotes(value)


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
        from tribodyn.results.store import remove_stale_parts

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
def kept_runs(command: str, args: Namespace) -> Iterator[KeptRuns]:
    """Reserve the directory of a command that keeps finished runs, and listen for a request to stop."""
    from tribodyn.studies import Watcher

    directory = OutputDirectory(f"{command}-{Path(args.case).stem}" if args.output is None else args.output)
    message = "stopping; finished runs are kept; interrupt again to leave at once"
    with directory.reserved(), Interruption(message) as stop:
        last_words(f"aborted; runs that had finished are kept in {os.fspath(directory.path)}")
        watcher = Watcher(stop=stop, note=Console.of(args).note)
        yield {"directory": directory.path, "watcher": watcher, **where(args)}
