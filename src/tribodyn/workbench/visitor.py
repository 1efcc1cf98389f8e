"""What the server keeps for one person: cases and frames of runs, with everything else forgotten in time."""

from __future__ import annotations

import asyncio
import secrets
import time
from collections import Counter, OrderedDict
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Final, TypeVar

MOST_CASES: Final = 1000
_SECRET_BYTES: Final = 32
_HALF_LIFE: Final = 60.0
"""Time after which half of what somebody took is forgotten [s]."""
_T = TypeVar("_T")


@dataclass
class Budget:
    """Time of workers that somebody took lately."""

    _seconds: float = 0.0
    _since: float = field(default_factory=time.monotonic)

    def charge(self, seconds: float) -> None:
        """Add the time of a job [s]."""
        self._seconds, self._since = self.taken + seconds, time.monotonic()

    @property
    def taken(self) -> float:
        """How much was taken [s]; what was long ago counts less."""
        return float(self._seconds * 0.5 ** ((time.monotonic() - self._since) / _HALF_LIFE))


@dataclass
class Visitor:
    """Runs that one person has seen.

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
    sockets
        Pages that are open.
    downloading
        Held while a file is made: one at a time.
    budget
        What they took of the workers.
    secret
        Held by their pages alone, and part of every request for more than the page. A browser sends a cookie
        to every port of the name that it came from, but gives this to pages of this port alone.
    """

    room: int
    cases: OrderedDict[str, str] = field(default_factory=OrderedDict)
    frames: OrderedDict[str, bytes] = field(default_factory=OrderedDict)
    pins: Counter[str] = field(default_factory=Counter)
    sockets: int = 0
    downloading: asyncio.Lock = field(default_factory=asyncio.Lock)
    secret: str = field(default_factory=lambda: secrets.token_urlsafe(_SECRET_BYTES))
    budget: Budget = field(default_factory=Budget)
    _size: int = 0
    _reading: asyncio.Lock = field(default_factory=asyncio.Lock)
    _free_at: float = 0.0

    async def read(self, work: Callable[[], _T]) -> _T:
        """Return the outcome of work on a case that was asked for, done beside the loop that serves all.

        Each visitor has one piece of work done at a time, and then none for as long as it took: nobody has
        more than half a processor. What was begun is finished even if nobody waits for it any more.
        """
        reading = asyncio.ensure_future(self._read(work))
        reading.add_done_callback(lambda done: done.cancelled() or done.exception())
        return await asyncio.shield(reading)

    async def _read(self, work: Callable[[], _T]) -> _T:
        loop = asyncio.get_running_loop()
        async with self._reading:
            await asyncio.sleep(self._free_at - loop.time())
            began = loop.time()
            try:
                return await asyncio.to_thread(work)
            finally:
                self._free_at = 2.0 * loop.time() - began

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
