"""Bad input: exit status 2, one clear message on stderr, nothing written, no traceback."""

import json
import os
import re
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

import tribodyn.simulation
from tribodyn.cli.main import main
from tribodyn.core.errors import MOST_FAULTS

RunCommand = Callable[..., str]


@pytest.fixture
def refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> RunCommand:
    """Run a command that must be refused, and return its message."""
    monkeypatch.chdir(tmp_path)

    def simulate(*_: object, **__: object) -> None:
        pytest.fail("bad input reached the simulation")

    monkeypatch.setattr(tribodyn.simulation, "simulate", simulate)

    def run(*arguments: str) -> str:
        before = _tree(tmp_path)
        assert main(arguments) == 2
        assert _tree(tmp_path) == before
        out, err = capsys.readouterr()
        assert out == ""
        assert err.startswith("tribodyn: ")
        assert err.count("\n") == 1
        assert err[:-1].isprintable()
        assert "Traceback" not in err
        return err

    return run


def _tree(directory: Path) -> dict[str, tuple[int, int] | None]:
    """Return size and time of change of every file in a directory."""
    found = {str(path): (path, path.stat()) for path in directory.rglob("*")}
    return {
        name: (stat.st_size, stat.st_mtime_ns) if path.is_file() else None
        for name, (path, stat) in found.items()
    }


