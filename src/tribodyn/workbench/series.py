"""Background runs along one key: a sweep, and the slope at a value."""

import asyncio
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.cases.keys import Key, ValueProblem
from tribodyn.cases.tables import plain_path
from tribodyn.core.errors import InputError
from tribodyn.results.summary import EFFORT
from tribodyn.workbench import messages
from tribodyn.workbench.controls import shown_number, text
from tribodyn.workbench.messages import SlopeRequest, Sweep, Values
from tribodyn.workbench.server_state import ServerState, in_words, refuse_rows
from tribodyn.workbench.variant import Origin, Variant
from tribodyn.workbench.worker_pool import Failed, GivenUp

AROUND: Final = (-0.10, -0.05, 0.0, 0.05, 0.10)  #: Points at which a slope is fitted, relative to the value.
_DIGITS: Final = 10

Report = Callable[[Mapping[str, Any]], None]
Point = dict[str, Any]
Said = Callable[[Sequence[Point], bool], dict[str, Any]]


@dataclass(frozen=True)
class SeriesPlan:
    """Runs along a key."""

    number: int  #: Of the request.
    variants: Sequence[Variant]  #: What is run.
    key: Key  #: The key that they differ in.
    say: Said  #: Returns the message after each point, from all points so far and whether it was the last.


class Series:
    """Runs that are made one after the other while no other job waits.

    ``state``: state of the server; ``plan``: what is run; ``report``: sends a message to the page.
    """

    def __init__(self, state: ServerState, plan: SeriesPlan, report: Report) -> None:
        self.state, self.plan, self.report = state, plan, report
        self._task = asyncio.create_task(self._compute())

    def cancel(self) -> None:
        """Stop it."""
        self._task.cancel()

    async def _compute(self) -> None:
        points: list[Point] = []
        with suppress(GivenUp):
            for variant in self.plan.variants:
                points.append(await self._point(variant))
                self.report(self.plan.say(points, len(points) == len(self.plan.variants)))

    async def _point(self, variant: Variant) -> Point:
        key = self.plan.key
        value = variant.case.at(key.path)
        point: Point = {
            "value": shown_number(key, value),
            "text": text(key, value),
            "run": variant.run,
            "results": {},
            "failure": "",
        }
        try:
            found = messages.header(await self._frame(variant))
        except Failed as error:
            return point | {"failure": str(error)}
        return point | {name: found[name] for name in ("results", "failure")}

    async def _frame(self, variant: Variant) -> bytes:
        kept = self.state.kept.frame(variant.run)
        if kept is not None:
            return kept
        unasked = self.state.rules.unasked
        job = self.state.order(variant, unasked, lambda event: None, background=True)
        try:
            content = await self.state.made(variant, job)
        except asyncio.CancelledError:
            self.state.pool.stop(job)
            raise
        self.state.kept.keep(variant.run, variant.toml, content)
        return content


@dataclass(frozen=True)
class _Along:
    """A key, and the values of the others."""

    state: ServerState
    origin: Origin
    key: Key
    values: Values

    def variants(self, texts: Iterator[str]) -> list[Variant]:
        """Return the cases with these values of the key; refuse those that take too long."""
        found: dict[str, Variant] = {}
        for value in texts:
            variant = self.origin.varied({**self.values, self.key.path: value})
            refuse_rows(variant.case)
            self._refuse_long(variant)
            found.setdefault(variant.run, variant.filled())
        return list(found.values())

    def _refuse_long(self, variant: Variant) -> None:
        expected, most = self.state.costs.expected(variant.case), self.state.rules.unasked
        if variant.case.campaign_cycles:
            raise InputError("points with wear campaigns are for `tribodyn sweep`", key="wear.cycles")
        if expected is not None and expected > most:
            raise InputError(
                f"a point takes about {in_words(expected)}, {in_words(most)} are the most here: use "
                "`tribodyn sweep`",
                key=self.key.path,
            )


