"""Our own text format: what is written reads back, and what a person writes is understood."""

from functools import partial
from pathlib import Path

import numpy as np
import pytest

from tribodyn.cases.units import to_si
from tribodyn.core.errors import InputError
from tribodyn.surfaces import Scale, Scan, read_scan, write_text

LENGTH = partial(to_si, like="m")


def read(tmp_path: Path, text: str, given: Scale | None = None) -> Scan:
    path = tmp_path / "scan.csv"
    path.write_bytes(text.encode())
    return read_scan(path, LENGTH, given or Scale())


@pytest.mark.parametrize("shape", [(64,), (40, 50)])
def test_what_is_written_reads_back_to_the_bit(shape, rough, tmp_path):
    scan = rough(*shape)
    heights = scan.heights.copy()
    heights.flat[7] = np.nan
    spacing = (1e-6,) if len(shape) == 1 else (1.1e-6, 0.7e-6)
    write_text(Scan(heights, spacing), tmp_path / "scan.csv")
    again = read_scan(tmp_path / "scan.csv", LENGTH)
    np.testing.assert_array_equal(again.heights, heights)
    assert again.spacing == spacing


@pytest.mark.parametrize("separator", [",", ";", "\t", " , "])
def test_separators(separator: str, tmp_path: Path) -> None:
    rows = "\n".join(separator.join(row) for row in (["1", "2.5", "-3e1"], ["4", "", "NaN"]))
    scan = read(tmp_path, f"# unit: um\n# spacing = 2 um, 0.5 um\n\n{rows}\n")
    np.testing.assert_allclose(
        scan.heights, 1e-6 * np.array([[1, 2.5, -30], [4, np.nan, np.nan]]), rtol=1e-15
    )
    assert scan.spacing == (0.5e-6, 2e-6)


def test_unit_and_spacing_may_be_given_beside_the_file(tmp_path: Path) -> None:
    scan = read(tmp_path, "1,2\r\n3,4\r\n", Scale("nm", "1 um"))
    np.testing.assert_allclose(scan.heights, [[1e-9, 2e-9], [3e-9, 4e-9]], rtol=1e-15)
    assert scan.spacing == (1e-6, 1e-6)


@pytest.mark.parametrize("text", ["1,2,3\n", "1\n2\n3\n"])
def test_a_single_line_or_column_is_a_profile(text: str, tmp_path: Path) -> None:
    scan = read(tmp_path, text, Scale("um", "2 um"))
    np.testing.assert_allclose(scan.heights, [1e-6, 2e-6, 3e-6], rtol=1e-15)
    assert scan.spacing == (2e-6,)


@pytest.mark.parametrize("header", ["x [mm],h [um]", "X[mm], H [µm]"])
def test_columns_carry_their_own_units(header: str, tmp_path: Path) -> None:
    scan = read(tmp_path, f"{header}\n0,1\n0.5,2\n1,3\n")
    np.testing.assert_allclose(scan.heights, [1e-6, 2e-6, 3e-6], rtol=1e-15)
    assert scan.spacing == (0.5e-3,)


TEXTS = {
    "a map": "# unit: um\n# spacing: 2 um, 1 um\n1,,-3e1\n\n  4 , nan,6\n# a note, with commas\n7,8,9\n",
    "a long line": "# unit: um\n# spacing: 1 um\n" + ",".join(f"{k}.5" for k in range(80)),
    "its end missing": "# unit: um\n# spacing: 1 um\n" + "1.5;" * 80,
    "many blank lines": "# unit: um\n# spacing: 1 um\n1,2\n" + "\n \n" * 80 + "3,4\n",
    "tabs alone": "# unit: um\n# spacing: 1 um\n1" + "\t" * 80 + "2\n",
    "columns": "\ufeffx [um],h [um]\r\n" + "\r\n".join(f"{k},{k}e-1" for k in range(80)) + "\r\n",
    "old line ends": "# unit: um\r# spacing: 1 um\r" + "12\t34\r" * 80,
}


HEIGHTS: dict[str, list[list[float]] | list[float]] = {
    "a map": [[1.0, np.nan, -30.0], [4.0, np.nan, 6.0], [7.0, 8.0, 9.0]],
    "a long line": [k + 0.5 for k in range(80)],
    "its end missing": [1.5] * 80 + [np.nan],
    "many blank lines": [[1.0, 2.0], [3.0, 4.0]],
    "tabs alone": [1.0, *[np.nan] * 79, 2.0],
    "columns": [0.1 * k for k in range(80)],
    "old line ends": [[12.0, 34.0]] * 80,
}


