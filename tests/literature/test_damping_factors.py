"""Restitution that the published damping factors really give, against independently computed values."""

from __future__ import annotations

import numpy as np
import pytest

from tribodyn.contact import DAMPING_FACTORS
from tribodyn.contact.damping_factors import rebound

MEANT = np.array([0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95, 0.99])
GIVEN = {
    "hunt-crossley": [
        0.51583,
        0.54685,
        0.58129,
        0.61974,
        0.66296,
        0.71195,
        0.76800,
        0.83287,
        0.90902,
        0.95237,
        0.99010,
    ],
    "lankarani-nikravesh": [
        0.66527,
        0.67226,
        0.68422,
        0.70163,
        0.72524,
        0.75615,
        0.79597,
        0.84710,
        0.91318,
        0.95351,
        0.99015,
    ],
    "gonthier": [
        0.10099,
        0.20461,
        0.30422,
        0.39779,
        0.48774,
        0.57728,
        0.66958,
        0.76800,
        0.87644,
        0.93593,
        0.98678,
    ],
    "flores": [
        0.06944,
        0.15554,
        0.25621,
        0.36287,
        0.47044,
        0.57728,
        0.68318,
        0.78854,
        0.89392,
        0.94683,
        0.98934,
    ],
}


@pytest.mark.parametrize("name", DAMPING_FACTORS)
def test_restitution_given(name: str) -> None:
    expected = np.array(GIVEN[name])
    # Half a unit of the fifth printed decimal.
    np.testing.assert_allclose(rebound(DAMPING_FACTORS[name](MEANT)), expected, rtol=0.0, atol=0.5001e-5)
