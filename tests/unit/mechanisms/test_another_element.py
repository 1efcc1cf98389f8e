"""A part is one file, with one line in a list: those of the manual are added to one copy, and run."""

import json
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
#: Tests over the lists of elements, of types of joints with shapes of their clearances, and of laws.
OVER_ELEMENTS, OVER_JOINTS = "tests/unit/mechanism/test_elements.py", "tests/unit/mechanism/test_joints.py"
OVER_LAWS = ("tests/analytic/joints/test_contact_limits.py", "tests/unit/contact/test_laws.py")
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


COMMANDS = """
from tribodyn.cli.main import main
assert main(["hello"]) == main(["cases"]) == 0
"""
SCRIPTS = {
    "belt": RUN.format(method="belt", check=BELT),
    "stokes": RUN.format(method="stokes", check=STOKES),
    "joint": JOINT,
    "shape": SHAPE,
    "law": LAW,
    "command": COMMANDS,
    "chart": CHART,
    "model": MODEL,
}
#: Runs scripts one after the other, each by itself, and prints what each fails with.
ALL = """
import json, sys, traceback
failed = {}
for name, script in json.load(sys.stdin).items():
    try:
        exec(script, {"__name__": name})
    except BaseException:
        failed[name] = traceback.format_exc()
print(json.dumps(failed), file=sys.stderr)
"""


def of_manual(first: str, language: str = "python") -> str:
    """Return the block of code in the manual that begins with these words."""
    page = PAGE.read_text(encoding="utf-8")
    found = re.search(rf"^```{language}\n({re.escape(first)}.*?)^```", page, re.M | re.S)
    assert found is not None
    return found[1]


def insert(path: Path, before: str, added: str) -> None:
    """Add text before the one place where some other text stands."""
    text = path.read_text(encoding="utf-8")
    assert text.count(before) == 1
    path.write_text(text.replace(before, added + before), encoding="utf-8")


def process(place: Path, *arguments: str, folder: Path, text: str = "") -> subprocess.CompletedProcess[str]:
    """Run Python with the copy of the package in a place; machine code is that of the same kernels."""
    environment = os.environ | {"PYTHONPATH": str(place)}
    command = [sys.executable, *arguments]
    return subprocess.run(command, cwd=folder, env=environment, input=text, capture_output=True, text=True)


@pytest.fixture(scope="module")
def place(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the folder with a copy of the package to which all parts of the manual are added."""
    place = tmp_path_factory.mktemp("copy")
    copy = place / "tribodyn"
    shutil.copytree(SOURCE, copy)  # with bytecode, which compiling again would take longer than all else
    for folder, title, first in (
        ("elements", "Belt", "gear"),
        ("elements", "Stokes", "gear"),
        ("joints", "Ball on plane", "ideal"),
        ("shapes", "Oval bore", "mesh"),
    ):
        module, package = title.lower().replace(" ", "_"), copy / "mechanism" / folder
        (package / f"{module}.py").write_text(of_manual(f'"""{title}'), encoding="utf-8")
        insert(package / "__init__.py", f'"{first}"', f'"{module}", ')
    # Another one whose gap is wrong.
    shapes = copy / "mechanism" / "shapes"
    text = (shapes / "oval_bore.py").read_text(encoding="utf-8")
    for name, other in (("oval", "wrong"), ("Oval", "Wrong"), ("barrel.gap + ", "1e3 * ")):
        assert name in text
        text = text.replace(name, other)
    (shapes / "wrong_bore.py").write_text(text, encoding="utf-8")
    insert(shapes / "__init__.py", '"mesh"', '"wrong_bore", ')
    (copy / "contact" / "exponential.py").write_text(of_manual('"""Exponential'), encoding="utf-8")
    insert(
        copy / "contact" / "__init__.py", '    "linear:LinearContact",\n', '    "exponential:Exponential",\n'
    )
    (copy / "cli" / "commands" / "hello.py").write_text(COMMAND, encoding="utf-8")
    insert(copy / "cli" / "main.py", '    "completion",\n', '    "hello",\n')
    charts = copy / "mechanism" / "sections" / "charts.py"
    insert(charts, "CHARTS: Final = (", of_manual("def heights"))
    insert(charts, "MOTION)\n", "HEIGHTS, ")
    model = of_manual("# A uniform rod", "toml")
    (copy / "mechanism" / "built_in" / "swinging-rod.toml").write_text(model, encoding="utf-8")
    return place


@pytest.fixture(scope="module")
def failed(place: Path) -> dict[str, str]:
    """Return what fails of the scripts, all run by one process."""
    done = process(place, "-c", ALL, folder=place, text=json.dumps(SCRIPTS))
    assert done.returncode == 0, done.stderr
    found: dict[str, str] = json.loads(done.stderr.splitlines()[-1])
    return found


@pytest.mark.parametrize("part", SCRIPTS)
def test_a_part_of_the_manual_takes_one_file_and_at_most_one_line(part: str, failed: dict[str, str]) -> None:
    assert part not in failed, failed[part]


@pytest.mark.long
def test_tests_over_lists_hold_for_the_parts_and_find_a_wrong_one(place: Path) -> None:
    which = "Belt or Stokes or ball-on-plane or oval-bore or wrong-bore or exponential"
    command = ("-m", "pytest", "-q", "-p", "no:cacheprovider", "-k", which)
    done = process(place, *command, OVER_ELEMENTS, OVER_JOINTS, *OVER_LAWS, folder=PAGE.parent)
    ends = [line for line in done.stdout.splitlines() if line.startswith(("FAILED", "ERROR"))]
    assert ends, done.stdout + done.stderr
    assert [line for line in ends if "wrong-bore" not in line] == [], done.stdout
    assert int(re.search(r"(\d+) passed", done.stdout)[1]) > 10
