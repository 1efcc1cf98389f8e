"""An element or a joint is one file and one line: those of the manual are added to a copy, and run."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import tribodyn

SOURCE = Path(tribodyn.__file__).parent
PAGE = Path(__file__).parents[3] / "CONTRIBUTING.md"
RUN = """
import numpy as np, tribodyn as td
from tribodyn.cases.load import parse
from tribodyn.mechanisms.catalogue import kinds
from tribodyn.mechanisms.general.elements import ELEMENTS
added = next(kind for kind in ELEMENTS if kind.METHOD == "{method}")
result = td.simulate(parse(added.EXAMPLE, "example", kinds()))
assert callable(td.Mechanism().{method})
{check}
"""
BELT = """
first, second = result["angular_velocity"].sel(axis="z").values[-1]
rate = 0.2 / (5e-4 + 0.25 * 9e-3)
assert np.allclose([first, second], [0.05 * rate, 0.025 * rate], rtol=1e-9), (first, second)
assert np.allclose(result["element_moment"].values, 9e-3 * 0.5 * rate, rtol=1e-9)
"""
STOKES = """
fallen = result["velocity"].sel(axis="z").values[:, 0]
assert np.allclose(fallen, 9.81 / 5.0 * np.expm1(-5.0 * result["time"].values), atol=1e-5)
assert np.allclose(result["element_force"].values[:, 0], -5.0 * abs(fallen), rtol=1e-9)
"""


JOINT = """
import numpy as np, tribodyn as td
found = td.Mechanism("Slope", gravity="3, 0, -9 m/s^2", run={"duration": "0.1 s"})
found.body("ball", mass="2 kg", centre="0, 0, 0 mm", inertia="1e-3, 1e-3, 1e-3 kg m^2")
result = td.simulate(found.ball_on_plane("plane", "ground", "ball", point="0, 0, 0 mm", axis=[0, 0, 1]))
x, z = (result["position"].sel(axis=axis).values[:, 0] for axis in "xz")
assert np.allclose(x, 1.5 * result["time"].values ** 2, atol=1e-9) and abs(z).max() < 1e-12
assert np.allclose(result["reaction_force_global"].sel(axis="z").values, 18.0, rtol=1e-9)
"""

SHAPE = """
import numpy as np, tribodyn as td
from tribodyn.mechanisms.general.model import model_of
found = td.Mechanism("Press", gravity="0, 0, -9.81 m/s^2", run={"duration": "0.2 ms"})
found.body("pin", mass="1 kg", centre="0, 0, 0 mm", inertia="1e-3, 1e-3, 1e-3 kg m^2")
found.revolute("bore", "ground", "pin", point="0, 0, 0 mm", axis=[0, 1, 0], second_axis=[0, 0, 1])
oval = {"shape": "oval-bore", "length": "20 mm", "ovality": "5 um"}
found.clearance("bore", radius="10 mm", radial="20 um", **oval)
model = model_of(found.case())
assert model.counterpart.kind("bore") == "cylindrical" and model.clearances["bore"].shape.ovality == 5e-6
result = td.simulate(found)
assert np.isclose(result["reaction_force_global"].sel(axis="z").values[0, 0], 9.81, rtol=1e-3)
# The pin rests where the bore is wide: 20 + 5 um down, less a few asperities of 1 um.
assert -25.5e-6 < result["displacement"].sel(axis="x").values[0, 0] < -18e-6
"""


def run_with(tmp_path: Path, folder: str, title: str, first: str, script: str) -> None:
    """Run a script with code of the manual, found by its title, added to a package of the mechanisms."""
    copy, module = tmp_path / "tribodyn", title.lower().replace(" ", "_")
    shutil.copytree(SOURCE, copy, ignore=shutil.ignore_patterns("__pycache__"))
    package = copy / "mechanisms" / "general" / folder
    found = re.search(rf'^```python\n("""{title}.*?)^```', PAGE.read_text(encoding="utf-8"), re.M | re.S)
    assert found is not None
    (package / f"{module}.py").write_text(found[1], encoding="utf-8")
    names = package / "__init__.py"
    text = names.read_text(encoding="utf-8")
    assert first in text
    names.write_text(text.replace(first, f'{first}    "{module}",\n'), encoding="utf-8")
    # Machine code is that of the same kernels.
    environment = os.environ | {"PYTHONPATH": str(tmp_path)}
    done = subprocess.run(
        [sys.executable, "-c", script], cwd=tmp_path, env=environment, capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize(("title", "check"), [("Belt", BELT), ("Stokes", STOKES)])
def test_an_element_of_the_manual_takes_one_file_and_one_line(tmp_path: Path, title: str, check: str) -> None:
    script = RUN.format(method=title.lower(), check=check)
    run_with(tmp_path, "elements", title, '    "gear",\n', script)


def test_a_joint_of_the_manual_takes_one_file_and_one_line(tmp_path: Path) -> None:
    run_with(tmp_path, "joints", "Ball on plane", '    "ideal",\n', JOINT)


def test_a_shape_of_a_clearance_of_the_manual_takes_one_file_and_one_line(tmp_path: Path) -> None:
    run_with(tmp_path, "shapes", "Oval bore", '    "mesh",\n', SHAPE)
