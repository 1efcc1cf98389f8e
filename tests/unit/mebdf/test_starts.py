"""Where the solver class begins: jumps of algebraic values, consistent values, velocities, late times."""

from __future__ import annotations

import itertools
import sys
import warnings
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.sparse import csr_array, diags_array
from scipy.sparse.linalg import aslinearoperator

sys.path.insert(0, str(Path(__file__).parents[3]))
from benchmarks.solver.dae_problems import pendulum
from mebdf import MEBDF


def solve(fun, t_span, y0, **options):
    return solve_ivp(fun, t_span, y0, method=MEBDF, **options)


def charging(t, y):
    """A capacitor behind a resistor of 1: its current follows the source, which steps at t = 1, at once."""
    return [y[1], (1.0 if t < 1.0 else 3.0) - y[0] - y[1]]


def discharging_backward(t, y):
    """The same seen backward in time from t = 2."""
    return [y[1], (1.0 if t > 1.0 else 3.0) + y[0] - y[1]]


BEFORE = np.exp(-1.0)  #: Current before the step of the source; behind it there are 2 more.
CIRCUIT = {"mass": [1.0, 0.0], "breakpoints": [1.0], "rtol": 1e-8, "atol": 1e-10}


@pytest.mark.filterwarnings("ignore:The values at t")
@pytest.mark.parametrize("current", [0.0, 1.0, 5.0])
@pytest.mark.parametrize("level", [0.2, 0.5, 2.0])
@pytest.mark.parametrize("t_eval", [None, pytest.param([0.0, 0.5, 1.0, 2.0], marks=pytest.mark.long)])
def test_events_on_algebraic_values_that_jump(current, level, t_eval):
    for terminal, direction, dense in itertools.product([False, True, 2], [-1, 0, 1], [False, True]):

        def crossed(t, y):
            return y[1] - level

        crossed.terminal, crossed.direction = terminal, direction
        solution = solve(
            charging, (0.0, 2.0), [0.0, current], events=crossed, dense_output=dense, t_eval=t_eval, **CIRCUIT
        )
        assert solution.success
        expected = crossings(current, level, direction)[: int(terminal) or None]
        np.testing.assert_allclose(solution.t_events[0], expected, atol=1e-6)


def crossings(current, level, direction):
    """Return when the current crosses a level: from the value given to 1, falling, jumping, falling."""
    found = []
    if (current - level) * (1.0 - level) < 0.0:
        found.append((0.0, np.sign(1.0 - current)))
    if BEFORE < level < 1.0:
        found.append((-np.log(level), -1.0))
    if BEFORE < level < BEFORE + 2.0:
        found.append((1.0, 1.0))
    if (BEFORE + 2.0) / np.e < level < BEFORE + 2.0:
        found.append((1.0 - np.log(level / (BEFORE + 2.0)), -1.0))
    return [time for time, sense in found if direction in (0, sense)]


@pytest.mark.filterwarnings("ignore:The values at t")
def test_an_event_at_a_jump_backward_in_time():
    solution = solve(
        discharging_backward,
        (2.0, 0.0),
        [0.0, 0.0],
        events=lambda t, y: y[1] - 2.0,
        dense_output=True,
        **CIRCUIT,
    )
    # The current is 1 − e^(t − 2) + … backward: below 1 until the source steps.
    assert solution.t_events[0][0] == pytest.approx(1.0, abs=1e-9)


def test_both_sides_of_a_jump_are_steps():
    with pytest.warns(UserWarning, match="changed component 1"):
        solution = solve(charging, (0.0, 2.0), [0.0, 0.0], dense_output=True, **CIRCUIT)
    assert solution.y[1, :2] == pytest.approx([0.0, 1.0])
    assert solution.t[1] < 1e-14
    here = np.searchsorted(solution.t, 1.0)
    assert solution.t[here] == 1.0
    assert solution.t[here + 1] < 1.0 + 1e-14
    np.testing.assert_allclose(solution.y[1, here : here + 2], [BEFORE, BEFORE + 2.0], atol=1e-7)
    assert np.all(np.diff(solution.t) > 0.0)
    # The wrong value is that of the start itself, not of output times.
    assert solution.sol([0.0, 1e-9])[1] == pytest.approx([1.0, 1.0])


