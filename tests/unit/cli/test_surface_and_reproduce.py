"""The commands ``surface`` and ``reproduce``."""

import json
import tomllib
from pathlib import Path

import pytest
import xarray as xr

import tribodyn as td
from tribodyn.cli.main import main
from tribodyn.papers.cheng_2022.claims import CLAIMS, kept_rows, summary
from tribodyn.papers.cheng_2022.claims.base import SLOW
from tribodyn.papers.cheng_2022.claims.ensemble import FILE, kept
from tribodyn.papers.cheng_2022.claims.measured import work
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


def test_one_run_gives_its_figures_with_their_data(tmp_path, capsys):
    assert main(["reproduce", "fig13", "fig10", "-o", str(tmp_path), "--quiet"]) == 0
    assert sorted(path.name for path in tmp_path.iterdir()) == [
        "fig10.nc",
        "fig10.png",
        "fig13.nc",
        "fig13.png",
    ]
    with xr.open_dataset(tmp_path / "fig13.nc", engine="netcdf4") as data:
        assert set(data.data_vars) >= {"e_x", "e_y", "phi_x", "phi_y"}
        assert data["e_x"].attrs["units"] == "m"
        assert data.attrs["formulation"] == "paper"


@pytest.mark.parametrize(
    ("arguments", "key"),
    [(["fig7"], "WHAT"), (["claim"], "WHAT"), (["fig10", "--formulation", "best"], "--formulation")],
)
def test_what_does_not_exist_is_refused(arguments, key, tmp_path, capsys):
    target = tmp_path / "out"
    assert main(["reproduce", *arguments, "-o", str(target)]) == 2
    message = capsys.readouterr().err
    assert key in message
    assert "allowed" in message
    assert not target.exists()


def test_an_ensemble_goes_on_from_what_a_folder_has(tmp_path, capsys):
    for member, slow in work():
        piece = {"numbers": {}, "texts": {}}
        for claim in CLAIMS:
            for name, found in kept().get(claim.name, {}).items():
                if (claim.leave == SLOW) == slow:
                    row = found["numbers"][str(member)]
                    piece["numbers"].setdefault(claim.name, {})[name] = row
                    piece["texts"].setdefault(claim.name, {})[name] = found["text"]
        name = f"member-{member}{'-slow' if slow else ''}.json"
        (tmp_path / name).write_text(json.dumps(piece), encoding="utf-8")
    assert main(["reproduce", "ensemble", "-o", str(tmp_path), "--quiet"]) == 0
    assert json.loads((tmp_path / FILE).read_text(encoding="utf-8")) == kept()


@pytest.mark.long
def test_everything_is_reproduced(tmp_path, capsys):
    assert main(["reproduce", "-o", str(tmp_path), "--json", "--quiet"]) == 0
    rows = json.loads(capsys.readouterr().out)
    kept = {row.claim.name: row for row in kept_rows(CLAIMS)}
    # Runs of this machine say what the kept ones say, digits apart.
    for row in rows:
        assert row["verdict"] == kept[row["claim"]].verdict("paper")
        assert set(row["found"]) == set(kept[row["claim"]].findings)
    assert {row["bound_chosen_by"] for row in rows} == {"the paper", "we"}
    counts = json.loads((tmp_path / "counts.json").read_text(encoding="utf-8"))
    assert counts == summary.summarise(list(kept.values()))
    assert (tmp_path / "claims.md").exists()
    assert len(list(tmp_path.glob("fig*.png"))) == len(list(tmp_path.glob("fig*.nc"))) >= 9
