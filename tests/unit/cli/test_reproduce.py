import json

import pytest
import xarray as xr

from tribodyn.cli.main import main
from tribodyn.papers.cheng_2022.claims import CLAIMS, kept_rows, summary
from tribodyn.papers.cheng_2022.claims.base import SLOW
from tribodyn.papers.cheng_2022.claims.ensemble import FILE, kept
from tribodyn.papers.cheng_2022.claims.measured import work


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
