"""Real runs that are killed, have no room left, meet each other, or whose results are damaged afterwards."""

import json
import os
import random
import resource
import shutil
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import pytest

from tribodyn.cli.main import main
from tribodyn.cli.options import OutputDirectory
from tribodyn.mechanisms.catalogue import parse_case
from tribodyn.mechanisms.results import read, summarise
from tribodyn.results.store import remove_stale_parts

RUN = [sys.executable, "-m", "tribodyn", "run", "vsv", "--force", "--set", "run.duration=1 s", "-o"]
WHOLE = ["case.toml", "figures", "report.html", "result.nc", "summary.json"]
SMALL = 100_000  #: Bytes that a full disk has left; a result needs ten times as many.


def started(folder: Path) -> subprocess.Popen[str]:
    return subprocess.Popen([*RUN, str(folder)], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)


def assert_one_run(folder: Path) -> None:
    """Assert that result, summary and case are there and of one and the same run."""
    result = read(folder)
    assert json.loads((folder / "summary.json").read_text(encoding="utf-8")) == summarise(result)
    assert (folder / "case.toml").read_text(encoding="utf-8") == result.attrs["case"]


def assert_whole_or_absent(folder: Path) -> None:
    """Assert that what has the name of a result is a whole one."""
    for path in [path for path in folder.rglob("*") if path.is_file() and path.suffix != ".part"]:
        if path.suffix == ".nc":
            assert read(path).attrs["failure"] == ""
        elif path.suffix == ".json":
            assert json.loads(path.read_text(encoding="utf-8"))["status"] == "complete"
        elif path.suffix == ".toml":
            parse_case(path.read_text(encoding="utf-8"), path.name)
        else:
            ends = {".png": b"IEND\xaeB`\x82", ".pdf": b"%%EOF\n", ".html": b"</html>"}
            assert path.read_bytes().rstrip(b"\n").endswith(ends[path.suffix].rstrip(b"\n"))
    # A file on its way is hidden and has an ending of its own: nobody takes it for a result.
    assert all(path.name.startswith(".") for path in folder.rglob("*.part"))


def assert_nothing_of_another_run(folder: Path) -> None:
    """Assert that there is a result, and that summary and case, where they are there, are of it."""
    result = read(folder)
    summary, case = folder / "summary.json", folder / "case.toml"
    if summary.exists():
        assert json.loads(summary.read_text(encoding="utf-8")) == summarise(result)
    if case.exists():
        assert case.read_text(encoding="utf-8") == result.attrs["case"]
    made = (folder / "result.nc").stat().st_mtime
    pictures = [*folder.glob("report.html"), *(folder / "figures").glob("*.p[nd][gf]")]
    assert all(picture.stat().st_mtime >= made for picture in pictures)


def pause(chance: random.Random, longest: float) -> None:
    """Wait for a part of ``longest``; what pytest shows of a failure says how long it was."""
    seconds = chance.uniform(0.0, longest)
    print(f"killed {seconds:.4f} s later")
    time.sleep(seconds)


def kill(folder: Path, wait: Callable[[subprocess.Popen[str]], None]) -> None:
    process = started(folder)
    wait(process)
    process.kill()
    process.communicate()
    if folder.exists():
        assert_whole_or_absent(folder)


def until_drawing(process: subprocess.Popen[str]) -> None:
    assert process.stderr is not None
    while "drawing" not in process.stderr.readline():
        assert process.poll() is None


