"""Whoever asks a run to stop waits no longer than a second, in whatever phase it is."""

import itertools
import time

import pytest

import tribodyn as td
from tribodyn.cases import Case
from tribodyn.core.errors import Stopped
from tribodyn.simulation import first_steps

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


@pytest.fixture(scope="module", params=FINE)
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
