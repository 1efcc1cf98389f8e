"""Compiled right-hand sides: the same solutions as in Python, in every form, with everything around them."""

import ctypes
import subprocess
import sys
import warnings

import numba as nb
import numpy as np
import pytest
from scipy import LowLevelCallable
from scipy.integrate import solve_ivp

from mebdf import MEBDF

NUMBERS = nb.types.CPointer(nb.float64)
SIGNATURE = nb.void(nb.float64, NUMBERS, NUMBERS, NUMBERS)
CTYPE = ctypes.CFUNCTYPE(None, ctypes.c_double, *(ctypes.POINTER(ctypes.c_double),) * 3)


def plain(t, y):
    return [y[1], 50.0 * (1.0 - y[0] ** 2) * y[1] - y[0]]


def jacobian(t, y):
    return np.array([[0.0, 1.0], [-100.0 * y[0] * y[1] - 1.0, 50.0 * (1.0 - y[0] ** 2)]])


@nb.njit
def as_array(t, y):
    y[0] += 0.0  # a function may write into its state
    return np.array([y[1], 50.0 * (1.0 - y[0] ** 2) * y[1] - y[0]])


@nb.njit
def as_tuple(t, y):
    return y[1], 50.0 * (1.0 - y[0] ** 2) * y[1] - y[0]


as_list = nb.njit(plain)


@nb.cfunc(SIGNATURE)
def as_c(t, y, out, data):
    out[0] = y[1]
    out[1] = 50.0 * (1.0 - y[0] ** 2) * y[1] - y[0]
    y[0] = 1e9


@CTYPE
def as_ctypes(t, y, out, data):
    out[0], out[1] = plain(t, y)


FORMS = {
    "array": as_array,
    "tuple": as_tuple,
    "list": as_list,
    "cfunc": as_c,
    "LowLevelCallable": LowLevelCallable(as_ctypes),
}


def solve(fun, end=60.0, y0=(2.0, 0.0), **options):
    options = {"rtol": 1e-7, "atol": 1e-9} | options
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        return solve_ivp(fun, (0.0, end), np.array(y0), method=MEBDF, **options)


@pytest.mark.parametrize("fun", FORMS.values(), ids=FORMS)
@pytest.mark.parametrize("jac", [None, nb.njit(jacobian)], ids=["differences", "given"])
def test_steps_are_those_of_the_function_in_python(fun, jac) -> None:
    expected, found = solve(plain, jac=None if jac is None else jacobian), solve(fun, jac=jac)
    np.testing.assert_array_equal(found.t, expected.t)
    np.testing.assert_array_equal(found.y, expected.y)
    assert (found.nfev, found.njev, found.nlu) == (expected.nfev, expected.njev, expected.nlu)
    assert MEBDF(fun, 0.0, [2.0, 0.0], 1.0, jac=jac).in_python == ()


@pytest.mark.parametrize("at_once", [1, 7, 10_000])
def test_events_dense_output_and_output_times(at_once) -> None:
    def crossing(t, y):
        return y[0]

    crossing.terminal = 2
    options = {"dense_output": True, "events": crossing, "t_eval": np.linspace(0.0, 60.0, 100)}
    expected, found = solve(plain, **options), solve(as_c, steps_at_once=at_once, **options)
    if at_once < 100:
        np.testing.assert_allclose(found.t_events[0], expected.t_events[0], rtol=1e-12)
        np.testing.assert_allclose(found.y, expected.y, rtol=1e-9)
    times = np.linspace(0.0, found.t[-1], 500)
    np.testing.assert_allclose(found.sol(times), solve(plain, dense_output=True).sol(times), rtol=1e-9)
    assert found.sol(times[3]).shape == (2,)


def test_the_last_of_each_lot_of_steps_is_seen() -> None:
    every, some = solve(as_c), solve(as_c, steps_at_once=8)
    np.testing.assert_array_equal(some.t[:-1], every.t[::8][: some.t.size - 1])
    assert (some.t[-1], some.nfev) == (every.t[-1], every.nfev)


def test_backward_and_over_breakpoints() -> None:
    @nb.njit
    def stepping(t, y):
        return np.array([-(y[0] - (1.0 if t < 1.0 else 3.0))])

    for span in ((0.0, 2.0), (2.0, 0.0)):
        options = {"method": MEBDF, "breakpoints": [1.0], "rtol": 1e-8, "atol": 1e-8}
        found, expected = (solve_ivp(fun, span, [1.0], **options) for fun in (stepping, stepping.py_func))
        np.testing.assert_array_equal(found.y, expected.y)
        np.testing.assert_array_equal(found.t, expected.t)


def test_data_are_handed_on() -> None:
    @nb.njit
    def decay(t, y, data):
        return -data[:2] * y + data[2]

    @nb.cfunc(SIGNATURE)
    def in_c(t, y, out, data):
        for i in range(2):
            out[i] = -data[i] * y[i] + data[2]

    options = {"data": [1.0, 1e4, 2.0], "y0": [1.0, 1.0], "end": 3.0}
    ends = [solve(fun, **options).y[:, -1] for fun in (decay.py_func, decay, in_c)]
    exact = [2.0 - np.exp(-3.0), 2e-4]
    np.testing.assert_allclose(ends, [exact] * 3, rtol=1e-5)