@pytest.mark.filterwarnings("ignore:The values at t")
@pytest.mark.parametrize(("start", "length"), [(0.0, 1e-9), (0.0, 1e-15), (1e11, 10.0), (1.0, 3e-16)])
def test_a_jump_at_the_start_of_any_span(start, length):
    def current(t, y):
        return y[1] - 0.5

    solution = solve(
        lambda t, y: [y[1] / length, 1.0 - y[0] - y[1]], (start, start + length), [0.0, 0.0],
        mass=[1.0, 0.0], events=current, dense_output=True,
    )  # fmt: skip
    assert solution.success
    assert solution.t_events[0][0] == pytest.approx(start, abs=1e-3 * length + np.spacing(start))


def floating(t, y):
    """Charges of three nodes, of which two are coupled to each other alone, and their voltages.

    The charges of the last two cancel for any voltages: ∂g/∂U is singular, as in the two-bit adder of the IVP
    Test Set.
    """
    charge, voltage = y[:3], y[3:]
    drive = min(t, 2.0 - t)
    flow = voltage[1] - voltage[2]
    rates = [drive - voltage[0], voltage[0] - flow - voltage[1], flow + voltage[1] - voltage[0]]
    held = [voltage[0], voltage[1] - voltage[2], voltage[2] - voltage[1]]
    return np.concatenate((rates, charge - held))


def test_consistent_values_that_equations_do_not_determine_are_taken_as_given():
    mass = [1.0, 1.0, 1.0, 0.0, 0.0, 0.0]
    y0 = np.array([0.5, 0.2, -0.2, 0.5, 0.3, 0.1]) + 1e-9 * np.array([1, -1, 1, 1, -1, 1])
    solver = MEBDF(floating, 0.5, y0, 2.0, mass=mass, rtol=1e-4, atol=1e-4)
    np.testing.assert_array_equal(solver.y, y0)
    with pytest.raises(
        ValueError, match=r"equation \d leaves a residual of .* no consistent value was found"
    ):
        MEBDF(floating, 0.5, y0 + 0.1 * np.array([0, 1, 1, 0, 0, 0]), 2.0, mass=mass, rtol=1e-4, atol=1e-4)


@pytest.mark.parametrize("rtol", [1e-3, 1e-5, 1e-7])
def test_an_integration_of_index_3_goes_on_at_breakpoints(rtol):
    problem = pendulum(3)
    solution = solve(
        problem.fun, (0.0, 1.0), problem.y0, mass=problem.mass, index=problem.index,
        breakpoints=[0.2, 0.4, 0.6, 0.8], rtol=rtol, atol=rtol,
    )  # fmt: skip
    assert solution.success, solution.message
    np.testing.assert_allclose(solution.y[:2, -1], problem.end[:2], atol=100.0 * rtol)


@pytest.mark.filterwarnings("ignore:The values at t:UserWarning")
@pytest.mark.parametrize(
    "rtol", [1e-3, 1e-5, *(pytest.param(rtol, marks=pytest.mark.long) for rtol in (1e-4, 1e-6, 1e-7))]
)
def test_values_of_index_3_that_a_run_has_left_are_a_start(rtol):
    # 41 of these 210 were refused, and the values at a terminal event at 5 of 7 tolerances.
    problem = pendulum(3)
    options = {"mass": problem.mass, "index": problem.index, "rtol": rtol, "atol": rtol}

    def passes(t, y):
        return y[0] + 0.5

    passes.terminal = True
    first = solve(problem.fun, (0.0, 10.0), problem.y0, events=passes, **options)
    again = solve(problem.fun, (first.t[-1], 10.0), first.y[:, -1], **options)
    assert again.success
    whole = solve(problem.fun, (0.0, 10.0), problem.y0, **options)
    for i in np.linspace(1, whole.t.size - 2, 30).astype(int):
        MEBDF(problem.fun, whole.t[i], whole.y[:, i], 10.0, **options)


