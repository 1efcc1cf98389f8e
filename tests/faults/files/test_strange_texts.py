"""Texts of strangers in terminals and pages, files of other programs, and types that no result has."""

import subprocess
import sys
from pathlib import Path

import netCDF4
import numpy as np
import pytest

from tribodyn.cli.main import BAD_INPUT, main
from tribodyn.core.errors import InputError
from tribodyn.core.quoting import GREY, PLAIN, without_controls
from tribodyn.mechanisms.catalogue import load_case
from tribodyn.mechanisms.results import read

ESCAPE = "\x1b]0;gone\x07\x1b[2J"
OTHERS = {
    "robot.urdf": "a robot description",
    "model.xacro": "a robot description",
    "x.mjcf": "a MuJoCo model",
    "part.step": "a CAD file",
    "part.STP": "a CAD file",
    "wheel.stl": "a surface mesh",
    "drive.slx": "a Simulink model",
    "table.csv": "a table of numbers",
    "case.json": "a JSON or YAML file",
    "script.py": "a Python program",
}


@pytest.mark.parametrize("name", OTHERS)
@pytest.mark.parametrize(
    "content", [b"<robot name='x'>\n", b"ISO-10303-21;\n", b"\x00\xff\x01", b"a, b\n1, 2\n"]
)
def test_a_file_of_another_program_is_called_what_it_is(name: str, content: bytes, tmp_path: Path) -> None:
    path = tmp_path / name
    path.write_bytes(content)
    with pytest.raises(InputError, match=f"this is {OTHERS[name]}.*reads case files in TOML"):
        load_case(path)


@pytest.mark.parametrize(
    ("content", "kind"),
    [
        ('<?xml version="1.0"?>\n<!-- a comment -->\n<mujoco model="x"/>', "a MuJoCo model"),
        ("<robot/>", "a robot description"),
        ("  <sdf version='1.6'>", "a Gazebo model"),
        ("<html>", "an XML file"),
    ],
)
def test_an_xml_file_is_known_by_its_first_element(content: str, kind: str, tmp_path: Path) -> None:
    path = tmp_path / "model.xml"
    path.write_text(content)
    with pytest.raises(InputError, match=f"this is {kind}"):
        load_case(path)


def test_no_other_verb_is_guessed(capsys: pytest.CaptureFixture[str]) -> None:
    for word in ("allocate", "optimise", "design"):
        assert main([word, "x"]) == BAD_INPUT
        assert "did you mean" not in capsys.readouterr().err
    assert main(["rum", "x"]) == BAD_INPUT
    assert "did you mean `tribodyn run`" in capsys.readouterr().err


def test_an_option_before_its_command_is_told_where_it_belongs(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["--debug", "compare", "a", "b"]) == BAD_INPUT
    said = capsys.readouterr().err
    assert "--debug follows the command" in said
    assert "did you mean" not in said


SOUND = 'case = "vsv"\ntitle = """a = 5 mm"""\n[joint]\nclearance = "20 um"\nradius = "6 mm"\n'


@pytest.mark.parametrize(
    ("wrong", "line", "hint"),
    [
        ("length = 12 mm", 6, 'length = "12 mm"'),
        ('length = "12 mm', 6, "does not end"),
        ("length = 12,5", 6, "12.5"),
        ('radius = "7 mm"', 6, "joint.radius stands twice, in line 5 and in line 6"),
        ("[joint]", 6, "[joint] stands twice, in line 3 and in line 6"),
        ("length == 1", 6, "line 6"),
        ("]", 6, "line 6"),
    ],
)
def test_what_is_no_toml_is_said_of_the_line_where_it_is(wrong, line, hint, tmp_path):
    """Lines that could be mistaken, before and behind, are sound; only the wrong one is named."""
    more = '[run]\noutput_interval = "1 ms" # 1 ms\nnote = """\nlength = 5 mm\nname = word\n"""\n'
    path = tmp_path / "case.toml"
    path.write_text(f"{SOUND}{wrong}\n{more}")
    with pytest.raises(InputError) as raised:
        load_case(path)
    (fault,) = raised.value.faults
    assert hint in str(fault)
    assert f"line {line}" in str(fault)


def test_further_wrong_lines_are_named_too(tmp_path: Path) -> None:
    path = tmp_path / "case.toml"
    path.write_text(f'{SOUND}length = 12 mm\nfriction_coefficient = 0,1\n[run]\nduration = "1 s"\n')
    with pytest.raises(InputError) as raised:
        load_case(path)
    assert [str(fault).partition("line ")[2][:1] for fault in raised.value.faults] == ["6", "7"]


@pytest.mark.parametrize("kind", ["vlen", "compound", "enum", "group"])
def test_types_that_no_result_has_are_refused(kind: str, tmp_path: Path) -> None:
    with netCDF4.Dataset(tmp_path / "result.nc", "w") as file:
        file.createDimension("time", 4)
        if kind == "vlen":
            file.createVLType(np.float64, "many")
            file.createVariable("x", file.vltypes["many"], ("time",))[0] = np.zeros(1000)
        elif kind == "compound":
            file.createCompoundType(np.dtype([("a", "f8")]), "pair")
        elif kind == "enum":
            file.createEnumType(np.int8, "level", {"low": 0})
        else:
            file.createGroup("more")
    with pytest.raises(InputError, match="groups or types of its own"):
        read(tmp_path)


def test_controls_are_shown_as_codes_and_grey_stays_grey() -> None:
    assert "\x1b" not in without_controls(f"a{ESCAPE}b")
    assert without_controls(f"{GREY}a\tb\n{PLAIN}") == f"{GREY}a\tb\n{PLAIN}"


def test_no_text_of_a_rig_reaches_terminal_or_page_as_it_is(tmp_path, capsys):
    table = tmp_path / "numbers.csv"
    row = f'steps,5,1,10 %,,"<script>alert(1)</script>{ESCAPE}","<img src=x>"'
    table.write_text(f"quantity,measured,half_width,accepted,null,source,explanation\n{row}\n")
    (tmp_path / "README.md").write_text("# x\n<script>1</script>\n")
    command = ["validate", str(table), "--against", "journal-dry", "--set", "run.duration=0.1 ms"]
    assert main([*command, "-o", str(tmp_path / "out")]) == 0
    captured = capsys.readouterr()
    assert "\x1b" not in captured.out + captured.err
    page = (tmp_path / "out" / "numbers.md").read_text(encoding="utf-8")
    assert "<script" not in page
    assert "<img" not in page


def test_a_warning_of_a_library_moves_no_cursor() -> None:
    script = (
        "import sys, warnings; from tribodyn.cli.console import escape_warnings; escape_warnings(); "
        "warnings.warn(sys.argv[1])"
    )
    done = subprocess.run([sys.executable, "-c", script, f"title {ESCAPE}"], capture_output=True, text=True)
    assert done.stderr == "UserWarning: title \\x1b]0;gone\\x07\\x1b[2J\n"
