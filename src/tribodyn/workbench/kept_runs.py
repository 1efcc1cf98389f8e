"""Runs that the workbench keeps: texts of cases and frames, with everything else forgotten in time."""

from __future__ import annotations

from collections import Counter, OrderedDict
from dataclasses import dataclass, field
from typing import Final

MOST_CASES: Final = 1000


@dataclass
class KeptRuns:
    """Runs that the pages have shown.

    Attributes
    ----------
    room
        Size of the frames that are kept [bytes]; the last one is kept in any case.
    cases
        Texts of cases by the names of their runs, the latest last.
    frames
        Bodies of frames, likewise.
    pins
        How often each pinned run is pinned; neither its case nor its frame is forgotten.
    """

    room: int
    cases: OrderedDict[str, str] = field(default_factory=OrderedDict)
    frames: OrderedDict[str, bytes] = field(default_factory=OrderedDict)
    pins: Counter[str] = field(default_factory=Counter)
    _size: int = 0

    def keep(self, run: str, toml: str, content: bytes) -> None:
        """Keep a run."""
        self._size += len(content) - len(self.frames.pop(run, b""))
        self.frames[run] = content
        self.cases[run] = toml
        self.cases.move_to_end(run)
        self._forget()

    def note(self, run: str, toml: str) -> None:
        """Keep the text of a case, which can be saved before it is run."""
        self.cases.setdefault(run, toml)
        self._forget()

    def frame(self, run: str) -> bytes | None:
        """Return the body of a frame that is kept."""
        if run not in self.frames:
            return None
        self.frames.move_to_end(run)
        self.cases.move_to_end(run)
        return self.frames[run]

    def pin(self, run: str) -> bool:
        """Keep a run until it is unpinned as often; return whether there is such a run."""
        if run not in self.cases:
            return False
        self.pins[run] += 1
        return True

    def unpin(self, run: str) -> None:
        """Let a run be forgotten in its time."""
        self.pins[run] -= 1
        if self.pins[run] <= 0:
            del self.pins[run]
        self._forget()

    def _forget(self) -> None:
        """Forget the runs that were looked at longest ago, but not the last one."""
        for run in [run for run in self.frames if run not in self.pins][:-1]:
            if self._size <= self.room:
                break
            self._size -= len(self.frames.pop(run))
        for run in [run for run in self.cases if run not in self.pins and run not in self.frames]:
            if len(self.cases) <= MOST_CASES:
                break
            del self.cases[run]