def chain(n):
    """Diffusion along a line whose odd nodes hold the mean of their neighbours."""
    matrix = csr_array(diags_array([np.ones(n - 1), np.full(n, -2.0), np.ones(n - 1)], offsets=[-1, 0, 1]))
    mass = (np.arange(n) % 2 == 0).astype(float)
    y0 = np.sin(np.pi * np.arange(1, n + 1) / (n + 1))
    y0[1::2] = 0.0
    return matrix, mass, y0


@pytest.mark.parametrize("how", ["jac", "jac_sparsity"])
def test_consistent_values_of_many_equations_are_found(how):
    n = 2001
    matrix, mass, y0 = chain(n)
    with pytest.warns(UserWarning, match="changed component 1 from 0 to"):
        solver = MEBDF(
            lambda t, y: matrix @ y, 0.0, y0, 1.0, mass=mass, rtol=1e-6, atol=1e-9, **{how: matrix}
        )
    np.testing.assert_allclose(solver.y[1::2], 0.5 * (y0[:-1:2] + y0[2::2]), atol=1e-8)


def test_values_of_many_equations_that_break_a_constraint_are_refused():
    n = 451
    matrix, mass, y0 = chain(n)

    def fun(t, y):
        f = matrix @ y
        f[401] = y[400] - 2.0  # holds no algebraic variable
        return f

    pattern = (abs(matrix) + diags_array(np.ones(n))).tolil()
    options = {"mass": mass, "jac_sparsity": pattern, "index": np.where(np.arange(n) == 401, 2, 1)}
    with pytest.raises(
        ValueError, match=r"equation 401 does not hold; it would with component 400 = 2 instead"
    ):
        MEBDF(fun, 0.0, y0, 1.0, **options)


def test_many_equations_without_a_consistent_value_are_named():
    n = 451
    matrix, mass, y0 = chain(n)
    y0[1::2] = 0.5 * (y0[:-1:2] + y0[2::2])

    def fun(t, y):
        f = matrix @ y
        f[401] = 1.0 + y[401] ** 2
        return f

    with pytest.raises(
        ValueError, match=r"equation 401 leaves a residual of .*no consistent value was found"
    ):
        MEBDF(fun, 0.0, y0, 1.0, mass=mass, jac_sparsity=matrix)


@pytest.mark.parametrize("index", [2, 3])
def test_the_implicit_form_refuses_a_wrong_velocity_as_the_mass_form_does(index):
    problem = pendulum(index)
    y0 = problem.y0 + 0.1 * np.eye(5)[2]

    def residual(t, y, slope):
        return problem.mass @ slope - problem.fun(t, y)

    for fun, options in ((problem.fun, {"mass": problem.mass}), (residual, {"slope": np.zeros(5)})):
        with pytest.raises(ValueError, match=r"not consistent: .*equation 4 does not hold"):
            MEBDF(fun, 0.0, y0, 1.0, index=problem.index, **options)


@pytest.mark.parametrize("index", [2, 3])
def test_the_implicit_form_finds_multipliers_by_differentiation(index):
    problem = pendulum(index)
    with pytest.warns(UserWarning, match="changed component 4 from 0"):
        solver = MEBDF(
            lambda t, y, slope: problem.mass @ slope - problem.fun(t, y), 0.0, [1.0, 0.0, 0.0, 1.0, 0.0], 1.0,
            slope=np.zeros(5), index=problem.index,
        )  # fmt: skip
    assert solver.y[4] == pytest.approx(1.0, abs=1e-4)


