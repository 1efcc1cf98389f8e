"""Benchmarks run, and peers solve the same equations."""

from __future__ import annotations

import json

import numpy as np
import pytest

from benchmarks.__main__ import BY_HAND, NAMES, module
from benchmarks.vane.numpy_vsv import NumpyVsv
from benchmarks.vane.vsv_case import NATIVE, one, problem_of, vsv_case


@pytest.mark.parametrize("t", [0.0, 0.5, 2.0, 4.0])
@pytest.mark.parametrize("speed", [1e-7, 1e-5, 1e-3])
def test_the_right_hand_side_in_numpy_is_that_of_the_kernels(t: float, speed: float) -> None:
    rng = np.random.default_rng(3)
    case, vsv = vsv_case(1.0)
    problem = problem_of(case, vsv)
    model = NumpyVsv(problem.data, vsv.joint, problem.memory.joint.entry_velocity)
    y = problem.y0 * (1.0 + 0.1 * rng.standard_normal(8))
    y[4:] = speed * rng.standard_normal(4) * np.array([1.0, 1.0, 100.0, 100.0])
    problem.functions.enter(t, y, problem.data, problem.memory)
    model.direction = problem.memory.regime[0]
    compiled = np.empty(8)
    problem.functions.rhs(t, y, problem.data, problem.memory, compiled)
    # Sums in another order: rounding of forces that nearly cancel, 1e-14 in practice.
    np.testing.assert_allclose(model.rhs(t, y), compiled, rtol=1e-9, atol=1e-9 * abs(compiled).max())


@pytest.mark.long  # compiles what the library lacks
def test_cvode_takes_the_same_steps_from_compiled_code_as_from_python() -> None:
    pytest.importorskip("sksundae")
    native, stepped = (one(solver, 1e-4, cycles=0.03) for solver in (NATIVE, "cvode"))
    assert (native["steps"], native["rhs"]) == (stepped["steps"], stepped["rhs"])
    # The same functions are compiled into other surroundings, so that the last bits may differ.
    np.testing.assert_allclose(native["columns"]["e_x"], stepped["columns"]["e_x"], rtol=1e-9)


def test_the_model_in_exudyn_is_the_same_mechanism() -> None:
    pytest.importorskip("exudyn")
    from benchmarks.vane.peers import with_exudyn
    from benchmarks.vane.vsv_case import errors

    cycles = 0.06
    surface = errors(with_exudyn("surface", 5e-4, cycles), one("mebdf", 1e-4, cycles=cycles))
    # Ours is linear in the tilt of 1e-3: angles differ by l_4/l_4 tilt²/2, 3e-5°; the clearance makes 3e-2°.
    assert surface["angle"] < 2e-4


#: These take many seconds even so; some compile kernels that the library lacks.
LASTING = (
    "builds",
    "costs",
    "joint_kernel",
    "kinks",
    "long_run",
    "options",
    "random_machines",
    "ring",
    "static_loops",
    "static_machines",
    "sweep",
    "vsv",
    "workbench",
)


@pytest.mark.parametrize(
    "name",
    [
        pytest.param(name, marks=pytest.mark.long(minutes=0.8)) if name in LASTING else name
        for name in (*NAMES, *BY_HAND)
    ],
)
def test_a_benchmark_runs(name: str) -> None:
    found = module(name).run(quick=True)
    assert found
    json.dumps(found)
