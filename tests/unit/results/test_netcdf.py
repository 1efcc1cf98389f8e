"""What is written is what was there."""

import subprocess
import sys
from pathlib import Path

import netCDF4
import numpy as np
import pytest
import xarray as xr

from tribodyn.results import netcdf
from tribodyn.results.netcdf import MOST_TEXTS, dataset_of, netcdf_content
from tribodyn.studies.plan import MOST_POINTS

TEXTS = np.array(["", "two words", "µ"], dtype=object)
KINDS = {
    "numbers": xr.Dataset({"a": (("x", "y"), np.arange(6.0).reshape(3, 2))}, {"x": [0.5, np.nan, 2.0]}),
    "small numbers": xr.Dataset({"a": ("x", np.arange(3, dtype=np.float32)), "n": ("x", [1, 2, 3])}),
    "truth values": xr.Dataset({"a": ("x", [True, False])}),
    "one number": xr.Dataset({"a": ((), 2.5, {"units": "m"})}, attrs={"n": 3, "f": 0.25, "text": ""}),
    "texts": xr.Dataset({"a": ("x", TEXTS)}, {"x": np.array(["p", "q", "r"])}, {"title": "°"}),
    "other coordinates": xr.Dataset(
        {"a": (("x", "y"), np.ones((2, 3)))},
        {"x": [1.0, 2.0], "at": ("x", [3.0, 4.0]), "alone": ("z", [5.0]), "once": 6.0},
    ),
    "dotted names": xr.Dataset({"a": ("joint.clearance", [1.0])}, {"joint.clearance": [2e-5]}),
    "nothing": xr.Dataset({"a": ("x", np.empty(0))}, {"x": np.empty(0)}),
    "many attributes": xr.Dataset(attrs={f"number {i}": i for i in range(50)}),
}


@pytest.mark.parametrize("kind", KINDS)
def test_it_reads_back_as_it_was(kind: str, tmp_path: Path) -> None:
    path = tmp_path / "file.nc"
    path.write_bytes(netcdf_content(KINDS[kind]))
    # Plain xarray, which knows nothing of the checksum that follows the file.
    xr.testing.assert_identical(xr.load_dataset(path, engine="netcdf4", decode_times=False), KINDS[kind])
    xr.testing.assert_identical(dataset_of(path.read_bytes()), KINDS[kind])


def test_a_file_that_another_program_wrote_is_read(tmp_path: Path) -> None:
    path = tmp_path / "file.nc"
    KINDS["numbers"].to_netcdf(path, engine="netcdf4")
    xr.testing.assert_identical(dataset_of(path.read_bytes()), KINDS["numbers"])


def test_any_changed_byte_is_seen() -> None:
    content = netcdf_content(KINDS["one number"])
    # What describes the arrays has no checksum within the file: this reads as another name.
    changed = content.replace(b"units", b"Units")
    assert changed != content
    with pytest.raises(ValueError, match="checksum"):
        dataset_of(changed)


def test_numbers_have_checksums(tmp_path: Path) -> None:
    path = tmp_path / "file.nc"
    path.write_bytes(netcdf_content(KINDS["numbers"]))
    with netCDF4.Dataset(path) as file:
        assert all(variable.filters()["fletcher32"] for variable in file.variables.values())


def test_more_texts_than_a_sweep_has_points_are_refused_unread() -> None:
    assert MOST_TEXTS >= MOST_POINTS
    # In a large file few are looked at together, to be safe from a long one named again and again.
    texts = np.full((MOST_TEXTS // 1000 + 1, 1000), "many", dtype=object)
    content = netcdf_content(xr.Dataset({"a": (("x", "y"), texts)}, attrs={"long": "x" * 1_000_000}))
    with pytest.raises(ValueError, match="a holds more than 100000 texts"):
        dataset_of(content)


@pytest.mark.parametrize("kind", ["float32", "float64", "int32", "uint8"])
def test_what_was_written_is_read_however_large(kind: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(netcdf, "MOST_COMPRESSED", 1000)
    values = np.arange(100_000).astype(kind)
    content = netcdf_content(xr.Dataset({"x": ("time", values)}))
    np.testing.assert_array_equal(dataset_of(content)["x"].values, values)


_PEAK = """
import resource
import numpy as np, xarray as xr
from tribodyn.results.netcdf import netcdf_parts
arrays = {f"v{i}": (("x", "y"), np.full((1000, 1000), float(i))) for i in range(5)}
def peak(): return 1024 * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
netcdf_parts(xr.Dataset({"v0": arrays["v0"]}))
before = peak()
netcdf_parts(xr.Dataset(arrays))
print((peak() - before) / 8e6)
"""


@pytest.mark.skipif(sys.platform != "linux", reason="elsewhere memory is counted in other units")
def test_writing_holds_one_copy_of_the_numbers() -> None:
    done = subprocess.run([sys.executable, "-c", _PEAK], stdout=subprocess.PIPE, text=True, check=True)
    # In arrays, of which the first of five was written before; with a second copy it would be nine.
    assert float(done.stdout) < 7.0
