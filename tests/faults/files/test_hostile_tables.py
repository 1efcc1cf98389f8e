"""Damaged tables, closed streams and full disks."""

import json
import os
import random
import resource
import shlex
import signal
import subprocess
import sys
import time
import warnings
from functools import partial
from pathlib import Path

import pytest

import tribodyn as td
from tribodyn.cli.main import BAD_INPUT, main
from tribodyn.core import platforms
from tribodyn.core.errors import InputError
from tribodyn.mechanisms.catalogue import load_case
from tribodyn.studies.local import _affordable
from tribodyn.validation.rig import MOST, rig

FILES = {
    "drive.angle.table": "time [s], crank [deg]\n0, -16\n1, 0\n2, 4\n3, -2\n4, -16\n",
    "drive.speed.table": "time [s]; speed [deg/s]\n0; 0\n1; 10,5\n2; -10,5\n3; 0\n",
    "loads.more.gas.moment.map": "time [s], 60 deg [N m], 90 deg [N m]\n0, 1, 2\n1, 2, 3\n2, 0, 1\n",
    "loads.more.gas.force_y.table": "vane [deg]\tforce [N]\n50\t1\n60\t2\n60\t2\n70\t1\n",
    "joint.form.bushing.map": "a [deg], -10 mm [um], 10 mm [um]\n0, 1, 1\n90, 2, 2\n180, 1, 1\n270, 2, 2\n",
}
BITS = [
    b"nan",
    b"inf",
    b"1e999",
    b"-",
    b",",
    b";",
    b"\n",
    b"\0",
    b"\xff",
    b"[",
    b"]",
    b"deg",
    b"1e308",
    b"9" * 400,
]


def attempt(folder: Path, key: str, content: bytes) -> str:
    """Return why a case with such a file is refused; nothing if it is not."""
    (folder / "file.csv").write_bytes(content)
    (folder / "case.toml").write_text(f'case = "vsv"\n{key} = "file.csv"\n')
    try:
        td.load_case(folder / "case.toml")
    except InputError as error:
        return str(error)
    return ""


@pytest.mark.parametrize("key", FILES)
def test_damaged_files_are_refused_in_words(key: str, tmp_path: Path) -> None:
    chance, whole = random.Random(key), FILES[key].encode()
    assert attempt(tmp_path, key, whole) == ""
    refused = 0
    for _ in range(40):
        content = bytearray(whole)
        for _ in range(chance.randint(1, 4)):
            place = chance.randrange(len(content) + 1)
            cut = chance.choice([0, 0, 1, 5])
            content[place : place + cut] = chance.choice([*BITS, bytes([chance.randrange(256)])])
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            told = attempt(tmp_path, key, bytes(content))
        refused += bool(told)
        assert len(told) < 1000
        assert told.isprintable()
    assert refused > 15


@pytest.mark.parametrize(
    "content", [b"", b"\n\n\n", b"\x89PNG\r\n", b"time [s], crank [deg]\n" + b"0, 1\n" * 3]
)
def test_what_is_no_table_is_refused(content: bytes, tmp_path: Path) -> None:
    assert attempt(tmp_path, "drive.angle.table", content)


def test_what_is_no_file_is_refused(tmp_path: Path) -> None:
    for name, make in (("folder.csv", Path.mkdir), ("pipe.csv", os.mkfifo), ("none.csv", lambda path: None)):
        make(tmp_path / name)
        (tmp_path / "case.toml").write_text(f'case = "vsv"\ndrive.angle.table = "{name}"\n')
        with pytest.raises(InputError, match=r"cannot be read|no such file"):
            td.load_case(tmp_path / "case.toml")


def test_a_table_longer_than_a_case_can_hold_is_refused(tmp_path: Path) -> None:
    rows = "".join(f"{k / 1000}, 0\n" for k in range(10_001))
    assert "more than 10000 rows" in attempt(
        tmp_path, "drive.angle.table", f"time [s], crank [deg]\n{rows}".encode()
    )
    names = ", ".join(f"{k / 10} deg [N m]" for k in range(600))
    rows = "".join(f"{k}, {', '.join('0' for _ in range(600))}\n" for k in range(100))
    assert "more than 50000 values" in attempt(
        tmp_path, "loads.more.gas.moment.map", f"time [s], {names}\n{rows}".encode()
    )


