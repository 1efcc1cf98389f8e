"""Builds of a machine whose copies scatter: some thousands of copies alone, and builds drawn from them.

A copy on a carrier whose motion is prescribed does not act on the others, so that any set of copies is a
build. Errors of a copy at instants of the motion become a polynomial of its inputs. A copy that is drawn has
fresh inputs, and what the polynomial misses of one of those simulated: the tail of a million builds lies
beyond the worst of some thousands of copies. Builds that are simulated as a whole, of the same copies, say
what independence leaves out: their numbers over those of the copies alone are a line, and a scatter about it.
"""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any, Final, Self, TypeAlias, Unpack, cast

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.cases import Case, Key
from tribodyn.cases.case import with_entries
from tribodyn.core.environment import one_thread
from tribodyn.core.errors import InputError, TribodynError
from tribodyn.mechanisms.catalogue import AnyCase, case_of
from tribodyn.mechanisms.output_keys import Instant
from tribodyn.results.summary import Summary
from tribodyn.results.variables import ERROR_UNITS
from tribodyn.simulation import simulate
from tribodyn.studies.archive import remarks
from tribodyn.studies.plan import POINT, Axis, SweepPlan, plan_of, plan_of_draws, varied_key
from tribodyn.studies.quadratic_model import quadratic
from tribodyn.studies.sampling import SAMPLERS
from tribodyn.studies.sweep import SILENT, Means, Watcher, Where, compute_missing

INSTANTS: Final = 48  #: Instants of a cycle at which errors are kept.
LEVELS: Final = (0.5, 0.9, 0.99, 0.997)  #: Shares of builds whose quantiles are given.
_BLOCK: Final = 400  #: Builds that are drawn at once.
#: Times that the copies are drawn anew, with replacement, for the interval of a quantile.
_REPLICATES: Final = 40
_SURE: Final = (0.025, 0.975)
Law: TypeAlias = Callable[[np.random.Generator, int], FloatArray]
#: Labels of a build's numbers by a part of their names.
NUMBERS: Final = {
    "spread_max": "Spread of copies, peak",
    "sigma": "Standard deviation of copies",
    "error_max": "Error of copies, peak",
}


@dataclass(frozen=True)
class BuildNumber:
    """A number over all builds."""

    name: str  #: As key results have it, with its unit at the end.
    label: str  #: With its unit.
    #: Over all builds drawn.
    mean: float
    deviation: float
    quantiles: FloatArray  #: Of :data:`LEVELS`, shape (n_levels,).
    #: Ends of their 95 % intervals, for other copies as many as these.
    low: FloatArray
    high: FloatArray
    drawn: FloatArray  #: The number of some of the builds, for a histogram.
    #: Of builds simulated as a whole, and of the same copies alone; empty without such builds.
    together: FloatArray
    same: FloatArray
    coupled: FloatArray  #: Quantiles that these builds let expect, shape (n_levels,); NaN without them.

    @property
    def correlation(self) -> float:
        """Correlation of builds as a whole with the same copies alone."""
        return float(np.corrcoef(self.together, self.same)[0, 1])


@dataclass(frozen=True)
class Builds:
    """Many builds of a machine."""

    #: Copies simulated alone, copies of a build, and builds drawn.
    copies: int
    of_build: int
    draws: int
    numbers: tuple[BuildNumber, ...]  #: One for each of :data:`NUMBERS`.
    #: Share of builds beyond each limit by the name of its number, with its 95 % interval.
    beyond: Mapping[str, tuple[float, float, float]]
    #: Share of the variance of the errors of copies that each scatter causes alone.
    contributions: Mapping[str, float]


