"""Files of a fit: the fitted case, a page, residuals, all numbers as JSON, and keys the data leave open."""

import datetime
import json
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations, product
from pathlib import Path
from typing import Any, Final

import numpy as np
import xarray as xr

from mebdf.arrays import FloatArray
from tribodyn.results.columns import variable
from tribodyn.results.store import write_text
from tribodyn.studies.calibration import STEP, Calibration
from tribodyn.studies.least_squares import LeastSquares
from tribodyn.studies.measured import MeasuredCurve
from tribodyn.studies.posterior import Posterior

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


CASE: Final = "fitted.toml"
PAGE: Final = "fit.md"
NUMBERS: Final = "fit.json"
RESIDUALS: Final = "residuals.csv"


@dataclass(frozen=True)
class FittedKey:
    """A fitted key."""

    #: Its path, and the fitted value as in a case file.
    path: str
    text: str
    #: Fitted value and standard deviation [SI].
    value: float
    deviation: float
    #: 95 % intervals by the covariance, by the profile of the cost and by the posterior distribution [SI];
    #: None where they were left out.
    interval: tuple[float, float]
    #: 95 % intervals by the covariance, by the profile of the cost and by the posterior distribution [SI];
    #: None where they were left out.
    profile: tuple[float, float] | None
    scatter: str  #: The distribution as a sweep takes it.
    #: 95 % intervals by the covariance, by the profile of the cost and by the posterior distribution [SI];
    #: None where they were left out.
    posterior: tuple[float, float] | None = None

    @property
    def words(self) -> str:
        """The key as a line."""
        return f"{self.path} = {self.text}"


def fitted_keys(
    calibration: Calibration,
    found: LeastSquares,
    profiles: Sequence[tuple[float, float]] | None,
    posterior: Posterior | None = None,
) -> list[FittedKey]:
    """Return the fitted keys; an interval by the covariance ends at the range."""
    keys = []
    covariance = found.covariance()
    for k, (one, parameter) in enumerate(zip(calibration.keys, found.parameters, strict=True)):
        value = one.value(found.named[parameter.name] - 1.0)
        half = found.half_width(parameter.name) * (one.high - one.low)
        deviation = float(np.sqrt(covariance[k, k])) * (one.high - one.low)
        ends = one.text(float(f"{value:.6g}")), one.text(float(f"{deviation:.3g}"))
        keys.append(
            FittedKey(
                path=parameter.name,
                text=one.text(float(f"{value:.6g}")),
                value=value,
                deviation=deviation,
                interval=(max(value - half, one.low), min(value + half, one.high)),
                profile=None if profiles is None else profiles[k],
                scatter=f"normal({ends[0]}, {ends[1]})",
                posterior=None if posterior is None else posterior.interval(k),
            )
        )
    return keys


def interval_text(calibration: Calibration, which: int, ends: tuple[float, float]) -> str:
    """Return an interval of a key as text."""
    one = calibration.keys[which]
    return " to ".join(one.text(float(f"{end:.4g}")) for end in ends)


def save(
    calibration: Calibration,
    found: LeastSquares,
    keys: Sequence[FittedKey],
    words: Sequence[str],
    folder: Path,
) -> None:
    """Write all files of a fit.

    ``words``: what the data determine; ``folder``: where files go.
    """
    write_text(folder / CASE, fitted_case(calibration, keys))
    write_text(folder / PAGE, page(calibration, found, keys, words))
    document = json.dumps(as_json(calibration, found, keys, words), indent=2, ensure_ascii=False)
    write_text(folder / NUMBERS, document + "\n")
    write_text(folder / RESIDUALS, residuals_table(calibration, found))


