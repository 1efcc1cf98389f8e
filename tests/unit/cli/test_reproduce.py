from __future__ import annotations

import json

import pytest
import xarray as xr

from tribodyn.cli.main import main


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


VERDICTS = {
    **dict.fromkeys(
        ("dry KE grows", "dry KE rebounds further", "dry KE penetrates", "dry KE force"), "contradicted"
    ),
    **dict.fromkeys(("oil film falls", "oil first contact", "stable at reversals"), "contradicted"),
    **dict.fromkeys(("oscillation above 30 µm", "rigid force smaller", "φ_y by adjustment"), "contradicted"),
    "Y velocities opposite, impacts": "contradicted",
    "Y velocities opposite, smooth motion": "contradicted",
    **dict.fromkeys(("F_cx larger, whole", "damping ensures stability, other loads"), "contradicted"),
    **dict.fromkeys(("F_cy negative", "F_cy negative, whole", "Y velocities differ"), "differs"),
    **dict.fromkeys(("zone forward", "zone reverse", "contact at the edges", "wear ratio"), "differs"),
    "damping at 90°": "differs",
    "wear depth, 40 µm": "on a condition",
    **{f"speed error, {at} µm": "not decidable" for at in (20, 40)},
    "surface contact more accurate": "not tested",
    **{f"angle error of all joints, {at} µm": "not tested" for at in (20, 40)},
    **{f"factor of all joints, {at} µm": "not tested" for at in (20, 40)},
    **{f"speed error of all joints, {at} µm": "not tested" for at in (20, 40)},
}
"""What is not simply reproduced in the formulation ``paper``."""
EXACT = {
    **{f"angle error of all joints, {at} µm": "on a condition" for at in (20, 40)},
    **{f"factor of all joints, {at} µm": "on a condition" for at in (20, 40)},
    **{f"speed error of all joints, {at} µm": "not decidable" for at in (20, 40)},
    "damping ensures stability, other loads": "reproduced",
    "φ_x positive, whole": "contradicted",
    "undamped diverges, moment": "contradicted",
    "undamped diverges, traction": "contradicted",
}
"""What ``exact`` makes of some."""


@pytest.mark.long
def test_everything_is_reproduced(tmp_path, capsys):
    assert main(["reproduce", "-o", str(tmp_path), "--json", "--quiet"]) == 0
    rows = json.loads(capsys.readouterr().out)
    found = {row["claim"]: row["verdict"] for row in rows}
    assert found == {row["claim"]: VERDICTS.get(row["claim"], "reproduced") for row in rows}
    exact = {row["claim"]: row["exact_verdict"] for row in rows}
    assert {name: exact[name] for name in EXACT} == EXACT
    assert {row["bound_chosen_by"] for row in rows} == {"the paper", "we"}
    counts = json.loads((tmp_path / "counts.json").read_text(encoding="utf-8"))
    assert (counts["rows"], counts["sentences"]) == (len(rows), 66)
    assert counts["by_row"]["paper"]["reproduced"] == len(rows) - len(VERDICTS)
    assert (tmp_path / "claims.md").exists()
    assert len(list(tmp_path.glob("fig*.png"))) == len(list(tmp_path.glob("fig*.nc"))) >= 9
