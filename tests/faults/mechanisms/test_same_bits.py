"""The same case gives the same bits in every process of a machine, and as on another processor.

Machine code is that for other processors, or made by each process, and NumPy, OpenBLAS and the C library are
kept from using what this processor has beyond the oldest one that they support.
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from functools import cache
from pathlib import Path

import pytest
from llvmlite.binding import get_host_cpu_features
from numpy._core._multiarray_umath import __cpu_dispatch__, __cpu_features__

import mebdf
import tribodyn
from mebdf.compiled.library import LEVELS
from tribodyn.mechanisms.catalogue import built_in, load_case
from tribodyn.mechanisms.results import read
from tribodyn.studies import sweep

BEGIN = """
import json, sys
from tribodyn.mechanisms.catalogue import load_case
from tribodyn.simulation import simulate
"""
BEFORE = """
simulate(load_case("journal-oil").replace({"run.duration": "0.5 ms"}))
"""
RUN = """
result = simulate(load_case("vsv").replace({"run.duration": "20 ms", "run.output_interval": "1 ms"}))
found = {name: result[name].values.tolist() for name in result.data_vars}
general = simulate(load_case("slider-crank").replace({"run.cycles": 0.01}))
hashes = [general.attrs[name] for name in ("data_sha256", "rows_sha256")]
json.dump(found | {"slider-crank": hashes}, sys.stdout)
"""
THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "NUMBA_NUM_THREADS")
HASHES = """
from hashlib import sha256

def hash_of(name):
    case = load_case(name)
    cycles = case.case == "mechanism" and case.run.cycles is not None
    brief = "0.5 ms" if "journal" in name else "20 ms"
    result = simulate(case.replace({"run.cycles": 0.01} if cycles else {"run.duration": brief}))
    digest = sha256(result.attrs["data_sha256"].encode())
    for column in sorted(result.data_vars):
        digest.update(result[column].values.tobytes())
    return digest.hexdigest()

json.dump({name: hash_of(name) for name in sys.argv[1:]}, sys.stdout)
"""
PARTS = """
from hashlib import sha256
import numpy as np
from scipy.integrate import solve_ivp
from mebdf import MEBDF
from mebdf.kernels.elementary import portable
from tribodyn.joints.bushing import joint_wrench
from tribodyn.papers.cheng_2022.reduced.system import vsv_of

def slope(t, y):
    return np.array([y[1], -1e3 * portable.sin(y[0]) - portable.exp(y[1])])

state = np.array([-3.9e-6, 6.57e-6, 6.46e-4, 1.31e-3, 3.6e-6, -2.4e-6, -2.8e-4, 3.8e-4])
wrench = joint_wrench(vsv_of(load_case("vsv")).joint.data(), state, omega=0.3)
path = solve_ivp(slope, (0.0, 1.0), [1.0, 0.0], method=MEBDF, rtol=1e-6).y
found = {name: sha256(values.tobytes()).hexdigest() for name, values in (("wrench", wrench), ("path", path))}
json.dump(found, sys.stdout)
"""
#: Environment in which libraries choose functions as on the oldest processor.
OLDEST = {
    "NPY_DISABLE_CPU_FEATURES": " ".join(name for name in __cpu_dispatch__ if __cpu_features__[name]),
    "OPENBLAS_CORETYPE": "Prescott",
    "GLIBC_TUNABLES": "glibc.cpu.hwcaps=-AVX2,-FMA,-AVX2_Usable,-FMA_Usable,-AVX512F",
}


@cache
def numbers(script: str, *arguments: str, **environment: str) -> dict[str, object]:
    """Return all numbers of a run in a process of its own; as text they read back exactly."""
    command = [sys.executable, "-c", script, *arguments]
    done = subprocess.run(
        command, stdout=subprocess.PIPE, text=True, check=True, env=os.environ | environment
    )
    found: dict[str, object] = json.loads(done.stdout)
    return found


def hashes(script: str, level: str, *cases: str) -> dict[str, object]:
    """Return the hashes of a script with machine code for a level of processors, and the oldest libraries."""
    return numbers(BEGIN + script, *cases, TRIBODYN_LEVEL=level, **OLDEST)


def test_what_a_process_did_before_and_its_threads_change_no_bit() -> None:
    one, four = (dict.fromkeys(THREADS, count) for count in "14")
    assert numbers(BEGIN + RUN, **one) == numbers(BEGIN + BEFORE + RUN, **four)


def test_one_and_two_workers_give_the_same_bits(tmp_path: Path) -> None:
    vary = {"joints.bearing.clearance.friction_coefficient": "0.1,0.2,0.3"}
    case = load_case("journal-dry").replace({"run.duration": "0.5 ms"})
    for workers in (1, 2):
        sweep(case, vary, workers=workers, directory=tmp_path / str(workers))
    one, two = (sorted((tmp_path / folder).rglob("result*.nc")) for folder in "12")
    assert len(one) == 3
    assert [read(path).attrs["rows_sha256"] for path in one] == [
        read(path).attrs["rows_sha256"] for path in two
    ]


@pytest.mark.parametrize("level", LEVELS)
def test_code_for_another_processor_changes_no_bit_of_a_joint_and_of_the_integrator(level: str) -> None:
    assert hashes(PARTS, level) == numbers(BEGIN + PARTS)


FUNCTIONS = """
import hashlib, json, math, sys
import numpy as np
x = np.random.default_rng(1).uniform(0.1, 9.0, 20000)
matrix = x[:10000].reshape(100, 100)
found = {
    "C library": [math.exp(value) for value in x],
    "NumPy": (np.tanh(x) + np.exp(x)).tolist(),
    "OpenBLAS": (matrix @ matrix).tolist(),
}
hashes = {name: hashlib.sha256(repr(values).encode()).hexdigest() for name, values in found.items()}
json.dump(hashes, sys.stdout)
"""


@pytest.mark.skipif(not get_host_cpu_features().get("fma", False), reason="needs a processor with FMA")
def test_these_libraries_do_choose_by_the_processor() -> None:
    here, there = numbers(FUNCTIONS), numbers(FUNCTIONS, **OLDEST)
    assert all(here[library] != there[library] for library in here)


@pytest.mark.long
@pytest.mark.parametrize("level", LEVELS)
def test_code_for_another_processor_changes_no_bit_of_any_case(level: str) -> None:
    assert hashes(HASHES, level, *built_in()) == numbers(BEGIN + HASHES, *built_in())


@pytest.mark.long
def test_the_library_returns_the_bits_of_code_that_each_process_compiles(tmp_path: Path) -> None:
    ignored = shutil.ignore_patterns("built", "__pycache__")
    for package in (mebdf, tribodyn):
        source = Path(package.__file__ or "").parent
        shutil.copytree(source, tmp_path / source.name, ignore=ignored)
    compiled = numbers(BEGIN + HASHES, *built_in(), PYTHONPATH=str(tmp_path))
    assert compiled == numbers(BEGIN + HASHES, *built_in())
