"""A wear campaign whose process is killed at random moments ends as one that was left alone, to the bit."""

import json
import random
import resource
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from tribodyn.cli.main import main
from tribodyn.mechanisms.catalogue import load_case
from tribodyn.mechanisms.results import read
from tribodyn.simulation import simulate

CHANGES = {
    "solver.grid.theta": 24,
    "solver.grid.z": 6,
    "run.output_interval": "50 ms",
    "run.impact_rows": 50,
    "wear.specific_wear_rate": "1.1e-12 m^2/N",
    "wear.cycles": 400,
    "wear.jump_limit": 0.5,
}


def changed(**more: object) -> dict[str, object]:
    return CHANGES | {name.replace("__", "."): value for name, value in more.items()}


def command(changes: dict[str, object]) -> list[str]:
    options = [word for name, value in changes.items() for word in ("--set", f"{name}={value}")]
    quick = ["--quiet", "--no-figures", "--no-report"]
    return [sys.executable, "-m", "tribodyn", "run", "vsv", *quick, *options, "-o", "out"]


def begin(changes: dict[str, object], folder: Path) -> subprocess.Popen[bytes]:
    return subprocess.Popen(
        command(changes), cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
    )


def left_alone(changes: dict[str, object], folder: Path) -> xr.Dataset:
    """Return the result of a campaign that is not disturbed, by a process of its own.

    A process that has called kernels one by one, as other tests do, holds code of them that rounds otherwise.
    """
    folder.mkdir()
    assert begin(changes, folder).wait(timeout=900) == 0
    return read(folder / "out")


def end(process: subprocess.Popen[bytes]) -> bool:
    """Kill a process as a power cut would; False if it was over already."""
    alive = process.poll() is None
    process.kill()
    process.wait(timeout=600)
    return alive


def pause(chance: random.Random, longest: float) -> None:
    """Wait for a part of ``longest``; what pytest shows of a failure says how long it was."""
    seconds = chance.uniform(0.0, longest)
    print(f"killed {seconds:.4f} s later")
    time.sleep(seconds)


def checkpoint_time(folder: Path) -> float:
    path = folder / "out" / "checkpoint.npz"
    return path.stat().st_mtime if path.exists() else 0.0


def wait_for_a_jump(process: subprocess.Popen[bytes], folder: Path, before: float) -> None:
    """Wait until the campaign has been kept once more, or its process is over."""
    deadline = time.monotonic() + 300.0  # compiling may come first
    while checkpoint_time(folder) == before and process.poll() is None:
        assert time.monotonic() < deadline
        time.sleep(0.01)


def same_to_the_bit(one: xr.Dataset, other: xr.Dataset) -> None:
    assert set(one.variables) == set(other.variables)
    for name in one.variables:
        values, others = one[name].values, other[name].values
        assert values.dtype == others.dtype
        assert values.tobytes() == others.tobytes(), name
    facts, other_facts = ({**data.attrs, "solver": json.loads(data.attrs["solver"])} for data in (one, other))
    for attributes in (facts, other_facts):
        del attributes["solver"]["wall_time"]
    assert facts == other_facts


def stopped_without_room(changes: dict[str, object], folder: Path) -> None:
    """Begin a campaign or go on with it where there is no room for a checkpoint: one line says so."""

    def no_room() -> None:
        resource.setrlimit(resource.RLIMIT_FSIZE, (2_000, 2_000))

    done = subprocess.run(
        command(changes), cwd=folder, capture_output=True, text=True, preexec_fn=no_room, check=False
    )
    assert done.returncode == 1
    assert done.stderr.startswith("tribodyn: writing or reading failed: ")
    assert done.stderr.count("\n") == 1


@pytest.mark.long
def test_killed_twice_it_ends_as_one_left_alone(tmp_path: Path) -> None:
    changes, chance = changed(wear__jump_limit=0.25), random.Random(19)
    undisturbed = left_alone(changes, tmp_path / "undisturbed")
    for _ in range(2):
        before = checkpoint_time(tmp_path)
        process = begin(changes, tmp_path)
        wait_for_a_jump(process, tmp_path, before)
        pause(chance, 0.1)  # some 30 cycles, each of which takes about 0.05 s or more
        assert end(process)
    checkpoint = tmp_path / "out" / "checkpoint.npz"
    kept = checkpoint.read_bytes()
    with np.load(checkpoint, allow_pickle=False) as archive:
        assert 0.0 < archive["depth"].max() < float(undisturbed["wear_depth"].max())
    # A full disk takes nothing of it.
    stopped_without_room(changes, tmp_path)
    assert checkpoint.read_bytes() == kept
    assert not (tmp_path / "out" / "result.nc").exists()
    assert begin(changes, tmp_path).wait(timeout=600) == 0
    same_to_the_bit(read(tmp_path / "out"), undisturbed)
    assert not checkpoint.exists()


@pytest.mark.long
def test_killed_fifty_times_it_ends_as_one_left_alone(tmp_path: Path) -> None:
    # At any moment: while Python starts, in a cycle, while a checkpoint is written, while the result is.
    changes, chance = (
        changed(wear__cycles=4000, wear__jump_limit=0.02, wear__jump_depth=0.05),
        random.Random(50),
    )
    began = time.monotonic()
    undisturbed = left_alone(changes, tmp_path / "undisturbed")
    longest = (time.monotonic() - began) / 50  # so that all pauses take half of it, however fast it is
    assert undisturbed.sizes["jump"] > 60
    kills = 0
    while kills < 50:
        before = checkpoint_time(tmp_path)
        process = begin(changes, tmp_path)
        if kills % 5:  # else it may be killed before it has done anything
            wait_for_a_jump(process, tmp_path, before)
        pause(chance, longest)
        assert end(process), "the campaign was over before it was killed often enough"
        kills += 1
    assert begin(changes, tmp_path).wait(timeout=900) == 0
    same_to_the_bit(read(tmp_path / "out"), undisturbed)


def test_a_campaign_without_room_on_the_disk_ends_in_words(tmp_path: Path) -> None:
    stopped_without_room(changed(wear__cycles=1, run__cycles=1), tmp_path)
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("content", [b"", b"\x93NUMPY\x01\x00", b"PK\x03\x04 torn", b"\x80\x04K\x01."])
def test_a_damaged_checkpoint_is_refused_and_kept(content, tmp_path, capsys):
    (tmp_path / "checkpoint.npz").write_bytes(content)
    options = [f"--set={name}={value}" for name, value in CHANGES.items()]
    assert main(["run", "vsv", "--quiet", *options, "-o", str(tmp_path)]) == 2
    message = capsys.readouterr().err
    assert "checkpoint.npz: it cannot be read" in message
    assert message.count("\n") == 1
    assert [(path.name, path.read_bytes()) for path in tmp_path.iterdir()] == [("checkpoint.npz", content)]


def test_another_case_does_not_go_on_from_it(tmp_path: Path) -> None:
    path = tmp_path / "checkpoint.npz"
    simulate(load_case("vsv").replace(changed(wear__cycles=1, run__cycles=1)), checkpoint=path)
    assert path.exists()
    out = tmp_path / "out"
    out.mkdir()
    path.rename(out / "checkpoint.npz")
    other = command(changed(joint__clearance="30 um"))
    found = subprocess.run(other, cwd=tmp_path, capture_output=True, text=True, timeout=300, check=False)
    assert found.returncode == 2
    assert found.stderr.count("\n") == 1
    assert "another case; choose another directory, or remove the file to begin anew" in found.stderr
    assert [file.name for file in out.iterdir()] == ["checkpoint.npz"]
