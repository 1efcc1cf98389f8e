"""Slopes of key results: central differences over a ladder of steps, and the plateau on which they agree.

Too short a step drowns in the error of the time integration, too long a one sees the curvature. A slope is
given where neighbouring steps agree; a largest value over time often has none.
"""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final, Unpack

import numpy as np
import xarray as xr

from mebdf.arrays import FloatArray
from tribodyn.cases import Case, Key
from tribodyn.core.errors import InputError, TribodynError
from tribodyn.core.quoting import as_given
from tribodyn.mechanisms.catalogue import AnyCase, case_of
from tribodyn.studies.archive import refuse_failures
from tribodyn.studies.plan import Axis, SweepPlan, plan_of, varied_key
from tribodyn.studies.search import matching, no_run_has, read_number, readable
from tribodyn.studies.sweep import SILENT, Means, Watcher, Where, run
from tribodyn.studies.variation import SOURCE

LADDER: Final = (1e-3, 2e-3, 5e-3, 1e-2, 2e-2, 5e-2)  #: Steps, as shares of a value.
AGREE: Final = 0.05  #: Largest difference of slopes on a plateau, as a share of their median.
_AT_LEAST: Final = 3  #: Steps of a plateau.
_NOTHING: Final = 1e-9  #: Relative change of a number up to which a key has no effect.
DIGITS: Final = 9  #: Digits of the values that are tried.


@dataclass(frozen=True)
class Slope:
    """Change of a number with a key."""

    #: The key, and the name of the number in ``summary.json``.
    path: str
    number: str
    value: float  #: Slope in the unit of the number over SI units of the key; NaN where steps do not agree.
    spread: float  #: Largest difference from it on the plateau, in its unit.
    steps: tuple[float, ...]  #: Steps of the plateau, in SI units of the key; empty where there is none.
    tried: FloatArray  #: Slope at each step of the ladder, shape (n_steps,).
    #: Change of the number in per cent for a change of the key by one per cent; NaN where one of them is 0.
    relative: float


def slopes(
    case: AnyCase,
    keys: Sequence[str] | Mapping[str, str | None],
    of: Sequence[str],
    *,
    directory: str | Path | None = None,
    watcher: Watcher = SILENT,
    **where: Unpack[Where],
) -> tuple[Slope, ...]:
    """Return the slopes of key results over keys of a case.

    Parameters
    ----------
    case
        A case, a :class:`tribodyn.Mechanism`, the name of a built-in case, or a file.
    keys
        Dotted paths; with a path, the longest step may be given as text with its unit, else it is 5 % of
        the value.
    of
        Names of key results.
    directory, watcher, **where
        Where runs are kept and computed, as for :func:`sweep`; who listens and may stop them.

    Returns
    -------
    tuple of Slope
        Number by number, for each the keys in their order.

    Raises
    ------
    InputError
        There is no such key or number, a key is no quantity, or it is 0 and has no step.
    TribodynError
        A run failed.

    Examples
    --------
    >>> from tribodyn.studies import slopes
    >>> key = "joints.wrist.clearance.radial"
    >>> [slope] = slopes("slider-crank", [key], ["error_rms_um_slider"])  # doctest: +SKIP
    """
    chosen = case_of(case)
    asked = keys if isinstance(keys, Mapping) else dict.fromkeys(keys)
    names = [matching(name, chosen, "--of")[0] for name in of]
    ladders = [_ladder(chosen, path, longest) for path, longest in asked.items()]
    place = None if directory is None else Path(directory)
    found = run(_plan(chosen, ladders), place, Means(**where, keep_results=False), watcher)
    return tuple(slope for name in names for slope in _slopes_of(numbers_of(found, name), name, ladders))


