"""What is told of wrong inputs, word for word as it is stored beside this file.

``make golden`` writes the messages anew. Read the difference as the user who made the mistake.
"""

import contextlib
import io
import os
import shlex
import tempfile
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any, Final

import pytest
import xarray as xr

import tribodyn as td
from tribodyn.cli.main import COMMANDS as ALL
from tribodyn.cli.main import main
from tribodyn.results import netcdf_content

STORED: Final = Path(__file__).with_name("messages.txt")

#: Each is refused. ``file`` is a line of prose, ``empty`` a folder, ``done`` has another case's result.
COMMANDS: Final = (
    "rum vsv",
    "Run vsv",
    "run",
    "run vsw",
    "help run",
    "run vsv --clearance 25um",
    "run slider-crank --static --kinematic",
    "sweep vsv --vary joint.clearance=20..40um",
    "run VSV",
    "run mine.tml",
    "run vsv --sett joint.clearance=25um",
    "run vsv --set joint.clearance",
    "run vsv --set joint.clearance=20e-6",
    "run vsv --set joint.clearance=25",
    "run vsv --set joint.clearance=\"'25'\"",
    "run vsv --set joint.clearance=25kg",
    "run vsv --set joint.clearence=25um",
    "run vsv --set Joint.Clearance=25um",
    "run vsv --set clearance=25um",
    "run vsv --set joint.clearance=-25um",
    "run vsv --set joint.clearance=5mm",
    "run vsv --set joint.clearance=25 --set contact.law=RSDC --set drive.frequency=1Hz",
    "run vsv --set contact.law=hertz",
    "run vsv --set joint.friction_coefficient=0,1",
    "run vsv --set joint.friction_coefficient=10%",
    "run vsv --set mechanism.crank_inertia=1e-6kgm^2",
    "run vsv --set mechanism.ring_mass=5kg",
    "run vsv --set wear.cycles=1e5.5",
    "run vsv --set drive.angular_frequency=1Hz",
    "run vsv --set drive.start_angle=-30deg",
    "run vsv --set film.viscosity=10mPas",
    "run vsv --solver rk45",
    "run vsv --solver MEBDF",
    "run vsv -o file",
    "run vsv -o done",
    "run vsv --json --set joint.clearance=25",
    "run --json",
    "show journl-oil",
    "show bodies",
    "cases vsv",
    "sweep vsv",
    "sweep vsv --vary joint.clearance=20,30",
    "sweep vsv --vary joint.clearance=20um:40um",
    "sweep vsv --vary joint.clearance=40um:20um:5um",
    "sweep vsv --vary joint.clearence=20um,30um",
    "sweep vsv --vary joint.clearance=gauss(20um,2um)",
    "sweep vsv --vary joint.clearance=normal(20um,2um)",
    "sweep vsv --vary contact.law=RSDC,ke",
    "report nowhere",
    "report empty",
    "compare done",
    "compare done nowhere",
    "surface nowhere.csv",
    "surface file",
    "bounce vsv --law RSDC",
    "reproduce fig7",
)

FILES: Final = (
    "",
    "clearance = 20 um",
    'case = "vsv"\n[joint]\nclearance = 20 um\nradius = 6 mm  # nominal\nfriction_coefficient = 0,1\n',
    'case = "vsv"\n[joint]\nclearance = 20\n',
    'case = "vsv"\n[joint]\nclearance = "20um\n',
    "case = vsv\n",
    'case = "VSV"\n',
    'case = "journal_oil"\n[joint]\nclearance = "20 um"\n',
    'kind = "vsv"\n',
    'case = "vsv"\njoint.clearance = "twenty um"\n',
    'case = "vsv"\n[Joint]\nClearance = "20 um"\n',
    'case = "vsv"\n[contact]\nlaw = "KE"\n[solver]\nname = "RADAU"\n',
    'case = "vsv"\n[joint]\nclearence = "20 um"\nradius = 6\nlength = "20 kg"\nfriction_coefficient = -1\n',
    'case = "vsv"\n[joint]\nclearance = "1 mm"\n[surfaces]\nbushing.roughness = "0 um"\n'
    'trunnion.roughness = "0 um"\n[run]\noutput_interval = "1 h"\n',
    'case = "vsv"\n[mechanism]\ncrank_inertia = "1e-6 kg m^2"\nvane_inertia = "1e-6 kg m^2"\n'
    '[drive]\nstart_angle = "-30 deg"\n',
    'case = "vsv"\n[asperities]\nsurface = "scan.csv"\ndensity = "0.1 1/um^2"\n',
    'case = "vsv"\n[run]\ncycles = 1\nduration = "1 s"\n',
    'case = "vsv"\n[joint]\nclearance = "20 um"\n[joint]\nradius = "6 mm"\n',
)

PYTHON: Final = (
    'td.load_case("vsw")',
    'td.load_case("vsv").replace({"joint.clearance": 20e-6})',
    'td.load_case("vsv").joint.clearance = 20e-6',
    'type(td.load_case("vsv"))(joint={"clearance": -1.0})',
    'td.read("nowhere")',
    'td.contact.law("hertz", td.load_case("vsv"))',
)


def answers() -> str:
    """Return every input with what is said of it."""
    told = [f"$ tribodyn {command}\n{answered(shlex.split(command))}" for command in COMMANDS]
    for content in FILES:
        Path("mine.toml").write_text(content, encoding="utf-8")
        shown = "".join(f"| {line}\n" for line in content.splitlines())
        told.append(f"$ tribodyn check mine.toml\n{shown}{answered(['check', 'mine.toml'])}")
    told += [f">>> {statement}\n{raised(statement)}" for statement in PYTHON]
    return "\n".join(told)


def answered(arguments: Sequence[str]) -> str:
    """Return what a command prints that must be refused."""
    said = io.StringIO()
    with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said):
        assert main(arguments) == 2, arguments
    # A new command changes no message.
    return said.getvalue().replace(", ".join(ALL), "(all commands)")


def raised(statement: str) -> str:
    """Return the error that a statement of Python raises."""
    names: dict[str, Any] = {"td": td}
    with pytest.raises(Exception, match=r".") as caught:
        exec(statement, names)
    return f"{caught.type.__name__}: {caught.value}\n"


@contextlib.contextmanager
def prepared(folder: Path) -> Iterator[None]:
    """Work in a folder that has what the inputs name."""
    (folder / "file").write_text("Dear all,\n", encoding="utf-8")
    (folder / "empty").mkdir()
    (folder / "done").mkdir()

    other = td.load_case("journal-dry").to_toml()
    (folder / "done" / "result.nc").write_bytes(netcdf_content(xr.Dataset(attrs={"case": other})))
    with contextlib.chdir(folder):
        yield


def test_the_messages_are_those_stored(tmp_path: Path) -> None:
    assert len((*COMMANDS, *FILES, *PYTHON)) >= 60
    with prepared(tmp_path):
        told = answers()
    assert os.fspath(tmp_path) not in told
    assert "pydantic" not in told
    assert told == STORED.read_text(encoding="utf-8")


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as place, prepared(Path(place)):
        STORED.write_text(answers(), encoding="utf-8")
