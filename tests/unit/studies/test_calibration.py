"""Calibration on a model whose runs take no time: a decaying oscillation that stands for a run of a case."""

import dataclasses
import errno
import json
import os
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

import tribodyn as td
from mebdf.arrays import FloatArray
from tribodyn.core.errors import InputError
from tribodyn.mechanisms.self_checks import YIELDED
from tribodyn.studies import Sampling, calibration, fit_report, posterior
from tribodyn.studies.calibration import EVALUATIONS, Calibration, VariedKey
from tribodyn.studies.fit_report import statements
from tribodyn.studies.measured import Experiment, Measured, MeasuredCurve, read

TIMES: FloatArray = np.linspace(0.0, 2.0, 40)
TRUTH = {"joint.clearance": 33e-6, "joint.friction_coefficient": 0.17}
RANGES = ("joint.clearance=10..60um", "joint.friction_coefficient=0.05..0.3")


def _model(case: td.studies.sweep.__class__) -> xr.Dataset:
    """Return a run whose amplitude follows the clearance and whose decay follows the friction."""
    time = np.linspace(0.0, 2.0, 400)
    amplitude, decay = 1e5 * case.joint.clearance, 8.0 * case.joint.friction_coefficient
    both = amplitude * decay
    return xr.Dataset(
        {
            "swing": ("time", amplitude * np.exp(-decay * time) * np.cos(7.0 * time), {"units": "m"}),
            "product": ("time", both * (1.0 + time), {"units": "N"}),
            "level": ("time", amplitude * (2.0 + time), {"units": "N m"}),
        },
        {"time": time},
        {"kind": "vsv", "failure": ""},
    )