VALUES = [
    # unknown keys, with the nearest valid spelling
    ('[joint]\nclearence = "20 um"', "joint.clearence", "joint.clearance"),
    ('[joints]\nclearance = "20 um"', "joints.clearance", "joint.clearance"),
    ('clearance = "20 um"', "clearance", "joint.clearance"),
    ('[bushing]\nyoung_modulus = "7 GPa"', "bushing.young_modulus", "surfaces.bushing.young_modulus"),
    ('[surfaces.bushing]\nyoungs_modulus = "7 GPa"', "surfaces.bushing.youngs_modulus", "young_modulus"),
    ('[surfaces.trunnion]\nhardness = "1 GPa"', "surfaces.trunnion.hardness", "surfaces.bushing.hardness"),
    ("[solver.grids]\ntheta = 48", "solver.grids.theta", "solver.grid.theta"),
    ("[qqqq]\nxyzzy = 1", "qqqq.xyzzy", "unknown key"),
    ('[joint]\n"clearance\\u001b[31m" = 1', 'joint."clearance\\U0000001b[31m"', "unknown key"),
    ("joint = 3", "joint", "clearance, radius"),
    ("surfaces = 3", "surfaces", "surfaces.trunnion"),
    ("[[joint]]\nx = 1", "joint", "clearance, radius"),
    # missing unit, with the right spelling
    ("[joint]\nclearance = 25", "joint.clearance", 'clearance = "25 um"'),
    ('[joint]\nclearance = "25"', "joint.clearance", 'clearance = "25 um"'),
    ("[drive]\nstart_angle = -16.0", "drive.start_angle", 'start_angle = "-16.0 deg"'),
    ("[solver.atol]\ntilt = 1e-8", "solver.atol.tilt", "rad"),
    # wrong dimension or unit
    ('[joint]\nclearance = "20 kg"', "joint.clearance", "length"),
    ('[joint]\nclearance = "20 parsnips"', "joint.clearance", "parsnips"),
    ('[drive]\nangular_frequency = "1 Hz"', "drive.angular_frequency", "rad/s"),
    ('[drive]\nspeed_amplitude = "20 deg"', "drive.speed_amplitude", "deg/s"),
    ('[loads]\nswitch_angle = "90 percent"', "loads.switch_angle", "deg"),
    ('[mechanism]\ngravity = "9.81 N"', "mechanism.gravity", "m/s^2"),
    ('[joint]\nfriction_coefficient = "0.1 m"', "joint.friction_coefficient", "bare number"),
    # another kind of value
    ("[joint]\nclearance = true", "joint.clearance", "20 um"),
    ("[joint]\nclearance = [20]", "joint.clearance", "20 um"),
    ("[joint]\nclearance = 1979-05-27", "joint.clearance", "20 um"),
    ("[joint]\nclearance = {value = 20}", "joint.clearance.value", "joint.clearance"),
    ("[joint]\nfriction_coefficient = true", "joint.friction_coefficient", "a number"),
    ("[contact]\ntensile_clip = 1", "contact.tensile_clip", "true or false"),
    ('[contact]\ntensile_clip = "yes"', "contact.tensile_clip", "true or false"),
    ("[solver.grid]\ntheta = 48.5", "solver.grid.theta", "whole number"),
    ("[solver.grid]\ntheta = 1000000000", "solver.grid.theta", "4096"),
    ("title = 3", "title", "text"),
    ('title = "two\\nlines"', "title", "one line"),
    # not finite
    ("[joint]\nclearance = nan", "joint.clearance", "finite"),
    ('[joint]\nclearance = "nan um"', "joint.clearance", "finite"),
    ('[joint]\nclearance = "inf um"', "joint.clearance", "finite"),
    ('[joint]\nclearance = "1e999 um"', "joint.clearance", "too large"),
    ('[asperities]\nradius = "2e-309 um"', "asperities.radius", "too small"),
    ("[joint]\nfriction_coefficient = nan", "joint.friction_coefficient", "finite"),
    ("[joint]\nfriction_coefficient = -inf", "joint.friction_coefficient", "finite"),
    ("[solver]\nrtol = " + "9" * 400, "solver.rtol", "finite"),
    # impossible
    ('[joint]\nclearance = "-20 um"', "joint.clearance", "> 0"),
    ('[joint]\nclearance = "0 um"', "joint.clearance", "> 0"),
    ('[joint]\nclearance = "1e-999 um"', "joint.clearance", "> 0"),
    ('[joint]\nclearance = "5 mm"', "joint.clearance", "joint.radius"),
    ('[joint]\nlength = "-1 mm"', "joint.length", "> 0"),
    ("[joint]\nfriction_coefficient = -0.1", "joint.friction_coefficient", ">= 0"),
    ("[surfaces.bushing]\npoisson_ratio = 0.51", "surfaces.bushing.poisson_ratio", "<= 0.5"),
    ("[surfaces.bushing]\npoisson_ratio = 0", "surfaces.bushing.poisson_ratio", "> 0"),
    ('[surfaces.bushing]\nyoung_modulus = "0 GPa"', "surfaces.bushing.young_modulus", "> 0"),
    (
        '[surfaces]\ntrunnion.roughness = "0 um"\nbushing.roughness = "0 um"',
        "surfaces.bushing.roughness",
        "rough",
    ),
    ('[mechanism]\nvane_mass = "0 kg"', "mechanism.vane_mass", "> 0"),
    ('[mechanism]\nring_mass = "5 kg"', "mechanism.ring_inertia", "kg m^2"),
    ('[mechanism]\ncrank_inertia = "1e-6 kg m^2"', "mechanism.crank_inertia", "kg m^2"),
    ('[wear]\nspecific_wear_rate = "-1 m^2/N"', "wear.specific_wear_rate", ">= 0"),
    ("[solver]\nrtol = 0", "solver.rtol", "1e-12"),
    ("[run]\ncycles = 0", "run.cycles", "> 0"),
    ('[run]\nduration = "-1 s"', "run.duration", "> 0"),
    ('[run]\ncycles = 1\nduration = "1 s"', "run.duration", "not both"),
    ('[run]\noutput_interval = "1 h"', "run.output_interval", "lasts only"),
    ('[run]\noutput_interval = "1 ns"', "run.output_interval", "output times"),
    # out of reach
    ('[drive]\nstart_angle = "-30 deg"', "drive.start_angle", "reaches only from"),
    ('[drive]\nspeed_amplitude = "-20 deg/s"', "drive.start_angle", "reaches only from"),
    ('[drive]\nspeed_amplitude = "0 deg/s"', "drive.speed_amplitude", "must move"),
    ('[mechanism]\npivot_distance = "2 m"', "drive.start_angle", "cannot be assembled"),
    # names
    ('[contact]\nlaw = "hertz"', "contact.law", "ke, rsdc"),
    ('[contact]\nlaw = "RSDC"', "contact.law", "ke, rsdc"),
    ('[contact]\nlaw = "rsd"', "contact.law", 'did you mean "rsdc"'),
    ('[solver]\nname = "euler"', "solver.name", "bdf"),
    ("[solver]\nname = 5", "solver.name", "bdf"),
    ('[joint]\nfriction = "viscous"', "joint.friction", "traction, moment"),
    ('[mechanism]\nformulation = "<b>"', "mechanism.formulation", "exact, paper"),
    ('[run]\nstart = "anywhere"', "run.start", "equilibrium, centred"),
]


