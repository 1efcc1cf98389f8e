"""Types of a claim, and the judgement of a measured number by bounds with their origins."""

import inspect
import math
import tomllib
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import partial
from importlib.resources import files
from typing import Final, Literal, NamedTuple, Self, TypeAlias

import numpy as np
import xarray as xr

from mebdf.arrays import FloatArray
from tribodyn.papers.cheng_2022.runs import CLEARANCES, Runs, is_smooth, mean_rate, smooth

Verdict: TypeAlias = Literal[
    "reproduced", "on a condition", "differs", "contradicted", "not decidable", "not tested"
]
Chooser: TypeAlias = Literal["the paper", "we"]
Range: TypeAlias = tuple[float, float]

#: All verdicts, each with its meaning.
VERDICTS: Final[dict[Verdict, str]] = {
    "reproduced": "the number is strictly inside the bound",
    "on a condition": "it is inside the bound with a value that no equation allows",
    "differs": "it is outside the bound and strictly inside a wider one",
    "contradicted": "it is outside both, or the run ends early",
    "not decidable": "no verdict has nine tenths of the ensemble: choices that the paper leaves open, or "
    "our own, decide",
    "not tested": "it is not simulated in this formulation",
}
#: A number is reproduced when ours is within this factor of the number that the paper prints.
CLOSE: Final = 1.25
NEAR: Final = 2.0  #: It differs within this factor, and contradicts beyond.
FIRST: Final = "2026-11-21"  #: Day of the first table of claims.
STRICT: Final = "2026-11-22"  #: Day on which every claim got a strict bound with an owner.
#: Day on which domains, sentences and the claims left out until then were added.
REVIEWED: Final = "2026-11-23"
#: Day on which every claim got an ensemble, and half-sentences rows of their own.
VARIED: Final = "2026-11-26"


@dataclass(frozen=True)
class Bound:
    """Interval in which a number must lie."""

    full: Range  #: A claim is reproduced strictly between these two.
    partly: Range  #: It differs strictly between these two, and is contradicted elsewhere.
    unit: str  #: Unit of the number.
    by: Chooser  #: Who chose ``full``: the paper where its words do, or we.
    since: str = STRICT  #: Day on which it was chosen. All of ours were chosen with results at hand.
    origin: float = 0.0  #: Number from which the limits are counted when the bound is scaled.
    factors: bool = False  #: Whether the limits are factors of ``origin``.

    def verdict(self, value: float) -> Verdict:
        """Return the verdict on a number; NaN contradicts the claim."""
        if self.full[0] < value < self.full[1]:
            return "reproduced"
        return "differs" if self.partly[0] < value < self.partly[1] else "contradicted"

    def with_margin(self, margin: float) -> Self:
        """Return the bound that a number must pass by a margin; this near to its limits it differs."""
        low, high = self.full
        wide = min(low - margin, self.partly[0]), max(high + margin, self.partly[1])
        return replace(self, full=(low + margin, high - margin), partly=wide)

    @property
    def edges(self) -> tuple[float, ...]:
        """The finite ends of ``full``, at which a claim is not reproduced."""
        return tuple(edge for edge in self.full if math.isfinite(edge))

    def scaled(self, factor: float) -> Self:
        """Return the bound with its distance from ``origin`` scaled; one that the paper chose stays."""
        if self.by == "the paper":
            return self
        full, partly = (
            (self._moved(low, factor), self._moved(high, factor)) for low, high in (self.full, self.partly)
        )
        return replace(self, full=full, partly=partly)

    def _moved(self, limit: float, factor: float) -> float:
        if not math.isfinite(limit):
            return limit
        if not self.factors:
            return self.origin + factor * (limit - self.origin)
        ratio = limit / self.origin
        wider = 1.0 + factor * (max(ratio, 1.0 / ratio) - 1.0)
        return self.origin * wider if ratio > 1.0 else self.origin / wider

    def __str__(self) -> str:
        """Return the bound in words, with who chose it and when."""
        low, high = self.full
        if math.isinf(low):
            text = f"below {high:.4g}"
        elif math.isinf(high):
            text = f"above {low:.4g}"
        else:
            text = f"{low:.3g} to {high:.3g}"
        return f"{text}{' ' if self.unit else ''}{self.unit} ({self.by}, {self.since})"


