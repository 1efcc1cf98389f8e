"""Parts, even times and key results of a result in notebooks."""

import numpy as np
import pytest
from tests.unit.mechanism.made_up import result

import tribodyn.accessor  # noqa: F401
from tribodyn.core.errors import InputError

RESULT = result()


def test_a_joint_is_chosen_by_its_name_and_a_wrong_one_answered() -> None:
    assert RESULT.tribodyn.sel(joint="wrist")["reaction_force"].dims == ("time", "axis")
    with pytest.raises(
        InputError, match=r'joint: given "wirst"; allowed: main, pin, wrist, guide; did you mean "wrist"'
    ):
        RESULT.tribodyn.sel(joint="wirst")
    with pytest.raises(InputError, match="joints: no such dimension"):
        RESULT.tribodyn.sel(joints="wrist")


def test_a_result_is_read_at_even_times() -> None:
    step = 5e-5
    found = RESULT.tribodyn.resample(step)
    np.testing.assert_allclose(np.diff(found["time"]), step)
    expected = np.interp(found["time"], RESULT["time"], RESULT["joint_angle"].values[:, 0])
    np.testing.assert_allclose(found["joint_angle"].values[:, 0], expected, atol=1e-12)
    assert found.attrs["kind"] == "mechanism"
    with pytest.raises(InputError, match=r"above 0 and at most 0\.012"):
        RESULT.tribodyn.resample(0.0)


def test_key_results_are_a_table() -> None:
    numbers = RESULT.tribodyn.numbers
    assert numbers.loc["force_max_N_wrist", "part"] == "wrist"
    assert numbers.loc["force_max_N_wrist", "unit"] == "N"
    assert numbers.loc["force_max_N_wrist", "value"] == RESULT.tribodyn.summary["force_max_N_wrist"]


def test_a_chart_is_drawn_over_the_angle_of_a_joint() -> None:
    figure = RESULT.tribodyn.plot.joint_forces(over="main")
    assert figure.axes[-1].get_xlabel() == "angle of main [°]"
    assert RESULT.tribodyn.plot().texts[0].get_text() == "Errors of the outputs"
    with pytest.raises(InputError, match=r'over: given "mian"; allowed: a joint, .*did you mean "main"'):
        RESULT.tribodyn.plot.joint_forces(over="mian")
    with pytest.raises(InputError, match="orbits has no time axis"):
        RESULT.tribodyn.plot.orbits(over="main")
