from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from tribodyn.contact.damping_factors import DAMPING_FACTORS, rebound


@pytest.mark.parametrize("factor", DAMPING_FACTORS.values(), ids=DAMPING_FACTORS.keys())
def test_elastic_impact_has_no_damping(factor) -> None:  # type: ignore[no-untyped-def]
    assert factor(np.array([1.0]))[0] == 0.0


@pytest.mark.parametrize(("ratio", "exponent"), [(0.05, 1.5), (0.4, 1.5), (0.4, 10.0 / 9.0), (3.0, 1.0)])
def test_rebound_is_that_of_the_equation_of_motion(ratio: float, exponent: float) -> None:
    def motion(_t: float, state: np.ndarray) -> list[float]:
        depth = max(state[0], 0.0)
        return [state[1], -(depth**exponent) * (1.0 + ratio * state[1])]

    def leaves(_t: float, state: np.ndarray) -> float:
        return float(state[0])

    leaves.terminal, leaves.direction = True, -1.0  # type: ignore[attr-defined]
    run = solve_ivp(motion, (0.0, 100.0), [0.0, 1.0], events=leaves, rtol=1e-10, atol=1e-12)
    # The event is found to about 1e-10; δⁿ, not smooth at δ = 0, costs the integrator some digits.
    assert rebound(np.array([ratio]))[0] == pytest.approx(-run.y_events[0][0, 1], rel=1e-7)
