"""Stribeck curves of a case: the shape of what comes out, and what is refused."""

import pytest

import tribodyn as td
from tribodyn.cli.main import main
from tribodyn.core.errors import InputError

OIL = td.load_case("journal-oil").replace({"joints.bearing.clearance.friction_coefficient": 0.1})


def test_a_curve_for_each_viscosity() -> None:
    curves = td.stribeck(OIL, [1.0, 30.0, 1000.0], viscosity=["5 mPa s", "32 cSt at 870 kg/m^3"])
    assert curves["friction_coefficient"].shape == (2, 3)
    assert curves.attrs["viscosity"] == ["5 mPa s", "27.84 mPa s"]
    # Thicker oil carries more of the load at every speed.
    assert (curves["film_share"].diff("viscosity") > 0.0).all()
    shares = curves["film_share"] + curves["contact_share"]
    assert shares.values == pytest.approx(1.0, abs=1e-9)


def test_a_load_is_given_or_that_of_the_case() -> None:
    given = OIL.replace({"loads.y.force": "0 N"})
    wanted = td.stribeck(given, [30.0], viscosity=["5 mPa s"])["friction_coefficient"]
    both = td.load_case("slider-crank-oil").replace({"joints.big-end.clearance.friction_coefficient": 0.1})
    for load in (200.0, "200 N"):
        found = td.stribeck(given, [30.0], joint="bearing", load=load, viscosity=["5 mPa s"])
        assert found["friction_coefficient"].equals(wanted)
    for case, wrong, words in (
        (OIL, {"joint": "crank"}, "bearing"),
        (both, {}, "give one"),
        (OIL.replace({"loads.x.frame": "body"}), {}, "give one"),
    ):
        with pytest.raises(InputError, match=words):
            td.stribeck(case, [30.0], **wrong)


@pytest.mark.parametrize(
    ("case", "words"), [("journal-oil", "friction"), ("journal-dry", "oil"), ("vsv", "oil")]
)
def test_what_has_no_such_curve_is_refused(case: str, words: str) -> None:
    with pytest.raises(InputError, match=words):
        td.stribeck(td.load_case(case))


def test_the_command_prints_it(capsys: pytest.CaptureFixture[str]) -> None:
    friction = ["--set", "joints.bearing.clearance.friction_coefficient=0.1"]
    assert main(["stribeck", "journal-oil", *friction, "--viscosity", "5,10 mPa s", "--points", "2"]) == 0
    out = capsys.readouterr().out
    assert out.count("viscosity") == 2
    assert main(["stribeck", "journal-oil", *friction, "--speed", "9..1 rad/s"]) == 2
