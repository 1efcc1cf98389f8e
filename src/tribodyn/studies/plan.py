"""The plan of a sweep: every point with its validated case, before anything runs."""

import hashlib
import itertools
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Final

from tribodyn.cases import Case, Key, keys_in
from tribodyn.cases.keys import Value
from tribodyn.cases.tables import plain_path, with_components
from tribodyn.core.errors import InputError
from tribodyn.core.platforms import version
from tribodyn.core.quoting import LONGEST, as_given, brief
from tribodyn.studies.sampling import SAMPLERS
from tribodyn.studies.variation import SOURCE, Asked, Levels, Scatter, variation, written

MOST_POINTS: Final = 100_000
SENSITIVITY: Final = "saltelli"  #: The sampler whose points give Sobol' indices.
POINT: Final = "point"  #: Dimension of samples.


@dataclass(frozen=True)
class Sampling:
    """Sampling of distributions."""

    samples: int | None = None  #: How many; None where nothing is drawn.
    method: str = "lhs"  #: A key of :data:`~tribodyn.studies.sampling.SAMPLERS`.
    seed: int = 0  #: Equal seeds give equal samples.


@dataclass(frozen=True)
class Point:
    """One simulation of a sweep."""

    changes: Mapping[str, str]  #: What differs from the base case, by dotted path, as a user writes it.
    toml: str = field(repr=False)  #: The whole resolved case; empty where only its changes are known.
    name: str  #: Hash of both and of the version of tribodyn: equal names have equal results.

    @property
    def label(self) -> str:
        """The changes on one line."""
        return ", ".join(f"{path} = {value}" for path, value in self.changes.items())


@dataclass(frozen=True)
class Axis:
    """A dimension of the sweep and the parameters that vary along it."""

    name: str  #: Dotted path of the parameter, or ``point`` for samples.
    columns: Mapping[Key, tuple[Value, ...]]  #: Values of each parameter along the dimension, equally many.

    @property
    def size(self) -> int:
        """Number of values."""
        return len(next(iter(self.columns.values())))

    def changes(self, i: int) -> dict[str, str]:
        """Return the settings at place ``i``."""
        return {key.path: written(key, values[i]) for key, values in self.columns.items()}


@dataclass(frozen=True)
class SweepPlan:
    """All points of a sweep."""

    case: Case  #: What is swept.
    axes: tuple[Axis, ...]  #: Dimensions, the samples last.
    points: tuple[Point, ...]  #: One for each combination, the last axis running fastest.
    sampling: Sampling  #: How samples were drawn.

    @property
    def sampled(self) -> bool:
        """Whether one of the dimensions holds samples."""
        return self.axes[-1].name == POINT


def make_plan(case: Case, vary: Mapping[str, Asked], sampling: Sampling = Sampling()) -> SweepPlan:
    """Return the plan of a sweep; the cases of all its points are valid.

    Parameters
    ----------
    case
        What is swept.
    vary
        What each dotted path is to be, see :func:`~tribodyn.studies.variation.variation`.
    sampling
        How distributions are sampled.

    Returns
    -------
    SweepPlan
        All points, in the order in which they are computed.

    Raises
    ------
    InputError
        A path or value is wrong, or a combination of values cannot be; the message names the key.
    """
    if not vary:
        raise InputError("nothing varies; give PATH=VALUES at least once", key=SOURCE)
    wanted = [variation(varied_key(case, path), asked) for path, asked in vary.items()]
    levels = [entry for entry in wanted if isinstance(entry, Levels)]
    scatters = [entry for entry in wanted if isinstance(entry, Scatter)]
    axes = [Axis(entry.key.path, {entry.key: entry.values}) for entry in levels]
    _check_sampling(sampling, scatters, levels)
    _check_number(math.prod(axis.size for axis in axes) * (sampling.samples or 1))
    if scatters:
        axes.append(_drawn(scatters, sampling))
    return plan_of(case, tuple(axes), sampling)


