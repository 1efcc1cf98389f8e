import math
from collections.abc import Callable

import numpy as np
import pytest
from scipy.integrate import quad

from tribodyn.contact.contact_law import asperity_integral, density, exceedance
from tribodyn.core.arrays import FloatArray


@pytest.mark.parametrize("weight", [density, exceedance])
@pytest.mark.parametrize(
    ("power", "lower", "upper"),
    [
        (1.5, 0.0, 0.017),
        (1.425, 0.017, 0.1),
        (1.263, 0.1, 1.9),
        (1.0, 1.9, math.inf),
        (1.5, 0.0, math.inf),
        (1.263, 6e-7, 1.1e-5),
        (1.263, 3.0, 55.0),
    ],
)
def test_agrees_with_adaptive_quadrature(
    weight: Callable[[FloatArray], FloatArray], power: float, lower: float, upper: float
) -> None:
    h_star = np.linspace(-4.0, 8.0, 13)

    def reference(h: float) -> float:
        # Beyond 15 standard deviations the integrand is below 1e-48.
        top = min(upper, 15.0 - min(h, 0.0))
        return float(
            quad(lambda s: s**power * weight(h + s), lower, top, epsabs=0, epsrel=1e-12, limit=400)[0]
        )

    expected = np.array([reference(h) for h in h_star])
    # 1e-6 is asked for; both quadratures are good to some 1e-12 and the larger number holds them there.
    np.testing.assert_allclose(
        asperity_integral(h_star, power, lower, upper, weight), expected, rtol=1e-10, atol=1e-300
    )
