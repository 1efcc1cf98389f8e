import numpy as np
import pytest

from tribodyn.mechanisms.catalogue import load_case
from tribodyn.papers.cheng_2022.reduced.problem import initial_state, vsv_data, vsv_memory
from tribodyn.papers.cheng_2022.reduced.system import vsv_of


@pytest.mark.parametrize("clearance", [5, 20, 100, 190, 500])
@pytest.mark.parametrize("friction", ["traction", "moment"])
def test_every_clearance_has_an_equilibrium(clearance, friction):
    case = load_case("vsv").replace({"joint.clearance": f"{clearance} um", "joint.friction": friction})
    vsv = vsv_of(case)
    data = vsv_data(vsv, duration=1.0)
    attitude = initial_state(data, vsv_memory(data), "equilibrium")
    # Some point of the axis lies within three σ of the wall, and none beyond it by more than that.
    ends = [
        np.hypot(attitude[0] - z * np.tan(attitude[3]), attitude[1] - z * np.tan(attitude[2]))
        for z in (-data.mechanism.half_length, data.mechanism.half_length)
    ]
    assert max(ends) == pytest.approx(data.joint.clearance, abs=3.0 * data.joint.roughness)
