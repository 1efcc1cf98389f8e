"""The search for a limit, around a simulation whose force is proportional to the clearance."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import tribodyn as td
from tribodyn.cli.main import main
from tribodyn.core.errors import InputError, TribodynError
from tribodyn.studies.search import Limit, limit, question

FIND = ["find", "vsv", "--vary", "joint.clearance=10..29 um", "--until"]


def test_the_limit_is_found_where_it_is(simulated: list[Any]) -> None:
    # The largest force of the made-up simulation is 100 N for each micrometre, rounded to whole ones.
    asked = ("vsv", "joint.clearance", "10..29 um")
    found = td.studies.find(*asked, "contact_force_max_N=2250", within=0.001)
    assert found == pytest.approx(22.5e-6, abs=0.1e-6)
    assert found <= 22.5e-6
    least = td.studies.find(*asked, "contact_force_max_N>=2250", within=0.001)
    assert 22.5e-6 <= least == pytest.approx(22.5e-6, abs=0.1e-6)
    assert len(simulated) < 30


def test_a_limit_may_be_a_change_against_the_case_as_it_is(simulated, tmp_path, capsys):
    # The built-in case has 20 um, so 2000 N: a quarter less is 1500 N.
    found = td.studies.find("vsv", "joint.clearance", "10..29 um", "contact_force_max_N=-25 %", within=0.001)
    assert found == pytest.approx(15e-6, abs=0.1e-6)
    assert found <= 15e-6
    assert main([*FIND, "contact_force_max_N>=+10%", "-o", str(tmp_path)]) == 0
    assert "Contact force, peak: at least 2200 N at joint.clearance = 22" in capsys.readouterr().out
    with pytest.raises(InputError, match=r"allowed: NAME=NUMBER, such as tilt_max_mrad=2$"):
        limit("contact_force_max_N=5 %", td.load_case("vsv"), "--limit", least=False)


def test_a_limit_outside_the_range_says_what_is_there(simulated: list[Any]) -> None:
    with pytest.raises(TribodynError, match="1000 at 10 um and 2900 at 29 um: it does not pass 5000"):
        td.studies.find("vsv", "joint.clearance", "10..29 um", "contact_force_max_N=5000")
    with pytest.raises(TribodynError, match="a run of the search failed: steps became too small"):
        td.studies.find("vsv", "joint.clearance", "10..30 um", "contact_force_max_N=2000")


def test_a_component_of_a_vector_is_asked_for_by_its_name() -> None:
    asked = question(
        td.load_case("slider-crank"), "gravity.z", "-10..-9 m/s^2", Limit("energy_residual", 0.1)
    )
    assert (asked.key.path, asked.low, asked.high) == ("gravity.z", -10.0, -9.0)


def test_a_number_of_a_joint_is_asked_for_by_its_name() -> None:
    crank = td.load_case("slider-crank")
    until = limit("offset_max_um_wrist=30", crank, "--until")
    asked = question(crank, "joints.wrist.clearance.radial", "20..60 um", until)
    assert asked.key_result.label == "Offset, peak, wrist"
    with pytest.raises(InputError, match=r"nearest of .*: offset_max_um_wrist"):
        limit("offset_max_um_wrisd=30", crank, "--until")


def test_the_one_taken_of_several_numbers_is_named() -> None:
    crank = td.load_case("slider-crank")
    until = limit("sustained_N=30", crank, "--until")
    assert until.name == "joint_force_sustained_N"
    assert {"force_sustained_N_wrist", "force_sustained_N_crankpin"} <= {*until.others}
    assert limit("error_max_um_slider=30", crank, "--until").others == ()


def test_the_command_prints_the_answer(simulated, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert main([*FIND, "contact_max_N=2250"]) == 0  # a part of the name will do
    out, err = capsys.readouterr()
    assert "contact_force_max_N is taken" not in err
    assert "Contact force, peak: at most 2250 N at joint.clearance = 22." in out
    assert float(out.split("where it is ")[1].split(" N")[0]) <= 2250.0
    low, high = (
        float(word) for word in out.split("between ")[1].replace(" um", "").split(";")[0].split(" and ")
    )
    assert low <= 22.5 <= high
    assert td.read("find-vsv/sweep.nc").sizes["joint.clearance"] > 3


def test_shares_come_with_their_interval(simulated: list[Any]) -> None:
    vary = {"joint.clearance": "uniform(10 um, 20 um)"}
    swept = td.studies.sweep("vsv", vary, samples=10, workers=0)
    (share,) = td.studies.shares(swept, {"contact_force_max_N": 1799.0}).values()
    assert (share.within, share.points) == (8, 10)
    # Wilson 1927 for 8 of 10: (8.192 ± 1.96·1.3985)/13.84 + 1.92/13.84 = 0.490 to 0.943.
    assert (share.low, share.high) == pytest.approx((0.490, 0.943), abs=1e-3)


@pytest.mark.parametrize(
    ("number", "first", "total"),
    [
        # Variances of 3x and y are 9/12 and 1/12; that of xy is 7/144, of which 1/48 is x's or y's alone.
        (lambda x, y: 3.0 * x + y, (0.9, 0.1), (0.9, 0.1)),
        (lambda x, y: x * y, (3 / 7, 3 / 7), (4 / 7, 4 / 7)),
    ],
)
def test_indices_are_those_of_known_functions(number: Any, first: Any, total: Any) -> None:
    import json

    import xarray as xr

    x, y = td.studies.SAMPLERS["saltelli"](1024, 2, 1).T
    swept = xr.Dataset(
        {"z": ("point", number(x, y)), "same": ("point", np.ones(x.size))},
        attrs={"varied": json.dumps(["x", "y"]), "sampling_method": "saltelli"},
    )
    found = td.studies.sensitivities(swept, resamples=99)
    assert list(found) == ["z"]
    for index, alone, in_all in zip(found["z"].values(), first, total, strict=True):
        # Quasi-random points of 1024: three times the bootstrap's half width is far from what an error makes.
        assert index.first == pytest.approx(alone, abs=3.0 * index.first_error)
        assert index.total == pytest.approx(in_all, abs=3.0 * index.total_error)
        assert index.total_error < 0.1


def test_a_sweep_for_sensitivities(simulated, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    two = ["--vary", "joint.clearance=uniform(10 um, 29 um)", "--vary", "joint.radius=uniform(5 mm, 6 mm)"]
    pictures = ["--no-figures", "--no-report", "--workers", "0"]
    command = ["sweep", "vsv", *two, *pictures, "--method", "saltelli", "--limit", "contact_force_max_N=2000"]
    assert main([*command, "--samples", "8"]) == 0
    assert len(simulated) == 8 * 4
    out = capsys.readouterr().out
    assert "Contact force, peak: at most 2000 N at " in out
    assert " of 32 points, " in out
    (clearance,) = (line for line in out.splitlines() if line.startswith("  joint.clearance "))
    (radius,) = (line for line in out.splitlines() if line.startswith("  joint.radius "))
    assert radius.split()[1] == "0.00"  # the made-up force does not depend on it
    assert float(clearance.split()[1]) > 0.1
    assert main([*command, "--samples", "6"]) == 2
    assert "power of two" in capsys.readouterr().err


def test_a_second_search_goes_on_with_what_is_there(simulated: list[Any], tmp_path: Path) -> None:
    asked = ("vsv", "joint.clearance", "10..29 um", "contact_force_max_N=2250")
    first = td.studies.find(*asked, directory=tmp_path)
    count = len(simulated)
    assert td.studies.find(*asked, directory=tmp_path) == first
    assert len(simulated) == count
    td.studies.find(*asked, directory=tmp_path, within=0.001)
    assert len(simulated) > count


def test_a_key_result_that_no_run_gives_is_named(
    simulated: list[Any], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(TribodynError, match="no run has error_max_um_vane"):
        td.studies.find("vsv", "joint.clearance", "10..29 um", "error_max_um_vane=1000")
    sweep = ["sweep", "vsv", "--vary", "joint.clearance=10,20 um", "--summary-only", "--workers", "0"]
    for option in ("--limit=error_max_um_vane=1000", "--show=error_max_um_vane"):
        assert main([*sweep, option, "-o", str(tmp_path / option[2:6])]) == 1
        assert "no run has error_max_um_vane" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("path", "between", "until", "hint"),
    [
        ("joint.clearence", "10..60 um", "tilt_max_mrad=1", "joint.clearance"),
        ("joint.clearance", "10:60 um", "tilt_max_mrad=1", "10..60 um"),
        ("joint.clearance", "60..10 um", "tilt_max_mrad=1", "upwards"),
        ("joint.clearance", "10..60 kg", "tilt_max_mrad=1", "length"),
        ("contact.law", "ke..rsdc", "tilt_max_mrad=1", "a range"),
        ("joint.clearance", "10..60 um", "tilt_max_mrad", "NAME=NUMBER"),
        ("joint.clearance", "10..60 um", "tilt_max_rad=1", "nearest of .*: tilt_max_mrad"),
    ],
)
def test_wrong_questions_are_refused(path: str, between: str, until: str, hint: str) -> None:
    with pytest.raises(InputError, match=hint):
        td.studies.find("vsv", path, between, until)
