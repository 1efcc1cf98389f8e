"""Scans that cannot be measured: one clear message each, which names the file and what to change."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from tribodyn.cli.main import main
from tribodyn.surfaces import Scan, SelfAffine, generate, write_text

Rows = list[str]
HEAD = "# unit: um\n# spacing: 1 um\n"


def rows(count: int = 48, width: int = 48) -> Rows:
    heights = generate(SelfAffine(1e-6, 0.8, 24e-6, 8e-6), (count, width), 1e-6, 1).heights * 1e6
    return [",".join(f"{value:.6f}" for value in row) for row in heights]


def text(lines: Rows, head: str = HEAD) -> bytes:
    return (head + "\n".join(lines) + "\n").encode()


def with_field(lines: Rows, row: int, field: str) -> Rows:
    return [f"{field},{line.partition(',')[2]}" if k == row else line for k, line in enumerate(lines)]


def profile(points: int = 100) -> Rows:
    return [f"{k},{np.sin(k):.4f}" for k in range(points)]


def holes(share: float) -> Rows:
    keep = np.random.default_rng(1).random((48, 48)) >= share
    return [
        ",".join(value if known else "" for value, known in zip(line.split(","), kept, strict=True))
        for line, kept in zip(rows(), keep, strict=True)
    ]


def stepped(along: str) -> Rows:
    heights = np.array([[float(value) for value in line.split(",")] for line in rows(64, 64)])
    if along == "x":
        heights[:, 30:] += 25.0
    else:
        heights[41:] -= 25.0
    return [",".join(f"{value:.6f}" for value in row) for row in heights]


TEXTS = {
    "empty": (b"", "the file is empty"),
    "only a head": (HEAD.encode(), "no heights"),
    "only blank lines": (b"\n\n \n", "no heights"),
    "binary": (b"\x00\x01\x02" * 100, "binary file"),
    "not UTF-8": (b"\xff\xfe1,2\n", "not UTF-8 text (byte 0, line 1)"),
    "words": (text(["one,two", "three,four", "five,six"]), "there are no heights"),
    "a word among numbers": (text(with_field(rows(), 9, "high")), 'line 12: given "high"'),
    "an expression": (text(with_field(rows(), 9, "__import__('os')")), "line 12"),
    "digits with underscores": (text(with_field(rows(), 9, "1_000")), "line 12"),
    "infinity": (text(with_field(rows(), 9, "inf")), 'line 12: given "inf"'),
    "overflow": (text(with_field(rows(), 9, "1e999")), "is their unit right"),
    "two rows": (text(["1,5;2,5", "1,7;2,1"]), "2 x 2 heights are too few"),
    "truncated line": (text([*rows()[:-1], "0.1,0.2"]), "line 50 has 2 fields where 48 are needed"),
    "ragged": (text([*rows()[:5], rows()[5] + ",1", *rows()[6:]]), "line 8 has 49 fields"),
    "no unit": (text(rows(), "# spacing: 1 um\n"), "# unit: um"),
    "no spacing": (text(rows(), "# unit: um\n"), "# spacing: 0.5 um"),
    "wrong unit": (text(rows(), "# unit: kg\n# spacing: 1 um\n"), "'kg' is not a unit of length"),
    "unknown unit": (text(rows(), "# unit: parsnips\n# spacing: 1 um\n"), "parsnips"),
    "unit as an expression": (text(rows(), "# unit: (1).__class__\n# spacing: 1 um\n"), "length"),
    "spacing without a unit": (text(rows(), "# unit: um\n# spacing: 1\n"), "the unit is missing"),
    "no spacing at all": (text(rows(), "# unit: um\n# spacing: 0 um\n"), "lengths above zero"),
    "negative spacing": (text(rows(), "# unit: um\n# spacing: -1 um\n"), "lengths above zero"),
    "three spacings": (text(rows(), "# unit: um\n# spacing: 1 um, 1 um, 1 um\n"), "one length, or two"),
    "heights in metres": (text(rows(), "# unit: m\n# spacing: 1 um\n"), "is their unit right"),
    "spacing in metres": (text(rows(), "# unit: um\n# spacing: 1 m\n"), "unit of the spacing"),
    "heights far steeper than spacing": (text(rows(), "# unit: mm\n# spacing: 1 um\n"), "the mean slope is"),
    "one number": (text(["1"]), "1 heights are too few"),
    "one short line": (text([rows()[0][:60].rpartition(",")[0]]), "too few"),
    "a narrow map": (text(rows()[:5]), "cut out one line and give it as a profile"),
    "nothing but missing": (text([",".join(["nan"] * 48)] * 48), "no height in this file"),
    "many holes": (text(holes(0.2)), "% of the heights are missing"),
    "flat": (text([",".join(["1.5"] * 48)] * 48), "all heights are equal"),
    "digitised": (
        text([",".join(f"{round(float(v))}" for v in line.split(",")) for line in rows()]),
        "different heights",
    ),
    "a mark for missing heights": (text(with_field(rows(), 9, "-9999")), "at point (10, 1)"),
    "a step across": (text(stepped("x")), "um at x = 0.0295 mm"),
    "a step along": (text(stepped("y")), "at y = 0.0405 mm"),
    "x goes back": (text([*profile(50), *profile(50)], "x [um],h [um]\n"), "grows from point to point"),
    "x stands still": (text([*profile(50), "49,1"], "x [um],h [um]\n"), "at point 51 of 51"),
    "x is missing": (text([*profile(50), ",1"], "x [um],h [um]\n"), "grows from point to point"),
    "unequal steps": (
        text([f"{k**1.2},{np.sin(k)}" for k in range(100)], "x [um],h [um]\n"),
        "resample the profile",
    ),
    "one far point": (text([*profile(100), "1e12,1"], "x [um],h [um]\n"), "unequal steps"),
    "columns without units": (text(profile(), "x,h\n"), "x: the unit of x is missing"),
    "a third column": (
        text(["1,2,3"] * 40, "x [um],h [um],t [s]\n"),
        'given the header "x [um],h [um],t [s]"',
    ),
    "spacing beside columns": (text(profile(), "# spacing: 1 um\nx [um],h [um]\n"), "leave it out"),
}


@pytest.fixture
def refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> Callable[..., str]:
    """Run ``tribodyn surface``, which must refuse, and return its message."""
    monkeypatch.chdir(tmp_path)

    def run(*arguments: str) -> str:
        before = sorted(tmp_path.rglob("*"))
        assert main(["surface", *arguments, "-o", "out"]) == 2
        assert sorted(tmp_path.rglob("*")) == before
        out, err = capsys.readouterr()
        assert out == ""
        assert err.startswith("tribodyn: ")
        assert err.count("\n") == 1
        assert err[:-1].isprintable()
        return err

    return run


@pytest.mark.parametrize("name", TEXTS)
def test_text_that_is_no_surface(name: str, refused: Callable[..., str], tmp_path: Path) -> None:
    content, said = TEXTS[name]
    (tmp_path / "scan.csv").write_bytes(content)
    message = refused("scan.csv")
    assert said in message
    assert "scan.csv" in message or "--" in message


@pytest.mark.parametrize("ending", ["nc", "npy", "txt", "hgt", ""])
@pytest.mark.parametrize(
    "content", [b"", b"\x00" * 512, b"CDF\x01" + b"\xff" * 100, b"PK\x03\x04broken", b"word\n"]
)
def test_files_in_no_format(ending: str, content: bytes, refused: Callable[..., str], tmp_path: Path) -> None:
    (tmp_path / f"scan.{ending}").write_bytes(content)
    assert f"scan.{ending}" in refused(f"scan.{ending}", "--unit", "um", "--spacing", "1 um")


def test_a_truncated_array(refused: Callable[..., str], tmp_path: Path) -> None:
    np.save(tmp_path / "scan.npy", np.random.default_rng(1).random((64, 64)))
    whole = (tmp_path / "scan.npy").read_bytes()
    (tmp_path / "scan.npy").write_bytes(whole[: len(whole) // 2])
    assert "cannot be read" in refused("scan.npy", "--unit", "um", "--spacing", "1 um")


def test_an_array_that_runs_code_is_not_opened(refused: Callable[..., str], tmp_path: Path) -> None:
    class Trap:
        def __reduce__(self) -> tuple[object, tuple[str]]:
            return (Path.touch, (tmp_path / "trap",))

    np.save(tmp_path / "scan.npy", np.array([[Trap()]], dtype=object), allow_pickle=True)
    refused("scan.npy", "--unit", "um", "--spacing", "1 um")
    assert not (tmp_path / "trap").exists()


@pytest.mark.parametrize("shape", [(0,), (3, 4, 5), (1, 1)])
def test_arrays_of_another_kind(shape: tuple[int, ...], refused: Callable[..., str], tmp_path: Path) -> None:
    np.save(tmp_path / "scan.npy", np.ones(shape))
    refused("scan.npy", "--unit", "um", "--spacing", "1 um")


def test_files_that_are_none(refused: Callable[..., str], tmp_path: Path) -> None:
    assert "no such file" in refused("scan.csv")
    assert "directory" in refused(".")
    assert "device" in refused("/dev/zero")
    assert "no such file" in refused("n" * 5000)
    assert "no such file" in refused("a\0b")


def test_huge_scans(refused: Callable[..., str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "scan.csv").write_bytes(text(rows()))
    monkeypatch.setattr("tribodyn.surfaces.read.LARGEST_FILE", 1000)
    assert "larger than 1 kB" in refused("scan.csv")
    monkeypatch.undo()
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("tribodyn.surfaces.table.MOST_POINTS", 1000)
    assert "cut out a part" in refused("scan.csv")
    monkeypatch.setattr("tribodyn.surfaces.read.MOST_POINTS", 1000)
    np.save(tmp_path / "scan.npy", np.zeros((50, 50)))
    assert "cut out a part" in refused("scan.npy", "--unit", "um", "--spacing", "1 um")


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (["--level", "cubic"], '--level: given "cubic"; allowed: mean, plane, quadratic'),
        (["--filter", "box"], "--filter"),
        (["--short-cutoff", "5"], '--short-cutoff: given "5": the unit is missing'),
        (["--short-cutoff", "5 kg"], "--short-cutoff"),
        (["--short-cutoff", "-5 um"], "--short-cutoff"),
        (["--short-cutoff", "1 um"], "--short-cutoff: given 1 um; the scan holds waves from 2 um"),
        (["--long-cutoff", "1 m"], "--long-cutoff"),
        (["--short-cutoff", "20 um", "--long-cutoff", "10 um"], "--short-cutoff"),
        (["--unit", "um"], "--unit: the file says it itself"),
        (["--spacing", "1 um"], "--spacing: the file says it itself"),
        (["--channel", "two"], "--channel"),
        (["--format", "jpeg"], "--format"),
        (["--modulus", "7 GPa"], "--hardness: the plasticity index needs this too"),
        (["--hardness", "7 GPa"], "--modulus"),
        (["--hardness", "7 GPa", "--modulus", "7 m"], "--modulus"),
        (["--hardness", "0 GPa", "--modulus", "7 GPa"], "--hardness"),
    ],
)
def test_options_that_cannot_be(options, said, refused, tmp_path):
    (tmp_path / "scan.csv").write_bytes(text(rows()))
    assert said in refused("scan.csv", *options)


def test_a_channel_that_is_not_there(refused: Callable[..., str], tmp_path: Path) -> None:
    np.save(tmp_path / "scan.npy", np.random.default_rng(1).random((64, 64)))
    given = ("scan.npy", "--unit", "um", "--spacing", "1 um", "--channel")
    assert "--channel: given 2; channels of heights: 1" in refused(*given, "2")
    refused(*given, "0")


def test_rough_surfaces_with_scratches_and_ridges_are_no_steps(tmp_path: Path) -> None:
    """What looks like a step here and there must not be refused."""
    heights = generate(SelfAffine(1e-6, 0.8, 24e-6, 8e-6), (64, 64), 1e-6, 1).heights.copy()
    heights[:, 20] -= 5e-6
    heights[40:43] += 4e-6
    write_text(Scan(heights, (1e-6, 1e-6)), tmp_path / "scan.csv")
    assert main(["surface", str(tmp_path / "scan.csv"), "--quiet"]) == 0
    saw = 2e-6 * ((np.arange(400) % 25) / 25.0) + 1e-8 * np.sin(np.arange(400) ** 2)
    write_text(Scan(saw, (1e-6,)), tmp_path / "turned.csv")
    assert main(["surface", str(tmp_path / "turned.csv"), "--quiet"]) == 0
