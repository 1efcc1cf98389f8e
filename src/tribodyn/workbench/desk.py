"""One socket: what its page wishes, what is done about it, and what it is sent.

While a slider is dragged, a run that is under way comes to its end, and the newest wish is begun next: giving
runs up at every movement would show nothing as long as the hand moves. A wish of a hand at rest ends what is
under way for another. Of results the newest waits until the page has drawn the one before.
"""

from __future__ import annotations

import asyncio
import json
import traceback
from collections.abc import Callable, Coroutine, Mapping
from contextlib import suppress
from functools import partial
from typing import Any, Final

from tribodyn.core.errors import TribodynError
from tribodyn.workbench import frame
from tribodyn.workbench.bench import COMPILING, Bench, refusal
from tribodyn.workbench.cost import in_words, refuse_rows
from tribodyn.workbench.crew import Failed, GivenUp, Job
from tribodyn.workbench.messages import (
    Cancel,
    Drawn,
    Message,
    Misunderstood,
    Pin,
    Slope,
    Sweep,
    Values,
    Wish,
    understood,
)
from tribodyn.workbench.neighbours import neighbours
from tribodyn.workbench.series import Plan, Series, slope_of, sweep_of
from tribodyn.workbench.variant import Origin, Variant
from tribodyn.workbench.visitor import Visitor

_UNDRAWN: Final = 5.0
"""Time after which a page that says nothing is taken to have drawn [s]."""
_CALM: Final = 0.3
"""Time without a wish after which neighbours are computed [s]."""
_UNHURRIED: Final = 0.25
"""Time between two looks at wishes that are not granted while a slider is dragged [s]."""
_TOLD: Final = 1.0
"""Expected time from which a page is told what it waits for [s]."""

Send = Callable[[str | bytes], None]


def _read(origin: Origin, values: Values) -> Variant:
    """Return a case with other values, with the texts that are made of it."""
    variant = origin.varied(values)
    refuse_rows(variant.case)
    return variant.filled()


