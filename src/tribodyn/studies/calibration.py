"""Calibration: keys of a case fitted to measured data by robust least squares.

The fit runs over shares of the ranges of the keys, from several starts, and scales the noise to the scatter
of the residuals. Every evaluation is kept in a file, so that an interrupted fit takes the same path again
without computing anything twice.
"""

import hashlib
import json
import math
import sys
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from operator import attrgetter
from pathlib import Path
from typing import Final, Self

import numpy as np
import xarray as xr
from scipy import stats

from mebdf.arrays import FloatArray
from tribodyn.cases.case import Case
from tribodyn.cases.keys import Key
from tribodyn.core.errors import InputError, TribodynError
from tribodyn.core.quoting import as_given
from tribodyn.mechanisms.self_checks import YIELDED
from tribodyn.results.store import write_bytes, write_text
from tribodyn.simulation import simulate
from tribodyn.studies import least_squares
from tribodyn.studies.archive import remark
from tribodyn.studies.measured import Experiment, MeasuredCurve, MeasuredNumber
from tribodyn.studies.search import key_range
from tribodyn.studies.variation import written

EVALUATIONS: Final = "evaluations.jsonl"
STEP: Final = 1e-2  #: Step of the differences, as a share of the range: large against the error of a run.
COARSE: Final = 1e-3
FINE: Final = 1e-6  #: Relative change of the cost at which the starts and the last fit end.
#: Degrees of freedom below which residuals are too few for their scatter and for a robust loss.
_FEW: Final = 8
_GAUSSIAN: Final = 1.4826  #: Standard deviation over the median of magnitudes, for normal residuals.
_NEAR: Final = 0.1
#: Accuracy of the end of a profile interval, as a share of its width, and largest number of steps to it.
_TRIALS: Final = 5
#: Points whose cost is compared, over the number of starts that are made from the best of them.
_SCREENED: Final = 4
_FAILED: Final = 1e3  #: Residual of a run that fails.


@dataclass(frozen=True)
class VariedKey:
    """A key that is fitted, and its range [SI]."""

    key: Key
    low: float
    high: float

    @classmethod
    def of(cls, case: Case, text: str, option: str = "--vary") -> Self:
        """Return the request ``PATH=LOW..HIGH`` for a case."""
        path, equals, values = (part.strip() for part in text.partition("="))
        if not equals:
            raise InputError(
                f"{as_given(text)}; allowed: PATH=LOW..HIGH, such as joint.clearance=10..60um", key=option
            )
        return cls(*key_range(case, path, values.strip("\"'")))

    def value(self, share: float) -> float:
        """Return the value at a share of the range [SI]."""
        return self.low + share * (self.high - self.low)

    def text(self, value: float) -> str:
        """Return a value as in a case file."""
        return written(self.key, value)