@pytest.fixture(autouse=True)
def _quick(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(calibration, "simulate", _model)


def _case():
    return td.load_case("vsv")


def _file(folder: Path, name: str, seed: int = 0, noise: float = 0.01) -> Path:
    run = _model(_case().replace({key: _text(key) for key in TRUTH}))
    values = np.interp(TIMES, run["time"].values, run[name].values)
    values = values + np.random.default_rng(seed).normal(0.0, noise * np.ptp(values), values.size)
    unit = run[name].attrs["units"]
    rows = "\n".join(f"{1e3 * t!r}, {v!r}" for t, v in zip(TIMES.tolist(), values.tolist(), strict=True))
    path = folder / f"{name}-{seed}.csv"
    path.write_text(f"time [ms], {name} [{unit}]\n{rows}\n", encoding="utf-8")
    return path


def _text(key: str) -> str | float:
    return f"{TRUTH[key]} m" if key == "joint.clearance" else TRUTH[key]


def _fit(data: Measured, folder: Path | None = None, **options) -> Calibration:
    keys = [VariedKey.of(_case(), text) for text in RANGES]
    experiments = [Experiment("run.csv", {}, data)]
    return Calibration(_case(), keys, experiments, data.noise(0.01), folder, **options)


def _read(path: Path) -> Measured:
    return read(path, _model(_case()))


@pytest.mark.parametrize(("fits", "least"), [(40, 34), pytest.param(100, 90, marks=pytest.mark.long)])
def test_intervals_hold_the_truth_in_19_of_20_fits(fits: int, least: int, tmp_path: Path) -> None:
    # 95 %, less three deviations of 40 draws, and two of 100.
    held = dict.fromkeys(TRUTH, 0)
    for seed in range(fits):
        fit = _fit(_read(_file(tmp_path, "swing", seed)))
        keys = fit_report.fitted_keys(fit, fit.fitted(1), None)
        for key in keys:
            held[key.path] += key.interval[0] <= TRUTH[key.path] <= key.interval[1]
    assert all(least <= count < fits for count in held.values()), held


def test_profile_and_covariance_agree_where_the_model_is_nearly_linear(tmp_path: Path) -> None:
    fit = _fit(_read(_file(tmp_path, "swing")))
    found = fit.fitted(2)
    (clearance, _) = fit_report.fitted_keys(fit, found, [fit.profile(found, k) for k in range(2)])
    assert clearance.profile is not None
    np.testing.assert_allclose(clearance.profile, clearance.interval, rtol=0.01)


def test_an_outlier_hardly_moves_a_robust_fit(tmp_path: Path) -> None:
    path = _file(tmp_path, "swing")
    lines = path.read_text(encoding="utf-8").splitlines()
    lines[5] = lines[5].split(",")[0] + ", 40"
    path.write_text("\n".join(lines), encoding="utf-8")
    fit = _fit(_read(path))
    assert fit_report.fitted_keys(fit, fit.fitted(2), None)[0].value == pytest.approx(33e-6, rel=0.02)


def test_what_only_a_product_determines_is_named_with_what_would_help(tmp_path: Path) -> None:
    fit = _fit(_read(_file(tmp_path, "product")))
    words = " ".join(statements(fit, fit.fitted(2)))
    assert "joint.clearance and joint.friction_coefficient trade off" in words
    assert "Measuring level as well" in words or "Measuring swing as well" in words


def test_an_interrupted_fit_goes_on_to_the_same_result(tmp_path: Path) -> None:
    data = _read(_file(tmp_path, "swing"))
    whole = _fit(data).fitted(2)
    left = [20]

    def interrupt(text: str) -> None:
        left[0] -= 1
        if left[0] == 0:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        _fit(data, tmp_path, note=interrupt).fitted(2)
    with (tmp_path / EVALUATIONS).open("a", encoding="utf-8") as file:
        file.write('{"values": [1e-5, 0.')  # as a killed process leaves it
    noted: list[str] = []
    resumed = _fit(data, tmp_path, note=noted.append).fitted(2)
    assert resumed.values.tolist() == whole.values.tolist()
    assert noted[0].startswith("run 20:")


def test_evaluations_of_another_fit_are_refused(tmp_path: Path) -> None:
    _fit(_read(_file(tmp_path, "swing", 1)), tmp_path).fitted(1)
    with pytest.raises(InputError, match="another fit"):
        _fit(_read(_file(tmp_path, "swing", 2)), tmp_path)


def test_the_fitted_case_is_a_case_with_its_spread(tmp_path: Path) -> None:
    fit = _fit(_read(_file(tmp_path, "swing")))
    found = fit.fitted(2)
    fit_report.save(fit, found, fit_report.fitted_keys(fit, found, None), ["words"], tmp_path)
    text = (tmp_path / fit_report.CASE).read_text(encoding="utf-8")
    assert '--vary joint.clearance="normal(' in text
    case = td.load_case(tmp_path / fit_report.CASE)
    assert case.joint.clearance == pytest.approx(33e-6, rel=0.02)
    spread = text.split('joint.clearance="')[1].split('"')[0]
    assert td.studies.make_plan(case, {"joint.clearance": spread}, Sampling(samples=3)).points
    assert "words" in (tmp_path / fit_report.PAGE).read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ("time [s], swing [N]\n0, 1\n1, 2\n", "is not a unit of"),
        ("time [s], swig [m]\n0, 1\n1, 2\n", "swing"),
        ("time [s], swing\n0, 1\n1, 2\n", "unit in brackets"),
        ("time [s], swing [m]\n1, 1\n0, 2\n", "must rise"),
        ("time [s], swing [m]\n0, 1\n9, 2\n", "data reach to 9 s"),
        ("time [s], swing [m]\n0, one\n1, 2\n", "no number"),
        ("angle [rad], swing [m]\n0, 1\n1, 2\n", "first column"),
        ("quantity, value\nsteps, many\n", "no number"),
        ("quantity, mean\nsteps, 3\n", "columns quantity, value"),
        ("quantity, value\nsteps\n", "row 1 has no value"),
        (f"time [s], swing [m]\n0, {'1' * 200_000}\n1, 2\n", "field larger"),
        (f"time [s], swing{' ' * 20_000}x [m] [\n0, 1\n1, 2\n", "unit in brackets"),
    ],
)
def test_data_that_fit_no_run_are_refused(content: str, message: str, tmp_path: Path) -> None:
    path = tmp_path / "bad.csv"
    path.write_text(content, encoding="utf-8")
    with pytest.raises(InputError, match=message):
        _read(path)


