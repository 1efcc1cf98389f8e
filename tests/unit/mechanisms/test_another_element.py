"""A part is one file, with one line in a list: those of the manual are added to a copy, and run."""

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
#: Tests over the lists of types of joints and of shapes of their clearances.
OVER_JOINTS = "tests/unit/mechanism/test_joints.py"
RUN = """
import numpy as np, tribodyn as td
from tribodyn.cases.load import parse
from tribodyn.mechanisms.catalogue import kinds
from tribodyn.mechanism.elements import ELEMENTS
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
from tribodyn.mechanism.assembly.parts_by_number import model_of
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


LAW = """
import numpy as np, pytest, tribodyn as td
from tribodyn.core.errors import InputError
given = {"contact.law": "exponential", "contact.reference_pressure": "3 MPa"}
case = td.load_case("journal-dry").replace(given)
law = case.contact.law_of(case.surface_pair)
assert np.allclose(law.stiffness_pressure(np.array([0.0, 1.0])), [3e6, 3e6 * np.exp(-2.0)], rtol=1e-12)
assert td.load_case("journal-dry").contact.reference_pressure == 2e6
for key, value, said in (("reference_pressure", "0 MPa", "> 0"), ("decay", 11.0, "<= 10")):
    with pytest.raises(InputError, match=said) as caught:
        case.replace({f"contact.{key}": value})
    assert caught.value.key == f"contact.{key}"
    with pytest.raises(InputError, match=said):
        type(law)(case.surface_pair, **{key: float(str(value).split()[0])})
shorter = case.replace({"run.duration": "2 ms"})
assert 'reference_pressure = "3 MPa"' in shorter.to_toml()
result = td.simulate(shorter)
assert float(result["pressure_max"].max()) > 0.0
"""

CHART = """
import pathlib, tribodyn as td
from tribodyn.report import draw_all, write
found = td.Mechanism("Stone", gravity="0, 0, -9.81 m/s^2", run={"duration": "10 ms"})
found.body("stone", mass="1 kg", centre="0, 0, 0 mm", inertia="1e-3, 1e-3, 1e-3 kg m^2")
result = td.simulate(found.spherical("end", "ground", "stone", point="50, 0, 0 mm"))
folder = pathlib.Path("run")
draw_all(result, folder / "figures")
assert (folder / "figures" / "heights.png").stat().st_size > 10_000
write(result, folder / "report.html")
assert "How high the mass centres of the bodies are." in (folder / "report.html").read_text("utf-8")
"""

MODEL = """
import numpy as np, tribodyn as td
result = td.simulate("swinging-rod")
angle = result["joint_angle"].values[:, 0]
swing = np.sqrt(9.81 * 0.15 / (7.5e-3 + 0.15**2))
assert np.allclose(angle, 0.1 / swing * np.sin(swing * result["time"].values), atol=1e-4)
"""

COMMAND = '''
"""``tribodyn hello``: print a greeting."""

HELP = "print a greeting"
EXAMPLE = "tribodyn hello"

def add_arguments(parser):
    """Add no arguments."""

def execute(args):
    """Print it."""
    print("Hello")
    return 0
'''


def of_manual(first: str, language: str = "python") -> str:
    """Return the block of code in the manual that begins with these words."""
    page = PAGE.read_text(encoding="utf-8")
    found = re.search(rf"^```{language}\n({re.escape(first)}.*?)^```", page, re.M | re.S)
    assert found is not None
    return found[1]


def copy_of_package(place: Path) -> Path:
    copy = place / "tribodyn"
    shutil.copytree(SOURCE, copy, ignore=shutil.ignore_patterns("__pycache__"))
    return copy


def insert(path: Path, before: str, added: str) -> None:
    """Add text before the one place where some other text stands."""
    text = path.read_text(encoding="utf-8")
    assert text.count(before) == 1
    path.write_text(text.replace(before, added + before), encoding="utf-8")


def run(place: Path, script: str) -> None:
    """Run a script with the copy of the package in a folder; machine code is that of the same kernels."""
    environment = os.environ | {"PYTHONPATH": str(place)}
    done = subprocess.run(
        [sys.executable, "-c", script], cwd=place, env=environment, capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr


def failures(place: Path, *tests: str) -> str:
    """Run tests with the copy of the package in a folder; return what pytest says, empty if all pass."""
    environment = os.environ | {"PYTHONPATH": str(place)}
    command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", *tests]
    done = subprocess.run(command, cwd=PAGE.parent, env=environment, capture_output=True, text=True)
    return done.stdout + done.stderr if done.returncode else ""


def run_with(place: Path, folder: str, title: str, first: str, script: str) -> Path:
    """Run a script with code of the manual, found by its title, added to a package of the mechanisms."""
    package = copy_of_package(place) / "mechanism" / folder
    module = title.lower().replace(" ", "_")
    (package / f"{module}.py").write_text(of_manual(f'"""{title}'), encoding="utf-8")
    insert(package / "__init__.py", f'"{first}"', f'"{module}", ')
    run(place, script)
    return package / f"{module}.py"