@dataclass
class Calibration:
    """A fit under way."""

    #: What is simulated, what is fitted, and to what: one run for each experiment.
    case: Case
    keys: Sequence[VariedKey]
    experiments: Sequence[Experiment]
    noise: FloatArray  #: Standard uncertainty of each value, shape (n,).
    directory: Path | None = None  #: Where evaluations are kept; None keeps them in memory only.
    note: Callable[[str], None] = lambda text: None  #: Receives a line for each evaluation.
    known: dict[str, list[float]] = field(default_factory=dict)
    #: Of these, the ones with elastic bodies that the case does not ask for.
    softer: set[str] = field(default_factory=set)

    def __post_init__(self) -> None:
        """Refuse settings of fitted keys, and read the evaluations of an earlier fit."""
        fitted = {one.key.path for one in self.keys}
        for experiment in self.experiments:
            if both := fitted & experiment.settings.keys():
                raise InputError(
                    f"{experiment.file} sets {both.pop()}, which is fitted; leave out one of them",
                    key="--data",
                )
        if self.directory is not None and (self.directory / EVALUATIONS).exists():
            self._read(self.directory / EVALUATIONS)

    @property
    def fingerprint(self) -> str:
        """Hash of the case without the fitted keys, the names of these, and the data."""
        middle = self.case.replace({one.key.path: one.text(one.value(0.5)) for one in self.keys})
        names = ",".join(one.key.path for one in self.keys)
        data = "\n".join(f"{one.data.digest} {dict(one.settings)}" for one in self.experiments)
        return hashlib.sha256(f"{middle.to_toml()}\n{names}\n{data}".encode()).hexdigest()

    @property
    def values(self) -> FloatArray:
        """All measured values, experiment by experiment, shape (n,)."""
        return np.concatenate([one.data.values for one in self.experiments])

    def of_parts(
        self, values: FloatArray
    ) -> list[tuple[Experiment, MeasuredCurve | MeasuredNumber, FloatArray]]:
        """Return values in the order of all data, shape (n,), by experiment and part."""
        ends = np.cumsum([one.data.values.size for one in self.experiments])[:-1]
        return [
            (experiment, part, of_part)
            for experiment, some in zip(self.experiments, np.split(values, ends), strict=True)
            for part, of_part in experiment.data.of_parts(some)
        ]

    def run(self, values: Sequence[float], which: int = 0) -> xr.Dataset:
        """Simulate the case of an experiment with values of the keys [SI]."""
        return simulate(self.changed(values).replace(dict(self.experiments[which].settings)))

    def changed(self, values: Sequence[float]) -> Case:
        """Return the case with values of the keys [SI]."""
        return self.case.replace(
            {one.key.path: one.text(value) for one, value in zip(self.keys, values, strict=True)}
        )

    def computed(self, shares: Sequence[float]) -> FloatArray:
        """Return the computed values of the data at shares of the ranges, shape (n,)."""
        values = [one.value(share) for one, share in zip(self.keys, shares, strict=True)]
        name = json.dumps(values)
        if name not in self.known:
            self.known[name] = self._evaluated(values)
            self._keep(name)
        return np.array(self.known[name])

    def remarks(self) -> list[str]:
        """Return a note on values of the keys with elastic bodies, where others have none."""
        return remark([self._words(json.loads(name)) for name in sorted(self.softer)], len(self.known))

    def residuals(self, given: Mapping[str, float]) -> FloatArray:
        """Return differences over the noise at shares of the ranges, plus one, by path, shape (n,)."""
        computed = self.computed([given[one.key.path] - 1.0 for one in self.keys])
        missed = (computed - self.values) / self.noise
        return np.where(np.isfinite(missed), missed, _FAILED)

    def parameters(self) -> list[least_squares.FitParameter]:
        """Return the parameters of the fit: shares of the ranges, plus one, so that steps are shares, too."""
        return [least_squares.FitParameter(one.key.path, 1.0, 2.0) for one in self.keys]

    def fitted(self, starts: int) -> least_squares.LeastSquares:
        """Return the fit, from the best of several starts, with the noise scaled to the scatter."""
        parameters = self.parameters()
        robust = self.values.size - len(parameters) >= _FEW
        loss: least_squares.Loss = "soft_l1" if robust else "linear"
        tried = (self._from(start, loss) for start in self._screened(starts, loss))
        best = min(tried, key=attrgetter("cost"))
        if robust:
            self.noise = self.noise * max(_GAUSSIAN * float(np.median(np.abs(best.residuals))), 1e-12)
        return least_squares.fit(
            self.residuals, parameters, start=best.named, loss=loss, step=STEP, tolerance=FINE
        )

    def _screened(self, starts: int, loss: least_squares.Loss) -> list[dict[str, float]]:
        """Return the points with the least cost among several times as many."""
        names = [one.key.path for one in self.keys]
        points = [
            dict(zip(names, point, strict=True))
            for point in least_squares.starting_points(self.parameters(), _SCREENED * starts)
        ]
        return sorted(points, key=lambda point: least_squares.cost_of(self.residuals(point), loss))[:starts]

    def _from(self, start: Mapping[str, float], loss: least_squares.Loss) -> least_squares.LeastSquares:
        return least_squares.fit(
            self.residuals, self.parameters(), start=start, loss=loss, step=STEP, tolerance=COARSE
        )

    def profile(self, found: least_squares.LeastSquares, which: int) -> tuple[float, float]:
        """Return the profile interval of a key [SI], from the cost with all other keys fitted.

        At both ends it has risen by the 95 % quantile; an end beyond the range is that of the range.
        """
        parameters = self.parameters()
        name, others = parameters[which].name, [one for k, one in enumerate(parameters) if k != which]
        allowed = 0.5 * float(stats.f.ppf(least_squares.CONFIDENCE, 1, found.freedoms)) * found.scatter
        best, guess = found.named[name], max(found.half_width(name), STEP)

        def rise(place: float) -> float:
            fixed = {name: place}
            if not others:
                return least_squares.cost_of(self.residuals(fixed), found.loss) - found.cost
            start = _along(found, which, place)
            inner = least_squares.fit(
                lambda given: self.residuals({**given, **fixed}),
                others,
                start=start,
                loss=found.loss,
                step=STEP,
                tolerance=COARSE,
            )
            return inner.cost - found.cost

        ends = [_crossing(rise, allowed, best, sign * guess, end) for sign, end in ((-1.0, 1.0), (1.0, 2.0))]
        low, high = (self.keys[which].value(end - 1.0) for end in ends)
        return low, high

    def _words(self, values: Sequence[float]) -> str:
        return ", ".join(
            f"{one.key.path} = {one.text(value)}" for one, value in zip(self.keys, values, strict=True)
        )

    def _evaluated(self, values: list[float]) -> list[float]:
        self.note(f"run {len(self.known) + 1}: {self._words(values)}")
        return [
            value
            for which, experiment in enumerate(self.experiments)
            for value in self._of_run(values, which, experiment)
        ]

    def _of_run(self, values: list[float], which: int, experiment: Experiment) -> list[float]:
        """Return the computed values of an experiment, NaN where its run fails."""
        lost = [math.nan] * experiment.data.values.size
        try:
            run = self.run(values, which)
        except InputError:
            raise
        except TribodynError:
            return lost
        if YIELDED in json.loads(run.attrs.get("notes", "[]")):
            self.softer.add(json.dumps(values))
        return lost if run.attrs.get("failure") else [float(value) for value in experiment.data.computed(run)]

    def _keep(self, name: str) -> None:
        if self.directory is None:
            return
        path = self.directory / EVALUATIONS
        if not path.exists():
            write_text(path, json.dumps({"fingerprint": self.fingerprint}) + "\n")
        computed = [value if math.isfinite(value) else None for value in self.known[name]]
        with path.open("a", encoding="utf-8") as file:
            softer = {"elastic": True} if name in self.softer else {}
            file.write(json.dumps({"values": json.loads(name), "computed": computed, **softer}) + "\n")

    def _read(self, path: Path) -> None:
        """Read the evaluations of an earlier fit; a last line that is half written is left out."""
        lines = path.read_bytes().split(b"\n")
        if lines.pop():
            write_bytes(path, b"".join(line + b"\n" for line in lines))
        first = _object(lines[0]) if lines else {}
        if first.get("fingerprint") != self.fingerprint:
            what = "belongs to another fit" if "fingerprint" in first else "does not name its fit"
            raise InputError(f"{path} {what}; choose another folder or remove the file", key="--output")
        for number, line in enumerate(lines[1:], 2):
            entry = _object(line)
            values = _finite(entry.get("values"), len(self.keys))
            computed = _finite(entry.get("computed"), self.values.size, failed=True)
            if values is None or computed is None:
                raise InputError(
                    f"line {number} of {path} is no evaluation of this fit; choose another folder or "
                    "remove the file",
                    key="--output",
                )
            self.known[json.dumps(values)] = computed
            self.softer |= {json.dumps(values)} if entry.get("elastic") is True else set()


