"""The last value of a parameter at which a key result keeps a limit: a root found with few runs."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from itertools import pairwise
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Final, Self, Unpack

import xarray as xr

from tribodyn.cases import Case, Key
from tribodyn.cases.fields import Entry, read_entry
from tribodyn.cases.keys import Value
from tribodyn.cases.units import with_shared_unit
from tribodyn.core.errors import InputError, TribodynError
from tribodyn.core.quoting import as_given, meant, nearest
from tribodyn.mechanisms.catalogue import AnyCase, case_of
from tribodyn.mechanisms.results import key_results_of_case
from tribodyn.results.summary import KeyResult, name_today
from tribodyn.studies.archive import refuse_failures
from tribodyn.studies.plan import make_plan, varied_key
from tribodyn.studies.sweep import Means, Watcher, Where, run
from tribodyn.studies.variation import SOURCE, written

WITHIN: Final = 0.01  #: Accuracy of the root, as a share of the range.
#: Digits of the values that are tried: a value that a person can read, and that reads back exactly.
_DIGITS: Final = 5


@dataclass(frozen=True)
class Limit:
    """A key result and the value that it must reach, or not exceed."""

    name: str  #: Name in ``summary.json``.
    value: float  #: In the unit of the number; a change in per cent where it is relative.
    at_least: bool = False  #: Whether the number must not be below it; else it must not be above it.
    relative: bool = False  #: Whether it is a change of the number of the case as it is.
    others: tuple[str, ...] = ()  #: Key results that have the words of the one asked for, too.

    @property
    def sign(self) -> str:
        """Comparison of the number with the limit."""
        return "at least" if self.at_least else "at most"

    def is_kept(self, number: float) -> bool:
        """Return whether a number keeps the limit."""
        return number >= self.value if self.at_least else number <= self.value

    def of(self, number: float) -> Self:
        """Return the limit in the unit of the number, which the case as it is has so."""
        if not self.relative:
            return self
        return replace(self, value=number * (1.0 + self.value / 100.0), relative=False)


@dataclass(frozen=True)
class Question:
    """Search for the value at which a number reaches its limit."""

    #: What is simulated, and which of its keys varies.
    case: Case
    key: Key
    #: Ends of the range that is searched, SI.
    low: float
    high: float
    until: Limit  #: The number and its limit.

    @property
    def present(self) -> float:
        """The value of the case as it is, SI."""
        value = self.case.at(self.key.path)
        if not isinstance(value, float):
            raise InputError(
                "the case has no value that a change in per cent could be of",
                key=self.key.path,
                source=SOURCE,
            )
        return value

    @property
    def key_result(self) -> KeyResult:
        """Properties of the number."""
        return key_results_of_case(self.case)[self.until.name]


@dataclass
class Search:
    """A question under way; everything tried is kept in a folder, from which a second search goes on."""

    question: Question  #: What is asked.
    directory: Path  #: Where runs are kept, as by :func:`tribodyn.studies.run`.
    #: As for a sweep.
    means: Means
    watcher: Watcher
    #: The number at each value of the parameter that was tried, SI.
    tried: dict[float, float] = field(default_factory=dict)

    @property
    def limit(self) -> Limit:
        """The limit in the unit of the number; a relative one after a run of the case as it is."""
        asked = self.question
        if not asked.until.relative:
            return asked.until
        return asked.until.of(self._numbers([asked.present])[0])

    def root(self, within: float = WITHIN) -> float:
        """Return a value at which the number keeps the limit, at most so far from where it reaches it, SI.

        ``within``: how far, as a share of the range. Raises TribodynError if the number lies on one side of
        the limit at both ends, or a run failed.
        """
        from scipy.optimize import brentq

        asked, limit = self.question, self.limit
        at_ends = self._numbers([asked.low, asked.high])
        if (at_ends[0] - limit.value) * (at_ends[1] - limit.value) > 0.0:
            raise TribodynError(self._not_between(at_ends))
        xtol = within * abs(asked.high - asked.low)
        found = float(brentq(self._excess, asked.low, asked.high, xtol=xtol, rtol=4 * math.ulp(1.0)))
        return self._kept(found, xtol)

    def _kept(self, root: float, within: float) -> float:
        """Return the value nearest to a root, or so far from it, at which the limit is kept."""
        asked, limit = self.question, self.limit
        upwards = limit.is_kept(self.tried[asked.high])
        for step in (0.0, 0.5 * within, within):
            value = readable(root + step if upwards else root - step)
            value = min(max(value, asked.low), asked.high)
            if limit.is_kept(self._numbers([value])[0]):
                return value
        low, high = self.bracket()
        return high if upwards else low

    def dataset(self) -> xr.Dataset:
        """Return all that was tried as a sweep, which then stands in the folder."""
        return self._runs(sorted(self.tried))

    def bracket(self) -> tuple[float, float]:
        """Return the values nearest to each other between which the number passes the limit, SI."""
        values = sorted(self.tried)
        limit = self.limit.value
        pairs = pairwise(values)
        return min(
            ((a, b) for a, b in pairs if (self.tried[a] - limit) * (self.tried[b] - limit) <= 0.0),
            key=lambda pair: pair[1] - pair[0],
        )

    def _excess(self, value: float) -> float:
        return self._numbers([readable(value)])[0] - self.limit.value

    def _numbers(self, values: Sequence[float]) -> list[float]:
        missing = [value for value in values if value not in self.tried]
        if missing:
            dataset = self._runs(missing)
            refuse_failures(dataset, "a run of the search failed")
            if self.question.until.name not in dataset:
                raise TribodynError(no_run_has(self.question.until.name, dataset))
            numbers = dataset[self.question.until.name].values.tolist()
            self.tried |= dict(zip(missing, numbers, strict=True))
        if not all(math.isfinite(self.tried[value]) for value in values):
            raise TribodynError(f"the runs have no {self.question.until.name}")
        return [self.tried[value] for value in values]

    def _runs(self, values: Sequence[float]) -> xr.Dataset:
        key = self.question.key
        plan = make_plan(self.question.case, {key.path: [written(key, value) for value in values]})
        return run(plan, self.directory, self.means, self.watcher)

    def _not_between(self, at_ends: Sequence[float]) -> str:
        asked = self.question
        low, high = (
            f"{number:.4g} at {written(asked.key, end)}"
            for number, end in zip(at_ends, (asked.low, asked.high), strict=True)
        )
        return (
            f"{asked.until.name} is {low} and {high}: it does not pass {self.limit.value:.4g} between them; "
            "search a wider range, or another limit"
        )


def find(
    case: AnyCase,
    vary: str,
    between: str,
    until: str,
    *,
    within: float = WITHIN,
    directory: str | Path | None = None,
    **where: Unpack[Where],
) -> float:
    """Return the last value of a parameter at which a key result keeps a limit.

    Parameters
    ----------
    case
        A case, a :class:`tribodyn.Mechanism`, the name of a built-in case, or a file.
    vary
        Dotted path of the parameter.
    between
        The range that is searched, such as ``"10..60 um"``; the number must pass the limit in it.
    until
        Key result and the most that it may be, in its unit, such as ``"vane_angle_error_max_deg=0.03"``, or
        a change against the case as it is, ``"error_rms_um_tip=-20 %"``; with ``>=`` the least.
    within
        How near to the limit the value is found, as a share of the range.
    directory
        Where runs are kept; what is there already is not computed again. By default nowhere.
    **where
        ``workers``, by default 0, ``scheduler`` and ``tls``, as for :func:`sweep`.

    Returns
    -------
    float
        A value that keeps the limit, in SI units, by Brent's method (Brent, *Algorithms for Minimization
        without Derivatives*, 1973).

    Raises
    ------
    InputError
        Something asked for cannot be.
    TribodynError
        The number does not pass the limit, or a run failed.
    """
    chosen = case_of(case)
    asked = question(chosen, vary, between, limit(until, chosen, "until"))
    with TemporaryDirectory() as place:
        where.setdefault("workers", 0)
        means = Means(**where, keep_results=False)
        return Search(asked, Path(directory or place), means, Watcher()).root(within)


#: Places in which the names of key results are listed, in words.
LISTED: Final = "`tribodyn run` writes those that a case has to summary.json."


def question(case: Case, vary: str, values: str, until: Limit) -> Question:
    """Return the search, checked.

    ``case``: what is simulated; ``vary``: dotted path of the key that varies; ``values``: the range, such as
    ``"10..60 um"``; ``until``: the number and its limit. Raises InputError if there is no such key, it cannot
    vary over a range, or the range is none.
    """
    return Question(case, *key_range(case, vary, values), until)


def key_range(case: Case, path: str, values: str) -> tuple[Key, float, float]:
    """Return a key of a case and both ends of a range of it, such as ``10..60 um`` [SI].

    Raises InputError if there is no such key, it cannot vary over a range, or the range is none.
    """
    key = varied_key(case, path)
    ends = values.split("..")
    if key.kind not in ("quantity", "number") or len(ends) != 2:
        raise InputError(
            f"{as_given(values)}; allowed: a range of {key.allowed}, as in 10..60 um",
            key=key.path,
            source=SOURCE,
        )
    low, high = (read_number(key, text) for text in with_shared_unit([end.strip() for end in ends]))
    if not low < high:
        raise InputError(f"{as_given(values)}; the range must go upwards", key=key.path, source=SOURCE)
    return key, low, high


def read_number(key: Key, text: str) -> float:
    """Return a value of a key as a user wrote it [SI]."""
    value: Value = read_entry(key, Entry(text, SOURCE, text=True))
    assert isinstance(value, float)
    return value


def limit(text: str, case: Case, option: str, *, least: bool = True) -> Limit:
    """Return a limit on a number of a case, ``NAME=NUMBER`` or ``NAME>=NUMBER``, in the unit of the number.

    Where such a question can be asked, with ``>=`` it is the least that the number may be, and ``NAME=-20 %``
    is a change against the case as it is.

    A part of the name will do: ``contact_max_N`` is ``contact_force_max_N``, the first with all its words.

    Raises InputError if there is no such key result, or what follows is no number.
    """
    name, equals, number = (part.strip() for part in text.partition("="))
    at_least, name = name.endswith(">"), name.rstrip("<> ")
    relative = least and number.endswith("%")
    try:
        value = float(number.removesuffix("%") if relative else number)
    except ValueError:
        value = math.nan
    allowed = "NAME=NUMBER, such as tilt_max_mrad=2" + (
        ", or NAME=-20 % of the case as it is" if least else ""
    )
    if not equals or not math.isfinite(value):
        raise InputError(f"{as_given(text)}; allowed: {allowed}", key=option)
    if at_least and not least:
        raise InputError(f"{as_given(text)}; points that do not exceed a limit are counted", key=option)
    first, *others = matching(name, case, option)
    return Limit(first, value, at_least, relative, tuple(others))


def matching(name: str, case: Case, option: str) -> list[str]:
    """Return the key results of a case that a name means: one, or those with all its words.

    Raises InputError if there is none.
    """
    name, known = name_today(name), key_results_of_case(case)
    words = set(name.split("_"))
    found = [name] if name in known else [one for one in known if words <= set(one.split("_"))]
    if not found:
        raise InputError(f"{as_given(name)}; not a key result; {nearest(name, known)}. {LISTED}", key=option)
    return found


def no_run_has(name: str, dataset: xr.Dataset) -> str:
    """Return that runs do not give a key result of their kind, and which one was probably meant."""
    return f"no run has {name} for this case{meant(name, [str(other) for other in dataset.data_vars])}"


def readable(value: float, digits: int = _DIGITS) -> float:
    """Return a value of few digits, which a person can read and which reads back exactly."""
    return float(f"{value:.{digits}g}")
