"""What a run is estimated to take, against what it takes."""

import json
import math
import subprocess
import sys
import time
from collections.abc import Mapping
from importlib.resources import files
from pathlib import Path
from statistics import median

import pytest

import tribodyn as td
from tribodyn.cases.case import Case
from tribodyn.cli.main import main
from tribodyn.core import platforms
from tribodyn.core.errors import InputError
from tribodyn.mechanisms.catalogue import MECHANISMS, built_in
from tribodyn.mechanisms.workload import Workload
from tribodyn.simulation import estimate, first_steps

#: Peak memory of a process [B], that of its own program: the one of ``getrusage`` begins with the memory of
#: the process that started it.
PEAK = """
lines = pathlib.Path("/proc/self/status").read_text().splitlines()
peak = 1024 * next(int(line.split()[1]) for line in lines if line.startswith("VmHWM"))
"""
#: A run in a process of its own.
MEASURE = f"""
import json, pathlib, sys, tempfile, time
import tribodyn as td
from tribodyn.mechanisms.results import write_run
from tribodyn.simulation import first_steps
case = td.load_case(sys.argv[1], json.loads(sys.argv[2]))
first_steps(case)
begin = time.process_time()
dataset = td.simulate(case)
with tempfile.TemporaryDirectory() as folder:
    write_run(dataset, pathlib.Path(folder))
solver = json.loads(dataset.attrs["solver"])
{PEAK}print(json.dumps(dict(memory=peak, seconds=time.process_time() - begin, steps=solver["steps"])))
"""
PEAK_OF_CHECK = f"""
import pathlib, sys
from tribodyn.cli.main import main
main(["check", *sys.argv[1:]])
{PEAK}print(peak)
"""
FILM = "joints.bearing.film.grid"
FINEST = {"solver.grid.theta": 4096, "solver.grid.z": 256}
Changes = Mapping[str, object]

#: None of them is among the runs that the coefficients were fitted to.
VALIDATED: list[tuple[str, Changes]] = [
    ("vsv", {"run.cycles": 7}),
    ("vsv", {"solver.grid.theta": 700, "solver.grid.z": 90}),
    ("vsv", {"run.output_interval": "0.2 ms"}),
    ("vsv", {"drive.angular_frequency": "3 rad/s", "joint.clearance": "60 um"}),
    ("vsv", {"wear.cycles": 1_000_000}),
    ("vsv", {"solver.name": "bdf", "run.cycles": 1}),
    ("vsv-engine", {"run.cycles": 5}),
    ("journal-dry", {"run.duration": "30 ms", "loads.x.force": "20 N", "loads.y.force": "0 N"}),
    ("journal-dry", {"solver.grid.theta": 1024, "solver.grid.z": 32}),
    ("journal-dry", {"run.output_interval": "0.2 us"}),
    ("journal-oil", {f"{FILM}.theta": 128, f"{FILM}.z": 48}),
    ("journal-oil", {"drives.motor.speed": "300 rad/s", "run.duration": "0.4 s"}),
    ("slider-crank", {"drives.motor.speed.value": "1500 rpm", "run.cycles": 5}),
    ("slider-crank", {"solver.grid.theta": 300, "solver.grid.z": 40}),
    ("slider-crank", {"run.output_interval": "2 us"}),
    ("slider-crank", {"joints.wrist.clearance.ideal": True, "run.cycles": 30}),
    ("slider-crank", {"solver.name": "radau"}),
    ("four-bar", {"run.cycles": 8}),
    ("slider-crank-3d", {"run.duration": "20 s"}),
    ("vsv-free", {"joints.trunnion.clearance.radial": "40 um"}),
    ("vsv-joints", {"solver.grid.theta": 144, "solver.grid.z": 24}),
]


def work_of(case: Case) -> Workload:
    return MECHANISMS[case.kind()].workload(case)  # type: ignore[arg-type]


