"""Heights as drawings state them, against closed forms."""

import math
from collections.abc import Callable

import numpy as np
import pytest

from tribodyn.surfaces import Scan, analyse
from tribodyn.surfaces.parameters import arithmetic_mean, mean_total_height, numbers

SINE = np.sin(2.0 * np.pi * np.arange(10_000) / 1000.0)


def test_a_sine_has_the_known_ratios() -> None:
    # Ra = 2a/π, Rz = 2a; ten waves of a thousand points leave 1e-5.
    assert arithmetic_mean(3.0 + SINE) == pytest.approx(2.0 / math.pi, rel=1e-4)
    assert mean_total_height(SINE) == pytest.approx(2.0, rel=1e-4)


def test_missing_heights_have_no_say() -> None:
    holed = SINE.copy()
    holed[100:120] = np.nan
    assert arithmetic_mean(holed) == pytest.approx(arithmetic_mean(SINE), rel=1e-2)


def test_profiles_and_maps_have_names_of_their_own(rough: Callable[..., Scan]) -> None:
    profile, area = (numbers(analyse(rough(*shape))) for shape in ((512,), (64, 80)))
    assert {"Ra_um", "Rq_um", "Rz_um"} <= profile.keys()
    assert {"Sa_um", "Sq_um"} <= area.keys()
    assert not {"Sa_um", "Sq_um"} & profile.keys()
    assert not {"Ra_um", "Rz_um"} & area.keys()
    assert profile["Rq_um"] == profile["sigma_um"]
    # Of Gaussian heights σ = √(π/2) Ra; a few hundred points scatter by some per cent.
    assert profile["Rq_um"] / profile["Ra_um"] == pytest.approx(math.sqrt(math.pi / 2.0), rel=0.1)
    assert profile["Ra_um"] < profile["Rz_um"]
