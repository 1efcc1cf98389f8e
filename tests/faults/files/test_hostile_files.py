"""Files made to harm whoever reads them: endless, huge, deep, or of another kind than their name says."""

import difflib
import json
import os
import random
import shutil
import subprocess
import sys
import zipfile
from collections.abc import Callable
from pathlib import Path

import netCDF4
import pytest
from tests.faults.trial import Watched, tolerable

from tribodyn.cli.main import main
from tribodyn.core import files
from tribodyn.core.errors import InputError
from tribodyn.core.files import read_regular
from tribodyn.mechanism.builder.mechanism_builder import Mechanism
from tribodyn.mechanisms.catalogue import load_case

FEW, PARTS, EACH = 5, 14, 358
Maker = Callable[[Path, random.Random], None]


def pipe(path: Path, _: random.Random) -> None:
    os.mkfifo(path)


def device(path: Path, draw: random.Random) -> None:
    path.symlink_to(draw.choice(["/dev/zero", "/dev/urandom", "/dev/tty", "/dev/null", "/dev/full"]))


def linked_pipe(path: Path, draw: random.Random) -> None:
    pipe(path.with_name("pipe"), draw)
    path.symlink_to(path.with_name("pipe"))


def folder(path: Path, _: random.Random) -> None:
    path.mkdir()


def nowhere(path: Path, draw: random.Random) -> None:
    path.symlink_to(draw.choice(["nothing", path.name, "/proc/kcore", "/proc/self/mem"]))


def sparse(path: Path, draw: random.Random) -> None:
    with path.open("wb") as stream:
        stream.write(draw.choice([b"", b"\x89HDF\r\n\x1a\n", b"CDF\x01", b"PK\x03\x04"]))
        stream.truncate(draw.choice([5 * 10**9, 10**12]))


def deep_key(path: Path, draw: random.Random) -> None:
    dot = draw.choice([".", " . ", '."a.b".', ".'x'."])
    path.write_text(dot.join("a" * draw.choice([21, 3000, 60_000])) + " = 1\n", encoding="utf-8")


def deep_value(path: Path, draw: random.Random) -> None:
    opening = draw.choice(["[", "{a = ", "[[", "[\n", "{a.b.c = ", "[{a = "])
    path.write_text("a = " + opening * draw.choice([30, 500, 60_000]), encoding="utf-8")


def many_keys(path: Path, draw: random.Random) -> None:
    line = draw.choice(["a{}=1\n", "[a{}]\n", "[a{}.b.c.d.e.f.g.h]\n", "a{}.b.c.d=1\n", "[[a{}]]\n"])
    path.write_text("".join(line.format(k) for k in range(40_000)), encoding="utf-8")


def long_name(path: Path, draw: random.Random) -> None:
    name = draw.choice("aä\x01") * draw.choice([300, 5000, 200_000])
    text = draw.choice(
        ['case = "vsv"\n"{}" = 1', 'case = "{}"', 'case = "vsv"\ntitle = "{}"', "a = {{{}={}}}"]
    )
    path.write_text(text.format(name, name), encoding="utf-8")


def open_strings(path: Path, draw: random.Random) -> None:
    piece = draw.choice(['"', '"""', "'''", '\\"""', '""""', "'", '"\\', "a='''"])
    path.write_text("a = " + piece * draw.choice([7, 1000, 150_000]), encoding="utf-8")


def declared(path: Path, draw: random.Random) -> None:
    """Write a small file that declares billions of numbers or texts, blocks of them, or dimensions."""
    with netCDF4.Dataset(path, "w") as file:
        side = draw.choice([9000, 40_000, 10**6])
        file.createDimension("time", side)
        file.createDimension("law", draw.choice([side, None]))
        form = draw.choice(["f8", "i1", str, "f4"])
        packed = {} if form is str else {"zlib": True}
        chunks = (64, 64) if draw.random() < 0.5 else None
        file.createVariable(
            draw.choice(["e_x", "time", "other"]), form, ("time", "law"), chunksizes=chunks, **packed
        )
        if form is not str:
            file.variables[next(iter(file.variables))][0, 0] = 1
        file.kind = draw.choice(["sweep", "vsv", "mechanism"])


def noise(path: Path, draw: random.Random) -> None:
    beginning = draw.choice([b"", b"\x89HDF\r\n\x1a\n", b"CDF\x01", b"CDF\x05", b"PK\x03\x04", b"[a]\n"])
    path.write_bytes(beginning + draw.randbytes(draw.choice([1, 100, 10_000])))


