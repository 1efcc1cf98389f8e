"""Case files: what is read, misplaced keys, bases."""

from pathlib import Path

import pytest

import tribodyn as td
from tribodyn.core.errors import InputError
from tribodyn.mechanisms.catalogue import load_case, parse_case


def test_a_file_needs_only_what_differs(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    path.write_text('case = "vsv"\n[joint]\nclearance = "30 um"\n[solver]\n[solver.grid]\n', encoding="utf-8")
    assert load_case(path) == load_case("vsv").replace({"joint.clearance": "30 um"})
    assert load_case(str(path)) == load_case(path)


def test_a_byte_order_mark_is_no_obstacle(tmp_path: Path) -> None:
    path = tmp_path / "windows.toml"
    path.write_bytes(b'\xef\xbb\xbfcase = "vsv"\r\n')
    assert load_case(path) == load_case("vsv")


def test_built_in_names_come_before_files(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("vsv").write_text("nonsense", encoding="utf-8")
    load_case("vsv")
    with pytest.raises(InputError, match="not valid TOML"):
        load_case("./vsv")


@pytest.mark.parametrize(
    ("text", "key"),
    [
        ('case = "vsv"\n"joint.clearance" = "20 um"\n', '"joint.clearance"'),
        ('case = "vsv"\n"" = 1\n', '""'),
        ('case = "vsv"\n[joint.clearance]\nvalue = "20 um"\n', "joint.clearance.value"),
        ('case = "vsv"\n[[joint]]\nclearance = "20 um"\n', "joint"),
        ('case = "vsv"\n[jiont]\n', "jiont"),
        ('case = "vsv"\njoint = {}\n[loads]\nair_force_x = {}\n', "loads.air_force_x"),
        ('case = "vsv"\n[run]\ncycles = 2\nduration = "3 s"\n', "run.duration"),
        ('case = ["vsv"]\n', "case"),
        ("case = {}\n", "case"),
    ],
)
def test_misplaced_keys_are_found(text: str, key: str) -> None:
    with pytest.raises(InputError) as caught:
        parse_case(text, "case.toml")
    assert caught.value.key == key
    assert caught.value.source == "case.toml"


def test_a_file_without_a_kind_is_taken_for_the_one_whose_tables_it_has(tmp_path: Path) -> None:
    file = tmp_path / "mine.toml"
    file.write_text('title = "Arm"\n[bodies.arm]\nmass = "1 kg"\n[joints.pivot]\ntype = "revolute"\n')
    with pytest.raises(InputError, match='write case = "mechanism" at the top'):
        load_case(file)


def test_a_file_with_a_name_alike_is_named(tmp_path: Path) -> None:
    (tmp_path / "crank.toml").write_text("", encoding="utf-8")
    for given in ("cranks.toml", "crank"):
        with pytest.raises(InputError, match=r"there is no such file.*did you mean .*crank\.toml\?"):
            load_case(str(tmp_path / given))


def test_a_table_in_braces_that_goes_on_elsewhere_is_named() -> None:
    text = '[joints]\nwrist = { type = "revolute" }\n[joints.wrist.clearance]\nradial = "1 um"\n'
    with pytest.raises(
        InputError, match=r"\[joints\.wrist\.clearance\] cannot follow; write \[joints\.wrist\]"
    ):
        parse_case(text, "mine.toml")


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


def test_names_are_data_only(tmp_path: Path) -> None:
    path = tmp_path / "<b>лопатка {0} %s $(id).toml"
    title = "<script>alert(1)</script> лопатка {0} %s 🌀"
    path.write_text(f'case = "vsv"\ntitle = "{title}"\n', encoding="utf-8")
    case = load_case(path)
    assert case.title == title
    assert parse_case(case.to_toml(), "again") == case


def test_a_force_is_a_size_and_no_vector() -> None:
    with pytest.raises(InputError, match=r"these are several numbers.*direction = \[-1, 0, 0\]"):
        parse_case('case = "mechanism"\n[loads.push]\nforce = "-100, 0, 0 N"\n', "mine.toml")
