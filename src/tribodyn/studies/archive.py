"""The points of a sweep on disk, each in a folder named by its hash.

``summary.json`` is written last, and it is the mark of a point that is done.
"""

import json
import secrets
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Final

from tribodyn.core.errors import InputError
from tribodyn.core.files import read_regular
from tribodyn.core.quoting import brief
from tribodyn.results.atomic import adopt, remove_stale_parts, write_bytes, write_text
from tribodyn.results.schema import is_summary
from tribodyn.results.store import CASE, POINTS, RESULT, SUMMARY
from tribodyn.results.summary import Summary
from tribodyn.studies.plan import Point
from tribodyn.studies.work import PointOutcome

_LARGEST_SUMMARY: Final = 1_000_000


class Archive:
    """Storage of points.

    Parameters
    ----------
    directory
        Folder of the sweep; ``points/`` in it is made when there is a point to compute.

    Raises
    ------
    InputError
        Something else has the name of that folder.
    """

    def __init__(self, directory: Path) -> None:
        self.folder = directory / POINTS
        self.staging = self.folder.absolute() / secrets.token_hex(4)
        """Path beside which workers of this machine leave whole results, under names of this sweep."""
        if self.folder.exists() and not self.folder.is_dir():
            raise InputError(f"{brief(self.folder)} is a file; choose another directory", key="--output")

    def find(self, point: Point, *, whole: bool) -> Summary | None:
        """Return the summary of a point that is done, with its whole result if asked, else None.

        A point that failed may have no result.
        """
        try:
            content = json.loads(read_regular(self.folder / point.name / SUMMARY, _LARGEST_SUMMARY))
        except (OSError, ValueError, RecursionError):
            return None
        if not is_summary(content):
            return None
        missing = whole and not content.get("failure") and not (self.folder / point.name / RESULT).is_file()
        return None if missing else content

    @contextmanager
    def open(self) -> Iterator[None]:
        """Have the folder while the block runs; in the end remove what nobody kept, and it too if empty."""
        self.folder.mkdir(parents=True, exist_ok=True)
        remove_stale_parts(self.folder)
        try:
            yield
        finally:
            for part in self.folder.glob(f".{self.staging.name}.*.part"):
                part.unlink(missing_ok=True)
            with suppress(OSError):
                self.folder.rmdir()

    def keep(self, point: Point, outcome: PointOutcome) -> None:
        """Write a point, each file whole or not at all."""
        folder = self.folder / point.name
        folder.mkdir(parents=True, exist_ok=True)
        for part in folder.glob(".*.part"):
            part.unlink(missing_ok=True)
        write_text(folder / CASE, point.toml)
        if outcome.staged:
            adopt(Path(outcome.staged), folder / RESULT)
        elif outcome.result:
            write_bytes(folder / RESULT, outcome.result)
        text = json.dumps(outcome.summary, indent=2, ensure_ascii=False, allow_nan=False)
        write_text(folder / SUMMARY, text + "\n")
