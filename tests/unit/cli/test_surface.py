import json
import tomllib
from pathlib import Path

import pytest

import tribodyn as td
from tribodyn.cli.main import main
from tribodyn.surfaces import SelfAffine, generate, write_text
from tribodyn.surfaces.parameters import PARAMETERS

SHORT = "6 um"


@pytest.fixture
def scan(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A file of a generated surface in the current directory."""
    monkeypatch.chdir(tmp_path)
    write_text(generate(SelfAffine(1e-6, 0.8, 24e-6, 8e-6), (96, 128), 1e-6, 1), tmp_path / "scan.csv")
    return tmp_path / "scan.csv"


def test_numbers_are_printed_and_nothing_is_written(scan: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["surface", "scan.csv", "--short-cutoff", SHORT]) == 0
    out, err = capsys.readouterr()
    assert "warning" not in err
    for parameter in PARAMETERS.values():
        assert (parameter.label in out) == (parameter.of_maps in (None, True))
    assert "[asperities]" in out
    assert "depend on the wavelengths" in out
    assert list(scan.parent.iterdir()) == [scan]


def test_a_directory_gets_numbers_figure_and_block(scan: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["surface", "scan.csv", "--short-cutoff", SHORT, "-o", "out"]) == 0
    assert "look at out" in capsys.readouterr().out
    out = scan.parent / "out"
    files = sorted(str(path.relative_to(out)) for path in out.rglob("*") if path.is_file())
    assert files == ["asperities.toml", "figures/surface.png", "surface.json"]
    stored = json.loads((out / "surface.json").read_text())
    assert stored["file"] == "scan.csv"
    assert stored["short_cutoff_um"] == pytest.approx(6.0)
    assert stored["long_cutoff_um"] is None
    assert len(stored["cutoffs"]) > 5
    block = tomllib.loads((out / "asperities.toml").read_text())
    assert set(block) == {"asperities", "surfaces"}


def test_the_block_is_what_a_case_takes_from_the_file(scan: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["surface", "scan.csv", "--short-cutoff", SHORT, "-o", "out", "--quiet"]) == 0
    block = (scan.parent / "out" / "asperities.toml").read_text()
    (scan.parent / "mine.toml").write_text(f'case = "vsv"\n{block}')
    direct = {"asperities.surface": "scan.csv", "asperities.short_cutoff": SHORT}
    assert td.load_case("mine.toml") == td.load_case("vsv").replace(direct)
    assert main(["check", "mine.toml"]) == 0


def test_level_filter_and_cut_offs_are_used(scan: Path, capsys: pytest.CaptureFixture[str]) -> None:
    def sigma(*options: str) -> float:
        assert main(["surface", "scan.csv", "--json", *options]) == 0
        return float(json.loads(capsys.readouterr().out)["sigma_um"])

    whole = sigma()
    assert sigma("--long-cutoff", "40 um") < 0.95 * whole
    assert sigma("--level", "quadratic") < whole
    assert sigma("--long-cutoff", "40 um", "--filter", "spectral") != sigma("--long-cutoff", "40 um")
