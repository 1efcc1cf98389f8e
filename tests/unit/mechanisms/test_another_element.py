"""An element is one file and one line: the belt of the manual is added to a copy, and runs."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import tribodyn

SOURCE = Path(tribodyn.__file__).parent
PAGE = Path(__file__).parents[3] / "CONTRIBUTING.md"
RUN = """
import numpy as np, tribodyn as td
from tribodyn.cases.load import parse
from tribodyn.mechanisms.catalogue import kinds
from tribodyn.mechanisms.general.elements import ELEMENTS
belt = next(kind for kind in ELEMENTS if kind.METHOD == "belt")
result = td.simulate(parse(belt.EXAMPLE, "example", kinds()))
first, second = result["angular_velocity"].sel(axis="z").values[-1]
rate = 0.2 / (5e-4 + 0.25 * 9e-3)
assert np.allclose([first, second], [0.05 * rate, 0.025 * rate], rtol=1e-9), (first, second)
assert np.allclose(result["element_moment"].values, 9e-3 * 0.5 * rate, rtol=1e-9)
assert callable(td.Mechanism().belt)
"""


def test_the_belt_of_the_manual_takes_one_file_and_one_line(tmp_path: Path) -> None:
    copy = tmp_path / "tribodyn"
    shutil.copytree(SOURCE, copy, ignore=shutil.ignore_patterns("__pycache__"))
    elements = copy / "mechanisms" / "general" / "elements"
    found = re.search(r'^```python\n("""Belt:.*?)^```', PAGE.read_text(encoding="utf-8"), re.M | re.S)
    assert found is not None
    (elements / "belt.py").write_text(found[1], encoding="utf-8")
    names = elements / "__init__.py"
    text = names.read_text(encoding="utf-8")
    names.write_text(text.replace('    "gear",\n', '    "gear",\n    "belt",\n'), encoding="utf-8")
    # Machine code is that of the same kernels.
    environment = os.environ | {"PYTHONPATH": str(tmp_path)}
    done = subprocess.run(
        [sys.executable, "-c", RUN], cwd=tmp_path, env=environment, capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr
