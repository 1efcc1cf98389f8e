"""The same case gives the same bits in every process of a machine, and as on another processor.

Machine code is made for other processors, and NumPy, OpenBLAS and the C library are kept from using what this
processor has beyond the oldest one that they support.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest
from llvmlite.binding import get_host_cpu_features
from numpy._core._multiarray_umath import __cpu_dispatch__, __cpu_features__

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
from numba.core.registry import cpu_target

def hash_of(name):
    case = load_case(name)
    cycles = case.case == "mechanism" and case.run.cycles is not None
    brief = "0.5 ms" if case.case == "journal" else "20 ms"
    result = simulate(case.replace({"run.cycles": 0.01} if cycles else {"run.duration": brief}))
    digest = sha256(result.attrs["data_sha256"].encode())
    for column in sorted(result.data_vars):
        digest.update(result[column].values.tobytes())
    return digest.hexdigest()

processor = cpu_target.target_context.codegen().magic_tuple()[1]
json.dump({"processor": processor} | {name: hash_of(name) for name in sys.argv[1:]}, sys.stdout)
"""
PARTS = """
from hashlib import sha256
import numpy as np
from numba.core.registry import cpu_target
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
processor = cpu_target.target_context.codegen().magic_tuple()[1]
json.dump({"processor": processor} | found, sys.stdout)
"""
AVX2 = ("avx2", "bmi", "bmi2", "f16c", "fma", "lzcnt", "movbe")
AVX512 = (*AVX2, "avx512f", "avx512bw", "avx512cd", "avx512dq", "avx512vl")
PROCESSORS = {"generic": (), "haswell": AVX2, "skylake-avx512": AVX512}
"""Processors by LLVM's names, with what they need of this machine."""


OLDEST = {
    "NPY_DISABLE_CPU_FEATURES": " ".join(name for name in __cpu_dispatch__ if __cpu_features__[name]),
    "OPENBLAS_CORETYPE": "Prescott",
    "GLIBC_TUNABLES": "glibc.cpu.hwcaps=-AVX2,-FMA,-AVX2_Usable,-FMA_Usable,-AVX512F",
}
"""Environment in which libraries choose functions as on the oldest processor."""


def numbers(script: str, *arguments: str, **environment: str) -> dict[str, object]:
    """Return all numbers of a run in a process of its own; as text they read back exactly."""
    command = [sys.executable, "-c", script, *arguments]
    done = subprocess.run(
        command, stdout=subprocess.PIPE, text=True, check=True, env=os.environ | environment
    )
    found: dict[str, object] = json.loads(done.stdout)
    return found


def hashes(script: str, processor: str, cache: Path, *cases: str) -> dict[str, object]:
    """Return the hashes of a script with machine code for a processor, and libraries as on the oldest one.

    Without an empty list of features numba would add all that this machine has.
    """
    compiled = {"NUMBA_CPU_NAME": processor, "NUMBA_CPU_FEATURES": "", "NUMBA_CACHE_DIR": str(cache)}
    found = numbers(BEGIN + script, *cases, **compiled, **OLDEST)
    assert found.pop("processor") == processor
    return found


def hashes_here(script: str, *cases: str) -> dict[str, object]:
    """Return the hashes of a script with machine code for the processor of this machine."""
    found = numbers(BEGIN + script, *cases)
    found.pop("processor")
    return found


def test_what_a_process_did_before_and_its_threads_change_no_bit() -> None:
    one, four = (dict.fromkeys(THREADS, count) for count in "14")
    assert numbers(BEGIN + RUN, **one) == numbers(BEGIN + BEFORE + RUN, **four)


def test_one_and_two_workers_give_the_same_bits(tmp_path: Path) -> None:
    vary = {"joint.friction_coefficient": "0.1,0.2,0.3"}
    case = load_case("journal-dry").replace({"run.duration": "0.5 ms"})
    for workers in (1, 2):
        sweep(case, vary, workers=workers, directory=tmp_path / str(workers))
    one, two = (sorted((tmp_path / folder).rglob("result*.nc")) for folder in "12")
    assert len(one) == 3
    assert [read(path).attrs["rows_sha256"] for path in one] == [
        read(path).attrs["rows_sha256"] for path in two
    ]


@pytest.mark.long
def test_the_first_run_of_all_is_the_second_to_the_bit(tmp_path: Path) -> None:
    first = numbers(BEGIN + RUN, NUMBA_CACHE_DIR=str(tmp_path))
    assert any(tmp_path.rglob("*.nbc"))
    assert numbers(BEGIN + RUN, NUMBA_CACHE_DIR=str(tmp_path)) == first


LIBM = ("sin", "cos", "tan", "atan", "atan2", "exp", "log", "pow", "tanh", "hypot")


def test_code_for_another_processor_changes_no_bit_of_a_joint_and_of_the_integrator(tmp_path: Path) -> None:
    # Whole cases take minutes to compile.
    assert hashes(PARTS, "generic", tmp_path) == hashes_here(PARTS)
    compiled = list(tmp_path.rglob("*.nbc"))
    assert compiled
    assert not [(path.name, name) for path in compiled for name in LIBM if is_called(name, path)]


def is_called(name: str, path: Path) -> bool:
    """Tell whether machine code names a function of the C library; its own name stands there, too."""
    own = path.name.split("-")[0].split(".")[-1]
    return name != own and f"\0{name}\0".encode() in path.read_bytes()


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
@pytest.mark.parametrize("processor", PROCESSORS)
def test_code_for_another_processor_changes_no_bit_of_any_case(processor: str, tmp_path: Path) -> None:
    features = get_host_cpu_features()
    if missing := [name for name in PROCESSORS[processor] if not features.get(name, False)]:
        pytest.skip(f"this machine has no {', '.join(missing)}")
    assert hashes(HASHES, processor, tmp_path, *built_in()) == hashes_here(HASHES, *built_in())
