"""Rows at accepted steps where a problem asks for them: the same in every walk, thinned with their peaks."""

from dataclasses import replace

import numpy as np
import pytest

from tribodyn.core.problem import CompiledFunctions, Following, Problem
from tribodyn.integrate import integrate
from tribodyn.integrate.following import CHUNK, CHUNK_ROOM, ROOM, Followed, thinning

WINDOWS = np.array([[0.0, 0.3], [1.0, 1.4]])


def oscillator(following: Following | None) -> Problem:
    """Return y'' = −400 y, observed as (y, number of steps accepted before); memory counts accepted steps."""

    def rhs(t, y, data, memory, f):
        f[:] = y[1], -400.0 * y[0]

    def jac(t, y, data, memory, f, jacobian):
        jacobian[:] = [[0.0, 1.0], [-400.0, 0.0]]

    def accept(t, y, data, memory):
        memory[0] += 1.0

    def observe(t, y, data, memory, row):
        row[:] = y[0], memory[0]

    def nothing(*_):
        pass

    return Problem(
        functions=CompiledFunctions(rhs, jac, nothing, nothing, accept, observe, nothing),
        data=(),
        memory=np.zeros(1),
        y0=np.array([1.0, 0.0]),
        t_span=(0.0, 2.0),
        breakpoints=(1.0,),
        atol=np.full(2, 1e-8),
        state_names=("y", "v"),
        n_observed=2,
        field_shape=(0,),
        following=following,
    )


def inside(t, windows=WINDOWS):
    return ((t[:, None] >= windows[:, 0]) & (t[:, None] <= windows[:, 1])).any(axis=1)


@pytest.mark.parametrize("solver", ["mebdf", "bdf", "radau"])
def test_every_step_in_the_windows_gives_one_row(solver):
    outputs = np.array([0.0, 0.1, 0.5, 1.0, 1.1, 2.0])
    solution = integrate(
        oscillator(Following(WINDOWS, 10**6, ((0,),))), solver=solver, rtol=1e-6, output_times=outputs
    )
    assert np.all(np.diff(solution.t) > 0.0)
    at_steps = ~np.isin(solution.t, outputs)
    assert inside(solution.t[at_steps]).all()
    # Between two rows that follow each other no step was accepted but the one that the later row belongs to.
    accepted = solution.rows[:, 1]
    for begin, end in WINDOWS:
        steps = accepted[at_steps & (solution.t >= begin) & (solution.t <= end)]
        assert steps.size > 5
        assert np.all(np.diff(steps) == 1.0)
    assert solution.rows[:, 0] == pytest.approx(np.cos(20.0 * solution.t), abs=1e-3)


@pytest.mark.parametrize("solver", ["mebdf", "bdf"])
def test_following_changes_no_step(solver):
    plain = integrate(oscillator(None), solver=solver, rtol=1e-6, output_times=[0.0, 2.0])
    followed = integrate(
        oscillator(Following(WINDOWS, 10**6, ((0,),))), solver=solver, rtol=1e-6, output_times=[0.0, 2.0]
    )
    assert followed.y_end.tobytes() == plain.y_end.tobytes()
    assert followed.statistics.steps == plain.statistics.steps


def test_many_steps_are_thinned_and_keep_their_peaks():
    everything = oscillator(Following(np.array([[0.0, 2.0]]), 10**6, ((0,),)))
    whole = integrate(everything, rtol=1e-11, output_times=[0.0])
    assert whole.t.size > CHUNK
    assert everything.following is not None
    thin = integrate(
        replace(
            oscillator(everything.following),
            following=replace(everything.following, most=60),
            memory=np.zeros(1),
        ),
        rtol=1e-11,
        output_times=[0.0],
    )
    assert thin.t.size <= 61
    assert np.isin(thin.t, whole.t).all()
    assert thin.rows[:, 0].max() == whole.rows[:, 0].max()
    assert thin.rows[:, 0].min() == whole.rows[:, 0].min()


@pytest.mark.parametrize("solver", ["mebdf", "bdf"])
def test_every_third_step_gives_a_row_and_those_that_are_wanted(solver):
    windows, wanted = np.array([[0.0, 2.0]]), np.zeros(1)
    every = integrate(oscillator(Following(windows, 10**6, ((0,),))), solver=solver, rtol=1e-6).t
    third = Following(windows, 10**6, ((0,),), 3, wanted)
    # The breakpoint and the end are steps, too, and have their turn.
    assert integrate(oscillator(third), solver=solver, rtol=1e-6).t.tolist() == every[2::3].tolist()
    problem = oscillator(third)

    def advance(t_a, t_b, y_b, data, memory):
        wanted[0] = 1.0 if 0.5 < t_b < 0.6 else 0.0

    problem = replace(problem, functions=replace(problem.functions, advance=advance))
    chosen = integrate(problem, solver=solver, rtol=1e-6).t
    asked = every[(every > 0.5) & (every < 0.6)]
    assert asked.size > 3
    assert np.isin(asked, chosen).all()
    assert chosen.size < every.size / 2 + asked.size


def test_long_rows_are_kept_within_their_room_with_their_peaks():
    n = 20_000
    followed = Followed(Following(np.array([[0.0, 1.0]]), 2000, ((0,),)), n)
    t = np.linspace(0.0, 1.0, 1500, endpoint=False)
    values = np.random.default_rng(2).normal(size=t.size)
    chunk = followed.times.size
    assert 1 < followed.rows.shape[0] == chunk <= CHUNK_ROOM / (8 * n)
    for begin in range(0, t.size, chunk):
        part = slice(begin, begin + chunk)
        followed.times[: t[part].size], followed.rows[: t[part].size] = t[part], values[part, None]
        followed.collect(t[part].size)
    times, rows = followed.merged(np.empty(0), np.empty((0, n)))
    assert times.size > 2
    assert rows.nbytes <= ROOM / 2
    assert (rows[:, 0].min(), rows[:, 0].max()) == (values.min(), values.max())


def test_thinning_keeps_the_extremes_of_every_column():
    values = np.random.default_rng(3).normal(size=(5000, 3))
    kept = thinning(values, 70)
    assert kept.size <= 70
    assert np.all(np.diff(kept) > 0)
    for column in range(3):
        assert {values[:, column].argmin(), values[:, column].argmax()} <= set(kept.tolist())
    again = thinning(values[kept], 30)
    assert values[kept][again].max(axis=0).tolist() == values.max(axis=0).tolist()