def fitted_case(calibration: Calibration, keys: Sequence[FittedKey]) -> str:
    """Return the case with fitted values; comments hold source and spread, as sweeps take it."""
    files = ", ".join(f"{one.file} (SHA-256 {one.data.digest[:16]})" for one in calibration.experiments)
    lines = [
        f"# Fitted to {files}, {datetime.date.today().isoformat()}.",
        "# tribodyn sweep THIS_FILE --samples 100 "
        + " ".join(f'--vary {key.path}="{key.scatter}"' for key in keys),
    ]
    case = calibration.changed([key.value for key in keys])
    return "\n".join(lines) + "\n" + case.to_toml()


def page(
    calibration: Calibration, found: LeastSquares, keys: Sequence[FittedKey], words: Sequence[str]
) -> str:
    """Return the page of a fit."""
    lines = [
        f"# Fit to {', '.join(one.file for one in calibration.experiments)}",
        "",
        f"{calibration.values.size} values, {len(calibration.known)} sets of values of the keys tried, "
        f"{'robust' if found.loss != 'linear' else 'plain'} least squares.",
        "",
        "| key | fitted | 95 % by covariance | 95 % by profile | 95 % by posterior | for sweeps |",
        "|---|---|---|---|---|---|",
    ]
    for k, key in enumerate(keys):
        intervals = (key.interval, key.profile, key.posterior)
        cells = ("" if ends is None else interval_text(calibration, k, ends) for ends in intervals)
        lines.append(f"| `{key.path}` | {key.text} | {' | '.join(cells)} | `{key.scatter}` |")
    lines += ["", "## What the data determine", "", *(f"- {sentence}" for sentence in words)]
    lines += ["", "## Residuals", "", "| quantity | values | root mean square, over the noise | largest |"]
    lines.append("|---|---|---|---|")
    for _, part, of_part in calibration.of_parts(found.residuals):
        rms, largest = np.sqrt(np.mean(of_part**2)), np.abs(of_part).max()
        lines.append(f"| {part.name} | {of_part.size} | {rms:.3g} | {largest:.3g} |")
    return "\n".join(lines) + "\n"


def as_json(
    calibration: Calibration, found: LeastSquares, keys: Sequence[FittedKey], words: Sequence[str]
) -> dict[str, Any]:
    """Return the fit as JSON values, SI units."""
    deviations = np.sqrt(np.diag(found.covariance()))
    outer = np.outer(deviations, deviations)
    correlation = np.divide(found.covariance(), outer, out=np.eye(len(keys)), where=outer > 0.0)
    return {
        "data": [
            {"file": one.file, "sha256": one.data.digest, "settings": dict(one.settings)}
            for one in calibration.experiments
        ],
        "runs": len(calibration.known),
        "keys": [
            {
                "path": key.path,
                "fitted": key.text,
                "value": key.value,
                "deviation": key.deviation,
                "interval": list(key.interval),
                "profile": None if key.profile is None else list(key.profile),
                "posterior": None if key.posterior is None else list(key.posterior),
                "distribution": key.scatter,
            }
            for key in keys
        ],
        "correlation": correlation.tolist(),
        "scatter": found.scatter,
        "statements": list(words),
    }


def residuals_table(calibration: Calibration, found: LeastSquares) -> str:
    """Return measured values, computed values and residuals, as CSV."""
    lines = ["data,quantity,time [s],measured,computed,residual over noise"]
    computed = found.residuals * calibration.noise + calibration.values
    for (experiment, part, of_part), (*_, values) in zip(
        calibration.of_parts(found.residuals), calibration.of_parts(computed), strict=True
    ):
        curve = isinstance(part, MeasuredCurve)
        times = part.times if isinstance(part, MeasuredCurve) else [float("nan")]
        measured = part.values if isinstance(part, MeasuredCurve) else [part.value]
        for time, one, value, missed in zip(times, measured, values, of_part, strict=True):
            place = f"{time:.9g}" if curve else ""
            lines.append(f"{experiment.file},{part.name},{place},{one:.9g},{value:.9g},{missed:.4g}")
    return "\n".join(lines) + "\n"