class Desk:
    """What one page is served by.

    Parameters
    ----------
    bench
        What all pages share.
    visitor
        Whose page it is.
    send
        Sends text or bytes to the page, without waiting.
    complain
        Told of errors of our own.
    """

    def __init__(self, bench: Bench, visitor: Visitor, send: Send, complain: Callable[[str], None]) -> None:
        self.bench, self.visitor, self.send, self.complain = bench, visitor, send, complain
        self.newest: Wish | None = None
        self.served: Wish | None = None
        self.before: Values = {}
        self.job: Job | None = None
        self.pins: set[str] = set()
        self.series: dict[type[Message], Series] = {}
        self.asked: dict[type[Message], int] = {}
        self._woken = asyncio.Event()
        self._undrawn: int | None = None
        self._unsent: tuple[bytes, int, int] | None = None
        self._patience: asyncio.TimerHandle | None = None
        self._tasks: set[asyncio.Task[None]] = set()
        self._ahead: asyncio.Task[None] | None = None

    def open(self) -> None:
        """Greet the page, and begin to serve it."""
        self.tell(self.bench.hello)
        if self.bench.state:
            self.tell(self.bench.state)
        self.bench.told.append(self.tell)
        self._begin(self._serve())

    def close(self) -> None:
        """Give up everything that this page asked for."""
        self.bench.told.remove(self.tell)
        for task in self._tasks:
            task.cancel()
        self._stop()
        for series in self.series.values():
            series.cancel()
        for run in self.pins:
            self.visitor.unpin(run)
        if self._patience is not None:
            self._patience.cancel()

    def tell(self, message: Mapping[str, Any]) -> None:
        """Send a message."""
        self.send(json.dumps(message))

    def hear(self, text: str | bytes) -> None:
        """Take a message of the page."""
        try:
            self._follow(understood(text))
        except Misunderstood as error:
            self.tell({"type": "error", "message": str(error)})

    def _follow(self, said: Message) -> None:
        match said:
            case Wish():
                self._wish(said)
            case Drawn(number):
                self._drawn(number)
            case Cancel(number):
                self._cancel(number)
            case Pin(run, kept):
                self._pin(run, kept)
            case Sweep() | Slope():
                self._begin(self._begin_series(said))

    def _begin(self, work: Coroutine[Any, Any, None]) -> asyncio.Task[None]:
        task = asyncio.create_task(work)
        self._tasks.add(task)
        task.add_done_callback(self._done)
        return task

    def _done(self, task: asyncio.Task[None]) -> None:
        self._tasks.discard(task)
        if not task.cancelled() and (error := task.exception()) is not None:
            self.complain("".join(traceback.format_exception(error)))
            self.tell({"type": "error", "message": "internal error; load the page again"})

    # Wishes

    def _wish(self, wish: Wish) -> None:
        running, self.newest = self.served, wish
        if self._ahead is not None:
            self._ahead.cancel()
        if running is not None and running.values != wish.values and (wish.rest or running.agreed):
            self._stop()
        self._woken.set()

    def _stop(self) -> None:
        """Give up the run that is under way, if there is one."""
        if self.job is not None:
            self.bench.crew.stop(self.job)

    async def _serve(self) -> None:
        """Grant one wish after the other, always the newest."""
        await self.bench.ready.wait()
        while True:
            await self._woken.wait()
            self._woken.clear()
            if self.newest is None:
                continue
            wish, self.newest = self.newest, None
            if self.served is not None and self.served.values != wish.values:
                self.before = self.served.values
            self.served = wish
            try:
                variant = await self.visitor.read(partial(_read, self.bench.origin, wish.values))
                granted = await self._granted(wish, variant)
            except GivenUp:
                continue
            except (TribodynError, Failed) as error:
                self.tell(refusal(wish.number, error))
                continue
            if granted and wish.rest and self.newest is None:
                self._ahead = self._begin(self._compute_neighbours(wish))

    async def _granted(self, wish: Wish, variant: Variant) -> bool:
        """Send the answer to a wish; False if the page was told why there is none."""
        kept = self.visitor.frame(variant.run)
        if kept is not None:
            self._deliver(kept, wish.number, frame.KEPT)
            return True
        if not await self._is_compiled(wish, variant):
            return False
        expected = self.bench.costs.expected(variant.case) or 0.0
        reason = self._why_ask(variant, expected)
        if reason and (not wish.agreed or expected > self.bench.rules.longest):
            self._ask(wish, reason, expected)
            return False
        if not reason and expected > self.bench.rules.dragged and not wish.rest:
            words = f"a run takes about {in_words(expected)}: it begins when you let go"
            self._state("waiting", words, expected, wish.number)
            await asyncio.sleep(_UNHURRIED)
            return False
        if expected > _TOLD:
            self._state("running", "", expected, wish.number)
        content = await self._made(wish, variant)
        self.visitor.keep(variant.run, variant.toml, content)
        self._deliver(content, wish.number, 0)
        return True

    async def _is_compiled(self, wish: Wish, variant: Variant) -> bool:
        """Have the equations compiled, if somebody agreed; False if the page was asked whether to."""
        if await self.bench.are_compiled(variant):
            return True
        if not wish.agreed:
            words = "the equations of this case are not compiled yet: that takes about a minute, once"
            self._ask(wish, words, COMPILING)
            return False
        self._state("compiling", "compiling the equations of this case", COMPILING, wish.number)
        self.job = self.bench.preparation(variant, self.visitor.budget)
        try:
            await self.bench.prepare(variant, self.job)
        finally:
            self.job = None
        return True

    def _why_ask(self, variant: Variant, expected: float) -> str:
        """Return why a run is not to be made unasked, empty if it may be."""
        if variant.case.campaign_cycles:
            return (
                f"a wear campaign is not live: it takes up to {in_words(expected)} for each cycle that it "
                f"simulates, and jumps over most of its {variant.case.campaign_cycles}"
            )
        if expected > self.bench.rules.unasked:
            return f"by the cost of the last run this takes about {in_words(expected)}"
        return ""

    def _ask(self, wish: Wish, reason: str, expected: float) -> None:
        """Ask back before a long run, or say that it is too long for this place."""
        longest = self.bench.rules.longest
        if expected > longest:
            words = f"{reason}; the most that a run may take here is {in_words(longest)}: use `tribodyn run`"
            self.tell(refusal(wish.number, TribodynError(words)))
            return
        self.tell({"type": "ask", "number": wish.number, "seconds": expected, "message": reason})

    async def _made(self, wish: Wish, variant: Variant) -> bytes:
        """Have a run made."""
        rules, total = self.bench.rules, variant.case.duration

        def heard(event: Mapping[str, Any]) -> None:
            share = min(event["reached"] / (variant.case.campaign_cycles or total), 1.0)
            self._state("running", "", None, wish.number, share)

        limit = rules.longest if wish.agreed else 3.0 * rules.unasked
        self.job = self.bench.order(variant, limit, heard, budget=self.visitor.budget)
        try:
            return await self.bench.made(variant, self.job)
        finally:
            self.job = None

    def _state(
        self, state: str, message: str, seconds: float | None, number: int, share: float | None = None
    ) -> None:
        about = {"state": state, "message": message, "seconds": seconds, "number": number, "share": share}
        self.tell({"type": "state", **about})

    def _cancel(self, number: int) -> None:
        if self.newest is not None and self.newest.number == number:
            self.newest = None
        if self.served is not None and self.served.number == number:
            self._stop()
        for series in self.series.values():
            if series.plan.number == number:
                series.cancel()
        self.asked = {kind: asked for kind, asked in self.asked.items() if asked != number}

    # Answers

    def _deliver(self, content: bytes, number: int, flags: int) -> None:
        """Send an answer, or have it wait until the page has drawn the last one."""
        if self._undrawn is not None:
            self._unsent = content, number, flags
            return
        self.send(frame.addressed(content, number, flags))
        self._undrawn = number
        loop = asyncio.get_running_loop()
        self._patience = loop.call_later(_UNDRAWN, self._drawn, number)

    def _drawn(self, number: int) -> None:
        if number != self._undrawn:
            return
        self._undrawn = None
        if self._patience is not None:
            self._patience.cancel()
        if self._unsent is not None:
            unsent, self._unsent = self._unsent, None
            self._deliver(*unsent)

    # What nobody waits for

    async def _compute_neighbours(self, wish: Wish) -> None:
        """Compute what the next step of the slider that moved last would ask for."""
        await asyncio.sleep(_CALM)
        around = partial(neighbours, self.bench.origin, wish.values, self.before)
        for values in await self.visitor.read(lambda: [*around()]):
            with suppress(TribodynError, Failed, GivenUp):
                await self._kept_ahead(await self.visitor.read(partial(_read, self.bench.origin, values)))

    async def _kept_ahead(self, variant: Variant) -> None:
        bench, rules = self.bench, self.bench.rules
        expected = bench.costs.expected(variant.case)
        if variant.run in self.visitor.frames or expected is None or expected > rules.dragged:
            return
        budget = self.visitor.budget
        job = bench.order(variant, rules.unasked, lambda event: None, background=True, budget=budget)
        try:
            self.visitor.keep(variant.run, variant.toml, await bench.made(variant, job))
        except asyncio.CancelledError:
            bench.crew.stop(job)
            raise

    async def _begin_series(self, said: Sweep | Slope) -> None:
        self.asked[type(said)] = said.number
        if (old := self.series.pop(type(said), None)) is not None:
            old.cancel()
        made: Callable[[], Plan]
        made = (
            partial(sweep_of, self.bench, said)
            if isinstance(said, Sweep)
            else partial(slope_of, self.bench, said)
        )
        try:
            plan = await self.visitor.read(made)
        except TribodynError as error:
            self.tell(refusal(said.number, error))
            return
        # Unless it was given up, or another one was asked for, while it was planned.
        if self.asked.get(type(said)) == said.number:
            self.series[type(said)] = Series(self.bench, self.visitor, plan, self.tell)

    # Pins

    def _pin(self, run: str, kept: bool) -> None:
        if not kept:
            if run in self.pins:
                self.pins.remove(run)
                self.visitor.unpin(run)
        elif run not in self.pins:
            if len(self.pins) >= self.bench.rules.pins:
                raise Misunderstood(f"at most {self.bench.rules.pins} runs can be pinned")
            if not self.visitor.pin(run):
                raise Misunderstood("this run is not kept any more")
            self.pins.add(run)
