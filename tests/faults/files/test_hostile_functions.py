"""Right-hand sides, mass matrices and options drawn at random, most of them wrong: a sentence each."""

import warnings

import numpy as np
import pytest
from scipy.sparse import csr_array

from tribodyn.integrate import MEBDF

FEW, MANY = 30, 5000
MOST_STEPS = 100
FAULTS = ("none", "nan", "inf", "raises", "shape", "jump", "huge")


class OwnError(Exception):
    """What a user's function raises."""


def function(rng, n):
    """Return a linear right-hand side that goes wrong, and its Jacobian."""
    matrix = rng.standard_normal((n, n)) * 10.0 ** rng.integers(-3, 4)
    fault, when = rng.choice(FAULTS), rng.random()

    def fun(t, y):
        f = matrix @ y + np.sin(t)
        if fault == "jump":
            return f + 10.0 * np.sign(np.sin(20.0 * t))
        if fault == "huge":
            return f * 1e200
        if t <= when:
            return f
        if fault == "raises":
            raise OwnError
        return {"nan": f * np.nan, "inf": f + np.inf, "shape": f[:-1]}.get(fault, f)

    return fun, matrix


def mass_matrix(rng, n):
    rank = rng.integers(0, n + 1)
    singular = rng.standard_normal((n, rank)) @ rng.standard_normal((rank, n))
    diagonal = (rng.random(n) > 0.3).astype(float)
    return [
        None,
        np.eye(n),
        diagonal,
        csr_array(np.diag(diagonal)),
        singular,
        np.zeros((n, n)),
        np.ones((n + 1, n)),
    ][rng.integers(7)]


def drawn(rng):
    """Return the arguments of a solver."""
    n = int(rng.choice([1, 2, 3, 5, 8, 70]))
    fun, matrix = function(rng, n)
    options = {
        "rtol": 10.0 ** -rng.integers(1, 11),
        "atol": 10.0 ** -rng.integers(1, 11),
        "mass": mass_matrix(rng, n),
    }
    if options["mass"] is not None and rng.random() < 0.5:
        options["index"] = rng.integers(1, 4, n)
    jac = [None, matrix, -matrix, matrix * np.nan, matrix[:-1]][rng.integers(5)]
    if rng.random() < 0.2:
        options["breakpoints"] = rng.random(3)
    return fun, rng.standard_normal(n) * 10.0 ** rng.integers(-2, 3), {**options, "jac": jac}


def outcome(fun, y0, options):
    """Return how an integration ends: the message of what was raised or failed, else nothing."""
    try:
        solver = MEBDF(fun, 0.0, y0, 1.0, **options)
        message = None
        for _ in range(MOST_STEPS):
            if solver.status == "running":
                message = solver.step()
    except OwnError:
        return "the user's own exception"
    except ValueError as problem:
        return str(problem)
    assert solver.status == "failed" or np.all(np.isfinite(solver.y))
    return message


#: What a sentence that is ours holds.
OURS = (
    *(
        "`fun` is",
        "`mass` is",
        "`index` is",
        "`jac` is",
        "is not finite",
        "not consistent",
        "holds no algebraic variable",
    ),
    *("the step became shorter", "is singular", "fails again and again", "the user's own"),
)


@pytest.mark.parametrize("count", [FEW, pytest.param(MANY, marks=pytest.mark.long(minutes=1.2))])
def test_every_case_ends_with_a_sentence(count):
    for seed in range(count):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            message = outcome(*drawn(np.random.default_rng(seed)))
        assert message is None or any(text in message for text in OURS), (seed, message)