@pytest.mark.parametrize("index", [[1, 1, 1, 1, 3], [1, 1, 1, 2, 3]])
@pytest.mark.parametrize("implicit", [False, True])
def test_an_index_that_is_too_low_is_raised(index, implicit):
    problem, calls = pendulum(3), 0

    def fun(t, y):
        nonlocal calls
        calls += 1
        return problem.fun(t, y)

    def residual(t, y, slope):
        return problem.mass @ slope - fun(t, y)

    options = {"rtol": 1e-6, "atol": 1e-6, "index": index}
    form = {"slope": np.zeros(5)} if implicit else {"mass": problem.mass}
    with pytest.warns(UserWarning, match=r"`index` is too low for .*give `index=\[1, 1, 2, 2, 3\]`"):
        solution = solve(residual if implicit else fun, (0.0, 1.0), problem.y0, **options, **form)
    assert solution.success
    np.testing.assert_allclose(solution.y[:2, -1], problem.end[:2], atol=1e-4)
    # 200 and 263; they were 131,808 and 113,581 with the first index, after the warning.
    assert calls < 700


@pytest.mark.parametrize("start", [1e11, -1e11, 1e14])
@pytest.mark.parametrize("sense", [1.0, -1.0])
@pytest.mark.parametrize("rate", [0.0, 1e-9])
def test_a_start_at_rest_late_in_time(start, sense, rate):
    solution = solve(lambda t, y: [rate], (start, start + 100.0 * sense), [0.0], rtol=1e-6, atol=1e-8)
    assert solution.success, solution.message
    assert solution.y[0, -1] == pytest.approx(100.0 * sense * rate, rel=1e-3)  # spacing of t: 0.016


@pytest.mark.parametrize("start", [1.44e4, 1e9])
@pytest.mark.parametrize("fastest", [1e8, 1e12, 1e16])
def test_the_first_step_is_at_least_sixteen_spacings(start, fastest):
    solver = MEBDF(lambda t, y: -fastest * (y - 1.0), start, [0.0], start + 1e4, rtol=1e-10, atol=1e-10)
    times = []
    solver.fun_single, inner = lambda t, y: (times.append(t), inner(t, y))[1], solver.fun_single
    solver.step()
    steps = np.array([time - start for time in times if time > start])
    assert steps[0] >= 16.0 * np.spacing(start)


@pytest.mark.parametrize("start", [1e8, 3e8, 1e9, 3e9, 1e10])
def test_equal_steps_late_in_time_lead_to_the_time_of_the_solution(start):
    """The spacing of times is up to 2e-6 and steps are some 0.05: rounded they added up to another time."""
    solution = solve(lambda t, y: [y[1], -y[0]], (start, start + 10.0), [1.0, 0.0], rtol=1e-8, atol=1e-9)
    assert solution.success, solution.message
    # 6 to 3700 tolerances before; 0.03, or what half a spacing of times changes.
    np.testing.assert_allclose(solution.y[:, -1], [np.cos(10.0), -np.sin(10.0)], atol=50.0 * 1e-8)


@pytest.mark.parametrize("start", [1e9, 1e10, 1e11])
def test_the_shortest_step_is_tried_before_a_late_start_fails(start):
    solver = MEBDF(lambda t, y: -1e3 * y, start, [1.0], start + 1.0, rtol=1e-8, atol=1e-8)
    times = []
    solver.fun_single, inner = lambda t, y: (times.append(t), inner(t, y))[1], solver.fun_single
    message = ""
    while solver.status == "running":
        message = solver.step()
    assert "shorter than the spacing between numbers" in message
    # The first step, of 16 roundings, was the last one, too.
    assert min(time for time in times if time > start) - start < 12.5 * np.finfo(np.float64).eps * start


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"mass": lambda t, y: np.eye(2)}, "`mass` is a function; .*`slope`"),
        ({"mass": aslinearoperator(np.eye(2))}, "`mass` is a LinearOperator; give its matrix"),
        ({"jac": aslinearoperator(np.eye(2))}, "`jac` is a LinearOperator; give its matrix"),
        ({"jac": lambda t, y: aslinearoperator(np.eye(2))}, "`jac` is a LinearOperator; give its matrix"),
    ],
)
def test_matrices_of_a_kind_that_is_refused(options, message):
    with pytest.raises(ValueError, match=message):
        solve(lambda t, y: -y, (0.0, 1.0), [1.0, 2.0], **options)


