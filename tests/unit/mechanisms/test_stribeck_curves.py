"""Stribeck curves of a case: the shape of what comes out, and what is refused."""

import pytest

import tribodyn as td
from tribodyn.cli.main import main
from tribodyn.core.errors import InputError
from tribodyn.mechanisms.catalogue import parse_case
from tribodyn.presets.journal.case import mechanism_of

OIL = td.load_case("journal-oil").replace({"joint.friction_coefficient": 0.1})


def test_a_curve_for_each_viscosity() -> None:
    curves = td.stribeck(OIL, [1.0, 30.0, 1000.0], viscosity=["5 mPa s", "32 cSt at 870 kg/m^3"])
    assert curves["friction_coefficient"].shape == (2, 3)
    assert curves.attrs["viscosity"] == ["5 mPa s", "27.84 mPa s"]
    # Thicker oil carries more of the load at every speed.
    assert (curves["film_share"].diff("viscosity") > 0.0).all()
    shares = curves["film_share"] + curves["contact_share"]
    assert shares.values == pytest.approx(1.0, abs=1e-9)


def test_a_joint_of_a_mechanism_has_that_of_the_journal_it_is() -> None:
    journal = OIL.replace({"loads.force_y": "0 N"})
    mechanism = parse_case(mechanism_of(journal).to_toml(), "model")
    given = {"joint": "bearing", "load": "200 N", "viscosity": ["5 mPa s"]}
    found = td.stribeck(mechanism, [30.0], **given)
    assert found["friction_coefficient"].equals(
        td.stribeck(journal, [30.0], viscosity=["5 mPa s"])["friction_coefficient"]
    )
    for wrong, words in (({"joint": "crank"}, "bearing"), ({"load": None}, "needs a load")):
        with pytest.raises(InputError, match=words):
            td.stribeck(mechanism, [30.0], **{**given, **wrong})


@pytest.mark.parametrize(
    ("case", "words"), [("journal-oil", "friction"), ("journal-dry", "oil"), ("vsv", "oil")]
)
def test_what_has_no_such_curve_is_refused(case: str, words: str) -> None:
    with pytest.raises(InputError, match=words):
        td.stribeck(td.load_case(case))


def test_the_command_prints_it(capsys: pytest.CaptureFixture[str]) -> None:
    friction = ["--set", "joint.friction_coefficient=0.1"]
    assert main(["stribeck", "journal-oil", *friction, "--viscosity", "5,10 mPa s", "--points", "2"]) == 0
    out = capsys.readouterr().out
    assert out.count("viscosity") == 2
    assert main(["stribeck", "journal-oil", *friction, "--speed", "9..1 rad/s"]) == 2
