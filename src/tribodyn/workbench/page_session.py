"""Session of one page: its requests, the runs that answer them, and what is sent over its socket.

While a slider is dragged, the run under way is completed, and the newest request is served next: with a run
stopped at every movement nothing would be shown before the drag ends. A request at the end of a gesture stops
the run of another request. The newest result waits until the page has drawn the one before.
"""

import asyncio
import json
import traceback
from collections.abc import Callable, Coroutine, Mapping
from contextlib import suppress
from dataclasses import replace
from functools import partial
from typing import Any, Final

from tribodyn.core.errors import TribodynError
from tribodyn.workbench import messages
from tribodyn.workbench.edits import edited
from tribodyn.workbench.series import Series, SeriesPlan, slope_of, sweep_of
from tribodyn.workbench.server_state import ServerState, in_words, refusal, refuse_rows
from tribodyn.workbench.variant import Origin, Variant, neighbours
from tribodyn.workbench.worker_pool import Failed, GivenUp, Job

_UNDRAWN: Final = 5.0  #: Time after which a page that says nothing is taken to have drawn [s].
_CALM: Final = 0.3  #: Time without a request after which neighbours are computed [s].
_UNHURRIED: Final = 0.25  #: Pause after a request that is not served while a slider is dragged [s].
_REPORTED: Final = 1.0  #: Expected time from which the progress of a run is reported [s].

Send = Callable[[str | bytes], None]


def _read(origin: Origin, values: messages.Values) -> Variant:
    """Return a case with other values, and the texts derived from it."""
    variant = origin.varied(values)
    refuse_rows(variant.case)
    return variant.filled()


def _opened(request: messages.RunRequest, variant: Variant) -> messages.RunRequest:
    """Return the request for the case that the workbench opens as agreed: the page begins with its run."""
    opens = not request.values and request.edit == messages.Edit() and not variant.case.campaign_cycles
    return replace(request, agreed=True) if opens else request


def _same(one: messages.RunRequest, other: messages.RunRequest) -> bool:
    """Return whether two requests are for the same run."""
    return one.values == other.values and one.edit == other.edit