def test_extra_arguments_of_an_implicit_equation_are_refused():
    with pytest.raises(
        ValueError, match=r"`args` are not passed on with `slope`; give .* `lambda t, y, slope"
    ):
        solve(lambda t, y, slope, rate: slope + rate * y, (0.0, 1.0), [1.0], slope=[0.0], args=(2.0,))


def small_beside_large(t, y):
    """Two algebraic variables, 1000 and e^−t."""
    return [-y[0], y[1] - 1000.0, y[2] - y[0]]


@pytest.mark.filterwarnings("ignore:The values at t")
@pytest.mark.parametrize("given", [0.5, 1e-2, 1e-5])
@pytest.mark.parametrize("rtol", [1e-3, 1e-6, 1e-9])
def test_a_small_value_beside_a_large_one_is_corrected(given, rtol):
    start = [1.0, 1000.0, 1.0 + given]
    solution = solve(small_beside_large, (0.0, 3.0), start, mass=[1.0, 0.0, 0.0], rtol=rtol, atol=1e-3 * rtol)
    assert solution.success
    # Beside it the error of the integration, of some tolerances.
    np.testing.assert_allclose(solution.y[2, -1], np.exp(-3.0), rtol=10.0 * rtol)


@pytest.mark.filterwarnings("ignore:The values at t")
def test_a_small_value_beside_a_large_one_is_corrected_among_eight_hundred():
    n = 800
    pairs = np.kron(np.eye(n // 2), [[1.0, 0.0], [1.0, 1.0]])

    def fun(t, y):
        """Every second variable is algebraic: the first of them is 1000, the others e^−t."""
        algebraic = y[1::2] - y[::2]
        algebraic[0] = y[1] - 1000.0
        return np.ravel(np.column_stack((-y[::2], algebraic)))

    start = np.ones(n)
    start[[1, 3]] = 1000.0, 1.5
    mass = np.tile([1.0, 0.0], n // 2)
    solution = solve(fun, (0.0, 3.0), start, mass=mass, jac_sparsity=csr_array(pairs), rtol=1e-6, atol=1e-9)
    assert solution.success
    np.testing.assert_allclose(solution.y[3, -1], np.exp(-3.0), rtol=1e-5)


def test_output_times_get_consistent_values_at_the_start():
    with pytest.warns(UserWarning, match="changed component 1"):
        solution = solve(charging, (0.0, 0.5), [0.0, 0.0], t_eval=[0.0, 0.5], **CIRCUIT)
    assert solution.y[1] == pytest.approx([1.0, np.exp(-0.5)])


def test_values_of_the_solver_at_the_start_are_consistent():
    with pytest.warns(UserWarning, match="changed component 1"):
        y0 = MEBDF(charging, 0.0, [0.0, 0.0], 2.0, **CIRCUIT).y
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        solution = solve(charging, (0.0, 0.5), y0, mass=[1.0, 0.0])
    assert solution.y[1, 0] == pytest.approx(1.0)


def test_the_implicit_form_reports_an_index_that_is_too_low():
    problem = pendulum(3)
    with pytest.raises(ValueError, match="the index is above 1; give `index`"):
        MEBDF(
            lambda t, y, slope: problem.mass @ slope - problem.fun(t, y),
            0.0,
            problem.y0,
            1.0,
            slope=np.zeros(5),
        )


@pytest.mark.filterwarnings("ignore:The values at t")
def test_a_current_of_nanoamperes_beside_a_kilovolt_is_corrected():
    solution = solve(
        lambda t, y: [-y[0], y[1] - 1000.0, y[2] - 1e-9 * y[0]],
        (0.0, 3.0),
        [1.0, 1000.0, 1.1e-9],
        mass=[1.0, 0.0, 0.0],
        rtol=1e-6,
        atol=[1e-9, 1e-6, 1e-18],
    )
    assert solution.success
    np.testing.assert_allclose(solution.y[2, -1], 1e-9 * np.exp(-3.0), rtol=1e-5)
