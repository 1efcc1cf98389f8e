"""``tribodyn fit`` from data to the fitted case."""

import json

import numpy as np
import pytest

import tribodyn as td
from tribodyn.cli.main import main

MASS = 0.31
CHANGES = ["--set", "run.duration=1 ms", "--set", "contact.law=ke"]


@pytest.fixture
def data(tmp_path):
    changes = {"run.duration": "1 ms", "contact.law": "ke", "bodies.journal.mass": f"{MASS} kg"}
    run = td.simulate(td.load_case("journal-dry").replace(changes))
    times = np.linspace(1e-4, 9e-4, 30)
    values = np.interp(times, run["time"].values, run["displacement"].values[:, 0, 0]) * 1e6
    path = tmp_path / "run.csv"
    rows = "\n".join(f"{t * 1e3:.6f}, {v:.9f}" for t, v in zip(times, values, strict=True))
    path.write_text(f"time [ms], displacement.bearing.x [um]\n{rows}\n", encoding="utf-8")
    return path


def test_a_mass_is_found_in_a_motion(data, tmp_path, capsys):
    target = tmp_path / "out"
    command = [
        "fit",
        "journal-dry",
        *CHANGES,
        "--data",
        str(data),
        "--vary",
        "bodies.journal.mass=0.1..0.6 kg",
        "--starts",
        "1",
    ]
    assert main([*command, "-o", str(target), "--json", "--quiet"]) == 0
    (key,) = json.loads(capsys.readouterr().out)["keys"]
    assert key["value"] == pytest.approx(MASS, rel=1e-3)
    assert td.load_case(target / "fitted.toml").at("bodies.journal.mass") == pytest.approx(MASS, rel=1e-3)
    assert {path.name for path in target.iterdir()} >= {"fit.md", "fit.json", "residuals.csv"}


@pytest.mark.parametrize(
    ("vary", "message"),
    [
        ("bodies.journal.mass", "PATH=LOW..HIGH"),
        ("bodies.journal.mas=1..2 kg", "bodies.journal.mass"),
        ("bodies.journal.mass=2..1 kg", "upwards"),
    ],
)
def test_keys_without_a_range_are_refused(vary, message, data, tmp_path, capsys):
    target = tmp_path / "out"
    assert main(["fit", "journal-dry", "--data", str(data), "--vary", vary, "-o", str(target)]) == 2
    assert message in capsys.readouterr().err
    assert not target.exists()