TRIBODYN = [sys.executable, "-m", "tribodyn"]
SHORT = ["run", "vsv", "--set", "run.duration=2 ms", "--set", "run.output_interval=1 ms", "--no-figures"]
HEADER = "quantity,measured,half_width,accepted,null,source,explanation\n"


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="needs a device that is always full")
def test_a_closed_stdout_ends_nothing_and_a_full_log_is_said_once(tmp_path: Path) -> None:
    words = [*TRIBODYN, *SHORT, "-o", "out", "--log", "/dev/full"]
    done = subprocess.run(
        f"{shlex.join(words)} >&-", shell=True, cwd=tmp_path, capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "out" / "summary.json").exists()
    assert done.stderr.count("/dev/full cannot be written") == 1
    assert "Traceback" not in done.stderr


def test_the_end_of_the_terminal_saves_a_run(tmp_path: Path) -> None:
    command = [*TRIBODYN, "run", "vsv", "--set", "run.cycles=200", "--no-figures", "--no-report", "-o", "out"]
    # Under nohup, the tests themselves ignore the signal.
    heard = partial(signal.signal, signal.SIGHUP, signal.SIG_DFL)
    with subprocess.Popen(
        command, cwd=tmp_path, stderr=subprocess.PIPE, text=True, preexec_fn=heard
    ) as process:
        assert process.stderr is not None
        # Once progress is reported the run is under way.
        while "%" not in process.stderr.readline():
            assert process.poll() is None
        process.send_signal(signal.SIGHUP)
        process.communicate(timeout=120.0)
    summary = json.loads((tmp_path / "out" / "summary.json").read_text(encoding="utf-8"))
    assert summary["status"] == "failed"
    assert summary["simulated_time_s"] > 0.0


def test_open_files_without_a_limit_allow_all_workers(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(resource, "getrlimit", lambda _: (resource.RLIM_INFINITY, resource.RLIM_INFINITY))
    assert platforms.free_handles() > 10**6
    assert _affordable(7, lambda text: None) == 7


@pytest.mark.parametrize(
    ("rows", "message"),
    [
        (f"steps,5,1,10 %,,{'x' * 200_000},\n", "field larger"),
        ("steps,../x.csv,1,10 %,,,\n", "a file in the same folder"),
        ("steps,/etc/x.csv,1,10 %,,,\n", "a file in the same folder"),
        ("".join(f"n{k},5,1,,,,\n" for k in range(30_000)), f"allowed: {MOST} at most"),
        ("steps\n", "is given"),
    ],
)
def test_a_table_of_measurements_that_is_none_is_refused_before_the_run(rows, message, tmp_path):
    path = tmp_path / "numbers.csv"
    path.write_text(HEADER + rows, encoding="utf-8")
    began = time.process_time()
    with pytest.raises(InputError, match=message if rows != "steps\n" else "no number"):
        rig(path, load_case("journal-dry"), ())
    assert time.process_time() - began < 20.0


def test_a_readme_that_is_no_text_is_shown_as_far_as_it_is(tmp_path: Path) -> None:
    (tmp_path / "numbers.csv").write_text(f"{HEADER}steps,5,1,,,,\n", encoding="utf-8")
    (tmp_path / "README.md").write_bytes(b"# x\n\xff\xfe measured\n")
    assert "measured" in rig(tmp_path / "numbers.csv", load_case("journal-dry"), ()).readme()


def test_a_mesh_without_a_mass_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    corners = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
    faces = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
    facets = [1e-110 * x for face in faces for corner in face for x in corners[corner]]
    case = tmp_path / "case.toml"
    case.write_text(
        f'case = "mechanism"\nrun.duration = "1 ms"\n[bodies.a]\nshape = "mesh"\nfacets = {facets}\n'
        'density = "7850 kg/m^3"\n[joints.main]\ntype = "revolute"\nbetween = ["ground", "a"]\n'
        'point = "0, 0, 0 mm"\naxis = [0, 0, 1]\n'
    )
    assert main(["check", str(case)]) == BAD_INPUT
    assert "internal error" not in capsys.readouterr().err
