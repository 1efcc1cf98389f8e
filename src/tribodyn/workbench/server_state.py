"""State that all pages of a server share: the case, the workers, the kept runs, and the cost of runs."""

import asyncio
import math
from collections import Counter, OrderedDict
from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass, field
from functools import cached_property
from statistics import median
from typing import Any, Final

from tribodyn.cases.case import Case
from tribodyn.cases.tables import keys_in
from tribodyn.cases.write import Choices, choices_of
from tribodyn.core.errors import InputError, TribodynError
from tribodyn.workbench.description import description
from tribodyn.workbench.messages import LARGEST, Edit
from tribodyn.workbench.variant import Origin, Variant
from tribodyn.workbench.worker_pool import Failed, Job, WorkerPool

MOST_ROWS: Final = 100_000  #: Rows of a result that a page is sent, at most.
#: Number of runs from which the next one is estimated: a single one may have met a busy machine.
_LAST: Final = 5
_NO_GRID: Final = ("run", "wear")  #: Tables whose whole numbers do not say how fine a grid is.
#: Exponent of the number of steps over the relative tolerance, for a method of the fourth order or so.
_TOLERANCE_POWER: Final = -0.2


@dataclass
class Costs:
    """Seconds that runs took, by their equations."""

    #: Of the last runs with these equations, for a case of size one.
    seconds: Mapping[Choices, tuple[float, ...]] = field(default_factory=dict)

    def note(self, case: Case, seconds: float) -> None:
        """Remember the time of a run."""
        choices = choices_of(case)
        last = (*self.seconds.get(choices, ()), seconds / size(case))[-_LAST:]
        # Anew: threads may be looking at the ones before.
        self.seconds = {**self.seconds, choices: last}

    def knows(self, case: Case) -> bool:
        """Return whether a run with these equations was made before."""
        return choices_of(case) in self.seconds

    def expected(self, case: Case) -> float | None:
        """Return the expected time of a run [s], as if all equations cost the same; None before any run."""
        seconds = self.seconds
        if not seconds:
            return None
        last = next(reversed([*seconds.values()]))
        return median(seconds.get(choices_of(case), last)) * size(case)


def size(case: Case) -> float:
    """Return the amount of work of a case: its time, its nodes and its tolerance, in no particular unit."""
    found = case.duration
    for path, key in keys_in(case).items():
        value = case.at(path) if key.kind == "count" and path.partition(".")[0] not in _NO_GRID else None
        if isinstance(value, int) and value > 0:
            found *= value / float(key.example or 1.0)
    tolerance = case.at("solver.rtol")
    return found * tolerance**_TOLERANCE_POWER if isinstance(tolerance, float) else found


def refuse_rows(case: Case) -> None:
    """Refuse a case whose result no page could hold."""
    interval = case.at("run.output_interval")
    if isinstance(interval, float) and case.duration / interval > MOST_ROWS:
        raise InputError(
            f"these are {case.duration / interval:.3g} rows; a page holds {MOST_ROWS}: lengthen it, or use "
            "`tribodyn run`",
            key="run.output_interval",
        )


def in_words(seconds: float) -> str:
    """Return a time as a person says it."""
    if seconds < 100.0:
        return f"{max(seconds, 0.1):.2g} s"
    if seconds < 6000.0:
        return f"{math.ceil(seconds / 60.0)} minutes"
    return f"{seconds / 3600.0:.2g} hours"


MOST_CASES: Final = 1000


@dataclass
class KeptRuns:
    """Runs that the pages have shown."""

    room: int  #: Size of the frames that are kept [bytes]; the last one is kept in any case.
    #: Texts of cases by the names of their runs, the latest last.
    cases: OrderedDict[str, str] = field(default_factory=OrderedDict)
    frames: OrderedDict[str, bytes] = field(default_factory=OrderedDict)  #: Bodies of frames, likewise.
    #: How often each pinned run is pinned; neither its case nor its frame is forgotten.
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


_LEAST_SHARE: Final = 0.01  #: Share of a long run that counts as completed when no progress was reported.
OnEvent = Callable[[Mapping[str, Any]], None]


