"""Identifiability of fitted keys: which keys the data leave open, which trade off, what would help."""

from collections.abc import Iterator, Sequence
from itertools import combinations, product
from typing import Final

import numpy as np
import xarray as xr

from tribodyn.core.arrays import FloatArray
from tribodyn.results.columns import variable
from tribodyn.studies.calibration import STEP, Calibration
from tribodyn.studies.least_squares import LeastSquares

TRADING: Final = 0.95  #: Correlation from which on two keys trade off.
WIDE: Final = 0.5  #: Half width of an interval over the range from which on a key is not determined.
_TIMES: Final = 50
_NOISE: Final = 0.01  #: Noise assumed of a further measurement, over its range.
#: Range of a component, over that of all components of its variable, up to which it is taken for rounding.
_ROUNDING: Final = 1e-6
_NOTHING: Final = 1e-15  #: Range of any variable up to which it is taken for zero [SI].


def statements(calibration: Calibration, found: LeastSquares) -> list[str]:
    """Return sentences on what the data determine; one that says so if they determine everything."""
    names = [one.name for one in found.parameters]
    information = found.jacobian.T @ found.jacobian / max(found.scatter, 1e-300)
    # Beyond the range nothing is known; with its information the matrix is regular.
    covariance = np.linalg.inv(information + np.eye(len(names)))
    spread = np.sqrt(np.diag(covariance))
    loose = [name for name, one in zip(names, spread, strict=True) if 1.96 * one > WIDE]
    correlation = covariance / np.outer(spread, spread)
    trading = [
        (names[i], names[k], float(correlation[i, k]))
        for i, k in combinations(range(len(names)), 2)
        if abs(correlation[i, k]) >= TRADING
    ]
    words = [f"The data do not determine {name}: its interval covers most of the range." for name in loose]
    words += [
        f"{a} and {b} trade off (correlation {rho:.3f}): the data determine a combination of them only."
        for a, b, rho in trading
    ]
    if not words:
        return ["The data determine every key."]
    best = _helpful(calibration, found, information)
    return [*words, best] if best else words


def _helpful(calibration: Calibration, found: LeastSquares, information: FloatArray) -> str:
    """Return the measurement over time that would narrow the widest interval most; empty without one."""
    shares = np.clip(found.values - 1.0, 0.0, 1.0 - STEP)
    values = [one.value(float(share)) for one, share in zip(calibration.keys, shares, strict=True)]
    middle = calibration.run(values)
    moved = []
    for k, one in enumerate(calibration.keys):
        changed = list(values)
        changed[k] = one.value(float(shares[k]) + STEP)
        moved.append(calibration.run(changed))
    regular = information + np.eye(len(values))
    worst = int(np.argmax(np.diag(np.linalg.inv(regular))))
    before = float(np.sqrt(np.linalg.inv(regular)[worst, worst]))
    widths = {
        name: float(np.sqrt(np.linalg.inv(regular + gain.T @ gain)[worst, worst]))
        for name, gain in _gains(middle, moved)
    }
    if not widths or min(widths.values()) > 0.9 * before:
        return (
            "No further variable over time, measured to 1 % of its range, would narrow the widest interval."
        )
    name = min(widths, key=lambda one: widths[one])
    return (
        f"Measuring {name} as well, to 1 % of its range, would narrow the interval of "
        f"{found.parameters[worst].name} {before / widths[name]:.2g} times."
    )


def _gains(middle: xr.Dataset, moved: Sequence[xr.Dataset]) -> Iterator[tuple[str, FloatArray]]:
    """Yield the derivatives of each variable over time by the shares, over its noise, shape (n_t, n)."""
    last = min(float(run["time"].values[-1]) for run in (middle, *moved))
    times = np.linspace(0.0, last, _TIMES)
    for name in _names(middle):
        base, *others = (
            np.interp(times, run["time"].values, variable(run, name, "--data")) for run in (middle, *moved)
        )
        size, whole = float(np.ptp(base)), middle[name.partition(".")[0]].values
        if size <= max(_ROUNDING * float(np.ptp(whole)), _NOTHING):
            continue
        gain = (np.array(others) - base).T / (STEP * _NOISE * size)
        if np.isfinite(gain).all():
            yield name, gain


def _names(run: xr.Dataset) -> Iterator[str]:
    """Yield the names of variables over time, with every combination of labels."""
    for name in map(str, run.data_vars):
        dims = run[name].dims
        labels = [dim for dim in dims[1:] if dim in run.coords and run[dim].dtype.kind == "U"]
        if dims[:1] == ("time",) and len(labels) == len(dims) - 1 and run[name].dtype.kind == "f":
            for one in product(*(run[dim].values.tolist() for dim in labels)):
                yield ".".join((name, *one))
