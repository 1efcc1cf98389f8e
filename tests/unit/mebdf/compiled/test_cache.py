"""Where compiled kernels are kept, what names the place, and what happens when it is damaged or goes."""

from __future__ import annotations

import os
import pickle
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numba as nb
import pytest

from mebdf.compiled import cache
from mebdf.compiled.private_folder import private_folder
from mebdf.kernels.jit import SOURCES


@pytest.fixture
def place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty folder for compiled code, for this test alone."""
    folder = private_folder(tmp_path / cache.fingerprint(SOURCES))
    monkeypatch.setattr(cache, "folder", lambda sources: folder)
    return folder


def compiled() -> Any:
    """Return a function that does not know yet what was compiled before."""

    def double(number: float) -> float:
        return 2 * number

    return cache.cached(nb.njit(double), SOURCES)


def misses(function: Any) -> int:
    return sum(function.stats.cache_misses.values())


def test_what_was_compiled_is_found(place: Path) -> None:
    first, second = compiled(), compiled()
    assert first(2.0) == second(2.0) == 4.0
    assert (misses(first), misses(second)) == (1, 0)
    assert len(list(place.glob("*.nbc"))) == 1


def test_what_is_found_is_parsed_only_for_a_caller(place: Path) -> None:
    compiled()(2.0)
    found = compiled()
    assert found(2.0) == 4.0
    (library,) = (each.library for each in found.overloads.values())
    assert library._own is None

    def fourfold(number: float) -> float:
        result: float = found(found(number))
        return result

    assert nb.njit(fourfold)(2.0) == 8.0
    assert misses(found) == 0
    assert library._own is not None


def test_what_is_found_needs_no_compiler() -> None:
    use = "import sys; from mebdf.kernels.elementary import portable; portable.sin(1.0); print(*sys.modules)"
    for _ in range(2):  # the first one may compile
        done = subprocess.run([sys.executable, "-c", use], capture_output=True, text=True, check=True)
    assert not set(done.stdout.split()) & {"numba.np.arraymath", "scipy.linalg", "cffi"}


@pytest.mark.parametrize("pattern", ["*.nbi", "*.nbc"])
def test_damaged_files_are_compiled_again_and_mended(place: Path, pattern: str) -> None:
    compiled()(2.0)
    for path in place.glob(pattern):
        path.write_bytes(path.read_bytes()[:20])
    again, later = compiled(), compiled()
    assert again(2.0) == later(2.0) == 4.0
    assert (misses(again), misses(later)) == (1, 0)


@pytest.mark.parametrize("place_in_file", [0.1, 0.3, 0.5, 0.7, 0.9])
def test_machine_code_of_which_a_bit_changed_is_not_executed(place: Path, place_in_file: float) -> None:
    compiled()(2.0)
    (path,) = place.glob("*.nbc")
    content = bytearray(path.read_bytes())
    content[int(place_in_file * len(content))] ^= 1
    path.write_bytes(content)
    again, later = compiled(), compiled()
    assert again(2.0) == later(2.0) == 4.0
    assert (misses(again), misses(later)) == (1, 0)


def test_an_index_of_types_that_are_unknown_here_is_written_anew(place: Path) -> None:
    function = compiled()
    function(2.0)
    (index,), ((signature, code),) = place.glob("*.nbi"), function.overloads.items()
    # As another process leaves it that knows more packages, between reading it and saving.
    index.write_bytes(pickle.dumps(nb.__version__, protocol=-1) + b"cno_such_package\nNumber\n.")
    function._cache.save_overload(signature, code)
    later = compiled()
    assert later(2.0) == 4.0
    assert misses(later) == 0


def test_a_folder_that_another_process_removed_is_made_again(place: Path) -> None:
    function = compiled()
    function(2.0)
    shutil.rmtree(place)
    assert function(2) == 4
    assert len(list(place.glob("*.nbc"))) == 1
    later = compiled()
    assert later(2) == 4
    assert misses(later) == 0


def test_nothing_is_kept_once_the_sources_have_changed(place: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    # Modules imported before and after the change would be mixed under the name of the sources before.
    monkeypatch.setattr(cache, "fingerprint", lambda sources: "another")
    assert compiled()(2.0) == 4.0
    assert not list(place.glob("*.nb?"))


def test_nothing_is_kept_where_others_may_write_meanwhile(place: Path) -> None:
    place.chmod(0o770)
    assert compiled()(2.0) == 4.0
    assert not list(place.iterdir())


def test_a_disk_that_refuses_costs_the_copy_and_not_the_run(
    place: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "replace", full)
    assert compiled()(2.0) == 4.0
    assert not list(place.glob("*.nb?"))


def test_processes_that_compile_at_once_save_one_after_the_other(
    place: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    files: list[int] = []

    @contextmanager
    def watched(folder: Path) -> Iterator[None]:
        files.append(len(list(folder.iterdir())))
        yield
        files.append(len(list(folder.iterdir())))

    monkeypatch.setattr(cache, "locked", watched)
    compiled()(2.0)
    assert files == [0, 2]


SETTINGS = {"CPU_NAME": "generic", "CPU_FEATURES": "", "OPT": 1, "BOUNDSCHECK": 1}


@pytest.mark.parametrize(("name", "value"), SETTINGS.items(), ids=SETTINGS.keys())
def test_settings_that_change_the_code_change_the_name(
    name: str, value: object, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(cache, "_processor", cache._processor.__wrapped__)
    for host in ("CPU_NAME", "CPU_FEATURES"):
        monkeypatch.setattr(nb.config, host, None)
    before = cache.fingerprint(SOURCES)
    monkeypatch.setattr(nb.config, name, value)
    assert cache.fingerprint(SOURCES) != before


@pytest.mark.parametrize("module", [nb, cache.llvmlite, cache.np], ids=lambda module: module.__name__)
def test_versions_change_the_name(module: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    before = cache.fingerprint(SOURCES)
    monkeypatch.setattr(module, "__version__", "0.0")
    assert cache.fingerprint(SOURCES) != before


def test_nothing_is_kept_where_a_source_is_missing(tmp_path: Path, places: list[Path]) -> None:
    # As in an archive: the name would be the same for any sources.
    assert cache.folder.__wrapped__(cache.Sources(tmp_path, ("kernels/*.py",))) is None


@pytest.fixture
def places(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> list[Path]:
    """The three places for compiled code, all of them in the folder of this test."""
    names = ("numba", "caches", "temporary")
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path / "numba"))
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "caches"))
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path / "temporary"))
    return [tmp_path / name for name in names]


def found() -> Path | None:
    return cache.folder.__wrapped__(SOURCES)


def test_the_next_place_serves_where_one_cannot_be_written_to(
    places: list[Path], recwarn: pytest.WarningsRecorder
) -> None:
    for parent in places:
        assert found() == next(parent.iterdir()) / cache.fingerprint(SOURCES)
        shutil.rmtree(parent)
        parent.touch()
    assert found() is None
    assert not recwarn.list


def test_a_place_that_others_may_have_filled_is_passed_over_with_a_warning(places: list[Path]) -> None:
    planted = places[0] / "mebdf"
    planted.mkdir(parents=True)
    planted.chmod(0o770)
    with pytest.warns(RuntimeWarning, match="others may write"):
        place = found()
    assert place == places[1] / "mebdf" / cache.fingerprint(SOURCES)
    assert not list(planted.iterdir())


def test_without_a_setting_the_place_is_in_the_home_folder(
    places: list[Path], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delenv("NUMBA_CACHE_DIR", raising=False)
    monkeypatch.setenv("XDG_CACHE_HOME", "not/absolute")
    monkeypatch.setenv("HOME", str(tmp_path))
    assert found() == tmp_path / ".cache" / "mebdf" / cache.fingerprint(SOURCES)


def test_a_new_name_removes_old_ones(places: list[Path]) -> None:
    parent = private_folder(places[0] / "mebdf")
    for number in range(6):
        old = parent / f"{number:032x}"
        old.mkdir()
        os.utime(old, times=(number, number))
    place = found()
    assert sorted(path.name[-1] for path in parent.iterdir() if path != place) == ["3", "4", "5"]


def test_where_nothing_can_be_kept_kernels_are_compiled_all_the_same(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cache, "folder", lambda sources: None)
    function = compiled()
    assert function(2.0) == 4.0
    assert function.stats.cache_path is None
