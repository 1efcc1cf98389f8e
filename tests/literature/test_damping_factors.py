"""Restitution that the published damping factors really give, against independently computed values."""

import numpy as np
import pytest

from tribodyn.contact import DAMPING_FACTORS

MEANT = np.array([0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95, 0.99])
#: Roots of the energy balance; an integration of the impact on δ^1.5 gave the same to 2e-7.
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
    "herbert-mcwhannell": [
        0.49070,
        0.50078,
        0.51997,
        0.55031,
        0.59362,
        0.65107,
        0.72268,
        0.80698,
        0.90089,
        0.95011,
        0.99000,
    ],
    "lee-wang": [
        0.68666,
        0.71195,
        0.73900,
        0.76800,
        0.79920,
        0.83287,
        0.86934,
        0.90902,
        0.95237,
        0.97561,
        0.99502,
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
    "zhiying-qishao": [
        0.21747,
        0.26642,
        0.32670,
        0.39884,
        0.48261,
        0.57690,
        0.67957,
        0.78736,
        0.89592,
        0.94886,
        0.98995,
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


@pytest.mark.parametrize("name", GIVEN)
def test_restitution_given(name: str) -> None:
    expected = np.array(GIVEN[name])
    # Half a unit of the fifth printed decimal.
    np.testing.assert_allclose(DAMPING_FACTORS[name].realised(MEANT), expected, rtol=0.0, atol=0.5001e-5)


def test_hu_and_guo() -> None:
    # Published: a = 3(1 − e)/(2e). The e that comes back is 1/(1 + 2a/3) only to first order in 1 − e.
    ratio = DAMPING_FACTORS["hu-guo"](MEANT)
    np.testing.assert_allclose(1.0 / (1.0 + 2.0 * ratio / 3.0), MEANT, rtol=1e-14)
    balance = ratio - np.log1p(ratio)
    back = ratio * DAMPING_FACTORS["hu-guo"].realised(MEANT)
    # The energy balance a − ln(1 + a) = −x − ln(1 − x), as accurate as Lambert's W beside its branch point.
    np.testing.assert_allclose(-back - np.log1p(-back), balance, rtol=1e-6)


def test_how_the_factors_begin_at_elastic_impact() -> None:
    """An impact loses 2a/3 of its speed at first: right factors begin as 3(1 − e)/2."""
    small = 1e-4
    slopes = {name: float(factor(np.array(1.0 - small))) / small for name, factor in DAMPING_FACTORS.items()}
    right = {
        "hunt-crossley",
        "herbert-mcwhannell",
        "lankarani-nikravesh",
        "zhiying-qishao",
        "hu-guo",
        "calibrated",
    }
    assert {name: slopes[name] for name in right} == pytest.approx(dict.fromkeys(right, 1.5), rel=1e-3)
    assert slopes["lee-wang"] == pytest.approx(0.75, rel=1e-3)


def test_from_where_on_a_factor_is_right() -> None:
    # Read off the numbers above: the last that misses by more than 0.05, and the next.
    for name, low, high in (
        ("hunt-crossley", 0.7, 0.8),
        ("herbert-mcwhannell", 0.6, 0.7),
        ("lee-wang", 0.9, 0.95),
        ("lankarani-nikravesh", 0.7, 0.8),
        ("zhiying-qishao", 0.2, 0.3),
    ):
        assert low < DAMPING_FACTORS[name].valid_from <= high
    assert DAMPING_FACTORS["flores"].valid_from == DAMPING_FACTORS["calibrated"].valid_from == 0.01


def test_kelvin_and_voigt() -> None:
    # ln e = −πζ/√(1 − ζ²): a mass on a spring and a dashpot, contact until δ is zero again.
    zeta = 0.5 * DAMPING_FACTORS["kelvin-voigt"](MEANT)
    np.testing.assert_allclose(-np.pi * zeta / np.sqrt(1.0 - zeta**2), np.log(MEANT), rtol=1e-12)
    np.testing.assert_allclose(DAMPING_FACTORS["kelvin-voigt"].realised(MEANT), MEANT, rtol=1e-12)


def test_calibrated_returns_what_is_asked() -> None:
    # 1e-3 is asked for; the energy balance is solved to rounding.
    np.testing.assert_allclose(DAMPING_FACTORS["calibrated"].realised(MEANT), MEANT, rtol=1e-9)
