"""What else holds."""

import numpy as np
import pytest

from tribodyn.studies import DISTRIBUTIONS, SAMPLERS

ARGUMENTS = {
    "normal": ((20.0, 2.0), 20.0, 2.0),
    "lognormal": ((20.0, 5.0), 20.0, 5.0),
    "uniform": ((10.0, 30.0), 20.0, 20.0 / np.sqrt(12.0)),
    # Mean and variance of a triangular distribution: (a + b + c)/3 and (a² + b² + c² − ab − ac − bc)/18.
    "triangular": ((10.0, 12.0, 20.0), 14.0, np.sqrt((100 + 144 + 400 - 120 - 200 - 240) / 18)),
}


@pytest.mark.parametrize("name", DISTRIBUTIONS)
def test_the_ends_of_the_probabilities_are_finite(name: str) -> None:
    assert np.isfinite(DISTRIBUTIONS[name].quantiles(ARGUMENTS[name][0], np.array([0.0, 1.0]))).all()


def test_more_samples_of_a_sobol_sequence_keep_the_first() -> None:
    assert (SAMPLERS["sobol"](20, 2, 3)[:12] == SAMPLERS["sobol"](12, 2, 3)).all()