def _along(found: least_squares.LeastSquares, which: int, place: float) -> dict[str, float]:
    """Return the likely values of the other parameters when one is moved, by the covariance."""
    covariance = found.covariance()
    slope = covariance[:, which] / max(covariance[which, which], 1e-300)
    moved = np.clip(found.values + slope * (place - found.values[which]), 1.0, 2.0)
    return {one.name: float(moved[k]) for k, one in enumerate(found.parameters) if k != which}


def _crossing(rise: Callable[[float], float], allowed: float, best: float, step: float, end: float) -> float:
    """Return the point at which the cost has risen by the allowed amount, or the end of the range.

    The rise is nearly a parabola, so that its root is found by a few steps in proportion.
    """
    place = best + step
    for _ in range(_TRIALS):
        place = max(place, end) if step < 0.0 else min(place, end)
        found = rise(place)
        if place == end and found < allowed:
            return end
        factor = math.sqrt(allowed / found) if found > 0.0 else 4.0
        place = best + (place - best) * min(max(factor, 0.25), 4.0)
        if abs(factor - 1.0) < _NEAR:
            break
    return max(place, end) if step < 0.0 else min(place, end)


def _object(line: bytes) -> dict[str, object]:
    """Return the object that a line holds; empty where it holds none."""
    try:
        found = json.loads(line)
    except (ValueError, RecursionError):
        return {}
    return found if isinstance(found, dict) else {}


def _finite(found: object, length: int, *, failed: bool = False) -> list[float] | None:
    """Return a list of so many finite numbers, None for anything else.

    With ``failed`` null stands for a value of a run that failed, and becomes NaN.
    """
    if not isinstance(found, list) or len(found) != length:
        return None
    if not all(_is_finite(one) or (failed and one is None) for one in found):
        return None
    return [math.nan if one is None else float(one) for one in found]


def _is_finite(one: object) -> bool:
    """Return whether a value is a number that a float holds; JSON has integers of any length."""
    return type(one) in (int, float) and abs(one) <= sys.float_info.max  # type: ignore[arg-type]