@pytest.mark.parametrize("index", [None, [1, 1, 1]])
def test_mass_matrix(index) -> None:
    def reactions(t, y):
        slow, fast, last = 0.04 * y[0], 1e4 * y[1] * y[2], 3e7 * y[1] ** 2
        return np.array([-slow + fast, slow - fast - last, y[0] + y[1] + y[2] - 1.0])

    options = {"mass": [1.0, 1.0, 0.0], "y0": [1.0, 0.0, 0.0], "end": 1e6, "atol": [1e-12, 1e-16, 1e-12]}
    expected, found = (solve(fun, index=index, **options) for fun in (reactions, nb.njit(reactions)))
    assert found.t.size == pytest.approx(expected.t.size, rel=0.05)  # sums of terms round otherwise
    np.testing.assert_allclose(found.y[:, -1], expected.y[:, -1], rtol=1e-4)


def test_beyond_64_equations_libraries_solve() -> None:
    n = 80

    @nb.njit
    def chain(t, y):
        f = np.empty(80)
        for i in range(80):
            left = y[i - 1] if i > 0 else 1.0
            right = y[i + 1] if i < 79 else 0.0
            f[i] = 1e3 * (left - 2.0 * y[i] + right)
        return f

    for options in ({}, {"lband": 1, "uband": 1}):
        expected, found = (solve(fun, y0=np.zeros(n), end=1.0, **options) for fun in (chain.py_func, chain))
        np.testing.assert_allclose(found.y[:, -1], expected.y[:, -1], rtol=1e-6)


def test_what_runs_in_python_is_reported() -> None:
    with pytest.warns(UserWarning, match="`jac` runs in Python"):
        solver = MEBDF(as_c, 0.0, [2.0, 0.0], 1.0, jac=jacobian)
    assert solver.in_python == ("jac",)
    assert MEBDF(plain, 0.0, [2.0, 0.0], 1.0, jac=jacobian).in_python == ("fun", "jac")

    @nb.njit
    def of_two_kinds(t, y):
        return y[1], 1

    with pytest.warns(UserWarning, match="`of_two_kinds` runs in Python"):
        assert MEBDF(of_two_kinds, 0.0, [2.0, 0.0], 1.0).in_python == ("fun",)
    with pytest.warns(UserWarning, match="`jac` runs in Python"):
        found = solve_ivp(as_c, (0.0, 60.0), [2.0, 0.0], method=MEBDF, jac=jacobian, rtol=1e-7, atol=1e-9)
    np.testing.assert_array_equal(found.y, solve(plain, jac=jacobian).y)


def test_a_wrong_jacobian_is_replaced() -> None:
    @nb.njit
    def wrong(t, y):
        return -np.array([[0.0, 1.0], [-100.0 * y[0] * y[1] - 1.0, 50.0 * (1.0 - y[0] ** 2)]])

    with pytest.warns(RuntimeWarning, match="not the derivative"):
        found = solve_ivp(as_c, (0.0, 60.0), [2.0, 0.0], method=MEBDF, jac=wrong, rtol=1e-7, atol=1e-9)
    np.testing.assert_allclose(found.y[:, -1], solve(plain).y[:, -1], rtol=1e-4)


@pytest.mark.parametrize(
    ("fun", "message"),
    [
        (nb.cfunc(nb.float64(nb.float64))(lambda t: t), "must be `void"),
        (nb.njit(lambda t, y: y[:1]), r"expected to return shape \(2,\), but returned \(1,\)"),
    ],
)
def test_functions_that_do_not_fit_are_refused(fun, message) -> None:
    with pytest.raises(ValueError, match=message):
        MEBDF(fun, 0.0, [2.0, 0.0], 1.0)


def test_a_shape_that_changes_later_is_no_number() -> None:
    @nb.njit
    def shrinking(t, y):
        return y if t < 0.5 else y[:1]

    found = solve(shrinking, end=1.0)
    assert not found.success
    assert "was not finite at t = 0.5" in found.message


def test_a_failure_comes_behind_the_steps_before_it() -> None:
    @nb.njit
    def pole(t, y):
        return y * y

    expected, found = solve(pole.py_func, y0=[1.0], end=2.0), solve(pole, y0=[1.0], end=2.0)
    assert (found.status, found.message) == (-1, expected.message)
    np.testing.assert_array_equal(found.t, expected.t)


WITHOUT_NUMBA = """
import ctypes, sys
sys.modules["numba"] = sys.modules["llvmlite"] = None  # importing them fails
from mebdf import MEBDF
from scipy import LowLevelCallable
from scipy.integrate import solve_ivp

@ctypes.CFUNCTYPE(None, ctypes.c_double, *(ctypes.POINTER(ctypes.c_double),) * 3)
def decay(t, y, out, data):
    out[0] = -y[0]

print(*solve_ivp(LowLevelCallable(decay), (0.0, 1.0), [1.0], method=MEBDF, rtol=1e-8, atol=1e-8).y[:, -1])
"""


def test_an_address_needs_no_numba() -> None:
    done = subprocess.run([sys.executable, "-c", WITHOUT_NUMBA], capture_output=True, text=True)
    assert float(done.stdout) == pytest.approx(np.exp(-1.0), rel=1e-7), done.stderr