def builds(
    case: AnyCase,
    *,
    copies: int = 4000,
    draws: int = 1_000_000,
    coupled: int = 0,
    limits: Mapping[str, float] | None = None,
    seed: int = 0,
    directory: str | Path | None = None,
    watcher: Watcher = SILENT,
    **where: Unpack[Where],
) -> Builds:
    """Return numbers of many builds of a case whose copies scatter.

    Parameters
    ----------
    case
        A case with a pattern and something that scatters, or a file.
    copies
        Copies that are simulated alone.
    draws
        Builds that are drawn from them.
    coupled
        Builds that are simulated as a whole, of the first of these copies.
    limits
        The most that numbers of a build may be, by their names.
    seed
        Of inputs and draws.
    directory, watcher, **where
        Where runs are kept and computed, as for :func:`sweep`; who listens and may stop them.

    Returns
    -------
    Builds
        Quantiles of each number with their intervals, shares beyond limits, and the part of each scatter.

    Raises
    ------
    InputError
        The case repeats nothing or nothing scatters, or there are too few copies for the builds.
    TribodynError
        A run failed.

    Examples
    --------
    >>> from tribodyn.studies import builds
    >>> found = builds("ring.toml", copies=200, draws=10_000)  # doctest: +SKIP
    """
    chosen = case_of(case)
    runs = BuildRuns(chosen, copies, coupled, seed, None if directory is None else Path(directory))
    names = [f"copies_{part}_{ERROR_UNITS[runs.unit].spelled}" for part in NUMBERS]
    wrong = next((name for name in limits or {} if name not in names), None)
    if wrong is not None:
        raise InputError(f'given "{wrong}"; allowed: {", ".join(names)}', key="--limit")
    labels = [f"{label} [{ERROR_UNITS[runs.unit].shown}]" for label in NUMBERS.values()]
    means, of_build = Means(**where, keep_results=False), runs.of_build
    errors = runs.alone(means, watcher)
    random, part = np.random.default_rng([seed, 1]), max(draws // _REPLICATES, 1)
    with one_thread():
        population = Copies(runs.laws, runs.inputs, errors)
        drawn = draw(population, of_build, draws, random)
        again = [draw(population.again(random), of_build, part, random) for _ in range(_REPLICATES)]
    together = runs.together(means, watcher)
    same = numbers_of_builds(errors[: coupled * of_build].reshape(coupled, of_build, INSTANTS))
    numbers = tuple(
        _number((name, label), drawn[:, k], [one[:, k] for one in again], together[:, k], same[:, k], seed)
        for k, (name, label) in enumerate(zip(names, labels, strict=True))
    )
    beyond = {}
    for name, limit in (limits or {}).items():
        k = names.index(name)
        low, high = np.quantile([np.mean(one[:, k] > limit) for one in again], _SURE).tolist()
        beyond[name] = (float(np.mean(drawn[:, k] > limit)), low, high)
    return Builds(copies, of_build, draws, numbers, beyond, runs.contributions(errors))


def numbers_of_builds(errors: FloatArray) -> FloatArray:
    """Return the numbers of builds from errors of their copies, (n, n_copies, n_instants) to (n, 3)."""
    high, low = errors.max(axis=1), errors.min(axis=1)
    sigma = np.sqrt(np.mean(np.var(errors, axis=1), axis=1))
    largest = np.maximum(high.max(axis=1), -low.min(axis=1))
    return np.column_stack([np.max(high - low, axis=1), sigma, largest])


class Copies:
    """Copies as a population: a polynomial of their inputs for each instant, and what it misses of each copy.

    ``laws``: of each input: a function of a generator and a size that returns values, mean 0 and deviation 1;
    ``inputs``, ``errors``: of copies that were simulated, shapes (n, n_inputs) and (n, n_instants).
    """

    def __init__(self, laws: Sequence[Law], inputs: FloatArray, errors: FloatArray) -> None:
        self._laws, self.inputs, self.errors = laws, inputs, errors
        terms = _terms(inputs)
        factors, *_ = np.linalg.lstsq(terms, errors, rcond=None)
        spare = max(len(terms) - terms.shape[1], 1)
        self._factors = factors.astype(np.float32)
        self._rest = ((errors - terms @ factors) * np.sqrt(len(terms) / spare)).astype(np.float32)

    def drawn(self, random: np.random.Generator, builds: int, of_build: int) -> FloatArray:
        """Return the errors of builds of other copies, shape (builds, of_build, n_instants)."""
        size = builds * of_build
        terms = _terms(np.column_stack([law(random, size) for law in self._laws])).astype(np.float32)
        # The first copies of all builds, then the second: so are numbers of builds found fastest.
        order = np.arange(size).reshape(builds, of_build).T.ravel()
        errors = self._rest[random.integers(len(self._rest), size=size)[order]]
        errors += terms[order] @ self._factors
        return np.asarray(errors.reshape(of_build, builds, -1).swapaxes(0, 1))

    def again(self, random: np.random.Generator) -> Self:
        """Return copies as many as these, drawn from them with replacement."""
        chosen = random.integers(len(self.errors), size=len(self.errors))
        return type(self)(self._laws, self.inputs[chosen], self.errors[chosen])


def _terms(inputs: FloatArray) -> FloatArray:
    """Return the terms of the polynomial: all of second order, and cubes."""
    return np.hstack([quadratic(inputs), inputs * inputs * inputs])


def draw(copies: Copies, of_build: int, draws: int, random: np.random.Generator) -> FloatArray:
    """Return the numbers of builds, shape (draws, 3), each of so many copies drawn."""
    parts = []
    for begin in range(0, draws, _BLOCK):
        parts.append(numbers_of_builds(copies.drawn(random, min(_BLOCK, draws - begin), of_build)))
    return np.concatenate(parts).astype(np.float64)


def _number(
    words: tuple[str, str],
    drawn: FloatArray,
    again: Sequence[FloatArray],
    together: FloatArray,
    same: FloatArray,
    seed: int,
) -> BuildNumber:
    low, high = np.quantile([np.quantile(one, LEVELS) for one in again], _SURE, axis=0)
    coupled = np.full(len(LEVELS), np.nan)
    if together.size > 2:
        slope, offset = np.polyfit(same, together, 1)
        rest = together - (offset + slope * same)
        # Two numbers were fitted.
        rest *= np.sqrt(rest.size / (rest.size - 2.0))
        chosen = np.random.default_rng([seed, 2]).choice(rest, drawn.size)
        coupled = np.quantile(offset + slope * drawn + chosen, LEVELS)
    quantiles, mean, deviation = np.quantile(drawn, LEVELS), float(drawn.mean()), float(drawn.std())
    return BuildNumber(
        *words, mean, deviation, quantiles, low, high, drawn[:100_000], together, same, coupled
    )


class BuildRuns:
    """The runs that builds are made of."""

    def __init__(self, case: Any, copies: int, coupled: int, seed: int, directory: Path | None) -> None:
        if not getattr(case, "pattern", None):
            raise InputError("the case repeats nothing: write a table [pattern.NAME]", key="pattern")
        if not case.scattered:
            raise InputError("nothing differs from copy to copy: write a table [scatter.NAME]", key="scatter")
        self._case, self._coupled, self._directory = case, coupled, directory
        self.of_build: int = next(iter(case.pattern.values())).count
        if copies < max(self.of_build, coupled * self.of_build):
            raise InputError(f"given {copies}; {coupled or 1} builds have more copies", key="--copies")
        repeated = {name.partition("[")[0]: keys.unit for name, keys in case.outputs.items() if "[" in name}
        if len(repeated) != 1:
            words = f"the errors of one repeated output are compared, not of {len(repeated)}"
            raise InputError(words, key="outputs")
        [(self._output, self.unit)] = repeated.items()
        span = min(case.duration, getattr(case, "period", None) or case.duration)
        self._instants = [float(f"{span * (k + 0.5) / INSTANTS:.9g}") for k in range(INSTANTS)]
        self._shares = SAMPLERS["lhs"](copies, len(case.scattered), seed).T

    @cached_property
    def _alone(self) -> Any:
        """The case with one copy."""
        return self._case.one_copy(simulate(self._equal()), self._instants)

    @cached_property
    def _columns(self) -> dict[Key, list[float]]:
        """Values of all copies by the key that scatters."""
        alone, found = self._alone, {}
        for one, of_copies in zip(self._case.scattered.values(), self._shares, strict=True):
            key = varied_key(alone, one.key)
            base = alone.at(one.key) if one.added else 0.0
            if not isinstance(base, float):
                raise InputError("this key has no value that they could be added to", key=one.key)
            found[key] = [base + value for value in one.at_shares(key, of_copies.tolist())]
        return found

    def _equal(self) -> Case:
        """Return the case with equal copies."""
        scattered = [f"scatter.{name}" for name in self._case.scattered]
        return with_entries(cast(Case, self._case), {}, "equal copies", scattered)

    def alone(self, means: Means, watcher: Watcher) -> FloatArray:
        """Return the errors of copies alone at the instants, shape (n_copies, n_instants)."""
        axis = Axis(POINT, {key: tuple(values) for key, values in self._columns.items()})
        found = self._computed(plan_of_draws(self._alone, axis), "alone", means, watcher)
        return np.array([self._errors(one, self._output) for one in found])

    def together(self, means: Means, watcher: Watcher) -> FloatArray:
        """Return the numbers of the builds that are simulated as a whole, shape (n_builds, 3)."""
        if not self._coupled:
            return np.zeros((0, len(NUMBERS)))
        case, n, output = self._case, self.of_build, self._output
        times = f"{', '.join(map(repr, self._instants))} s"
        whole = self._equal().replace({f"outputs.{output}.at.times": times})
        first, shape = slice(self._coupled * n), (-1, n)
        of_builds = {key.path: np.reshape(of[first], shape) for key, of in self._columns.items()}
        [pattern] = case.pattern.values()
        columns = pattern.of_copies(of_builds, whole)
        axis = Axis(POINT, {varied_key(whole, path): tuple(own.tolist()) for path, own in columns.items()})
        found = self._computed(plan_of(whole, (axis,)), "together", means, watcher)
        errors = [[self._errors(one, f"{output}[{copy + 1}]") for copy in range(n)] for one in found]
        return numbers_of_builds(np.array(errors))

    @cached_property
    def inputs(self) -> FloatArray:
        """Values of all copies, off their means in standard deviations, shape (n_copies, n_inputs)."""
        values = np.array(list(self._columns.values())).T
        deviation = values.std(axis=0)
        return np.asarray((values - values.mean(axis=0)) / np.where(deviation > 0.0, deviation, 1.0))

    @cached_property
    def laws(self) -> list[Law]:
        """Laws of the inputs."""
        found: list[Law] = []
        for one, values in zip(self._case.scattered.values(), self.inputs.T, strict=True):
            if one.distribution == "normal":
                found.append(lambda random, size: random.standard_normal(size))
            elif one.distribution == "uniform":
                found.append(lambda random, size: random.uniform(-math.sqrt(3.0), math.sqrt(3.0), size))
            else:
                found.append(cast(Law, lambda random, size, values=values: random.choice(values, size)))
        return found

    def contributions(self, errors: FloatArray) -> dict[str, float]:
        """Return the share of the variance of errors that each scatter causes alone, by a linear fit."""
        apart = errors - errors.mean(axis=0)
        factors, *_ = np.linalg.lstsq(self.inputs, apart, rcond=None)
        shares = np.sum(factors**2, axis=1) / max(float(np.sum(apart.var(axis=0))), np.finfo(float).tiny)
        return dict(zip(self._case.scattered, shares.tolist(), strict=True))

    def _computed(self, plan: SweepPlan, name: str, means: Means, watcher: Watcher) -> list[Summary]:
        summaries: dict[str, Summary] = {}
        place = None if self._directory is None else self._directory / name
        compute_missing(plan, place, means, watcher, summaries)
        for note in remarks(plan, summaries):
            watcher.note(note)
        found = [summaries.get(point.name, {"failure": "it was not computed"}) for point in plan.points]
        failure = next((one["failure"] for one in found if one.get("failure")), None)
        if failure is not None:
            raise TribodynError(f"a run failed: {failure}")
        return found

    def _errors(self, summary: Summary, output: str) -> list[float]:
        spelled = ERROR_UNITS[self.unit].spelled
        names = (Instant(output, "time", time).name for time in self._instants)
        return [float(summary[f"error_at_{spelled}_{name}"]) for name in names]  # type: ignore[arg-type]
