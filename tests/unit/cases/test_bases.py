"""Case files that begin with another case file."""

from pathlib import Path

import pytest

import tribodyn as td
from tribodyn.core.errors import InputError


def test_a_variant_changes_some_keys_of_its_base(tmp_path: Path) -> None:
    (tmp_path / "base.toml").write_text(
        'case = "slider-crank"\n[drives.motor]\nspeed = "100 rpm"\n', encoding="utf-8"
    )
    wide = tmp_path / "wide.toml"
    wide.write_text(
        'case = "base.toml"\n[joints.wrist.clearance]\nradial = "40 um"\n[drives.motor]\nspeed = "60 rpm"\n',
        encoding="utf-8",
    )
    changes = {"joints.wrist.clearance.radial": "40 um", "drives.motor.speed": "60 rpm"}
    assert td.load_case(wide) == td.load_case("slider-crank").replace(changes)


def test_names_of_files_begin_where_they_are_written(tmp_path: Path) -> None:
    """A table that a base names is read from the folder of the base, not from that of the variant."""
    below = tmp_path / "below"
    below.mkdir()
    (below / "speed.csv").write_text("time [s], speed [rpm]\n0, 100\n1, 200\n", encoding="utf-8")
    (below / "base.toml").write_text(
        'case = "slider-crank"\n[run]\nduration = "0.1 s"\n[drives.motor.speed]\ntable = "speed.csv"\n'
        'column = "speed"\ninterpolation = "linear"\n',
        encoding="utf-8",
    )
    variant = tmp_path / "variant.toml"
    variant.write_text('case = "below/base.toml"\n', encoding="utf-8")
    assert td.load_case(variant) == td.load_case(below / "base.toml")


@pytest.mark.parametrize(
    ("files", "message"),
    [
        ({"mine": "mine"}, "begins with itself"),
        ({"mine": "other", "other": "mine"}, "begins with itself"),
        ({"mine": "missing"}, "no such file"),
        ({"mine": "1", **{str(n): str(n + 1) for n in range(1, 12)}}, "more than 8 files"),
    ],
)
def test_bases_that_lead_nowhere_are_refused(files: dict[str, str], message: str, tmp_path: Path) -> None:
    for name, base in files.items():
        (tmp_path / f"{name}.toml").write_text(f'case = "{base}.toml"\n', encoding="utf-8")
    with pytest.raises(InputError, match=message):
        td.load_case(tmp_path / "mine.toml")


def test_an_error_in_a_base_names_the_base(tmp_path: Path) -> None:
    (tmp_path / "base.toml").write_text(
        'case = "slider-crank"\n[drives.motor]\nspeed = "1 kg"\n', encoding="utf-8"
    )
    (tmp_path / "mine.toml").write_text('case = "base.toml"\n', encoding="utf-8")
    with pytest.raises(InputError) as caught:
        td.load_case(tmp_path / "mine.toml")
    assert caught.value.source == str(tmp_path / "base.toml")
