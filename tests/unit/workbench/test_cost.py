"""What a run will take, by what runs took."""

from tribodyn.mechanisms.catalogue import load_case
from tribodyn.workbench.server_state import Costs


def test_one_run_that_the_machine_held_up_does_not_end_a_drag():
    costs, case = Costs(), load_case("vsv")
    for seconds in (0.15, 0.16, 9.0, 0.14):
        costs.note(case, seconds)
        assert costs.expected(case) < 0.2
    for _ in range(3):
        costs.note(case, 9.0)
    assert 8.9 < costs.expected(case) < 9.1
