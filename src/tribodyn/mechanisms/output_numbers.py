"""Key results of the outputs of a mechanism: errors against the ideal motion, also at chosen instants."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING, Final, TypeAlias

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.kernels import dense
from tribodyn.mechanisms.mechanism_protocol import ByPart, plain
from tribodyn.mechanisms.output_keys import Instant
from tribodyn.results.reading import column, entries, number_in, once, peak, settled, sustained
from tribodyn.results.summary import KeyResult
from tribodyn.results.variables import ERROR_UNITS

if TYPE_CHECKING:
    import xarray as xr


#: Direction in which the drive passes, by the variable of the result; zero for both together.
PASSES: Final = {"error_at": 0.0, "error_at_forward": 1.0, "error_at_backward": -1.0}
_ROUNDING: Final = 1e-9
_TURN: Final = 2.0 * math.pi


def errors_at(
    instants: Sequence[Instant],
    times: FloatArray,
    error: Mapping[str, FloatArray],
    drive: Callable[[Instant], FloatArray],
    period: float,
) -> dict[str, FloatArray]:
    """Return the mean errors at instants by variable of the result, each of shape (n_instants,).

    Of several cycles the first is left out, in which the start dies away. They are NaN where the drive does
    not pass, or not in that direction; of a drive that passes in one direction only, and of times, what both
    directions give together. ``times``: rising [s], shape (n_t,); ``error``: of each output by its name,
    shape (n_t,); ``drive``: returns the coordinate that an instant counts over time [rad or m], shape (n_t,);
    ``period``: of the cycle [s], infinite where there is none.
    """
    found = {name: np.full(len(instants), np.nan) for name in PASSES}
    if times.size < 2:
        return found
    begin = period if times[-1] >= (2.0 - _ROUNDING) * period else times[0]
    used = times >= begin - _ROUNDING * (times[-1] - times[0])
    for k, instant in enumerate(instants):
        values = error[instant.output][used]
        if instant.kind == "time":
            when = _of_cycles(times[used], instant.value, period)
            senses = np.zeros(when.size)
        else:
            when, senses = passes(
                times[used], drive(instant)[used], instant.value, turns=instant.kind == "angle"
            )
        read = np.interp(when, times[used], values)
        both = np.any(senses > 0.0) and np.any(senses < 0.0)
        for name, sense in PASSES.items():
            chosen = read[(senses == sense) | (sense == 0.0)]
            if chosen.size and (both or sense == 0.0):
                found[name][k] = chosen.mean()
    return found


def passes(
    times: FloatArray, coordinate: FloatArray, value: float, *, turns: bool
) -> tuple[FloatArray, FloatArray]:
    """Return the times at which a coordinate passes a value [s], and directions: 1, −1, or 0 for a return.

    ``times``: rising [s], shape (n_t,); ``coordinate``: over these, shape (n_t,); ``value``: to be passed;
    ``turns``: whether values that differ by whole turns are the same.
    """
    least, most = float(coordinate.min()), float(coordinate.max())
    room = _ROUNDING * max(most - least, abs(least), abs(most))
    first, last = (math.ceil((least - room - value) / _TURN), math.floor((most + room - value) / _TURN))
    levels = value + _TURN * np.arange(first, last + 1) if turns else np.array([value])
    found = [_met(times, coordinate - level, room) for level in levels]
    when, senses = (np.concatenate([np.empty(0), *(pair[i] for pair in found)]) for i in range(2))
    return when, senses


def _met(times: FloatArray, off: FloatArray, room: float) -> tuple[FloatArray, FloatArray]:
    """Return the zeros of values, with the sign of their rate; of a stay within ``room`` the beginning."""
    near = np.abs(off) <= room
    comes = np.flatnonzero(near & ~np.append(False, near[:-1]))
    before, after = off[np.maximum(comes - 1, 0)], off[np.minimum(comes + 1, off.size - 1)]
    crosses = np.flatnonzero((off[:-1] * off[1:] < 0.0) & ~near[:-1] & ~near[1:])
    steps = off[crosses + 1] - off[crosses]
    between = times[crosses] - off[crosses] * (times[crosses + 1] - times[crosses]) / steps
    return np.append(times[comes], between), np.append(np.sign(after - before), np.sign(steps))


def _of_cycles(times: FloatArray, value: float, period: float) -> FloatArray:
    """Return a time of the cycle in each of the cycles that are there [s]."""
    room = _ROUNDING * (times[-1] - times[0])
    if math.isinf(period):
        found = np.array([value])
    else:
        first = math.ceil((times[0] - room - value) / period)
        found = value + period * np.arange(first, math.floor((times[-1] + room - value) / period) + 1)
    return np.asarray(found[(found >= times[0] - room) & (found <= times[-1] + room)])


_AT_REST: Final = 1.0e-9  #: Change of an ideal value in one step, over its range, that counts as zero.
Reduction: TypeAlias = "Callable[[xr.Dataset, FloatArray], float]"


def _rms(dataset: xr.Dataset, error: FloatArray) -> float:
    """Return the root of the mean over time of the square."""
    time, square = settled(dataset, column(dataset, "time")), settled(dataset, error) ** 2
    return (
        math.sqrt(float(np.trapezoid(square, time)) / float(time[-1] - time[0]))
        if time.size > 1
        else math.nan
    )


Reading: TypeAlias = "Callable[[xr.Dataset, int], float]"


def _direction(sign: float) -> Reading:
    """Return the mean error while the ideal value rises (1) or falls (−1)."""

    def read(dataset: xr.Dataset, output: int) -> float:
        time = settled(dataset, column(dataset, "time"))
        error, ideal = (
            settled(dataset, column(dataset, name)[:, output]) for name in ("output_error", "output_ideal")
        )
        moving = sign * np.diff(ideal) > _AT_REST * np.ptp(ideal)
        steps = np.diff(time)[moving]
        middle = 0.5 * (error[1:] + error[:-1])[moving]
        return float(np.sum(steps * middle) / np.sum(steps)) if steps.size else math.nan

    return read


#: Parts of names of key results: errors in one direction of motion.
DIRECTIONS: Final[dict[str, tuple[str, str, Reading]]] = {
    "forward": ("mean, forward", "Mean error, with its sign, while the ideal value rises.", _direction(1.0)),
    "backward": (
        "mean, backward",
        "Mean error, with its sign, while the ideal value falls; the difference of both is lost motion.",
        _direction(-1.0),
    ),
}
#: Parts of names of key results: statistics of an error over time.
MEASURES: Final[dict[str, tuple[str, str, Reduction]]] = {
    "sustained": (
        "sustained",
        "Largest difference from the motion with ideal joints for 99 % of the time; impacts excluded.",
        sustained,
    ),
    "max": ("peak", "Largest value at any time, impacts included.", lambda d, error: peak(settled(d, error))),
    "rms": ("rms", "Root mean square over time of the difference from the motion with ideal joints.", _rms),
}


def number_of(dataset: xr.Dataset, output: str) -> int:
    """Return the number of an output, whose name may be that of a key result; an unknown one raises."""
    return number_in(dataset, "output", plain(output), plain)


def _made(measure: str, unit: str, output: str) -> KeyResult:
    """Return the key result of an output; NaN where its error has another unit or is not known."""
    label, meaning, read = READINGS[measure]
    _, shown, scale = ERROR_UNITS[unit]

    def compute(dataset: xr.Dataset) -> float:
        k = number_of(dataset, output)
        error = column(dataset, "output_error")[:, k]
        if str(entries(dataset, "output_unit")[k]) != unit or not np.isfinite(error).all():
            return math.nan
        return scale * read(dataset, k)

    return KeyResult(f"Error, {label}", shown, "Outputs", meaning, compute).of_part(output)


def _of_error(reduce: Reduction) -> Reading:
    """Return the reading that reduces the error of an output."""
    return lambda dataset, output: reduce(dataset, column(dataset, "output_error")[:, output])


#: All of them.
READINGS: Final = {
    **{name: (label, meaning, _of_error(reduce)) for name, (label, meaning, reduce) in MEASURES.items()},
    **DIRECTIONS,
}


def _of_limit(output: str) -> KeyResult:
    """Return the largest error of an output as a share of its limit [%]; NaN without a limit."""

    def compute(dataset: xr.Dataset) -> float:
        k = number_of(dataset, output)
        return (
            100.0
            * peak(column(dataset, "output_error")[:, k])
            / float(column(dataset, "output_error_limit")[k])
        )

    meaning = "Largest error in the run over the limit of the output; at 100 % it is worn out."
    return KeyResult("Error, of its limit", "%", "Outputs", meaning, compute).of_part(output)


def _life(output: str) -> KeyResult:
    """Return the life of an output by its error; NaN without a limit."""
    meaning = "Drive cycles until the error reaches its limit at the wear rate of this run, estimated."

    def compute(dataset: xr.Dataset) -> float:
        return float(column(dataset, "output_life")[number_of(dataset, output)])

    return KeyResult("Life by error", "cycles", "Outputs", meaning, compute).of_part(output)


#: Key results of each output, by what stands before its name.
BY_OUTPUT: Final[dict[str, ByPart]] = {
    f"error_{measure}_{spelled}": partial(_made, measure, unit)
    for unit, (spelled, _, _) in ERROR_UNITS.items()
    for measure in READINGS
} | {"error_of_limit_percent": _of_limit, "error_life_cycles": _life}


#: Labels and meanings of errors at instants, by variable.
_PASSES: Final = {
    "error_at": ("at the instant", "Mean error, with its sign, where the key `at` of the output reads it."),
    "error_at_forward": ("at the instant, forward", "The same while the drive runs forward."),
    "error_at_backward": ("at the instant, backward", "The same while the drive runs backward."),
}


def _instants(dataset: xr.Dataset) -> dict[str, tuple[int, str]]:
    """Return number and unit of the error of each instant by its name."""
    units, names = entries(dataset, "output_unit"), entries(dataset, "instant")
    outputs = (number_of(dataset, str(one)) for one in entries(dataset, "instant_output"))
    return {str(name): (k, str(units[at])) for k, (name, at) in enumerate(zip(names, outputs, strict=True))}


def _at(variable: str, unit: str, instant: str) -> KeyResult:
    """Return the key result of an instant; NaN where its error has another unit or is not known."""
    label, meaning = _PASSES[variable]
    _, shown, scale = ERROR_UNITS[unit]

    def compute(dataset: xr.Dataset) -> float:
        k, own = once(dataset, "instants", partial(_instants, dataset))[instant]
        return scale * float(column(dataset, variable)[k]) if own == unit else math.nan

    return KeyResult(f"Error {label}", shown, "Outputs", meaning, compute).of_part(instant)


#: Key results of each instant, by what stands before its name.
BY_INSTANT: Final[dict[str, ByPart]] = {
    f"{variable}_{spelled}": partial(_at, variable, unit)
    for unit, (spelled, _, _) in ERROR_UNITS.items()
    for variable in _PASSES
}


_SOFT: Final = 1.0e-6  #: Stiffness of a direction over the largest one that counts as zero.
_N_WAYS: Final = 6  #: Translations and rotations of a shaft.


def shaft_displacements(
    position: FloatArray, normal: FloatArray, weight: FloatArray, depth: FloatArray
) -> FloatArray:
    """Return displacement [m] and rotation [rad] of a shaft that follows the wear, shape (n_t, 6).

    ``position``, ``normal``: of the nodes on the shaft [m], and into the bore, shape (n, 3); ``weight``:
    pressure times area over time [N], shape (n_t, n); ``depth``: worn off at the nodes [m], shape (n,).
    """
    size = float(np.max(np.linalg.norm(position, axis=1), initial=np.finfo(float).tiny))
    lever = np.concatenate([normal, np.cross(position / size, normal)], axis=1)
    row, column = np.triu_indices(_N_WAYS)
    of_nodes = np.concatenate([lever[:, row] * lever[:, column], lever * depth[:, None]], axis=1)
    sums = dense.product(weight, of_nodes)
    stiffness, force = np.empty((len(sums), _N_WAYS, _N_WAYS)), sums[:, row.size :]
    stiffness[:, row, column] = stiffness[:, column, row] = sums[:, : row.size]
    moved = np.linalg.pinv(stiffness, rcond=_SOFT, hermitian=True) @ force[..., None]
    most = float(depth.max(initial=0.0))
    way = np.linalg.norm(moved[:, :3, 0], axis=1)
    moved[way > most] *= (most / way[way > most])[:, None, None]
    return np.asarray(moved[..., 0] / np.repeat([1.0, size], 3))


def lives(error: FloatArray, growth: FloatArray, limits: FloatArray) -> FloatArray:
    """Return after how many cycles errors reach their limits, shape (n_outputs,); NaN for never.

    ``error``: over time in the units of the outputs, shape (n_t, n_outputs); ``growth``: of the error in one
    cycle, in the same shape; NaN where it is not known; ``limits``: shape (n_outputs,); NaN for none.
    """
    with np.errstate(divide="ignore", invalid="ignore"):
        cycles = (limits - error * np.sign(growth)) / np.abs(growth)
    cycles = np.where(np.isfinite(cycles), np.maximum(cycles, 0.0), np.inf)
    first = np.min(cycles, axis=0, initial=np.inf)
    return np.asarray(np.where(np.isfinite(first), first, np.nan))
