"""Cases that runs take, runs that are stopped, and runs of many cycles."""

import itertools
import time
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

import tribodyn as td
from benchmarks.vane.vsv_case import problem_of, vsv_case
from tribodyn import load_case, simulate
from tribodyn.cases import Case
from tribodyn.cli.main import main
from tribodyn.core.errors import InputError, Stopped
from tribodyn.integrate import integrate
from tribodyn.kernels.vsv.quantities import OBSERVED
from tribodyn.simulation import first_steps

PENDULUM = """
case = "mechanism"
[bodies.rod]
mass = "1 kg"
centre = "0.5, 0, 0 m"
inertia = "0.01, 0.01, 0.01 kg m^2"
[joints.pivot]
type = "revolute"
between = ["ground", "rod"]
point = "0, 0, 0 m"
axis = [0, 0, 1]
"""


def test_a_mechanism_a_name_and_a_file_stand_for_their_case(tmp_path: Path) -> None:
    rod = {"mass": "1 kg", "centre": "0.5, 0, 0 m", "inertia": "0.01, 0.01, 0.01 kg m^2"}
    pendulum = td.Mechanism("Pendulum", gravity="0, -9.81, 0 m/s^2", run={"duration": "20 ms"})
    pendulum.body("rod", **rod).revolute("pivot", "ground", "rod", point="0, 0, 0 m", axis=[0, 0, 1])
    file = tmp_path / "pendulum.toml"
    file.write_text(pendulum.case().to_toml(), encoding="utf-8")
    expected = td.simulate(pendulum.case())
    for given in (pendulum, file, str(file)):
        found = td.simulate(given)
        xr.testing.assert_identical(found["joint_angle"], expected["joint_angle"])


def test_a_name_is_that_of_a_built_in_case() -> None:
    assert td.simulate("four-bar").attrs["failure"] == ""
    with pytest.raises(InputError, match="did you mean slider-crank"):
        td.simulate("slider-crnk")


def test_a_change_gives_what_a_file_lacks(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "pendulum.toml"
    file.write_text(PENDULUM, encoding="utf-8")
    with pytest.raises(InputError, match="say how long"):
        td.load_case(file)
    assert td.load_case(file, {"run.duration": "1 s"}) == td.load_case(file, {"run.duration": "1000 ms"})
    assert main(["check", str(file)]) == 2
    assert "say how long" in capsys.readouterr().err
    assert main(["check", str(file), "--set", "run.duration=1 s"]) == 0
    # Alternatives go, and what is still wrong is said.
    assert main(["check", str(file), "--set", "run.durration=1 s"]) == 2
    assert "the nearest valid one is run.duration" in capsys.readouterr().err
    assert main(["check", str(tmp_path / "missing.toml"), "--set", "run.duration=1 s"]) == 2
    assert "there is no such file" in capsys.readouterr().err


@pytest.mark.parametrize("given", [3, None, {"case": "vsv"}, object()])
def test_what_is_no_case_is_refused(given: object) -> None:
    with pytest.raises(InputError, match=r"case: given .*; allowed: a case, a Mechanism, the name"):
        td.simulate(given)  # type: ignore[arg-type]


#: Cases whose start and whose checks take seconds.
FINE = {
    "vsv": {"run.duration": "20 ms", "solver.grid.theta": 1024, "solver.grid.z": 64},
    "journal-dry": {"run.duration": "1 ms", "solver.grid.theta": 1024, "solver.grid.z": 64},
    "slider-crank": {"run.cycles": 0.01, "solver.grid.theta": 1024, "solver.grid.z": 64},
}


class Caller:
    """Notes when it is asked, and wants to stop from some question on."""

    def __init__(self, patience: float = float("inf")) -> None:
        self.patience = patience
        self.asked: list[float] = []

    def __call__(self) -> bool:
        self.asked.append(time.thread_time())
        return len(self.asked) > self.patience


@pytest.fixture(
    scope="module",
    params=["vsv", *(pytest.param(name, marks=pytest.mark.long) for name in ("slider-crank", "journal-dry"))],
)
def case(request: pytest.FixtureRequest) -> Case:
    """Return a case whose equations are loaded."""
    found = td.load_case(request.param).replace(FINE[request.param])
    first_steps(found)
    return found


def test_no_phase_of_a_run_works_for_a_second_without_a_question(case: Case) -> None:
    caller, begin = Caller(), time.thread_time()
    assert td.simulate(case, stop=caller).attrs["failure"] == ""
    asked = [begin, *caller.asked, time.thread_time()]
    # Of the processor's time, which other work on the machine leaves alone.
    assert max(b - a for a, b in itertools.pairwise(asked)) < 1.0


def test_a_run_stopped_in_any_phase_says_so() -> None:
    case = td.load_case("vsv").replace({"run.duration": "20 ms"})
    caller = Caller()
    td.simulate(case, stop=caller)
    with pytest.raises(Stopped):
        td.simulate(case, stop=Caller(0))
    # What was computed is kept, but it is not whole: a comparison was left out.
    result = td.simulate(case, stop=Caller(len(caller.asked) - 1))
    assert result.attrs["failure"] == "interrupted"
    assert result.attrs["time_reached"] == 0.02


@pytest.mark.long
def test_a_hundred_cycles_reach_their_end() -> None:
    # At the 167th reversal the step once fell below the spacing of times.
    sparse = {"run.cycles": 100, "run.output_interval": "100 ms", "run.impact_window": "0 s"}
    dataset = simulate(load_case("vsv").replace(sparse))
    assert not dataset.attrs["failure"]
    np.testing.assert_allclose(dataset.attrs["time_reached"], 200.0 * np.pi)


@pytest.mark.parametrize("cycles", [84, 9999])
def test_a_cycle_is_the_same_however_late_it_is(cycles: int) -> None:
    angles = []
    for begin in (0.0, 2.0 * np.pi * cycles):
        problem = problem_of(*vsv_case(1.0))
        segments = problem.data.actions.segments.copy()
        segments.begin += begin
        data = problem.data._replace(actions=problem.data.actions._replace(segments=segments))
        late = replace(problem, data=data, t_span=(begin, begin + 3.3), breakpoints=(begin + np.pi,))
        solution = integrate(late, output_times=[begin + 3.3])
        assert solution.complete, solution.failure
        angles.append(solution.rows[0, OBSERVED.index("theta_v")])
    # 0.16 s after the reversal, runs differ by what the tolerances allow, 1e-5° each.
    np.testing.assert_allclose(angles[1], angles[0], rtol=0.0, atol=np.radians(2e-5))