class PageSession:
    """Serves one page.

    ``state``: shared by all pages; ``send``: sends text or bytes to the page, without waiting; ``log_error``:
    called with internal errors.
    """

    def __init__(self, state: ServerState, send: Send, log_error: Callable[[str], None]) -> None:
        self.state, self.send, self.log_error = state, send, log_error
        self.origin, self.edit = state.origin, messages.Edit()
        self.newest: messages.RunRequest | None = None
        self.served: messages.RunRequest | None = None
        self.before: messages.Values = {}
        self.job: Job | None = None
        self.pins: set[str] = set()
        self.series: dict[type[messages.Message], Series] = {}
        self.asked: dict[type[messages.Message], int] = {}
        self._woken = asyncio.Event()
        self._undrawn: int | None = None
        self._unsent: tuple[bytes, int, int] | None = None
        self._patience: asyncio.TimerHandle | None = None
        self._tasks: set[asyncio.Task[None]] = set()
        self._ahead: asyncio.Task[None] | None = None

    def open(self) -> None:
        """Describe the case to the page, and begin to serve it."""
        self.report(self.state.hello)
        if self.state.status:
            self.report(self.state.status)
        self.state.listeners.append(self.report)
        self._begin(self._serve())

    def close(self) -> None:
        """Stop all work for this page."""
        self.state.listeners.remove(self.report)
        for task in self._tasks:
            task.cancel()
        self._stop()
        for series in self.series.values():
            series.cancel()
        for run in self.pins:
            self.state.kept.unpin(run)
        if self._patience is not None:
            self._patience.cancel()

    def report(self, message: Mapping[str, Any]) -> None:
        """Send a message."""
        self.send(json.dumps(message))

    def receive(self, text: str | bytes) -> None:
        """Take a message of the page."""
        try:
            self._dispatch(messages.parsed(text))
        except messages.InvalidMessage as error:
            self.report({"type": "error", "message": str(error)})

    def _dispatch(self, said: messages.Message) -> None:
        match said:
            case messages.RunRequest():
                self._request_run(said)
            case messages.Drawn(number):
                self._drawn(number)
            case messages.Cancel(number):
                self._cancel(number)
            case messages.Pin(run, kept):
                self._pin(run, kept)
            case messages.Sweep() | messages.SlopeRequest():
                self._begin(self._begin_series(said))

    def _begin(self, work: Coroutine[Any, Any, None]) -> asyncio.Task[None]:
        task = asyncio.create_task(work)
        self._tasks.add(task)
        task.add_done_callback(self._done)
        return task

    def _done(self, task: asyncio.Task[None]) -> None:
        self._tasks.discard(task)
        if not task.cancelled() and (error := task.exception()) is not None:
            self.log_error("".join(traceback.format_exception(error)))
            self.report({"type": "error", "message": "internal error; load the page again"})

    # Requests

    def _request_run(self, request: messages.RunRequest) -> None:
        running, self.newest = self.served, request
        if self._ahead is not None:
            self._ahead.cancel()
        if running is not None and not _same(running, request) and (request.rest or running.agreed):
            self._stop()
        self._woken.set()

    def _stop(self) -> None:
        """Stop the run that is under way, if there is one."""
        if self.job is not None:
            self.state.pool.stop(self.job)

    async def _serve(self) -> None:
        """Serve one request after the other, always the newest."""
        await self.state.ready.wait()
        while True:
            await self._woken.wait()
            self._woken.clear()
            if self.newest is None:
                continue
            request, self.newest = self.newest, None
            if self.served is not None and not _same(self.served, request):
                self.before = self.served.values
            self.served = request
            try:
                await self._edit(request.edit)
                variant = await asyncio.to_thread(_read, self.origin, request.values)
                request = self.served = _opened(request, variant)
                answered = await self._answer(request, variant)
            except GivenUp:
                continue
            except (TribodynError, Failed) as error:
                self.report(refusal(request.number, error))
                continue
            if answered and request.rest and self.newest is None:
                self._ahead = self._begin(self._compute_neighbours(request))

    async def _edit(self, edit: messages.Edit) -> None:
        """Take the case as the page has edited it, and describe it to the page."""
        if edit == self.edit:
            return
        self.origin = await asyncio.to_thread(edited, self.state.origin, edit)
        self.edit, self.before = edit, {}
        description = await asyncio.to_thread(self.state.described, self.origin, edit)
        unchanged = self.origin.varied({})
        self.state.kept.note(unchanged.run, unchanged.toml)
        self.report({"type": "model", **description})

    async def _answer(self, request: messages.RunRequest, variant: Variant) -> bool:
        """Send the answer to a request; False if the page got the reason why there is none."""
        kept = self.state.kept.frame(variant.run)
        if kept is not None:
            self._deliver(kept, request.number, messages.KEPT)
            return True
        expected = self.state.costs.expected(variant.case) or 0.0
        reason = self._why_ask(variant, expected)
        if reason and (not request.agreed or expected > self.state.rules.longest):
            self._ask(request, reason, expected)
            return False
        if not reason and expected > self.state.rules.dragged and not request.rest:
            words = f"a run takes about {in_words(expected)}: it begins when you let go"
            self._report_state("waiting", words, expected, request.number)
            await asyncio.sleep(_UNHURRIED)
            return False
        if expected > _REPORTED:
            self._report_state("running", "", expected, request.number)
        content = await self._made(request, variant)
        self.state.kept.keep(variant.run, variant.toml, content)
        self._deliver(content, request.number, 0)
        return True

    def _why_ask(self, variant: Variant, expected: float) -> str:
        """Return why the user must agree to a run, empty if that is not necessary."""
        if variant.case.campaign_cycles:
            return (
                f"a wear campaign is not live: it takes up to {in_words(expected)} for each cycle that it "
                f"simulates, and jumps over most of its {variant.case.campaign_cycles}"
            )
        if expected > self.state.rules.unasked:
            return f"This run takes about {in_words(expected)}, as the last runs suggest."
        return ""

    def _ask(self, request: messages.RunRequest, reason: str, expected: float) -> None:
        """Ask the user before a long run, or refuse one that is too long for this server."""
        longest = self.state.rules.longest
        if expected > longest:
            most = in_words(longest)
            words = f"{reason.rstrip('.')}; the most that a run may take here is {most}: use `tribodyn run`"
            self.report(refusal(request.number, TribodynError(words)))
            return
        self.report({"type": "ask", "number": request.number, "seconds": expected, "message": reason})

    async def _made(self, request: messages.RunRequest, variant: Variant) -> bytes:
        """Return the body of the frame of a run."""
        rules, total = self.state.rules, variant.case.duration

        def on_event(event: Mapping[str, Any]) -> None:
            share = min(event["reached"] / (variant.case.campaign_cycles or total), 1.0)
            self._report_state("running", "", None, request.number, share)

        known = self.state.costs.knows(variant.case)
        limit = 3.0 * rules.unasked if known and not request.agreed else rules.longest
        self.job = self.state.order(variant, limit, on_event)
        try:
            return await self.state.made(variant, self.job)
        finally:
            self.job = None

    def _report_state(
        self, state: str, message: str, seconds: float | None, number: int, share: float | None = None
    ) -> None:
        about = {"state": state, "message": message, "seconds": seconds, "number": number, "share": share}
        self.report({"type": "state", **about})

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
        """Send an answer, or keep it until the page has drawn the last one."""
        if self._undrawn is not None:
            self._unsent = content, number, flags
            return
        self.send(messages.addressed(content, number, flags))
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

    # Background work

    async def _compute_neighbours(self, request: messages.RunRequest) -> None:
        """Compute the runs one step to either side of the slider that moved last."""
        await asyncio.sleep(_CALM)
        around = partial(neighbours, self.origin, request.values, self.before)
        for values in await asyncio.to_thread(lambda: [*around()]):
            with suppress(TribodynError, Failed, GivenUp):
                await self._kept_ahead(await asyncio.to_thread(_read, self.origin, values))

    async def _kept_ahead(self, variant: Variant) -> None:
        state, rules = self.state, self.state.rules
        expected = state.costs.expected(variant.case)
        if variant.run in self.state.kept.frames or expected is None or expected > rules.dragged:
            return
        job = state.order(variant, rules.unasked, lambda event: None, background=True)
        try:
            self.state.kept.keep(variant.run, variant.toml, await state.made(variant, job))
        except asyncio.CancelledError:
            state.pool.stop(job)
            raise

    async def _begin_series(self, said: messages.Sweep | messages.SlopeRequest) -> None:
        self.asked[type(said)] = said.number
        if (old := self.series.pop(type(said), None)) is not None:
            old.cancel()
        made: Callable[[], SeriesPlan]
        made = (
            partial(sweep_of, self.state, self.origin, said)
            if isinstance(said, messages.Sweep)
            else partial(slope_of, self.state, self.origin, said)
        )
        try:
            plan = await asyncio.to_thread(made)
        except TribodynError as error:
            self.report(refusal(said.number, error))
            return
        # Unless it was cancelled or replaced while it was planned.
        if self.asked.get(type(said)) == said.number:
            self.series[type(said)] = Series(self.state, plan, self.report)

    # Pins

    def _pin(self, run: str, kept: bool) -> None:
        if not kept:
            if run in self.pins:
                self.pins.remove(run)
                self.state.kept.unpin(run)
        elif run not in self.pins:
            if len(self.pins) >= self.state.rules.pins:
                raise messages.InvalidMessage(f"at most {self.state.rules.pins} runs can be pinned")
            if not self.state.kept.pin(run):
                raise messages.InvalidMessage("this run is not kept any more")
            self.pins.add(run)
