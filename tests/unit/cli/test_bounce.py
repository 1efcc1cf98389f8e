from __future__ import annotations

import json

import pytest

from tribodyn.cli.main import main
from tribodyn.contact import DAMPING_FACTORS


def test_shows_every_factor_of_a_law(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["bounce", "vsv", "--law", "linear", "--set", "contact.restitution=0.6"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert [line.split()[1] for line in lines[1:]] == list(DAMPING_FACTORS)
    assert lines[0].split() == ["law", "damping", "factor", "wanted", "point", "plate", "shaft"]
    calibrated = lines[-1].split()
    assert calibrated[2:5] == ["0.6000"] * 3


def test_json_is_one_document(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["bounce", "vsv", "--law", "linear", "--json"]) == 0
    rows = json.loads(capsys.readouterr().out)
    # Without a restitution it is that of the law rsdc, 0.70 at 50 MPa.
    assert {round(row["wanted"], 2) for row in rows} == {0.7}
    assert rows[0]["shaft"] == pytest.approx(1.0, abs=1e-4)


def test_unknown_law_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["bounce", "vsv", "--law", "hertz"]) == 2
    assert "allowed: ke, rsdc" in capsys.readouterr().err