def _with_outputs() -> xr.Dataset:
    """Return a run with outputs in several units, all of which the variable calls plain numbers."""
    time = np.linspace(0.0, 1.0, 5)
    values = np.stack([1e-6 * time, np.radians(time), 1e-3 * time], axis=1)
    return xr.Dataset(
        {
            "output_value": (("time", "output"), values, {"units": "1"}),
            "output_error": (("time", "output"), values, {"units": "1"}),
            "share": ("time", time, {"units": "1"}),
        },
        {"time": time, "output": ["tip", "arm", "speed"], "output_unit": ("output", ["m", "rad", "m/s"])},
    )


@pytest.mark.parametrize(
    ("name", "unit", "value"),
    [
        ("output_error.tip", "um", 60e-6),
        ("output_value.tip", "mm", 60e-3),
        ("output_error.arm", "deg", np.radians(60.0)),
        ("output_error.speed", "mm/s", 60e-3),
        ("share", "%", 0.6),
        ("share", "1", 60.0),
    ],
)
def test_the_unit_of_an_output_is_its_own(name: str, unit: str, value: float, tmp_path: Path) -> None:
    path = tmp_path / "run.csv"
    path.write_text(f"time [s], {name} [{unit}]\n0, 0\n1, 60\n", encoding="utf-8")
    (curve,) = read(path, _with_outputs()).parts
    assert isinstance(curve, MeasuredCurve)
    assert curve.values[1] == pytest.approx(value, rel=1e-12)


@pytest.mark.parametrize(
    ("name", "unit"),
    [("output_error.tip", "kg"), ("output_error.tip", "deg"), ("output_error.arm", "um"), ("share", "kg")],
)
def test_a_wrong_unit_of_an_output_is_refused(name: str, unit: str, tmp_path: Path) -> None:
    path = tmp_path / "run.csv"
    path.write_text(f"time [s], {name} [{unit}]\n0, 0\n1, 60\n", encoding="utf-8")
    with pytest.raises(InputError, match=f"column 2.*{unit}"):
        read(path, _with_outputs())


def _tampered() -> dict[str, Callable[[list[str]], list[str]]]:
    """Return what may have happened to the lines of a file of evaluations."""
    entry = {"values": [2e-5, 0.1], "computed": [0.0] * TIMES.size}

    def with_line(**changes: object) -> Callable[[list[str]], list[str]]:
        return lambda lines: [*lines, json.dumps(entry | changes)]

    return {
        "empty": lambda lines: [],
        "without its first line": lambda lines: lines[1:],
        "first line of another kind": lambda lines: ["[1]", *lines[1:]],
        "a list": lambda lines: [*lines, "[1, 2]"],
        "no JSON": lambda lines: [*lines, "{", *lines[1:]],
        "too deep": lambda lines: [*lines, "[" * 100_000],
        "not finite": with_line(computed=[float("nan")] * TIMES.size),
        "not finite key": with_line(values=[float("inf"), 0.1]),
        "huge": with_line(values=[10**400, 1]),
        "short": with_line(computed=[0.0]),
        "long": with_line(values=[2e-5, 0.1, 0.2]),
        "texts": with_line(values=["2e-5", "0.1"]),
        "nested": with_line(computed=[[0.0]] * TIMES.size),
        "switches": with_line(values=[True, False]),
        "null values": with_line(values=None),
    }


@pytest.mark.parametrize("change", _tampered())
def test_tampered_evaluations_are_refused(change: str, tmp_path: Path) -> None:
    data = _read(_file(tmp_path, "swing"))
    _fit(data, tmp_path).computed([0.5, 0.5])
    path = tmp_path / EVALUATIONS
    lines = _tampered()[change](path.read_text(encoding="utf-8").splitlines())
    path.write_text("".join(f"{line}\n" for line in lines), encoding="utf-8")
    with pytest.raises(InputError, match=r"evaluations\.jsonl.*choose another folder or remove the file"):
        _fit(data, tmp_path)


