"""Random differential-algebraic equations with closed solutions whose `index` is right or wrong.

Each has a known smooth solution, states of their own dynamics and one constraint of index 1, 2 or 3
(Hessenberg form). A wrong `index` must be refused, warned of, or harmless; the right one must be accepted.
"""

import warnings

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from tribodyn.integrate import MEBDF

TOLERANCE = 1e-5
#: Largest error of a wrong index in tolerances where those of the right one are below a tenth of it.
MOST = 100.0


class RandomDae:
    """y' = f(y, z, …) with g = 0: positions p (and velocities v) tied to w(t), and a force.

    Errors e = y - Y(t) obey, beside x' = X'(t) - e_x + ..., one of

    - index 1: 0 = e_force + c e;
    - index 2: p' = P'(t) + ... + b e_force, 0 = n e_p + ...;
    - index 3: p' = v, v' = V'(t) + ... + b e_force, 0 = n e_p + ....
    """

    def __init__(self, seed):
        rng = np.random.default_rng(seed)
        self.level = int(rng.integers(1, 4))
        self.n_x, self.n_p = int(rng.integers(1, 3)), int(rng.integers(2, 4))
        n_q = self.n_p * (self.level - 1)
        self.n = self.n_x + n_q + 1
        self.frequency = rng.uniform(0.5, 2.0, self.n)
        self.phase = rng.uniform(0.0, 6.0, self.n)
        self.coupling = 0.5 * rng.uniform(-1.0, 1.0, (self.n, self.n))
        self.push = rng.uniform(0.5, 1.5, self.n_p)
        self.normal = rng.uniform(0.5, 1.5, self.n_p)
        self.bend = rng.uniform(0.0, 0.3)
        first = [1] * (self.n_x + (self.n_p if self.level > 1 else 0))
        self.index = [*first, *([2] * self.n_p if self.level == 3 else []), self.level]
        self.mass = [1.0] * (self.n - 1) + [0.0]
        self.wrong = rng.integers(1, 4, self.n).tolist()

    def exact(self, t, order=0):
        """Return the solution, or its derivative; velocities are derivatives of positions."""
        y = np.sin(self.frequency * t + self.phase + 0.5 * np.pi * order) * self.frequency**order
        if self.level == 3:
            p = slice(self.n_x, self.n_x + self.n_p)
            y[self.n_x + self.n_p : -1] = (
                np.sin(self.frequency * t + self.phase + 0.5 * np.pi * (order + 1))
                * self.frequency ** (order + 1)
            )[p]
        return y

    def fun(self, t, y):
        exact, slope = self.exact(t), self.exact(t, 1)
        error = y - exact
        f = slope + self.coupling @ np.append(error[:-1], 0.0) + self.bend * (np.sin(y) - np.sin(exact))
        f[: self.n_x] -= error[: self.n_x]
        if self.level == 1:
            f[-1] = error[-1] + self.coupling[-1, :-1] @ error[:-1]
            return f
        p = slice(self.n_x, self.n_x + self.n_p)
        pushed = p if self.level == 2 else slice(self.n_x + self.n_p, self.n - 1)
        if self.level == 3:
            f[p] = y[pushed]
        f[pushed] += self.push * error[-1]
        f[-1] = self.normal @ (error[p] + self.bend * (np.sin(y[p]) - np.sin(exact[p])))
        return f

    def solve(self, index):
        """Return error in tolerances, evaluations and warnings; no error where it was refused or failed."""
        with warnings.catch_warnings(record=True) as issued:
            warnings.simplefilter("always")
            try:
                run = solve_ivp(
                    self.fun, (0.0, 2.0), self.exact(0.0), method=MEBDF, mass=self.mass, index=index,
                    rtol=TOLERANCE, atol=TOLERANCE,
                )  # fmt: skip
            except ValueError as refused:
                return None, 0, [str(refused)]
        texts = [str(warning.message) for warning in issued]
        if not run.success:
            return None, run.nfev, [*texts, run.message]
        error = np.max(np.abs(run.y[:, -1] - self.exact(2.0)) / TOLERANCE)
        return float(error), run.nfev, texts


def judge(seeds):
    """Return seeds whose right index was not accepted without a word, and whose wrong one did harm."""
    refused, harmed = [], []
    for seed in seeds:
        problem = RandomDae(seed)
        right, least, words = problem.solve(problem.index)
        if right is None or words:
            refused.append((seed, problem.index, words))
            continue
        error, cost, words = problem.solve(problem.wrong)
        if (error is not None and error > max(MOST, 10.0 * right)) or (cost > 20 * least and not words):
            harmed.append((seed, problem.index, problem.wrong, error, right, cost, least))
    return refused, harmed


@pytest.mark.parametrize(
    "seeds", [range(40), pytest.param(range(40, 1040), marks=pytest.mark.long)], ids=["short", "long"]
)
def test_a_wrong_index_is_refused_or_harmless_and_the_right_one_accepted(seeds):
    refused, harmed = judge(seeds)
    assert refused == []
    assert harmed == []
