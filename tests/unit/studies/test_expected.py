"""What a sweep is expected to take."""

import tribodyn as td
from tribodyn.studies.plan import make_plan
from tribodyn.studies.sweep import warnings_of


def test_a_sweep_warns_of_all_its_points_together() -> None:
    case = td.load_case("vsv", {"run.output_interval": "20 ms"})
    plan = make_plan(case, {"run.cycles": "10:200:10"})
    assert warnings_of(plan, 1, 1) == []
    (told,) = warnings_of(plan, 100 * len(plan.points), 1)
    assert told.startswith("2000 points in 1 processes are estimated to take ")
    assert told.endswith("more than 60 min: give fewer values, or change run.cycles")


def test_a_sweep_warns_of_the_memory_of_its_processes() -> None:
    plan = make_plan(td.load_case("vsv"), {"solver.grid.theta": "96,192,4096,256"})
    assert warnings_of(plan, 4, 1) == []
    (told,) = warnings_of(plan, 4, 8)
    assert told.startswith("4 points at once are estimated to take ")
    assert told.endswith("more than 2 GB: give fewer --workers, or change solver.grid.theta or solver.grid.z")


def test_a_small_sweep_on_many_processors_says_nothing() -> None:
    plan = make_plan(td.load_case("vsv"), {"joint.clearance": "10 um:60 um:1 um"})
    assert warnings_of(plan, 51, 64) == []
