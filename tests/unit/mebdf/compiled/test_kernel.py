"""Kernels as Python calls them."""

from __future__ import annotations

import pickle
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from typing import NamedTuple

import numpy as np
import pytest

from mebdf.compiled import jit
from mebdf.compiled.library import NoMachineCode
from mebdf.kernels.core import resume
from mebdf.kernels.jit import kernel
from mebdf.kernels.state import new_state


class Pair(NamedTuple):
    first: np.ndarray
    second: np.ndarray


@kernel
def scaled(pair, factor, target):
    for i in range(target.size):
        target[i] = factor * (pair.first[i] - pair.second[i])
    return target[0]


@kernel
def both(x):
    return x, 2.0 * x


@kernel
def several(x):
    return 3, x, x > 0.0


@kernel
def growing(x):
    return np.zeros(x.size + 1)[0]


@kernel
def printing(x):
    print(x)


def test_a_kernel_outside_the_list_is_compiled_for_what_it_is_called_with() -> None:
    target = np.zeros(2)
    pair = Pair(np.array([3.0, 5.0]), np.ones(2))
    assert scaled(pair, 2.0, target) == 4.0
    assert target.tolist() == [4.0, 8.0]
    assert both(1.5) == (1.5, 3.0)
    assert several(1.5) == (3, 1.5, True)


def test_data_of_the_last_call_are_taken_as_they_are_now() -> None:
    first, target = np.array([3.0]), np.zeros(1)
    pair = Pair(first, np.ones(1))
    assert scaled(pair, 1.0, target) == 2.0
    first[0] = 11.0
    assert scaled(pair, 1.0, target) == 10.0
    assert scaled(Pair(np.array([7.0]), pair.second), 1.0, target) == 6.0
    other = np.zeros(1)
    assert scaled(pair, 3.0, other) == 30.0
    assert (target[0], other[0]) == (6.0, 30.0)


def test_threads_do_not_disturb_each_other() -> None:
    def differences(number: int) -> list[float]:
        pair, target = Pair(np.array([float(number)]), np.zeros(1)), np.zeros(1)
        return [scaled(pair, 1.0, target) for _ in range(200)]

    with ThreadPoolExecutor(4) as pool:
        assert list(pool.map(differences, range(20))) == [[float(n)] * 200 for n in range(20)]


def test_wrong_numbers_of_arguments_are_refused() -> None:
    with pytest.raises(TypeError, match="takes 6 arguments, not 2"):
        resume(*new_state(0.0, np.ones(1), 1.0, 1e-3, np.ones(1))[:2])


@pytest.mark.parametrize(("wrong", "given"), [(growing, np.zeros(2)), (printing, 1.0)])
def test_a_kernel_that_allocates_or_prints_is_refused(wrong, given) -> None:
    with pytest.raises((NoMachineCode, jit.nb.core.errors.NumbaError)):
        wrong(given)


def test_a_kernel_is_pickled_by_its_name() -> None:
    assert pickle.loads(pickle.dumps(resume)) is resume


def test_functions_of_others_are_compiled_beside_kernels_and_may_call_them() -> None:
    assert both(2.0) == (2.0, 4.0)

    @jit.nb.njit
    def own(x):
        first, second = both(x)
        return np.sqrt(first) + second + np.zeros(2).size

    @jit.nb.cfunc("float64(float64)")
    def callback(x):
        return own(x) + 1.0

    assert own(4.0) == 12.0
    assert callback.ctypes(4.0) == 13.0


WITHOUT_NUMBA = """
import sys
sys.modules["numba"] = sys.modules["llvmlite"] = None  # importing them fails
from mebdf.compiled.library import NoMachineCode
from mebdf.kernels.jit import kernel

@kernel
def own(x):
    return x

try:
    own(1.0)
except NoMachineCode as problem:
    print(problem)
"""


def test_without_numba_a_sentence_says_what_to_install() -> None:
    done = subprocess.run([sys.executable, "-c", WITHOUT_NUMBA], capture_output=True, text=True)
    assert "install numba (the extra `compile`)" in done.stdout, done.stderr
