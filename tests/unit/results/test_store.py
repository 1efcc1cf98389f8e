import json
import os
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from tribodyn.core.errors import InputError
from tribodyn.mechanisms.results import read, summarise, write_run
from tribodyn.results import build, prepare_directory, store
from tribodyn.results.store import replacing, stage, summary_text, write_text


def test_a_run_reads_back_identical(make_result, tmp_path):
    result = make_result(0.5)
    result["F_cx"].values[3] = np.nan
    paths = write_run(result, tmp_path / "new" / "run")
    assert [path.name for path in paths] == ["result.nc", "case.toml", "summary.json"]
    xr.testing.assert_identical(read(tmp_path / "new" / "run"), result)
    assert (tmp_path / "new" / "run" / "case.toml").read_text() == result.attrs["case"]
    assert json.loads(paths[2].read_text()) == summarise(result)


def test_plain_xarray_opens_it(make_result, tmp_path):
    path = write_run(make_result(0.5), tmp_path)[0]
    with xr.open_dataset(path, engine="netcdf4", decode_timedelta=False) as opened:
        assert opened["theta_v"].attrs["units"] == "rad"
        assert opened["time"].dtype == np.float64


@pytest.mark.parametrize("end", [0.005, 0.1])
def test_partial_runs_are_stored(make_result, tmp_path, end):
    result = make_result(end, failure="interrupted")
    write_run(result, tmp_path)
    xr.testing.assert_identical(read(tmp_path), result)
    assert result.sizes["snapshot"] == 0
    assert json.loads((tmp_path / "summary.json").read_text())["status"] == "failed"


def test_a_run_without_a_single_sample_is_stored(tmp_path):
    result = build(
        coordinates={"time": []},
        columns={"e_x": [], "F_cx": []},
        attributes={"kind": "vsv", "failure": "at once"},
    )
    write_run(result, tmp_path)
    xr.testing.assert_identical(read(tmp_path), result)


def test_files_are_readable_as_the_umask_says(make_result, tmp_path):
    previous = os.umask(0o022)
    try:
        paths = write_run(make_result(0.1), tmp_path)
    finally:
        os.umask(previous)
    assert [path.stat().st_mode & 0o777 for path in paths] == [0o644] * 3


def _break_off(path):
    with replacing(path) as part:
        part.write_text("half")
        raise RuntimeError("disk full")


def test_a_failing_writer_leaves_the_old_file_whole(tmp_path):
    path = tmp_path / "file.txt"
    write_text(path, "old")
    with pytest.raises(RuntimeError, match="disk full"):
        _break_off(path)
    assert path.read_text() == "old"
    assert list(tmp_path.iterdir()) == [path]


def test_a_failing_run_leaves_all_three_old_files(make_result, tmp_path, monkeypatch):
    write_run(make_result(0.1), tmp_path)
    before = {path.name: path.read_bytes() for path in tmp_path.iterdir()}

    def fail(*_args, **_kwargs):
        raise OSError("no space left on device")

    monkeypatch.setattr(store, "netcdf_parts", fail)
    with pytest.raises(OSError, match="no space left"):
        write_run(make_result(0.2), tmp_path)
    assert {path.name: path.read_bytes() for path in tmp_path.iterdir()} == before


class Killed(BaseException):
    """The process ends here."""


def killed_after(monkeypatch, survived):
    """Let the process die after so many changes of the folder; return the list of those that were made."""
    made = []

    def dying(change):
        def changed(*arguments, **options):
            if len(made) == survived:
                raise Killed
            made.append(arguments)
            return change(*arguments, **options)

        return changed

    monkeypatch.setattr(os, "replace", dying(os.replace))
    # The parts of a killed process stay, hidden, and are no change that a reader sees.
    unlink = Path.unlink
    dying_unlink = dying(unlink)
    monkeypatch.setattr(
        Path, "unlink", lambda path, **o: None if path.suffix == ".part" else dying_unlink(path, **o)
    )
    return made


def test_nothing_ever_stands_beside_a_result_of_which_it_is_not(make_result, tmp_path, monkeypatch):
    # Few variables: reading all of them takes longer than everything else here.
    old, new = (make_result(end, case=name)[["F_cx", "p_max"]] for end, name in ((0.1, "old"), (0.2, "new")))
    seen = []
    for survived in range(20):
        folder = tmp_path / str(survived)
        write_run(old, folder)
        report = folder / "report.html"
        report.write_text("old")
        with monkeypatch.context() as patch:
            made = killed_after(patch, survived)
            try:
                write_run(new, folder, stale=[report])
            except Killed:
                pass
            else:
                assert len(made) == survived
                break
        there = old if read(folder).identical(old) else new
        xr.testing.assert_identical(read(folder), there)
        seen.append(there is new)
        for name, text in (
            ("summary.json", summary_text(summarise(there))),
            ("case.toml", there.attrs["case"]),
        ):
            assert not (folder / name).exists() or (folder / name).read_text() == text
        assert there is old or not report.exists()
    # Three removals, then three renames, the first of which brings the new result.
    assert seen == [False] * 4 + [True] * 2
    assert not report.exists()


def test_reading_nothing_says_what_to_do(tmp_path):
    with pytest.raises(InputError, match="there is no result"):
        read(tmp_path)


def test_reading_a_torn_file_is_an_input_error(make_result, tmp_path):
    path = write_run(make_result(0.1), tmp_path)[0]
    path.write_bytes(path.read_bytes()[:2000])
    with pytest.raises(InputError, match="cannot read the result"):
        read(tmp_path)


def test_a_long_case_text_is_stored(tmp_path):
    # HDF5 holds attributes of up to 64 kB in the usual way; a case with its comments may be longer.
    result = build(
        coordinates={"time": [0.0]}, columns={}, attributes={"kind": "vsv", "case": "# é\n" * 50_000}
    )
    write_run(result, tmp_path)
    assert read(tmp_path).attrs == result.attrs


def test_only_finished_files_remain(make_result, tmp_path):
    write_run(make_result(0.1), tmp_path)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["case.toml", "result.nc", "summary.json"]


def test_prepare_directory_makes_it_and_leaves_nothing(tmp_path):
    folder = prepare_directory(tmp_path / "a" / "b")
    assert folder.is_dir()
    assert list(folder.iterdir()) == []


def test_prepare_directory_refuses_a_file(tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(InputError, match="choose another folder"):
        prepare_directory(tmp_path / "file")


def test_what_cannot_be_staged_leaves_nothing(tmp_path, monkeypatch):
    def fail(_):
        raise OSError("no space left on device")

    monkeypatch.setattr(os, "fsync", fail)
    with pytest.raises(OSError, match="no space left"):
        stage(tmp_path / "result.nc", b"content")
    assert list(tmp_path.iterdir()) == []