def numbers_of(dataset: xr.Dataset, name: str) -> FloatArray:
    """Return a key result at all points of a sweep, shape (n_points,).

    Raises TribodynError if a point failed, or has no such number.
    """
    refuse_failures(dataset)
    if name not in dataset:
        raise TribodynError(no_run_has(name, dataset))
    numbers = np.asarray(dataset[name].values, dtype=np.float64).ravel()
    if not np.isfinite(numbers).all():
        raise TribodynError(f"not every run has {name}")
    return numbers


@dataclass(frozen=True)
class _Ladder:
    """A key, its value, and the values below and above it that are tried, SI, shape (n_steps,)."""

    key: Key
    value: float
    below: FloatArray
    above: FloatArray


def _ladder(case: Case, path: str, longest: str | None) -> _Ladder:
    key = varied_key(case, path)
    value = case.at(key.path)
    if key.kind not in ("quantity", "number") or not isinstance(value, float):
        raise InputError(
            "a slope needs a key with a number that the case states", key=key.path, source=SOURCE
        )
    if longest is None and value == 0.0:
        raise InputError(
            f"the value is 0, of which there are no shares; give the longest step, such as {key.path}=0.1 mm",
            key=key.path,
            source=SOURCE,
        )
    step = LADDER[-1] * abs(value) if longest is None else read_number(key, longest)
    if not step > 0.0:
        raise InputError(
            f"{as_given(str(longest))}; the longest step must be above 0", key=key.path, source=SOURCE
        )
    steps = step * np.array(LADDER) / LADDER[-1]
    below, above = (np.array([readable(value + sign * one, DIGITS) for one in steps]) for sign in (-1, 1))
    return _Ladder(key, value, below, above)


def _plan(case: Case, ladders: Sequence[_Ladder]) -> SweepPlan:
    """Return the plan of the runs: the case as it is, then of each key all values below and above."""
    n = 2 * len(LADDER)
    columns = {}
    for k, one in enumerate(ladders):
        values = np.full(1 + n * len(ladders), one.value)
        values[1 + n * k : 1 + n * (k + 1)] = np.concatenate([one.below, one.above])
        columns[one.key] = tuple(values.tolist())
    return plan_of(case, (Axis("run", columns),))


def _slopes_of(numbers: FloatArray, name: str, ladders: Sequence[_Ladder]) -> Iterator[Slope]:
    middle, blocks = numbers[0], numbers[1:].reshape(len(ladders), 2, -1)
    for one, (below, above) in zip(ladders, blocks, strict=True):
        tried = (above - below) / (one.above - one.below)
        without = np.max(np.abs(above - below)) <= _NOTHING * abs(middle)
        first, last = (0, tried.size) if without else plateau(tried)
        chosen = tried[first:last]
        value = 0.0 if without else float(np.median(chosen)) if chosen.size else math.nan
        spread = float(np.max(np.abs(chosen - value))) if chosen.size else math.nan
        relative = value * one.value / middle if middle and one.value else math.nan
        steps = tuple((0.5 * (one.above - one.below)[first:last]).tolist())
        yield Slope(one.key.path, name, value, spread, steps, tried, float(relative))


def plateau(tried: FloatArray) -> tuple[int, int]:
    """Return the longest run of neighbouring slopes that agree, the one of least spread among equally long.

    ``tried``: slopes by step, shape (n_steps,). Returns its first place, and the one behind its last; equal
    where fewer than three agree.

    Examples
    --------
    >>> import numpy as np
    >>> plateau(np.array([7.0, 2.5, 2.01, 2.0, 2.02, 3.0]))
    (2, 5)
    """
    runs = ((i, j) for i in range(tried.size) for j in range(i + _AT_LEAST, tried.size + 1))
    good = [(i, j) for i, j in runs if _spread(tried[i:j]) <= AGREE]
    return min(good, key=lambda run: (run[0] - run[1], _spread(tried[slice(*run)])), default=(0, 0))


def _spread(slopes: FloatArray) -> float:
    """Return the largest difference of slopes as a share of their median."""
    difference, median = float(np.ptp(slopes)), abs(float(np.median(slopes)))
    return difference / median if median else math.inf if difference else 0.0