def measured(name: str, changes: Changes) -> dict[str, float]:
    """Return what a run takes; its equations are compiled before."""
    case = td.load_case(name, changes)
    first_steps(case)
    command = [sys.executable, "-W", "ignore", "-c", MEASURE, name, json.dumps(changes)]
    done = subprocess.run(command, check=True, capture_output=True, text=True)
    found: dict[str, float] = json.loads(done.stdout)
    return found


@pytest.mark.parametrize("name", built_in())
def test_counts_are_those_of_the_problem(name: str) -> None:
    case = td.load_case(name)
    work, system = work_of(case), MECHANISMS[case.kind()].system(case)  # type: ignore[arg-type]
    problem = system.problem(case.duration)
    assert work.states == problem.y0.size
    assert work.quantities == problem.n_kept
    assert work.nodes + work.mapped == math.prod(problem.field_shape)
    assert work.samples == pytest.approx(system.output_times(case.duration).size, rel=0.01)
    pictures = system.picture_times(case.duration).size
    assert work.fields == pytest.approx(pictures, rel=0.05)


@pytest.mark.skipif(sys.platform != "linux", reason="other systems count the peak of memory otherwise")
@pytest.mark.parametrize(
    ("name", "changes"),
    [
        pytest.param("vsv", {"run.output_interval": "0.5 ms"}, marks=pytest.mark.long),
        pytest.param("journal-oil", {}, marks=pytest.mark.long),
        ("slider-crank", {}),
    ],
)
def test_memory_and_steps_of_a_run_are_as_estimated(name: str, changes: Changes) -> None:
    found, case = measured(name, changes), td.load_case(name, changes)
    assert 0.5 < estimate(case).memory / found["memory"] < 2.0
    assert 1.0 / 3.0 < work_of(case).steps / found["steps"] < 3.0


@pytest.mark.long
@pytest.mark.skipif(sys.platform != "linux", reason="other systems count the peak of memory otherwise")
def test_memory_and_time_of_other_runs_are_as_estimated() -> None:
    ratios = {}
    for name, changes in VALIDATED:
        found, expected = measured(name, changes), estimate(td.load_case(name, changes))
        ratios[name, str(changes)] = (
            round(expected.memory / found["memory"], 2),
            round(expected.seconds / found["seconds"], 2),
        )
    print(*(f"{memory:5.2f} {time:5.2f}  {run}" for run, (memory, time) in ratios.items()), sep="\n")
    assert all(0.5 < memory < 2.0 for memory, _ in ratios.values()), ratios
    # Of a busy machine all runs take more time.
    usual = median(time for _, time in ratios.values())
    assert all(1.0 / 3.0 < time / usual < 3.0 for _, time in ratios.values()), ratios


@pytest.mark.parametrize(
    ("name", "changes", "what", "key"),
    [
        ("vsv", FINEST, "memory", "solver.grid.theta or solver.grid.z"),
        ("slider-crank", FINEST, "memory", "solver.grid.theta or solver.grid.z"),
        ("journal-dry", FINEST, "memory", "solver.grid.theta or solver.grid.z"),
        (
            "journal-oil",
            {f"{FILM}.theta": 4096, f"{FILM}.z": 1024},
            "memory",
            "film.grid.theta or film.grid.z",
        ),
        ("vsv", {"run.output_interval": "10 us"}, "memory", "run.output_interval"),
        ("vsv", {"run.cycles": 10_000, "run.output_interval": "1 s"}, "memory", "run.impact_rows"),
        (
            "slider-crank",
            {"run.cycles": 1e6, "run.output_interval": "1 s", "run.step_rows": 0},
            "processor time",
            "run.cycles",
        ),
        ("vsv", {"wear.cycles": 10**12}, "processor time", "wear.cycles"),
        ("slider-crank", {"wear.cycles": 10**12}, "processor time", "wear.cycles"),
        (
            "slider-crank-3d",
            {"run.duration": "1e6 s", "run.output_interval": "1 s"},
            "processor time",
            "run.duration",
        ),
    ],
)
def test_what_takes_too_much_is_said_with_value_limit_and_key(name, changes, what, key):
    limit = {"memory": "2 GB", "processor time": "60 min"}[what]
    texts = [text for text in td.check(td.load_case(name, changes)) if "estimated" in text]
    assert any(f" of {what}, more than {limit}: change {key}" in text for text in texts), texts


