"""Files of strokes, loads and forms that are damaged: a case loads or is refused in words, nothing else."""

import os
import random
import warnings
from pathlib import Path

import pytest

import tribodyn as td
from tribodyn.core.errors import InputError

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