def plan_of(case: Case, axes: tuple[Axis, ...], sampling: Sampling = Sampling()) -> SweepPlan:
    """Return the plan of all points of these dimensions; returns and raises as :func:`make_plan`."""
    n_points = math.prod(axis.size for axis in axes)
    _check_number(n_points)
    places = enumerate(itertools.product(*(range(axis.size) for axis in axes)), 1)
    points = (
        _point(case, [axis.changes(i) for axis, i in zip(axes, at, strict=True)], f"point {k} of {n_points}")
        for k, at in places
    )
    return SweepPlan(case, axes, tuple(points), sampling)


def plan_of_draws(case: Case, axis: Axis) -> SweepPlan:
    """Return the plan of very many points along one dimension, whose cases differ by numbers alone.

    Of these the outermost are read; who computes a point reads its case. Raises as :func:`make_plan`.
    """
    _check_number(axis.size)
    for i in sorted({values.index(end(values)) for values in axis.columns.values() for end in (min, max)}):
        _point(case, [axis.changes(i)], f"point {i + 1} of {axis.size}")
    base = f"{case.to_toml()} changed by "
    points = tuple(Point(one, "", _name(f"{base}{one}")) for one in map(axis.changes, range(axis.size)))
    return SweepPlan(case, (axis,), points, Sampling())


def varied_key(case: Case, path: str) -> Key:
    """Return the key of a case that shall vary: of a vector, a component.

    Raises InputError if the case has no such key; the message names the nearest one.
    """
    keys = with_components(keys_in(case))
    path = plain_path(path, keys)
    if path not in keys:
        case.replace({path: ""}, source=SOURCE)
    return keys[path]


def _check_number(n_points: int) -> None:
    if n_points > MOST_POINTS:
        raise InputError(f"these are {n_points} points; at most {MOST_POINTS} are allowed", key=SOURCE)


def _check_sampling(sampling: Sampling, scatters: Sequence[Scatter], levels: Sequence[Levels]) -> None:
    if sampling.method not in SAMPLERS:
        raise InputError(f"{as_given(sampling.method)}; allowed: {', '.join(SAMPLERS)}", key="--method")
    if scatters and (sampling.samples is None or sampling.samples < 1):
        raise InputError(
            f"{scatters[0].key.path} is drawn from a distribution; say how many samples, 1 or more",
            key="--samples",
        )
    if not scatters and sampling.samples is not None:
        raise InputError(
            f"nothing is drawn from a distribution; give one, such as {SOURCE} "
            'joint.clearance="normal(20 um, 2 um)", or leave the samples out',
            key="--samples",
        )
    if sampling.method == SENSITIVITY and sampling.samples is not None:
        n = sampling.samples
        if n & (n - 1) or n < 2:
            raise InputError(f"given {n}; {SENSITIVITY} needs a power of two, 2 or more", key="--samples")
        if levels:
            raise InputError(
                f"{SENSITIVITY} takes distributions only, and {levels[0].key.path} forms a grid",
                key="--method",
            )
    if sampling.seed < 0:
        raise InputError(f"given {sampling.seed}; allowed: 0 or more", key="--seed")


def _drawn(scatters: Sequence[Scatter], sampling: Sampling) -> Axis:
    assert sampling.samples is not None
    cube = SAMPLERS[sampling.method](sampling.samples, len(scatters), sampling.seed)
    columns = {scatter.key: tuple(scatter.values(cube[:, i]).tolist()) for i, scatter in enumerate(scatters)}
    return Axis(POINT, columns)


def _point(case: Case, along: Sequence[Mapping[str, str]], which: str) -> Point:
    changes = {path: value for one in along for path, value in one.items()}
    try:
        toml = case.replace(changes, source=SOURCE).to_toml()
    except InputError as error:
        label = brief(Point(changes, "", "").label, 2 * LONGEST)
        raise InputError(f"{error.reason} ({which}: {label})", key=error.key, source=SOURCE) from None
    return Point(changes, toml, _name(toml))


def _name(case: str) -> str:
    return hashlib.sha256(f"tribodyn {version('tribodyn')}\n{case}".encode()).hexdigest()[:16]
