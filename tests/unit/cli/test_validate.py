"""``tribodyn validate``: sets of the package, and a user's own numbers by the same rules."""

import json

import numpy as np
import pytest

import tribodyn as td
from tribodyn.cli.main import main
from tribodyn.mechanisms.results import summarise

CHANGES = ["--set", "run.duration=2 ms"]
HEADER = "quantity,measured,half_width,accepted,null,source,explanation\n"


@pytest.fixture(scope="module")
def computed():
    run = td.simulate(td.load_case("journal-dry").replace({"run.duration": "2 ms"}))
    return {name: value for name, value in summarise(run).items() if isinstance(value, float) and value > 0.0}


def _judged(tmp_path, capsys, lines, *more):
    path = tmp_path / "mine.csv"
    path.write_text(HEADER + "".join(lines), encoding="utf-8")
    status = main(["validate", str(path), "--against", "journal-dry", *CHANGES, "--json", "--quiet", *more])
    return status, capsys.readouterr()


def test_a_set_prints_every_number_and_writes_its_page(tmp_path, capsys):
    assert main(["validate", "rack_pinion_friction", "-o", str(tmp_path)]) == 0
    told = capsys.readouterr().out
    assert "within the band" in told
    assert "reported only" in told
    names = {"rack_pinion_friction.md", "rack_pinion_friction.png", "validation.json"}
    assert {path.name for path in tmp_path.iterdir()} == names


def test_an_unknown_set_is_refused(tmp_path, capsys):
    assert main(["validate", "rack_pinon_friction", "-o", str(tmp_path / "out")]) == 2
    assert "rack_pinion_friction" in capsys.readouterr().err
    assert not (tmp_path / "out").exists()


def test_bands_of_every_kind_are_judged(tmp_path, capsys, computed):
    name, value = next(iter(computed.items()))
    bands = ("10 %", f"{0.1 * value}", f"{0.9 * value}..{1.1 * value}", "")
    for band in bands:
        for factor, verdict in ((1.05, "within the band"), (1.3, "outside")):
            if ".." in band and verdict == "outside":
                continue
            measured = factor * value
            _, told = _judged(tmp_path, capsys, [f"{name},{measured},{value},{band},,bench,because\n"])
            (row,) = json.loads(told.out)[0]["numbers"]
            assert row["verdict"] == (verdict if band else "reported only")
            assert row["computed"] == pytest.approx(value)
            assert row["explanation"] == ("because" if row["verdict"] == "outside" else "")


def test_assumed_inputs_widen_the_interval(tmp_path, capsys, computed):
    name, value = next(iter(computed.items()))
    line = [f"{name},{value},1,10 %,,bench,\n"]
    _, alone = _judged(tmp_path, capsys, line)
    _, assumed = _judged(tmp_path, capsys, line, "--assume", "loads.x.force=100..400 N")
    narrow, wide = (json.loads(told.out)[0]["numbers"][0]["u_computed"] for told in (alone, assumed))
    assert wide > narrow


def test_the_template_is_a_set(tmp_path, capsys):
    folder = tmp_path / "new"
    assert main(["validate", "--template", str(folder)]) == 0
    assert main(["validate", "--template", str(folder)]) == 2
    assert "already has README.md" in capsys.readouterr().err
    assert (folder / "numbers.csv").read_text(encoding="utf-8").startswith(HEADER)


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ("steps,many,1,10 %,,,\n", "no number"),
        ("steps,3,1,tenfold,,,\n", "10 %, 0.5, 10..20"),
        ("stepz,3,1,10 %,,,\n", "NAME: the run has no"),
        ("steps,3,1,-5 %,,,\n", "10 %, 0.5, 10..20"),
        ("steps,3,1,20..10,,,\n", "10 %, 0.5, 10..20"),
        ("steps,3,-1,10 %,,,\n", "half_width"),
        (",3,1,10 %,,,\n", "has no quantity"),
        ("steps,3,1,10 %,,,\nsteps,4,1,1 %,,,\n", "two rows"),
    ],
)
def test_rows_that_cannot_be_judged_are_refused(line, message, tmp_path, capsys):
    status, told = _judged(tmp_path, capsys, [line])
    assert status == 2
    assert message in told.err


def test_a_file_needs_its_case(tmp_path, capsys):
    path = tmp_path / "mine.csv"
    path.write_text(HEADER, encoding="utf-8")
    assert main(["validate", str(path)]) == 2
    assert "--against" in capsys.readouterr().err


@pytest.fixture
def curve(tmp_path):
    """The computed path of the shaft [um], times 1.02: its range, and the rms of the difference."""
    run = td.simulate(td.load_case("journal-dry").replace({"run.duration": "2 ms"}))
    time, values = run["time"].values[::10], 1e6 * run["displacement"].values[::10, 0, 0]
    rows = "".join(f"{1e3 * t!r},{1.02 * v!r}\n" for t, v in zip(time.tolist(), values.tolist(), strict=True))
    (tmp_path / "run.csv").write_text(f"time [ms],displacement.bearing.x [um]\n{rows}", encoding="utf-8")
    return 1.02 * np.ptp(values), 0.02 * np.sqrt(np.mean(values**2))


def test_a_curve_is_judged_by_the_root_mean_square_of_its_difference(tmp_path, capsys, curve):
    size, missed = curve
    for band, verdict in (
        (f"{101 * missed / size} %", "within the band"),
        (f"{99 * missed / size} %", "outside"),
        (f"{1.01 * missed}", "within the band"),
        (f"{0.99 * missed}", "outside"),
        ("", "reported only"),
    ):
        line = f"displacement.bearing.x,run.csv,0.1,{band},,bench,because\n"
        status, told = _judged(tmp_path, capsys, [line], "-o", str(tmp_path))
        assert status == 0
        (row,) = json.loads(told.out)[0]["numbers"]
        assert row["computed"] == pytest.approx(missed, rel=1e-6)
        assert row["unit"] == "um, rms difference"
        assert row["verdict"] == verdict
    assert (tmp_path / "mine.png").stat().st_size > 5000


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ("displacement.bearing.x,gone.csv,1,5 %,,,\n", "gone.csv"),
        ("displacement.bearing.y,run.csv,1,5 %,,,\n", "run.csv has no such column"),
    ],
)
@pytest.mark.usefixtures("curve")
def test_curves_that_are_not_there_are_refused(line, message, tmp_path, capsys):
    status, told = _judged(tmp_path, capsys, [line])
    assert status == 2
    assert message in told.err
