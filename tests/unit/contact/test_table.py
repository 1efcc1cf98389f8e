import dataclasses
import math
from collections.abc import Callable

import numpy as np
import pytest
from scipy.integrate import quad

from tribodyn.contact import RSDC, ContactLaw, KogutEtsion, SurfacePair, law_of_user, tabulate
from tribodyn.core.errors import InputError
from tribodyn.kernels.lookup import pressure_and_damping

#: Off the nodes, closer together where the pressure is small.
SEPARATIONS = -4.0 + 12.0 * np.sqrt(np.arange(1, 48) / 48.0)


def gauss(z: float) -> float:
    return math.exp(-0.5 * z * z) / math.sqrt(2.0 * math.pi)


def tail(z: float) -> float:
    return 0.5 * math.erfc(z / math.sqrt(2.0))


def adaptive(
    pair: SurfacePair, h: float, weight: Callable[[float], float]
) -> tuple[float, float, float, float]:
    """Return the four terms of Eqs. 2-4 at h* = ``h``, written out again and integrated adaptively [Pa]."""
    d = pair.critical_interference_star
    scale = 2.0 / 3.0 * pair.hardness_coefficient * pair.hardness * math.pi * pair.asperity_parameter
    end = 15.0 - min(h, 0.0)

    def integral(power: float, lower: float, upper: float) -> float:
        if lower >= end:
            return 0.0
        upper = min(upper, end)
        return float(
            quad(lambda s: s**power * weight(h + s), lower, upper, epsabs=0, epsrel=1e-11, limit=400)[0]
        )

    return (
        scale * d**-0.5 * integral(1.5, 0.0, d),
        scale * 1.03 * d**-0.425 * integral(1.425, d, 6.0 * d),
        scale * 1.40 * d**-0.263 * integral(1.263, 6.0 * d, 110.0 * d),
        2.0 * pair.hardness * math.pi * pair.asperity_parameter * integral(1.0, 110.0 * d, math.inf),
    )


def adaptive_damping(pair: SurfacePair, h: float) -> float:
    elastic, first, second, plastic = adaptive(pair, h, tail)
    mu = (plastic + first + second) / (elastic + first + second)
    end = 15.0 - min(h, 0.0)
    height = quad(lambda s: s**1.5 * gauss(h + s), 0.0, end, epsabs=0, epsrel=1e-11, limit=400)[0]
    stress = pair.composite_modulus * pair.asperity_density
    stress *= math.sqrt(pair.asperity_radius) * pair.roughness_rms**1.5
    return float(stress * mu / (mu + 1.0) * height)


# From nearly plastic through Table 1 to nearly elastic: δ_c* = 7e-8, 0.017, 1.7.
@pytest.mark.parametrize("hardness", [1e6, 492e6, 4.9e9])
def test_table_agrees_with_adaptive_quadrature(table_1_pair: SurfacePair, hardness: float) -> None:
    pair = dataclasses.replace(table_1_pair, hardness=hardness)
    table = tabulate(RSDC(pair), onset=8.0, smoothing_width=0.1)
    found = np.array([pressure_and_damping(table, h) for h in SEPARATIONS])
    pressure = [sum(adaptive(pair, h, gauss)) for h in SEPARATIONS]
    # 1e-6 is the accuracy that the model asks of the table.
    np.testing.assert_allclose(found[:, 0], pressure, rtol=1e-6)
    raw = SEPARATIONS < 7.9
    damping = [adaptive_damping(pair, h) for h in SEPARATIONS[raw]]
    np.testing.assert_allclose(found[raw, 2], damping, rtol=1e-6)


@pytest.mark.parametrize("law", [RSDC, KogutEtsion])
def test_only_a_tail_without_weight_is_left_out(table_1_pair: SurfacePair, law: type[ContactLaw]) -> None:
    # Of the pressure at h* = 0, 1e-11: less than the table's own error where a joint carries its load.
    found = law(table_1_pair)
    table = tabulate(found)
    at_end, beyond, at_zero = found.stiffness_pressure(np.array([table.h_last, table.h_last + 0.01, 0.0]))
    assert beyond <= 1e-11 * at_zero < at_end


def test_damping_is_zero_above_the_onset_and_whole_below_it(table_1_pair: SurfacePair) -> None:
    law = RSDC(table_1_pair)
    table = tabulate(law, onset=3.0, smoothing_width=0.5)
    for h_star in (3.0, 3.1, 4.0, 7.99):
        assert pressure_and_damping(table, h_star)[2:] == (0.0, 0.0)
    whole = law.damping_pressure(np.array([2.5]))[0]
    assert pressure_and_damping(table, 2.5)[2] == pytest.approx(whole, rel=1e-12)


@pytest.mark.parametrize(
    ("onset", "width", "key"),
    [
        (4.0, 0.0, "contact.smoothing_width"),
        (4.0, math.nan, "contact.smoothing_width"),
        (9.0, 1.0, "contact.onset_separation"),
        (math.nan, 1.0, "contact.onset_separation"),
        (-3.5, 1.0, "contact.onset_separation"),
    ],
)
def test_impossible_onset_is_refused_by_key(table_1_pair, onset, width, key):
    with pytest.raises(InputError) as caught:
        tabulate(KogutEtsion(table_1_pair), onset=onset, smoothing_width=width)
    assert caught.value.key == key


def test_a_pressure_that_rises_with_the_separation_is_refused(table_1_pair: SurfacePair) -> None:
    rising = law_of_user(lambda h_star: 1.0e6 * np.exp(0.5 * h_star))
    with pytest.raises(InputError, match=r"rises with the separation, from 1.353e\+05 Pa at h\* = -4"):
        tabulate(rising(table_1_pair))
