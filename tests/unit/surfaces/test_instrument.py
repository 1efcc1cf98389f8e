"""The same surface in several formats gives the same numbers."""

import warnings
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tribodyn.cases.units import to_si
from tribodyn.core.errors import InputError
from tribodyn.surfaces import Scale, Scan, analyse, read_scan, write_text
from tribodyn.surfaces.parameters import numbers

pytest.importorskip("SurfaceTopography")
LENGTH = partial(to_si, like="m")
SPACING = (1.5e-6, 1e-6)


@pytest.fixture(scope="module")
def scan(rough: Callable[..., Scan]) -> Scan:
    return Scan(rough(48, 64).heights, SPACING)


@pytest.fixture(scope="module")
def topography(scan: Scan) -> Any:
    """The same surface as an object of SurfaceTopography, in micrometres."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        from SurfaceTopography import Topography
    return Topography(scan.heights.T * 1e6, physical_sizes=(64.0, 48 * 1.5), unit="µm")


def write_netcdf(path: Path, topography: Any) -> Scale:
    topography.to_netcdf(str(path))
    return Scale()


def write_x3p(path: Path, topography: Any) -> Scale:
    topography.to_x3p(str(path))
    return Scale()


def write_gwyddion(path: Path, topography: Any) -> Scale:
    topography.to_gwy(str(path))
    return Scale()


def write_numpy(path: Path, topography: Any) -> Scale:
    np.save(path, topography.heights())
    return Scale("um", "1 um, 1.5 um")


def write_columns(path: Path, topography: Any) -> Scale:
    x, y = np.meshgrid(np.arange(64.0), np.arange(48) * 1.5, indexing="ij")
    np.savetxt(path, np.column_stack([x.ravel(), y.ravel(), topography.heights().ravel()]))
    return Scale("um")


def write_matrix(path: Path, topography: Any) -> Scale:
    np.savetxt(path, topography.heights().T)
    return Scale("um", "1 um, 1.5 um")


FORMATS = {
    "nc": write_netcdf,
    "x3p": write_x3p,
    "gwy": write_gwyddion,
    "npy": write_numpy,
    "xyz": write_columns,
    "txt": write_matrix,
}


@pytest.mark.parametrize("ending", FORMATS)
def test_every_format_gives_the_same_numbers(ending, scan, topography, tmp_path):
    path = tmp_path / f"scan.{ending}"
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        given = FORMATS[ending](path, topography)
    again = read_scan(path, LENGTH, given)
    assert again.heights.shape == (48, 64)
    assert again.spacing == pytest.approx(SPACING, rel=1e-12)
    # Text and 64-bit numbers carry 15 digits.
    np.testing.assert_allclose(again.heights, scan.heights, rtol=1e-12, atol=1e-18)
    write_text(scan, tmp_path / "scan.csv")
    expected = numbers(analyse(read_scan(tmp_path / "scan.csv", LENGTH)))
    # Curvatures are differences of heights: 1e-12 of a height is about 1e-11 of them.
    assert numbers(analyse(again)) == pytest.approx(expected, rel=1e-9)


def test_a_profile_of_points(tmp_path: Path) -> None:
    path = tmp_path / "line.xyz"
    x = np.arange(64.0)
    np.savetxt(path, np.column_stack([x, np.sin(x)]))
    scan = read_scan(path, LENGTH, Scale("um"))
    np.testing.assert_allclose(scan.heights, 1e-6 * np.sin(x), rtol=1e-12, atol=1e-18)
    assert scan.spacing[0] == pytest.approx(1e-6, rel=1e-12)


def test_undefined_heights_are_missing(scan: Scan, tmp_path: Path) -> None:
    heights = scan.heights.T * 1e6
    heights[3, 4] = np.nan
    np.save(tmp_path / "scan.npy", heights)
    again = read_scan(tmp_path / "scan.npy", LENGTH, Scale("um", "1 um"))
    assert np.flatnonzero(np.isnan(again.heights.T.ravel())).tolist() == [3 * 48 + 4]


def test_what_a_file_says_cannot_be_said_again(topography: Any, tmp_path: Path) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        write_netcdf(tmp_path / "scan.nc", topography)
    for given, key in ((Scale(unit="um"), "unit"), (Scale(spacing="1 um"), "spacing")):
        with pytest.raises(InputError, match="leave it out") as caught:
            read_scan(tmp_path / "scan.nc", LENGTH, given)
        assert caught.value.key == key


def test_without_the_extra_only_plain_text_is_read(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(__import__("sys").modules, "SurfaceTopography.IO", None)
    (tmp_path / "scan.nc").write_bytes(b"CDF")
    with pytest.raises(InputError, match="tribodyn\\[surfaces\\]"):
        read_scan(tmp_path / "scan.nc", LENGTH)
    (tmp_path / "scan.csv").write_text("1,2\n3,4\n")
    assert read_scan(tmp_path / "scan.csv", LENGTH, Scale("um", "1 um")).heights.shape == (2, 2)