@pytest.mark.parametrize("name", TEXTS)
def test_texts_as_they_come(name: str, tmp_path: Path) -> None:
    found = read(tmp_path, TEXTS[name])
    np.testing.assert_allclose(found.heights, 1e-6 * np.array(HEIGHTS[name]), rtol=1e-14)
    assert found.spacing == pytest.approx((1e-6, 2e-6) if name == "a map" else [1e-6] * found.heights.ndim)


@pytest.mark.parametrize(
    ("rows", "said"),
    [
        ("1,2\n" * 30 + "1\n", "line 33 has 1 fields where 2 are needed"),
        ("1,2\n" * 30 + "1,b\n", 'line 33: given "b"'),
        ("1,2\n" * 30 + "1,+nan\n", "line 33"),
        ("1,2\n" * 30 + "1,1,5\n", "line 33 has 3 fields"),
        ("1,2\n" * 30 + "# unit: um\n", "line 33: unit and spacing stand above the heights"),
        ("1,2\n" * 30 + "#" * 300, "line 33 has 200 characters or more"),
        ("1,2\n" * 30 + "ü".encode("latin-1").decode("utf-8", "surrogateescape"), "UTF-8 text (byte 147)"),
    ],
)
def test_errors_are_placed(rows: str, said: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("tribodyn.surfaces.table.LONGEST_LINE", 200)
    path = tmp_path / "scan.csv"
    path.write_bytes(f"# unit: um\n# spacing: 1 um\n{rows}".encode(errors="surrogateescape"))
    with pytest.raises(InputError) as caught:
        read_scan(path, LENGTH)
    assert said in str(caught.value)


PROFILE = [f"{i},{(i * i) % 7}" for i in range(6)]


@pytest.mark.parametrize(
    ("text", "unit"),
    [
        ("Position [mm],Height [um]\n" + "\n".join(PROFILE), None),
        ("Weg (mm);Höhe (µm)\n" + "\n".join(row.replace(",", ",0;") + ",0" for row in PROFILE), None),
        ("# run 7\nMeasured, twice\nx [mm]\tz [um]\n" + "\n".join(PROFILE).replace(",", "\t"), None),
        ("% no names\n" + "\n".join(PROFILE), "mm, um"),
        ("// no names\n" + "\n".join(PROFILE).replace(",", ";"), "mm,um"),
        ("distance,profile\n" + "\n".join(PROFILE), "mm, um"),
        ("h [um],x [mm]\n" + "\n".join(",".join(reversed(row.split(","))) for row in PROFILE), None),
    ],
    ids=["other-name", "decimal-commas", "preamble", "no-header", "semicolon", "no-units", "swapped"],
)
def test_profiles_as_instruments_write_them(text: str, unit: str | None, tmp_path: Path) -> None:
    scan = read(tmp_path, text + "\n", Scale(unit))
    np.testing.assert_allclose(scan.heights, 1e-6 * np.array([i * i % 7 for i in range(6)]), atol=1e-20)
    assert scan.spacing == pytest.approx((1e-3,), rel=1e-12)


def test_two_columns_without_units_are_asked_for_them(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="mm, um"):
        read(tmp_path, "\n".join(PROFILE))


def test_columns_in_the_other_order(tmp_path: Path) -> None:
    scan = read(tmp_path, "h [um],x [um]\n5,0\n6,1\n")
    np.testing.assert_allclose(scan.heights, [5e-6, 6e-6], rtol=1e-15)


def test_points_left_out_of_a_profile_are_missing(tmp_path: Path) -> None:
    scan = read(tmp_path, "# unit: um\nx,h\n0,1\n1,2\n4,3\n5,4\n6,5\n")
    np.testing.assert_array_equal(np.isnan(scan.heights), [False, False, True, True, False, False, False])
    assert scan.spacing[0] == pytest.approx(1e-6, rel=1e-15)


def test_rounded_positions_are_equal_steps(tmp_path: Path) -> None:
    x = np.round(np.arange(100) * 0.35, 2)
    rows = "\n".join(f"{place},{k}" for k, place in enumerate(x))
    assert read(tmp_path, f"x [um],h [um]\n{rows}\n").spacing[0] == pytest.approx(0.35e-6, rel=1e-3)
