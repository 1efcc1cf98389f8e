"""The numerical tests pass with machine code for other processors, which round otherwise.

Whether products and sums are contracted and how many nodes are added up at once decides the last bits, these
decide which steps are taken, and steps what a single trajectory ends with.
"""

from __future__ import annotations

import os
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import pytest
from llvmlite.binding import get_host_cpu_features

ROOT = Path(__file__).parents[2]
NUMERICAL = (
    *("tests/analytic", "tests/golden", "tests/literature", "tests/order"),
    *(f"tests/unit/{name}" for name in ("contact", "integrate", "kernels", "lubrication", "mechanisms")),
    *("tests/unit/simulation", "tests/unit/wear", "tests/unit/studies/test_sweep.py"),
    *(
        f"tests/faults/test_{name}.py"
        for name in ("random_physics", "integration_failures", "journal_faults")
    ),
)
ASK_NUMBA = (
    "from numba.core.registry import cpu_target; print(cpu_target.target_context.codegen().magic_tuple())"
)


@dataclass(frozen=True)
class Processor:
    """A processor by the names that LLVM and OpenBLAS know it by, and what it needs of this machine."""

    name: str
    linear_algebra: str
    needs: tuple[str, ...] = ()

    def environment(self, cache: Path) -> dict[str, str]:
        """Return the environment of a process that computes as this processor would.

        Without an empty list of features numba would add all that this machine has.
        """
        return os.environ | {
            "NUMBA_CPU_NAME": self.name,
            "NUMBA_CPU_FEATURES": "",
            "NUMBA_CACHE_DIR": str(cache),
            "OPENBLAS_CORETYPE": self.linear_algebra,
        }


AVX2 = ("avx2", "bmi", "bmi2", "f16c", "fma", "lzcnt", "movbe")
PROCESSORS = [
    Processor("generic", "Prescott"),
    Processor("haswell", "Haswell", AVX2),
    Processor(
        "skylake-avx512", "SkylakeX", (*AVX2, "avx512f", "avx512bw", "avx512cd", "avx512dq", "avx512vl")
    ),
]


@pytest.mark.long
@pytest.mark.parametrize("processor", PROCESSORS, ids=lambda processor: processor.name)
def test_the_numerical_tests_pass(processor: Processor, tmp_path: Path) -> None:
    features = get_host_cpu_features()
    if missing := [name for name in processor.needs if not features.get(name, False)]:
        pytest.skip(f"this machine has no {', '.join(missing)}")
    environment = processor.environment(tmp_path)
    asked = [sys.executable, "-c", ASK_NUMBA]
    told = subprocess.run(asked, env=environment, capture_output=True, text=True, check=True).stdout
    assert told.endswith(f"'{processor.name}', '')\n")
    command = [sys.executable, "-m", "pytest", "-q", "-p", "no:xdist", "-p", "no:cacheprovider"]
    done = subprocess.run(
        [*command, "-m", "not long and not house", *NUMERICAL],
        env=environment,
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=False,
    )
    assert any(tmp_path.rglob("*.nbc")), "nothing was compiled for it"
    assert done.returncode == 0, done.stdout[-20_000:] + done.stderr[-2_000:]