def of_span(bound: Bound, span: Range) -> Verdict:
    """Return the verdict on numbers of which the paper does not say which one is meant."""
    if bound.full[0] < span[0] and span[1] < bound.full[1]:
        return "reproduced"
    outside = span[1] <= bound.partly[0] or bound.partly[1] <= span[0]
    return "contradicted" if outside else "not decidable"


def _one_sided(
    limit: float,
    unit: str = "",
    *,
    upward: bool,
    partly: float | None = None,
    by: Chooser = "we",
    since: str = STRICT,
    origin: float = 0.0,
) -> Bound:
    full, wider = (
        (edge, math.inf) if upward else (-math.inf, edge)
        for edge in (limit, limit if partly is None else partly)
    )
    return Bound(full, wider, unit, by, since, origin)


#: Bound that a number must exceed; above ``partly`` the claim still differs only.
above: Final = partial(_one_sided, upward=True)
#: Bound that a number must stay below; below ``partly`` the claim still differs only.
below: Final = partial(_one_sided, upward=False)


def near(paper: float, unit: str, since: str = FIRST) -> Bound:
    """Return the bound of a number that the paper gives: within :data:`CLOSE`, or :data:`NEAR`."""
    full, partly = ((paper / factor, paper * factor) for factor in (CLOSE, NEAR))
    return Bound(full, partly, unit, "we", since, paper, factors=True)


class Sentence(NamedTuple):
    """A sentence of the paper."""

    where: str  #: Section, and figure where it names one.
    text: str  #: Its words, shortened where dots stand.


def _read() -> dict[str, Sentence]:
    text = files(__package__).joinpath("sentences.toml").read_text(encoding="utf-8")
    return {name: Sentence(**row) for name, row in tomllib.loads(text).items()}


SENTENCES: Final = _read()  #: Sentences by name, in the order of the paper.


NARROW: Final = CLEARANCES[0]  #: Clearance of section 5.2 [m].
#: Part of a run in which a number is measured: outside the first tenth of each stroke; the 50 ms after each
#: reversal; or all of it but the first tenth of the first stroke, where it starts.
Domain: TypeAlias = Literal["smooth motion", "impacts", "whole"]
Formulations: TypeAlias = Literal["both", "alike", "exact", "all"]
#: Formulations in which a claim is measured; one that is not about the mechanism in either.
IN: Final[dict[Formulations, tuple[str, ...]]] = {
    "both": ("paper", "exact"),
    "alike": ("paper",),
    "exact": ("exact",),
    "all": ("printed", "paper", "exact"),
}


SLOW: Final = ("tolerance", "solver")  #: Factors that slow claims leave as they are.
#: The same of claims with many runs, which another solver would take most of the time for.
MANY_RUNS: Final = ("solver",)


EARLY: Final = "the run ends early"  #: Text for a run that left the range of the contact law.


class EndedEarly(Exception):
    """A run left the range of the contact law: what is measured on all of it is not there."""


@dataclass(frozen=True)
class Trial:
    """Runs of one formulation on which a claim is measured."""

    runs: Runs  #: The runs, each computed once.
    formulation: str  #: ``printed``, ``paper`` or ``exact``.
    #: Time after each reversal that is no smooth motion [s]; by default a tenth of a stroke.
    left_out: float | None = None

    def vsv(self, clearance: float = NARROW, more: Mapping[str, object] | None = None) -> xr.Dataset:
        """Return two cycles of the mechanism, with ``more`` changes where given."""
        return self.whole(self.runs.vsv(self.formulation, clearance, more))

    def whole(self, run: xr.Dataset) -> xr.Dataset:
        """Return a run that went to its end, with the time that is left out of smooth motion."""
        if run.attrs["failure"]:
            raise EndedEarly
        return run if self.left_out is None else run.assign_attrs(impact_time=self.left_out)

    def part(self, domain: Domain, more: Mapping[str, object] | None = None) -> xr.Dataset:
        """Return two cycles at 20 µm, in smooth motion or whole."""
        run = self.vsv(more=more)
        if domain == "smooth motion":
            return smooth(run)
        return run.sel(time=run["time"].values > float(run.attrs["impact_time"]))

    def every_clearance(self, more: Mapping[str, object] | None = None) -> list[xr.Dataset]:
        """Return the mechanism with each clearance of the paper."""
        return [self.vsv(clearance, more) for clearance in self.runs.clearances]


