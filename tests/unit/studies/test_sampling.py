import numpy as np
import pytest

from tribodyn.studies import DISTRIBUTIONS, SAMPLERS

#: Probabilities whose quantiles have the moments of the distribution, but for what lies in the last tails.
MANY = (np.arange(200_000) + 0.5) / 200_000

ARGUMENTS = {
    "normal": ((20.0, 2.0), 20.0, 2.0),
    "lognormal": ((20.0, 5.0), 20.0, 5.0),
    "uniform": ((10.0, 30.0), 20.0, 20.0 / np.sqrt(12.0)),
    # Mean and variance of a triangular distribution: (a + b + c)/3 and (a² + b² + c² − ab − ac − bc)/18.
    "triangular": ((10.0, 12.0, 20.0), 14.0, np.sqrt((100 + 144 + 400 - 120 - 200 - 240) / 18)),
}


@pytest.mark.parametrize("name", DISTRIBUTIONS)
def test_mean_and_deviation_are_those_asked_for(name: str) -> None:
    arguments, mean, deviation = ARGUMENTS[name]
    values = DISTRIBUTIONS[name].quantiles(arguments, MANY)
    # The tails beyond the outermost of the probabilities hold less than 1e-4 of the deviation.
    assert values.mean() == pytest.approx(mean, rel=1e-4)
    assert values.std() == pytest.approx(deviation, rel=1e-3)


def test_a_truncated_normal_stays_inside() -> None:
    values = DISTRIBUTIONS["normal"].quantiles((20.0, 10.0, 15.0, 22.0), MANY)
    assert values.min() >= 15.0
    assert values.max() <= 22.0


@pytest.mark.parametrize("name", SAMPLERS)
@pytest.mark.parametrize("samples", [1, 5, 64])
def test_samples_lie_in_the_cube_and_repeat_with_their_seed(name: str, samples: int) -> None:
    cube = SAMPLERS[name](samples, 3, 7)
    assert cube.shape == (5 * samples if name == "saltelli" else samples, 3)
    assert ((cube >= 0.0) & (cube < 1.0)).all()
    assert (SAMPLERS[name](samples, 3, 7) == cube).all()
    assert (SAMPLERS[name](samples, 3, 8) != cube).any()


@pytest.mark.parametrize("name", SAMPLERS)
def test_each_stratum_holds_one_sample(name: str) -> None:
    # By construction of a Latin hypercube; of 2^n points of a Sobol sequence since it is a (t, s)-sequence
    # whose coordinates are each a (0, 1)-sequence, which scrambling keeps.
    cube = SAMPLERS[name](32, 2, 0)[:32]
    for column in cube.T:
        assert sorted(np.floor(32 * column)) == list(range(32))