@pytest.mark.parametrize(("title", "check"), [("Belt", BELT), ("Stokes", STOKES)])
def test_an_element_of_the_manual_takes_one_file_and_one_line(tmp_path: Path, title: str, check: str) -> None:
    script = RUN.format(method=title.lower(), check=check)
    run_with(tmp_path, "elements", title, "gear", script)
    assert not failures(tmp_path, "tests/unit/mechanism/test_elements.py")


def test_a_joint_of_the_manual_takes_one_file_and_one_line(tmp_path: Path) -> None:
    run_with(tmp_path, "joints", "Ball on plane", "ideal", JOINT)
    assert not failures(tmp_path, OVER_JOINTS)


def test_a_shape_of_a_clearance_of_the_manual_takes_one_file_and_one_line(tmp_path: Path) -> None:
    added = run_with(tmp_path, "shapes", "Oval bore", "mesh", SHAPE)
    assert not failures(tmp_path, OVER_JOINTS)
    insert(added, "barrel.gap + ", "1e3 * ")
    assert "oval-bore" in failures(tmp_path, OVER_JOINTS, "-k", "oval-bore")


def test_a_contact_law_of_the_manual_takes_one_file_and_one_line(tmp_path: Path) -> None:
    package = copy_of_package(tmp_path) / "contact"
    (package / "exponential.py").write_text(of_manual('"""Exponential'), encoding="utf-8")
    insert(package / "__init__.py", '    "linear:LinearContact",\n', '    "exponential:Exponential",\n')
    run(tmp_path, LAW)
    assert not failures(tmp_path, "tests/analytic/test_contact_limits.py", "tests/unit/contact/test_laws.py")


def test_a_command_takes_one_file_and_one_name(tmp_path: Path) -> None:
    folder = copy_of_package(tmp_path) / "cli"
    (folder / "commands" / "hello.py").write_text(COMMAND, encoding="utf-8")
    insert(folder / "main.py", '    "completion",\n', '    "hello",\n')
    run(tmp_path, "from tribodyn.cli.main import main; import sys; sys.exit(main(['hello']))")
    run(tmp_path, "from tribodyn.cli.main import main; import sys; sys.exit(main(['cases']))")


def test_a_chart_of_the_manual_takes_one_file(tmp_path: Path) -> None:
    charts = copy_of_package(tmp_path) / "mechanism" / "sections" / "charts.py"
    insert(charts, "CHARTS: Final = (", of_manual("def heights"))
    insert(charts, "MOTION)\n", "HEIGHTS, ")
    run(tmp_path, CHART)


def test_a_model_of_the_manual_takes_one_file(tmp_path: Path) -> None:
    folder = copy_of_package(tmp_path) / "mechanism" / "built_in"
    model = of_manual("# A uniform rod", "toml")
    (folder / "swinging-rod.toml").write_text(model, encoding="utf-8")
    run(tmp_path, MODEL)