def _along(state: ServerState, origin: Origin, path: str, values: Values) -> _Along:
    keys = origin.keys
    path = plain_path(path, keys)
    if path not in keys:
        raise InputError("there is no such key", key=path)
    return _Along(state, origin, keys[path], {name: value for name, value in values.items() if name != path})


def sweep_of(state: ServerState, origin: Origin, asked: Sweep) -> SeriesPlan:
    """Plan a sweep of a case that a page shows.

    Raises InputError if there is nothing to sweep over.
    """
    along = _along(state, origin, asked.key, asked.values)
    variants = along.variants(_levels(along.key, asked))

    def say(points: Sequence[Point], finished: bool) -> dict[str, Any]:
        about = {"number": asked.number, "key": asked.key, "points": points}
        return {"type": "sweep", **about, "of": len(variants), "finished": finished}

    return SeriesPlan(asked.number, variants, along.key, say)


def _levels(key: Key, asked: Sweep) -> Iterator[str]:
    """Yield the values of a sweep: all choices, or evenly from one end to the other."""
    if key.choices:
        yield from key.choices
    elif key.kind == "switch":
        yield from ("false", "true")
    else:
        first, last = (_number(key, end) for end in asked.ends)
        for number in np.linspace(first, last, asked.points):
            yield _written(key, float(number))


def _number(key: Key, end: str) -> float:
    """Return one end of a sweep in the unit of its key."""
    try:
        value = key.read(end, text=True)
    except ValueProblem as problem:
        raise InputError(str(problem) or f"allowed: {key.allowed}", key=key.path) from None
    number = shown_number(key, value)
    if number is None:
        raise InputError("only numbers and choices can be swept", key=key.path)
    return number


def _written(key: Key, number: float) -> str:
    """Return a number as a person writes it, with its unit."""
    if key.kind == "count":
        return str(round(number))
    return f"{float(f'{number:.{_DIGITS}g}')!r} {key.unit}".strip()


def slope_of(state: ServerState, origin: Origin, asked: SlopeRequest) -> SeriesPlan:
    """Plan to find the slope at the present value of a key.

    Raises InputError if the value is no number, or zero.
    """
    along = _along(state, origin, asked.key, asked.values)
    middle = shown_number(along.key, origin.varied(asked.values).case.at(along.key.path))
    if not middle:
        raise InputError("a slope needs a number other than zero", key=asked.key)
    variants = along.variants(_written(along.key, middle * (1.0 + share)) for share in AROUND)

    def say(points: Sequence[Point], finished: bool) -> dict[str, Any]:
        about = {"number": asked.number, "key": asked.key, "done": len(points), "of": len(variants)}
        return {"type": "slope", **about, "finished": finished, "results": slopes(points) if finished else {}}

    return SeriesPlan(asked.number, variants, along.key, say)


def slopes(points: Sequence[Point]) -> dict[str, dict[str, float]]:
    """Return the slopes of key results over a key, in percent a percent, with their standard errors.

    The straight line of least squares through all points; numbers that a point lacks, or that are zero on
    average, have none.

    ``points``: with ``value`` and ``results``.
    """
    names = set.intersection(*(set(point["results"]) for point in points)) if points else set()
    names -= EFFORT.keys()
    x = np.array([point["value"] for point in points], dtype=np.float64)
    found = {}
    for name in names:
        y = np.array([point["results"][name] for point in points], dtype=np.float64)
        if x.size > 2 and y.mean() != 0.0 and np.ptp(x) > 0.0:
            found[name] = _fitted(x / x.mean() - 1.0, y / y.mean())
    return found


def _fitted(x: FloatArray, y: FloatArray) -> dict[str, float]:
    """Return the slope of the straight line of least squares, and its standard error."""
    dx, dy = x - x.mean(), y - y.mean()
    slope = float(dx @ dy / (dx @ dx))
    left = dy - slope * dx
    return {"slope": slope, "scatter": float(np.sqrt(left @ left / (x.size - 2) / (dx @ dx)))}
