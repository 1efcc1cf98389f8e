import numpy as np
import pytest

from tribodyn.contact import KogutEtsion, SurfacePair


@pytest.fixture
def law(table_1_pair: SurfacePair) -> KogutEtsion:
    return KogutEtsion(table_1_pair)


def test_regimes_are_adjacent_and_reach_from_zero_to_infinity(law: KogutEtsion) -> None:
    regimes = law.regimes
    assert regimes.elastic.lower == 0.0
    assert regimes.plastic.upper == np.inf
    assert [r.upper for r in regimes[:-1]] == [r.lower for r in regimes[1:]]


def test_load_of_an_asperity_jumps_as_published_between_regimes(law: KogutEtsion) -> None:
    # Printed with the published law (ν = 0.3): +3.0 %, 13.2344 to 13.4565, and 3·110/K at full plasticity.
    elastic, first, second, plastic = law.regimes
    d = law.pair.critical_interference_star

    def load(regime: tuple[float, float, float, float], interference: float) -> float:
        return regime[0] * (interference * d) ** regime[1] / (elastic.stress * d**1.5)

    assert load(first, 1.0) == pytest.approx(1.03, rel=1e-12)
    assert load(first, 6.0) == pytest.approx(13.2344, rel=4e-6)  # printed to six digits
    assert load(second, 6.0) == pytest.approx(13.4565, rel=4e-6)
    assert load(second, 110.0) == pytest.approx(530.160, rel=1e-6)
    assert load(plastic, 110.0) == pytest.approx(330.0 / law.pair.hardness_coefficient, rel=1e-12)
