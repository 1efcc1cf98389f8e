"""Fits of real mechanisms to runs with noise: coverage of the intervals, and time."""

import time
from collections.abc import Mapping, Sequence

import numpy as np
import pytest
import xarray as xr

import tribodyn as td
from mebdf.arrays import FloatArray
from tribodyn.results.columns import variable
from tribodyn.studies.calibration import Calibration, VariedKey
from tribodyn.studies.fit_report import fitted_keys, statements
from tribodyn.studies.measured import Experiment, Measured, MeasuredCurve

FITS = 100
NOISE = 0.01  #: Standard deviation over the range of a curve.
PROCESSOR_TIME = 120.0  #: 60 s on two cores [s].

JOURNAL = {
    "bodies.journal.mass": (0.31, "kg", "0.1..0.6kg"),
    "joints.bearing.clearance.radial": (33e-6, "m", "25..45um"),
}
#: True value, its unit, and range of each key.
CRANK = {
    "joints.wrist.clearance.radial": (33e-6, "m", "10..60um"),
    "bodies.slider.mass": (0.16, "kg", "0.1..0.3kg"),
    "bodies.rod.mass": (0.24, "kg", "0.1..0.4kg"),
}


def _measured(run: xr.Dataset, names: Sequence[str], times: FloatArray, seed: int) -> Measured:
    random = np.random.default_rng(seed)
    curves = []
    for name in names:
        values = np.interp(times, run["time"].values, variable(run, name, "--data"))
        values = values + random.normal(0.0, NOISE * np.ptp(values), values.size)
        curves.append(MeasuredCurve(name, "", 1.0, times, values))
    return Measured(tuple(curves), "")


def _case(name: str, changes: dict[str, object], truth: Mapping[str, tuple[float, str, str]]):
    """Return a case and its run with the true values."""
    case = td.load_case(name).replace(changes)
    return case, td.simulate(
        case.replace({key: f"{value} {unit}" for key, (value, unit, _) in truth.items()})
    )


def _calibration(case, truth: Mapping[str, tuple[float, str, str]], data: Measured) -> Calibration:
    keys = [VariedKey.of(case, f"{key}={limits}") for key, (_, _, limits) in truth.items()]
    return Calibration(case, keys, [Experiment("run.csv", {}, data)], data.noise(NOISE))


@pytest.mark.long(minutes=8.5)
def test_intervals_of_a_journal_hold_the_truth_in_90_to_99_of_100_fits() -> None:
    case, run = _case("journal-dry", {"run.duration": "2 ms", "contact.law": "ke"}, JOURNAL)
    times = np.linspace(1e-4, 1.8e-3, 30)
    held = dict.fromkeys(JOURNAL, 0)
    for seed in range(FITS):
        fit = _calibration(
            case, JOURNAL, _measured(run, ("displacement.bearing.x", "displacement.bearing.y"), times, seed)
        )
        for key in fitted_keys(fit, fit.fitted(1), None):
            low, high = key.interval
            held[key.path] += low <= JOURNAL[key.path][0] <= high
    assert all(90 <= count <= 99 for count in held.values()), held


@pytest.mark.long(minutes=2)
def test_three_keys_of_a_slider_crank_take_a_minute_on_two_cores() -> None:
    case, run = _case("slider-crank", {"run.cycles": 1}, CRANK)
    times = np.linspace(0.1, 0.95, 60) * float(run["time"].values[-1])
    data = _measured(run, ("acceleration.slider.x", "drive_moment.main"), times, 1)
    began = time.process_time()
    fit = _calibration(case, CRANK, data)
    found = fit.fitted(2)
    keys = fitted_keys(fit, found, [fit.profile(found, k) for k in range(len(CRANK))])
    words = statements(fit, found)
    assert time.process_time() - began < PROCESSOR_TIME
    assert words == ["The data determine every key."]
    for key in keys:
        assert key.value == pytest.approx(CRANK[key.path][0], rel=0.05)