def packed_zeros(path: Path, draw: random.Random) -> None:
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr(draw.choice(["facts.npy", "main.xml", "depth.npy"]), bytes(50_000_000))


def commas(path: Path, draw: random.Random) -> None:
    path.write_bytes(
        draw.choice([b",", b"\n", b"1,", b"1\n", b"#", b";"]) * draw.choice([10, 10**6, 2 * 10**7])
    )


def far_point(path: Path, draw: random.Random) -> None:
    last = draw.choice([4e7, 1e12, 1e300])
    rows = [*(f"{k},0" for k in range(50)), f"{last},1"]
    path.write_text("x [um],h [um]\n" + "\n".join(rows), encoding="utf-8")


ANY: list[Maker] = [pipe, device, linked_pipe, folder, nowhere, sparse, noise, packed_zeros]
TABLES: list[Maker] = [deep_key, deep_value, many_keys, long_name, open_strings]
READERS: dict[str, tuple[list[Maker], str, list[list[str]]]] = {
    "case": (
        [*ANY, *TABLES, *TABLES],
        "case.toml",
        [["check", "{}"], ["show", "{}"], ["run", "{}", "--quiet"]],
    ),
    "scan": (
        [*ANY, commas, far_point],
        "scan.csv",
        [["surface", "{}", "--quiet"], ["surface", "{}", "--quiet", "--unit", "um"]],
    ),
    "array": (ANY, "scan.npy", [["surface", "{}", "--quiet", "--unit", "um", "--spacing", "1 um"]]),
    "result": ([*ANY, declared, declared], "result.nc", [["report", "{..}"], ["compare", "{..}", "{..}"]]),
    "sweep": ([*ANY, declared, declared], "sweep.nc", [["report", "{..}"]]),
    "checkpoint": (
        [pipe, device, linked_pipe, sparse, noise, packed_zeros],
        "checkpoint.npz",
        [["run", "vsv", "--set", "wear.cycles=5", "-o", "{..}", "--quiet"]],
    ),
}


# In parts, each a test: what takes an hour shows how far it is.
@pytest.mark.parametrize(
    ("part", "count"),
    [(-1, FEW), *(pytest.param(part, EACH, marks=pytest.mark.long(minutes=2.2)) for part in range(PARTS))],
)
def test_hostile_files_are_refused(part: int, count: int, tmp_path: Path, process: Watched) -> None:
    draw = random.Random(part)
    found = []
    for number in range(count):
        makers, name, commands = READERS[draw.choice(sorted(READERS))]
        place = tmp_path / str(number)
        place.mkdir()
        maker = draw.choice(makers)
        maker(place / name, draw)
        texts = [
            text.replace("{..}", str(place)).replace("{}", str(place / name))
            for text in draw.choice(commands)
        ]
        outcome = process.run(texts)
        found.append((maker.__name__, texts[0], outcome))
        shutil.rmtree(place)
    print(
        "worst:", max(one.seconds for *_, one in found), "s,", max(one.megabytes for *_, one in found), "MB"
    )
    bad = [entry for entry in found if entry[2].status != 2 or not tolerable(entry[2])]
    assert not bad, bad[:5]


@pytest.mark.parametrize("length", [2_000_000, pytest.param(20_000_000, marks=pytest.mark.long(minutes=0.8))])
def test_texts_of_megabytes_are_refused_early(length: int, tmp_path: Path, process: Watched) -> None:
    for content in (b"1\n", b"1,", b",", b"#", b"\n", b"a\n"):
        (tmp_path / "scan.csv").write_bytes(content * length)
        outcome = process.run(["surface", str(tmp_path / "scan.csv"), "--quiet"])
        assert outcome.status == 2
        assert tolerable(outcome), (content, outcome)


@pytest.mark.parametrize(
    "text",
    [
        'title = "' + "a." * 100 + '"',
        "# " + "[" * 500 + "\ncase = 1",
        "t = '''" + "[.\n" * 100 + "''''",
        't = """' + 'a."b""[{.\\"' * 30 + '"""""',
        "a = [" + "1.5, 2.5,\n" * 100 + "]",
        "a = 1.5\n" * 1 + "\n".join(f"k{i} = 1.5" for i in range(100)),
    ],
)
def test_dots_and_brackets_in_texts_and_comments_are_no_depth(text: str) -> None:
    assert files.parse(text)