@pytest.mark.parametrize(("content", "key", "hint"), VALUES, ids=[content for content, _, _ in VALUES])
def test_wrong_values_name_file_key_value_and_what_is_allowed(content, key, hint, refused, tmp_path):
    (tmp_path / "mine.toml").write_text(f'case = "vsv"\n{content}\n', encoding="utf-8")
    message = refused("check", "mine.toml")
    assert f"mine.toml: {key}" in message
    assert hint in message
    # run sees exactly what check sees, and leaves no directory behind (the fixture compares the tree).
    assert refused("run", "mine.toml") == message


@pytest.mark.parametrize(
    ("content", "hint"),
    [
        (b"", "empty"),
        (b"\n# only a comment\n", "empty"),
        (b"\x7fELF\x00\x01\x02", "binary"),
        (b'case = "vsv"\xff\xfe', "UTF-8"),
        ('case = "vsv"'.encode("utf-16"), "UTF-8"),
        (b'case = "vs', "TOML"),
        (b'case = "vsv"\n[joint', "TOML"),
        (b'case = "vsv"\ncase = "vsv"', "TOML"),
        (b"a = " + b"[" * 100_000, "TOML"),
        (b"a = " + b"9" * 10_000, "TOML"),
        (b"#" * 1_000_001, "larger than 1 MB"),
        (b'[joint]\nclearance = "20 um"', 'write case = "vsv"'),
        (b'case = "vsw"', 'did you mean "vsv"'),
        (b"case = 5", "allowed: vsv"),
    ],
)
def test_files_that_are_no_case(content: bytes, hint: str, refused: RunCommand, tmp_path: Path) -> None:
    (tmp_path / "mine.toml").write_bytes(content)
    message = refused("check", "mine.toml")
    assert "mine.toml: " in message
    assert hint in message
    assert len(message) < 400


@pytest.mark.parametrize(
    ("name", "hint"),
    [
        ("missing.toml", "no such file"),
        ("vsw", "did you mean vsv"),
        (".", "directory"),
        ("x" * 5000, "no such file"),
        ("plain.txt/inside.toml", "cannot be read"),
        ("\x1b[31mred", "no such file"),
        ("", "directory"),
    ],
)
def test_files_that_are_not_there(name: str, hint: str, refused: RunCommand, tmp_path: Path) -> None:
    (tmp_path / "plain.txt").write_text("text", encoding="utf-8")
    assert hint in refused("run", name)


def test_permissions_are_respected(refused, tmp_path, monkeypatch):
    # Played, because root, who runs many test suites, may read and write everything.
    def deny(*_: object, **__: object) -> None:
        raise PermissionError(13, "Permission denied")

    (tmp_path / "secret.toml").write_text('case = "vsv"', encoding="utf-8")
    monkeypatch.setattr(os, "open", deny)
    assert "cannot be read: Permission denied" in refused("check", "secret.toml")
    monkeypatch.undo()
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(Path, "mkdir", deny)
    assert "cannot be written there (permission denied)" in refused("run", "vsv", "-o", "closed/inside")


@pytest.mark.parametrize(
    "output", ["file", "file/inside", "full", "figured", "new/\0", "", "n" * 300, "deep/" + "n" * 300]
)
def test_output_that_cannot_be_written_is_found_before_the_run(output, refused, tmp_path):
    (tmp_path / "file").write_text("mine", encoding="utf-8")
    (tmp_path / "full" / "result.nc").mkdir(parents=True)
    (tmp_path / "figured").mkdir()
    (tmp_path / "figured" / "figures").write_text("mine", encoding="utf-8")
    message = refused("run", "vsv", "-o", output)
    assert "--output: given" in message
    assert "allowed: a directory" in message