@dataclass(frozen=True)
class Finding:
    """Finding of one formulation."""

    text: str  #: What was measured, with its unit.
    value: float  #: The number that is judged, in the unit of the bound.
    #: Least and largest number, where the paper does not say which one is meant.
    span: tuple[float, float] | None = None


@dataclass(frozen=True)
class Claim:
    """One statement of the paper."""

    name: str  #: Short name, unique.
    sentences: tuple[str, ...]  #: Sentences of the paper that make it, by their names in :data:`SENTENCES`.
    says: str  #: What the paper says.
    domain: Domain  #: Part of the run in which it is measured.
    bound: Bound  #: How the number is judged.
    #: Returns the finding of a trial; none where the claim is not tested. Its docstring begins with *Measure*
    #: and names the quantity.
    measure: Callable[[Trial], Finding] | None = None
    reason: str = ""  #: Why the finding is what it is, where it is not simply the paper's.
    condition: str = ""  #: What must be assumed for the claim to hold at all.
    #: ``both``: ``paper`` and ``exact``; ``all``: ``printed``, too; ``alike`` where it is not about the
    #: mechanism; ``exact`` where the others have no such model.
    formulations: Formulations = "both"
    #: Whether the number must pass its limit by the scatter of the ensemble: *always*, *opposite*.
    margin: bool = False
    #: Factors of the ensemble that it does not meet. Without the tolerance it is measured on few members: it
    #: has tolerances of its own, and its runs take minutes.
    leave: tuple[str, ...] = ()

    @property
    def where(self) -> str:
        """Sections and figures of the paper that make the claim."""
        return "; ".join(dict.fromkeys(SENTENCES[name].where for name in self.sentences))

    @property
    def quantity(self) -> str:
        """Measured quantity, from the docstring of ``measure``."""
        if self.measure is None:
            return ""
        source = self.measure.func if isinstance(self.measure, partial) else self.measure
        first = (inspect.getdoc(source) or "a number.").partition("\n")[0]
        return first.removeprefix("Measure ").removesuffix(".")


def listed(values: FloatArray, unit: str) -> str:
    """Return numbers and their unit, with three digits each, or all before the point."""
    return f"{', '.join(f'{value:.0f}' if abs(value) >= 1e3 else f'{value:.3g}' for value in values)} {unit}"


def least_growth(values: FloatArray) -> float:
    """Return the smallest growth from one number to the next [%]."""
    return float(100.0 * np.min(np.diff(values) / np.abs(values[:-1])))


_GAP: Final = 0.1  #: Longer times between samples are impacts left out [s].


def weights(time: FloatArray) -> FloatArray:
    """Return the time that each sample stands for [s]; none passes between stretches of smooth motion."""
    step = np.diff(time)
    step[step > _GAP] = 0.0
    return np.asarray(0.5 * (np.append(step, 0.0) + np.insert(step, 0, 0.0)))


def trend(time: FloatArray, error: FloatArray, run: xr.Dataset) -> float:
    """Return the median size of the rate of an error, averaged over 0.2 s, in the smooth motion of a run."""
    _, rate = mean_rate(time, error, run)
    return float(np.median(np.abs(rate)))


def of_instants(time: FloatArray, error: FloatArray, run: xr.Dataset) -> Finding:
    """Return the sizes of the rate of an error at all instants of smooth motion, which have any value.

    The paper gives one number and no instant. The least size is the 1 % quantile, since the rate passes zero.
    """
    rate = np.abs(np.gradient(error, time))[is_smooth(run, time)]
    low, high = (float(value) for value in np.quantile(rate, (0.01, 1.0)))
    middle = trend(time, error, run)
    text = f"{low:.1g} to {high:.2g} °/s over the instants; median over 0.2 s {middle:.2g} °/s"
    return Finding(text, middle, (low, high))
