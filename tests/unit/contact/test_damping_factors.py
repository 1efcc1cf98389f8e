import numpy as np
import pytest
from scipy.integrate import solve_ivp

from tribodyn.contact.damping_factors import DAMPING_FACTORS, DampingFactor, calibrated, rebound

MEANT = np.array([0.1, 0.3, 0.5, 0.7, 0.9, 0.99])


def impact(ratio: float, exponent: float, dashpot: bool = False) -> float:
    """Return the rebound of a mass 1 that meets the spring δⁿ with the speed 1, by integration."""

    def motion(_t: float, state: np.ndarray) -> list[float]:
        depth = max(state[0], 0.0)
        damping = ratio if dashpot else ratio * depth**exponent
        return [state[1], -(depth**exponent) - damping * state[1]]

    def leaves(_t: float, state: np.ndarray) -> float:
        return float(state[0])

    leaves.terminal, leaves.direction = True, -1.0  # type: ignore[attr-defined]
    run = solve_ivp(motion, (0.0, 1e3), [0.0, 1.0], events=leaves, rtol=1e-10, atol=1e-12)
    return -float(run.y_events[0][0, 1])


@pytest.mark.parametrize(("ratio", "exponent"), [(0.05, 1.5), (0.4, 1.5), (0.4, 10.0 / 9.0), (3.0, 1.0)])
def test_rebound_is_that_of_the_equation_of_motion(ratio: float, exponent: float) -> None:
    # The event is found to about 1e-10; δⁿ, not smooth at δ = 0, costs the integrator some digits.
    assert rebound(np.array([ratio]))[0] == pytest.approx(impact(ratio, exponent), rel=1e-7)


@pytest.mark.parametrize("name", DAMPING_FACTORS)
@pytest.mark.parametrize("meant", MEANT)
def test_realised_restitution_of_a_single_impact(name: str, meant: float) -> None:
    factor = DAMPING_FACTORS[name]
    # A dashpot is for the linear spring, on which F_max = 1 here; the others for any.
    came_out = impact(float(factor(np.array(meant))), 1.0 if factor.dashpot else 1.5, factor.dashpot)
    # 1e-4 is asked for; see above for what the integration is good to.
    assert factor.realised(np.array(meant)) == pytest.approx(came_out, abs=1e-6)


def test_the_smallest_restitutions_are_met_too() -> None:
    # Deep in contact the restitution of the paper's law falls towards zero; warnings are errors here.
    wanted = np.array([1e-2, 1e-3, 1e-6])
    np.testing.assert_allclose(rebound(calibrated(wanted)), wanted, rtol=1e-6)


@pytest.mark.parametrize("factor", DAMPING_FACTORS.values(), ids=DAMPING_FACTORS.keys())
def test_elastic_impact_has_no_damping(factor: DampingFactor) -> None:
    assert factor(np.array([1.0]))[0] == 0.0
    assert factor.realised(np.array([1.0]))[0] == 1.0