@dataclass(frozen=True)
class Rules:
    """Limits of what pages may request."""

    dragged: float = 2.0  #: Expected time of a run up to which it is made while a slider is dragged [s].
    unasked: float = 10.0  #: Expected time up to which the user need not agree [s].
    longest: float = 900.0  #: Time that a run may take [s].
    #: Pinned runs of a socket; sockets of the server.
    pins: int = 8
    sockets: int = 32
    messages: int = 60  #: Messages a second that are read from a socket.
    room: int = 100_000_000  #: Size of the frames that are kept [bytes].


@dataclass
class ServerState:
    """State that all pages of a server share."""

    origin: Origin  #: The case it was started with.
    pool: WorkerPool  #: The workers.
    rules: Rules = field(default_factory=Rules)  #: Limits of what pages may request.
    costs: Costs = field(default_factory=Costs)
    #: The last status reported to all pages: ``state``, ``message`` and ``seconds``.
    status: dict[str, Any] = field(default_factory=dict)
    #: Called with every new one.
    listeners: list[Callable[[Mapping[str, Any]], None]] = field(default_factory=list)
    ready: asyncio.Event = field(default_factory=asyncio.Event)
    #: Held while a file is made: one at a time.
    downloading: asyncio.Lock = field(default_factory=asyncio.Lock)

    @cached_property
    def kept(self) -> KeptRuns:
        """Runs that the pages have shown."""
        return KeptRuns(self.rules.room)

    async def warm(self) -> None:
        """Start the workers, and make the run of the case in each of them."""
        self._report("loading", "loading the equations of this case", 3.0)
        try:
            await self.pool.start()
            variant = self.origin.varied({})
            await asyncio.gather(*(self._try(variant) for _ in self.pool.workers))
            self._report("ready", "", None)
        except (Failed, TribodynError, OSError) as error:
            self._report("failed", str(error), None)
        self.ready.set()

    async def _try(self, variant: Variant) -> None:
        """Make a run, or begin one that is long, to measure what runs cost."""
        if variant.case.campaign_cycles:
            variant = variant.origin.varied({**variant.values, "wear.cycles": "0"})
        reached, duration = 0.0, variant.case.duration

        def on_event(event: Mapping[str, Any]) -> None:
            nonlocal reached
            reached = event["reached"]

        job = self.order(variant, self.rules.unasked, on_event)
        try:
            await self.made(variant, job)
        except Failed:
            if job.verdict is None:
                raise
            self.costs.note(variant.case, job.took * duration / max(reached, _LEAST_SHARE * duration))

    def _report(self, state: str, message: str, seconds: float | None) -> None:
        self.status = {"type": "state", "state": state, "message": message, "seconds": seconds}
        for listener in self.listeners:
            listener(self.status)

    def order(self, variant: Variant, seconds: float, on_event: OnEvent, *, background: bool = False) -> Job:
        """Return the job that makes the frame of a case."""
        order = {"work": "picture", "case": variant.toml, "header": variant.header}
        return Job(order, seconds, background, on_event)

    async def made(self, variant: Variant, job: Job) -> bytes:
        """Return the body of the frame that a job makes, and remember what it took."""
        content = await self.pool.do(job)
        if not variant.case.campaign_cycles:
            self.costs.note(variant.case, job.took)
        return content

    @cached_property
    def hello(self) -> dict[str, Any]:
        """First message to a page."""
        return {"type": "hello", **self.described(self.origin, Edit())}

    def described(self, origin: Origin, edit: Edit) -> dict[str, Any]:
        """Return the description of a case for a page, and of the edit that made it."""
        return {**description(origin), "edit": asdict(edit), "limits": self._limits}

    @property
    def _limits(self) -> dict[str, int]:
        return {"pins": self.rules.pins, "messages_per_second": self.rules.messages, "message_bytes": LARGEST}


def refusal(number: int, error: Exception) -> dict[str, Any]:
    """Return the message that refuses a request."""
    faults = error.faults if isinstance(error, InputError) else ()
    found = [{"key": fault.key, "message": fault.reason} for fault in faults]
    return {
        "type": "refused",
        "number": number,
        "message": str(error),
        "faults": found or [{"key": None, "message": str(error)}],
    }
