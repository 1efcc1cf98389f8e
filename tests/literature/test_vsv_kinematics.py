"""Numbers of the ideal mechanism and one attitude of the trunnion that were computed independently of us.

The crank angles are those of Table 2 and Fig. 10 of the source paper; Eqs. 11 to 18 give the vane angle.
"""

import math

import numpy as np
import pytest
from scipy.optimize import brentq, minimize_scalar

from tribodyn.core.errors import InputError
from tribodyn.kernels.vsv.data import THETA_V, VALUE, VELOCITY
from tribodyn.papers.cheng_2022.reduced.equilibrium import equilibrium
from tribodyn.papers.cheng_2022.reduced.problem import vsv_data, vsv_memory
from tribodyn.papers.cheng_2022.reduced.reach import check_reach, ideal_vane_angle

VANE_ANGLES = [(-16.0, 60.9995), (-10.0, 73.165), (0.0, 89.658), (10.0, 103.691), (24.0, 120.277)]


def loop_gap(lengths, crank, vane):
    """Return |S1S2|² − l_2² [m²] of the ideal mechanism, written in vectors."""
    along = np.array([math.cos(lengths.gamma), 0.0, math.sin(lengths.gamma)])
    s1 = lengths.l_m * along + lengths.l_1 * np.array([-math.sin(crank), 0.0, math.cos(crank)])
    s3 = np.array([lengths.l_4 * math.cos(vane), lengths.l_4 * (math.sin(vane) - 1.0), lengths.l_3])
    arm = math.atan2(s3[0], s3[2]) + lengths.phi
    s2 = np.array([lengths.l_3 * math.sin(arm), s3[1], lengths.l_3 * math.cos(arm)])
    return float(np.sum((s2 - s1) ** 2)) - lengths.l_2**2


def smallest_gap(lengths, crank):
    """Return the least |S1S2|² − l_2² over vane angles between the two assemblies, and where it is."""
    found = minimize_scalar(
        lambda vane: loop_gap(lengths, crank, vane),
        bounds=(0.2, 0.9),
        method="bounded",
        options={"xatol": 1e-12},
    )
    return found.fun, found.x


@pytest.mark.parametrize(("crank", "vane"), VANE_ANGLES)
def test_vane_angle_over_crank_angle(make_vsv, crank, vane):
    lengths = make_vsv().lengths
    found = math.degrees(ideal_vane_angle(lengths, np.radians([crank]))[0])
    # Half of the last digit given.
    assert found == pytest.approx(vane, abs=5e-5 if crank == -16.0 else 5e-4)
    assert loop_gap(lengths, math.radians(crank), math.radians(found)) == pytest.approx(0.0, abs=1e-15)


def test_the_other_assembly_at_the_start(make_vsv):
    lengths = make_vsv().lengths
    other = brentq(lambda vane: loop_gap(lengths, math.radians(-16.0), vane), -0.2, 0.3)
    assert math.degrees(other) == pytest.approx(-1.6, abs=0.05)


def test_ninety_degrees_is_not_where_the_paper_starts(make_vsv):
    # The paper's text puts θ_v = 90° at θ_a = −16°, against its own Eq. 16.
    crank = brentq(lambda a: ideal_vane_angle(make_vsv().lengths, np.array([a]))[0] - math.pi / 2, -0.1, 0.1)
    assert math.degrees(crank) == pytest.approx(0.228, abs=5e-4)


def test_the_assemblies_merge_at_the_limit_of_reach(make_vsv):
    # Where the closure touches zero without crossing it. −23.52° has been quoted for this limit, but
    # there the two assemblies are still 5° apart (26.4° and 31.5°); they merge at −23.575°, θ_v = 29.0°.
    lengths = make_vsv().lengths
    limit = brentq(lambda crank: smallest_gap(lengths, crank)[0], math.radians(-23.6), math.radians(-23.5))
    assert math.degrees(limit) == pytest.approx(-23.5747, abs=1e-4)
    assert math.degrees(smallest_gap(lengths, limit)[1]) == pytest.approx(29.00, abs=0.01)
    just_inside, just_outside = limit + math.radians(1e-3), limit - math.radians(1e-3)
    assert np.isfinite(ideal_vane_angle(lengths, np.array([just_inside])))
    assert np.isnan(ideal_vane_angle(lengths, np.array([just_outside])))
    with pytest.raises(InputError, match="reaches only from"):
        check_reach(lengths, just_outside, 0.0)


def test_kinetostatic_attitude_at_2_5_seconds(make_vsv):
    # Traction sees the actual vane speed, which at rest in the clearance is the ideal one.
    vsv = make_vsv()
    data = vsv_data(vsv)
    memory = vsv_memory(data)
    first = equilibrium(data, memory, 2.5, direction=1.0)
    speed = memory.scratch.motion[THETA_V, VELOCITY]
    q = equilibrium(data, memory, 2.5, direction=1.0, slip_speed=speed, guess=first)
    assert np.degrees(memory.scratch.motion[THETA_V, VALUE]) == pytest.approx(115.0, abs=10.0)
    # The reference has the linear gap of Eq. 48. The second-order term of the tilt closes each edge by
    # ½ r tan²φ, 7 nm; the ends touch in different directions, so the centre may move by up to twice that.
    second = 0.5e6 * vsv.joint.geometry.radius * float(np.sum(np.tan(q[2:4]) ** 2))
    assert second < 0.01
    np.testing.assert_allclose(1e6 * q[:2], [-3.35, 6.13], atol=0.005 + 2.0 * second)