@pytest.mark.parametrize("name", built_in())
def test_built_in_cases_take_little(name: str) -> None:
    assert estimate(name).warnings == ()


def test_a_run_warns_before_it_starts(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(str(tmp_path))

    def simulate(*_: object, **__: object) -> None:
        raise InputError("reached the simulation")

    monkeypatch.setattr("tribodyn.simulation.simulate", simulate)
    assert main(["run", "vsv", *(f"--set={key}={value}" for key, value in FINEST.items())]) == 2
    told = capsys.readouterr().err
    assert told.index("GB of memory, more than 2 GB: change solver.grid") < told.index("reached")


def test_a_run_that_no_memory_holds_is_refused_and_nothing_is_written(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(str(tmp_path))
    limit = tmp_path / "memory.max"
    limit.write_text("100000000\n")
    assert platforms.memory() > 1e8
    monkeypatch.setattr(platforms, "_MOST_MEMORY", limit)
    assert main(["run", "slider-crank", "--set=run.cycles=0.01"]) == 2
    told = capsys.readouterr().err
    assert "the run is estimated to take 0." in told
    assert "GB of memory, more than the 0.1 GB of this machine: change" in told
    assert [path.name for path in tmp_path.iterdir()] == ["memory.max"]
    limit.write_text("max\n")
    assert main(["run", "slider-crank", "--set=run.cycles=0.01", "--no-figures", "--no-report"]) == 0


@pytest.mark.skipif(sys.platform != "linux", reason="other systems count the peak of memory otherwise")
def test_a_check_takes_little_memory_however_fine_the_grid() -> None:
    options = [f"--set={key}={value}" for key, value in FINEST.items()]
    command = [sys.executable, "-c", PEAK_OF_CHECK, "vsv-joints", *options]
    done = subprocess.run(command, check=True, capture_output=True, text=True)
    assert int(done.stdout.splitlines()[-1]) < 6e8


@pytest.mark.parametrize("length", [{"run.duration": "1e9 s"}, {"run.cycles": 1e6}])
def test_output_times_by_default_are_limited_too(length: Changes) -> None:
    with pytest.raises(InputError, match="at most 2000000 output times"):
        td.load_case("slider-crank", length)


def processor_time(case: Case) -> float:
    """Return the least processor time of three runs of a case [s]."""
    first_steps(case)
    times = []
    for _ in range(3):
        begin = time.process_time()
        td.simulate(case)
        times.append(time.process_time() - begin)
    return min(times)


@pytest.mark.long
def test_an_oil_film_takes_a_few_times_the_time_of_a_dry_joint(tmp_path: Path) -> None:
    """The costs page gives the factors; here they hold within 1.7."""
    oiled = Path(str(files("tribodyn.mechanism").joinpath("built_in/slider-crank-oil.toml")))
    film = '[joints.big-end.film]\nviscosity = "0.01 Pa s"\n'
    text = oiled.read_text(encoding="utf-8")
    assert film in text
    (tmp_path / "dry.toml").write_text(text.replace(film, ""), encoding="utf-8")
    pairs = {
        4.9: (td.load_case("slider-crank-oil"), td.load_case(tmp_path / "dry.toml")),
        2.5: (td.load_case("journal-oil"), td.load_case("journal-dry")),
    }
    for factor, cases in pairs.items():
        oil, dry = map(processor_time, cases)
        assert factor / 1.7 < oil / dry < 1.7 * factor, factor