@pytest.fixture(scope="module")
def killed(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the folder of a run killed early, while it saved and while it drew: all its files are whole."""
    folder, chance = tmp_path_factory.mktemp("killed") / "out", random.Random(31)

    def until_saving(process: subprocess.Popen[str]) -> None:
        while not list(folder.glob(".*.part")) and process.poll() is None:
            time.sleep(1e-3)

    def while_drawing(process: subprocess.Popen[str]) -> None:
        until_drawing(process)
        pause(chance, 2.0)

    kill(folder, lambda process: pause(chance, 2.0))
    kill(folder, until_saving)
    kill(folder, while_drawing)
    assert_nothing_of_another_run(folder)
    return folder


@pytest.fixture(scope="module")
def made(killed: Path) -> tuple[Path, list[tuple[int, str]]]:
    """Return the folder of two runs started at once where one was killed, with status and message of each."""
    both = [started(killed), started(killed)]
    said = [process.communicate(timeout=300)[1] for process in both]
    return killed, [(process.returncode, text) for process, text in zip(both, said, strict=True)]


def test_of_two_runs_after_a_killed_one_one_is_refused(made: tuple[Path, list[tuple[int, str]]]) -> None:
    folder, outcomes = made
    (done, _), (refused, message) = sorted(outcomes)
    assert (done, refused) == (0, 2)
    assert "another tribodyn is writing results there" in message
    assert message.count("\n") == 1
    assert sorted(path.name for path in folder.iterdir()) == WHOLE
    assert_one_run(folder)


@pytest.mark.long
def test_runs_killed_at_fifty_moments(made: tuple[Path, list[tuple[int, str]]], tmp_path: Path) -> None:
    folder, chance = tmp_path / "out", random.Random(53)
    began = time.perf_counter()
    process = started(folder)
    process.communicate(timeout=300)
    lasts = time.perf_counter() - began
    for _ in range(50):
        kill(folder, lambda process: pause(chance, lasts))
        # There was a result before, so there is one now, and nothing that is not of it.
        assert_nothing_of_another_run(folder)
    process = started(folder)
    process.communicate(timeout=300)
    assert process.returncode == 0
    assert_one_run(folder)


def test_who_has_a_folder_alone_removes_what_killed_processes_left_at_once(tmp_path: Path) -> None:
    parts = [tmp_path / place / ".result.nc.1.part" for place in ("", "figures", "points")]
    for part in parts:
        part.parent.mkdir(exist_ok=True)
        part.touch()
    with OutputDirectory(str(tmp_path)).reserved():
        assert not any(part.exists() for part in parts)


def limit_files() -> None:
    resource.setrlimit(resource.RLIMIT_FSIZE, (SMALL, SMALL))


def assert_failed(folder: Path, **options: Callable[[], None]) -> None:
    """Run where there is an earlier result and no room for another: one line says so, and nothing is lost."""
    (folder / "result.nc").write_bytes(b"earlier")
    done = subprocess.run([*RUN, str(folder), "--quiet"], capture_output=True, text=True, **options)
    assert done.returncode == 1
    assert done.stderr.startswith("tribodyn: writing or reading failed: ")
    assert done.stderr.count("\n") == 1
    assert [path.name for path in folder.iterdir()] == ["result.nc"]
    assert (folder / "result.nc").read_bytes() == b"earlier"


def test_a_full_disk(mounted: Callable[[str], Path]) -> None:
    assert_failed(mounted(f"size={SMALL}"))


def test_a_limit_on_the_size_of_files(tmp_path: Path) -> None:
    assert_failed(tmp_path, preexec_fn=limit_files)


@pytest.fixture
def copy(made: tuple[Path, list[tuple[int, str]]], tmp_path: Path) -> Path:
    """Return a folder that holds a real result."""
    folder = tmp_path / "copy"
    folder.mkdir()
    for name in ("result.nc", "summary.json", "case.toml"):
        shutil.copy(made[0] / name, folder)
    return folder


def test_a_damaged_result_is_not_drawn(copy: Path, capfd: pytest.CaptureFixture[str]) -> None:
    file = copy / "result.nc"
    content = file.read_bytes()
    file.write_bytes(content[: len(content) // 2])
    assert main(["report", str(copy)]) == 2
    out, err = capfd.readouterr()
    assert out == ""
    assert err.count("\n") == 1
    assert "result.nc; it is damaged or no result" in err
    assert not (copy / "report.html").exists()


def test_a_summary_that_is_not_of_the_result_is_written_again(copy, monkeypatch, capsys):
    monkeypatch.setattr("tribodyn.cli.commands.report.draw", lambda *_, **__: None)
    summary, case = copy / "summary.json", copy / "case.toml"
    other = json.dumps(json.loads(summary.read_text(encoding="utf-8")) | {"contact_force_max_N": 1.0})
    for content in ('{"title": "Var', other, None):
        if content is None:
            summary.unlink()
            case.unlink()
        else:
            summary.write_text(content, encoding="utf-8")
        assert main(["report", str(copy), "--quiet"]) == 0
        assert "damaged or of another result; it was written again from result.nc" in capsys.readouterr().err
        assert_one_run(copy)
    case.write_text('case = "vsv"  # mine, for the next run\n', encoding="utf-8")
    assert main(["report", str(copy), "--quiet"]) == 0
    assert capsys.readouterr().err == ""
    assert "mine" in case.read_text(encoding="utf-8")


def test_a_report_waits_for_nobody(copy: Path, capsys: pytest.CaptureFixture[str]) -> None:
    with OutputDirectory(str(copy)).reserved():
        assert main(["report", str(copy)]) == 2
    assert "another tribodyn is writing results there" in capsys.readouterr().err


def test_what_a_killed_process_left_is_removed_in_time(tmp_path: Path) -> None:
    old, new = tmp_path / ".result.nc.1.part", tmp_path / ".result.nc.2.part"
    old.touch()
    new.touch()
    os.utime(old, (time.time() - 7200.0,) * 2)
    remove_stale_parts(tmp_path)
    assert (old.exists(), new.exists()) == (False, True)
