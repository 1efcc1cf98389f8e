"""The names that interface.md promises at the top of the package."""

from __future__ import annotations

import subprocess
import sys


def test_importing_what_stands_behind_a_public_function_does_not_shadow_it() -> None:
    code = (
        "import tribodyn.simulation, tribodyn.cases, tribodyn as td; "
        "assert callable(td.simulate) and callable(td.load_case)"
    )
    subprocess.run([sys.executable, "-c", code], check=True)
