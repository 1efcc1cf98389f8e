"""What all visitors of a server share: the case it was started with, the workers, and what runs cost."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, Final

from tribodyn.cases.choices import Choices, choices_of
from tribodyn.core.errors import InputError, TribodynError
from tribodyn.core.versions import version
from tribodyn.mechanisms.base import Mechanism
from tribodyn.mechanisms.results import headlines_of_case
from tribodyn.results import Headline
from tribodyn.workbench.controls import controls
from tribodyn.workbench.cost import Costs
from tribodyn.workbench.crew import Crew, Failed, Job
from tribodyn.workbench.messages import LARGEST
from tribodyn.workbench.variant import Origin, Variant
from tribodyn.workbench.visitor import Budget

COMPILING: Final = 60.0
"""Time that compiling usually takes [s]."""
_LEAST_SHARE: Final = 0.01
"""Share of a long run that counts as reached when nothing was told of it."""
DOWNLOADS: Final = ("case.toml", "result.nc", "report.html")
Heard = Callable[[Mapping[str, Any]], None]


@dataclass(frozen=True)
class Rules:
    """How much a visitor may ask for.

    Attributes
    ----------
    dragged
        Expected time of a run up to which it is made while a slider is dragged [s].
    unasked
        Expected time up to which it is made without asking back [s].
    longest
        Time that a run may take [s].
    pins, sockets, each
        Pinned runs of a socket; sockets of the whole server and of one visitor.
    messages
        Messages a second that are read from a socket.
    room
        Size of the frames kept for a visitor [bytes].
    """

    dragged: float = 2.0
    unasked: float = 10.0
    longest: float = 900.0
    pins: int = 8
    sockets: int = 32
    each: int = 32
    messages: int = 60
    room: int = 100_000_000


@dataclass
class Bench:
    """The shared part of a workbench.

    Attributes
    ----------
    origin, mechanism
        The case it was started with, and what is known of its kind.
    crew
        The workers.
    rules
        What visitors may ask for.
    state
        The last state of the whole bench that was told: ``state``, ``message`` and ``seconds``.
    told
        Called with every new one.
    """

    origin: Origin
    mechanism: Mechanism
    crew: Crew
    rules: Rules = field(default_factory=Rules)
    costs: Costs = field(default_factory=Costs)
    compiled: set[Choices] = field(default_factory=set)
    state: dict[str, Any] = field(default_factory=dict)
    told: list[Callable[[Mapping[str, Any]], None]] = field(default_factory=list)
    ready: asyncio.Event = field(default_factory=asyncio.Event)

    async def warm(self) -> None:
        """Start the workers, have the equations of the case ready, and make its run in each of them."""
        self._tell("loading", "loading the equations of this case", 3.0)
        try:
            await self.crew.start()
            variant = self.origin.varied({})
            if not await self.are_compiled(variant):
                words = "compiling the equations for this machine; later starts take seconds"
                self._tell("compiling", words, COMPILING)
                await self.prepare(variant, self.preparation(variant))
            # Each worker loads them for itself.
            await asyncio.gather(*(self.crew.do(self.preparation(variant)) for _ in self.crew.workers))
            await asyncio.gather(*(self._try(variant) for _ in self.crew.workers))
            self._tell("ready", "", None)
        except (Failed, TribodynError, OSError) as error:
            self._tell("failed", str(error), None)
        self.ready.set()

    async def _try(self, variant: Variant) -> None:
        """Make a run, or begin one that is long, to know what runs cost."""
        if variant.case.campaign_cycles:
            variant = variant.origin.varied({**variant.values, "wear.cycles": "0"})
        reached, duration = 0.0, variant.case.duration

        def heard(event: Mapping[str, Any]) -> None:
            nonlocal reached
            reached = event["reached"]

        job = self.order(variant, self.rules.unasked, heard)
        try:
            await self.made(variant, job)
        except Failed:
            if job.verdict is None:
                raise
            self.costs.note(variant.case, job.took * duration / max(reached, _LEAST_SHARE * duration))

    def _tell(self, state: str, message: str, seconds: float | None) -> None:
        self.state = {"type": "state", "state": state, "message": message, "seconds": seconds}
        for told in self.told:
            told(self.state)

    async def are_compiled(self, variant: Variant) -> bool:
        """Tell whether the equations of a case are compiled; a worker that finds them loads them."""
        if choices_of(variant.case) in self.compiled:
            return True
        answer = await self.crew.do(Job({"work": "load", "case": variant.toml}, self.rules.longest))
        if answer == b"true":
            self.compiled.add(choices_of(variant.case))
        return answer == b"true"

    def preparation(self, variant: Variant, budget: Budget | None = None) -> Job:
        """Return the job that has the equations of a case compiled and loaded, as :meth:`order` does."""
        order = {"work": "prepare", "case": variant.toml}
        return Job(order, self.rules.longest, budget=budget or Budget())

    async def prepare(self, variant: Variant, job: Job) -> None:
        """Have the equations of a case compiled."""
        await self.crew.do(job)
        self.compiled.add(choices_of(variant.case))

    def order(
        self,
        variant: Variant,
        seconds: float,
        heard: Heard,
        *,
        background: bool = False,
        budget: Budget | None = None,
    ) -> Job:
        """Return the job that makes the frame of a case, for whoever has this budget."""
        order = {"work": "picture", "case": variant.toml, "told": variant.told}
        return Job(order, seconds, background, heard, budget or Budget())

    async def made(self, variant: Variant, job: Job) -> bytes:
        """Return the body of the frame that a job makes, and remember what it took."""
        content = await self.crew.do(job)
        if not variant.case.campaign_cycles:
            self.costs.note(variant.case, job.took)
        self.compiled.add(choices_of(variant.case))
        return content

    @cached_property
    def hello(self) -> dict[str, Any]:
        """What a page is told first."""
        case = self.origin.case
        sections = [
            {
                "name": section.name,
                "title": section.title,
                "caption": section.caption,
                "widget": section.widget,
                "chapter": chapter.name,
                "playback": chapter.playback,
            }
            for chapter in self.mechanism.chapters
            for section in chapter.sections
        ]
        return {
            "type": "hello",
            "title": case.title,
            "mechanism": case.kind(),
            "case": self.origin.name,
            "version": version("tribodyn"),
            "controls": controls(case, self.mechanism.controls),
            "headlines": self._headlines(),
            "chapters": [
                {"name": chapter.name, "title": chapter.title, "lead": chapter.lead}
                for chapter in self.mechanism.chapters
            ],
            "sections": sections,
            "downloads": list(DOWNLOADS),
            "limits": {
                "pins": self.rules.pins,
                "messages_per_second": self.rules.messages,
                "message_bytes": LARGEST,
            },
        }

    def _headlines(self) -> list[dict[str, Any]]:
        """Return the headline numbers, those that hold first: impacts depend on what was before."""
        key = self.mechanism.key_numbers
        known = headlines_of_case(self.origin.case)
        found = [_headline(name, about, name in key) for name, about in known.items()]
        return sorted(found, key=lambda number: (not number["robust"], not number["key"]))


def _headline(name: str, about: Headline, key: bool) -> dict[str, Any]:
    """Return a headline number as the page reads it."""
    return {
        "name": name,
        "label": about.label,
        "unit": about.unit,
        "group": about.group,
        "meaning": about.meaning,
        "digits": about.digits,
        "robust": not about.over,
        "key": key,
    }


def refusal(number: int, error: Exception) -> dict[str, Any]:
    """Return what the page is told of a wish that cannot be."""
    faults = error.faults if isinstance(error, InputError) else ()
    told = [{"key": fault.key, "message": fault.reason} for fault in faults]
    return {
        "type": "refused",
        "number": number,
        "message": str(error),
        "faults": told or [{"key": None, "message": str(error)}],
    }