def test_a_full_disk_leaves_no_evaluations_without_their_fit(tmp_path, monkeypatch):
    """An empty file would be taken for that of any fit, and the runs of another one for those of this one."""
    data = _read(_file(tmp_path, "swing"))

    def full(*_: object, **__: object) -> None:
        raise OSError(errno.ENOSPC, "No space left on device")

    with monkeypatch.context() as patch:
        patch.setattr(os, "fsync", full)
        with pytest.raises(OSError, match="No space"):
            _fit(data, tmp_path).computed([0.5, 0.5])
    assert not (tmp_path / EVALUATIONS).exists()


def test_runs_that_failed_are_kept_as_such(tmp_path: Path) -> None:
    data = _read(_file(tmp_path, "swing"))
    fit = _fit(data, tmp_path)
    fit.known[name := json.dumps([2e-5, 0.1])] = [float("nan")] * TIMES.size
    fit._keep(name)
    assert "NaN" not in (tmp_path / EVALUATIONS).read_text(encoding="utf-8")
    assert np.isnan(_fit(data, tmp_path).known[name]).all()


def test_values_with_elastic_bodies_are_named_also_by_a_fit_that_goes_on(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def softer(case):
        found = _model(case)
        return found.assign_attrs(notes=json.dumps([YIELDED] if case.joint.clearance > 50e-6 else []))

    monkeypatch.setattr(calibration, "simulate", softer)
    data = _read(_file(tmp_path, "swing"))
    fit = _fit(data, tmp_path)
    fit.computed([0.5, 0.5])
    assert fit.remarks() == []
    fit.computed([0.9, 0.5])
    for one in (fit, _fit(data, tmp_path)):
        (note,) = one.remarks()
        assert note.startswith("1 of 2 points have elastic bodies")
        assert note.endswith(": joint.clearance = 55 um, joint.friction_coefficient = 0.175")


def test_runs_with_settings_of_their_own_determine_what_one_does_not(tmp_path: Path) -> None:
    case = _case()
    experiments = [
        Experiment("product.csv", {}, _read(_file(tmp_path, "product"))),
        Experiment("swing.csv", {"run.duration": "30 ms"}, _read(_file(tmp_path, "swing", 1))),
    ]
    noise = np.concatenate([one.data.noise(0.01) for one in experiments])
    keys = [VariedKey.of(case, text) for text in RANGES]
    fit = Calibration(case, keys, experiments, noise, tmp_path)
    found = fit.fitted(2)
    for key in fit_report.fitted_keys(fit, found, None):
        assert key.value == pytest.approx(TRUTH[key.path], rel=0.03)
    table = fit_report.residuals_table(fit, found).splitlines()
    assert [line.split(",")[0] for line in (table[1], table[-1])] == ["product.csv", "swing.csv"]
    with pytest.raises(InputError, match="another fit"):
        Calibration(case, keys, experiments[:1], noise[: TIMES.size], tmp_path)


def test_each_run_has_its_settings(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    seen: list[float] = []

    def noted(case):
        seen.append(case.run.duration)
        return _model(case)

    monkeypatch.setattr(calibration, "simulate", noted)
    data = _read(_file(tmp_path, "swing"))
    settings = ({"run.duration": "30 ms"}, {"run.duration": "40 ms"})
    experiments = [Experiment("swing.csv", one, data) for one in settings]
    keys = [VariedKey.of(_case(), text) for text in RANGES]
    fit = Calibration(_case(), keys, experiments, np.tile(data.noise(0.01), 2))
    fit.computed([0.5, 0.5])
    assert seen == [30e-3, 40e-3]


def test_a_setting_of_a_fitted_key_is_refused(tmp_path: Path) -> None:
    data = _read(_file(tmp_path, "swing"))
    keys = [VariedKey.of(_case(), text) for text in RANGES]
    experiments = [Experiment("swing.csv", {"joint.clearance": "20 um"}, data)]
    with pytest.raises(InputError, match=r"sets joint\.clearance, which is fitted"):
        Calibration(_case(), keys, experiments, data.noise(0.01))


def test_the_posterior_of_a_linear_model_is_that_of_the_covariance(tmp_path: Path) -> None:
    pytest.importorskip("emcee", reason="the extra posterior is not installed")
    fit = _fit(_read(_file(tmp_path, "swing")))
    found = dataclasses.replace(fit.fitted(1), loss="linear")

    def linear(given: dict[str, float]) -> FloatArray:
        moved = np.array([given[key.key.path] for key in fit.keys]) - found.values
        return found.residuals + found.jacobian @ moved

    # Of the residuals only the part that no key explains may stay: the fit is the minimum then.
    explained = found.jacobian @ np.linalg.lstsq(found.jacobian, found.residuals, rcond=None)[0]
    found = dataclasses.replace(found, residuals=found.residuals - explained)
    fit.residuals = linear
    samples = posterior.sample(fit, found, 4000)
    assert samples.statements == []
    for k, key in enumerate(fit_report.fitted_keys(fit, found, None, samples)):
        assert key.posterior is not None
        low, high = key.interval
        np.testing.assert_allclose(key.posterior, (low, high), atol=0.1 * (high - low))
        assert key.posterior == samples.interval(k)


def test_an_interrupted_chain_goes_on_to_the_same_samples(tmp_path: Path) -> None:
    pytest.importorskip("emcee", reason="the extra posterior is not installed")
    data = _read(_file(tmp_path, "swing"))
    whole = _fit(data)
    expected = posterior.sample(whole, whole.fitted(1), 20)
    assert "below 50 its intervals are rough" in expected.statements[0]
    left = [len(whole.known) - 40]

    def interrupt(text: str) -> None:
        left[0] -= 1
        if left[0] == 0:
            raise KeyboardInterrupt

    first = _fit(data, tmp_path, note=interrupt)
    found = first.fitted(1)
    with pytest.raises(KeyboardInterrupt):
        posterior.sample(first, found, 20)
    again = _fit(data, tmp_path)
    resumed = posterior.sample(again, again.fitted(1), 20)
    assert resumed.samples.tolist() == expected.samples.tolist()


def test_without_the_sampler_the_option_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "emcee", None)
    with pytest.raises(InputError, match=r"install tribodyn\[posterior\]"):
        posterior.sampler_package()


def test_determined_keys_are_said_to_be_so(tmp_path: Path) -> None:
    fit = _fit(_read(_file(tmp_path, "swing")))
    assert statements(fit, fit.fitted(2)) == ["The data determine every key."]


def test_rounding_is_no_measurement_that_would_help(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def with_rounding(case: td.studies.sweep.__class__) -> xr.Dataset:
        run = _model(case)[["product"]]
        time = run["time"].values
        across = np.random.default_rng(int(1e12 * case.joint.clearance)).normal(0.0, 2e-34, time.size)
        both = np.stack([run["product"].values, across], axis=1)
        run["displacement"] = (("time", "axis"), both, {"units": "m"})
        return run.assign_coords(axis=["x", "z"])

    monkeypatch.setattr(calibration, "simulate", with_rounding)
    fit = _fit(_read(_file(tmp_path, "product")))
    words = " ".join(statements(fit, fit.fitted(2)))
    assert "trade off" in words
    assert "displacement" not in words


def test_evaluations_that_are_no_text_are_refused(tmp_path: Path) -> None:
    data = _read(_file(tmp_path, "swing"))
    _fit(data, tmp_path).computed([0.5, 0.5])
    with (tmp_path / EVALUATIONS).open("ab") as file:
        file.write(b"\xff\xfe\n")
    with pytest.raises(InputError, match="line 3"):
        _fit(data, tmp_path)