@pytest.mark.parametrize(
    ("arguments", "hint"),
    [
        (("--set", "joint.clearance=25"), '--set: joint.clearance: given "25": the unit is missing'),
        (("--set", "joint.clearence=25 um"), "joint.clearance"),
        (("--set", "joint.clearance"), "PATH=VALUE"),
        (("--set", "=5"), "PATH=VALUE"),
        (("--set", ""), "PATH=VALUE"),
        (("--set", "solver.grid.z=2.5"), "whole number"),
        (("--set", "case=journal"), "case"),
        (("--set", "contact.tensile_clip=maybe"), "true or false"),
        (("--set", "joint.clearance=20 um\x1b[2J"), r"\U0000001b"),
        (("--solver", "euler"), "--solver: solver.name"),
        (("--set", "drive.start_angle=-30 deg"), "reaches only"),
    ],
)
def test_wrong_options_name_the_option(arguments: tuple[str, ...], hint: str, refused: RunCommand) -> None:
    assert hint in refused("run", "vsv", *arguments)


@pytest.mark.parametrize(
    "arguments", [["run"], ["run", "vsv", "--outptu", "x"], ["run", "vsv", "--out", "x"]]
)
def test_a_wrong_command_line_is_one_message(arguments, capsys):
    assert main(arguments) == 2
    message = capsys.readouterr().err
    assert re.fullmatch(r"tribodyn: .*--help`\n", message)


@pytest.mark.parametrize("name", ["missing", "file", "empty", "corrupt"])
def test_report_needs_results(name: str, refused: RunCommand, tmp_path: Path) -> None:
    (tmp_path / "file").write_text("text", encoding="utf-8")
    (tmp_path / "empty").mkdir()
    (tmp_path / "corrupt").mkdir()
    (tmp_path / "corrupt" / "result.nc").write_bytes(b"\x89HDF\r\n\x1a\n" + bytes(100))
    assert name in refused("report", name)


def test_debug_shows_the_traceback_and_keeps_the_status(tmp_path: Path) -> None:
    command = [sys.executable, "-m", "tribodyn", "check", "nowhere.toml", "--debug"]
    process = subprocess.run(command, capture_output=True, text=True, cwd=tmp_path, check=False)
    assert process.returncode == 2
    assert "Traceback" in process.stderr


def test_a_reader_that_leaves_is_no_error_message(tmp_path: Path) -> None:
    command = f'"{sys.executable}" -m tribodyn show vsv | head -c 10'
    process = subprocess.run(command, shell=True, capture_output=True, text=True, cwd=tmp_path, check=False)
    assert process.stdout == "# All keys"
    assert process.stderr == ""


def test_the_command_alone_prints_its_help(capsys: pytest.CaptureFixture[str]) -> None:
    assert main([]) == 0
    assert "usage: tribodyn" in capsys.readouterr().out


def test_a_refusal_is_json_where_json_is_asked_for(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    Path("mine.toml").write_text('case = "vsv"\n[joint]\nclearance = 20\nradios = 6\n', encoding="utf-8")
    assert main(["check", "mine.toml", "--json"]) == 2
    told = json.loads(capsys.readouterr().out)
    assert told["status"] == "refused"
    assert {fault["key"] for fault in told["faults"]} == {"joint.clearance", "joint.radios"}
    assert {fault["source"] for fault in told["faults"]} == {"mine.toml"}


def test_of_many_faults_the_first_are_told(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    lines = "".join(f"nothing_{i} = 1\n" for i in range(10_000))
    (tmp_path / "mine.toml").write_text(f'case = "vsv"\n{lines}', encoding="utf-8")
    assert main(["check", os.fspath(tmp_path / "mine.toml")]) == 2
    assert capsys.readouterr().err.count("\n") == MOST_FAULTS