@pytest.mark.parametrize(
    "text",
    [
        ".".join("a" * 3000) + " = 1",
        "'[' = 1\n[" + ".".join("a" * 30) + "]",
        't = """\\""""\n' + "b = " + "[" * 30,
        "t = '''it''s'''\nb = " + "{a = " * 30,
        '"#" = 1\n' + " . ".join("a" * 30) + " = 1",
    ],
)
def test_depth_outside_of_texts_is_seen(text: str) -> None:
    with pytest.raises(ValueError, match="nested too deeply"):
        files.parse(text)


@pytest.mark.parametrize(
    ("path", "value", "hint"),
    [
        ("surfaces.trunnion.young_modulus", 210e9, '"210 GPa"'),
        ("joint.clearance", 20e-6, '"20 um"'),
        ("joint.clearance", 25, '"25 um"'),
        ("drive.start_angle", -16.0, '"-16.0 deg"'),
    ],
)
def test_a_number_without_unit_is_shown_in_the_unit_that_was_meant(path, value, hint):
    with pytest.raises(InputError) as caught:
        load_case("vsv").replace({path: value})
    assert f"= {hint}" in str(caught.value)


COMMAND = [sys.executable, "-m", "tribodyn", "check"]


def test_the_status_of_bad_input_survives_a_full_stderr() -> None:
    with Path("/dev/full").open("w", encoding="ascii") as full:
        assert subprocess.run([*COMMAND, "nosuch"], stderr=full).returncode == 2


def test_a_micro_sign_is_read_where_the_terminal_has_no_encoding() -> None:
    plain = os.environ | {"LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0"}
    assert subprocess.run([*COMMAND, "vsv", "--set", "title=5 µm"], env=plain).returncode == 0
    arguments = [*map(os.fsencode, [*COMMAND, "vsv", "--set"]), b"title=5 \xb5m"]
    done = subprocess.run(arguments, env=plain, capture_output=True)
    assert done.returncode == 2
    assert b"these bytes are no text" in done.stderr


def test_a_summary_that_is_none_is_computed_again(tmp_path: Path) -> None:
    from tribodyn.results.schema import is_summary

    good = {"title": "", "status": "complete", "failure": "", "warnings": ["odd"], "steps": 3}
    assert is_summary(good)
    for wrong in (
        [],
        {},
        {"status": 1},
        good | {"steps": None},
        good | {"steps": [1]},
        good | {"warnings": "odd"},
    ):
        assert not is_summary(json.loads(json.dumps(wrong)))


def test_a_result_of_points_that_never_ends_is_refused(tmp_path: Path) -> None:
    place = tmp_path / "points" / "one"
    place.mkdir(parents=True)
    os.mkfifo(place / "result.nc")
    (tmp_path / "sweep.nc").write_bytes(b"")
    assert main(["report", str(tmp_path), "--points"]) == 2


def test_a_file_that_grows_while_it_is_read_is_not_read_on(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "file"
    path.write_bytes(b"x" * 11)
    small = os.stat_result((0o100644, 0, 0, 1, 0, 0, 5, 0, 0, 0))
    monkeypatch.setattr(os, "stat", lambda *_, **__: small)
    monkeypatch.setattr(os, "fstat", lambda _: small)
    with pytest.raises(OSError, match="grows while it is read"):
        read_regular(path, 10)


def test_names_that_are_right_are_compared_with_no_others(monkeypatch: pytest.MonkeyPatch) -> None:
    # For each body of a chain all others were searched for similar names: 1,000 bodies took ten seconds.
    looked: list[str] = []
    monkeypatch.setattr(difflib, "get_close_matches", lambda word, *_, **__: looked.append(word) or [])
    drawing = Mechanism("Chain", run={"duration": "1 s"})
    for k in range(30):
        body = f"link-{k}"
        drawing.body(body, mass="1 kg", centre=f"{k}, 0, 0 m", inertia="0.1, 0.1, 0.1 kg m^2")
        before = f"link-{k - 1}" if k else "ground"
        drawing.revolute(f"pin-{k}", before, body, point=f"{k - 0.5}, 0, 0 m", axis=[0, 0, 1])
    assert len(drawing.case().bodies) == 30
    assert looked == []
