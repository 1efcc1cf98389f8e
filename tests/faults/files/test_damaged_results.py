"""Result files with damage anywhere: the numbers that were written, or one error in words, never a crash."""

import json
import random
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from tribodyn.mechanisms.catalogue import load_case
from tribodyn.results import netcdf_content
from tribodyn.simulation import simulate

FEW, MANY = 60, 5000  #: Damaged files in ``make test`` and in ``make test-long``.


TIME_LIMIT = 5.0  #: No file may keep the reader longer than this, in time of the processor [s].


#: Reads one file for each line that it is given, and says what came of it.
READER = f"""
import json, sys, time
from tribodyn.core.errors import InputError
from tribodyn.core.quoting import brief
from tribodyn.mechanisms.results import read
whole = read(sys.argv[1])
for line in sys.stdin:
    began = time.process_time()
    try:
        said = "read" if read(line.strip()).identical(whole) else "changed"
    except InputError as error:
        text = str(error)
        expected = f"cannot read the result in {{brief(line.strip())}}; it is damaged or no result: "
        said = "refused" if text.startswith(expected) and "\\n" not in text else text
    if time.process_time() - began > {TIME_LIMIT}:
        said += ", too slowly"
    print(json.dumps(said), flush=True)
"""


def cut(content: bytearray, draw: random.Random) -> None:
    del content[draw.randrange(len(content)) :]


def change_bytes(content: bytearray, draw: random.Random) -> None:
    for _ in range(draw.choice([1, 2, 5, 50])):
        content[draw.randrange(len(content))] = draw.randrange(256)


def overwrite(content: bytearray, draw: random.Random) -> None:
    start = draw.randrange(len(content))
    end = min(start + draw.randrange(1, 200), len(content))
    content[start:end] = draw.randbytes(end - start)


def clear(content: bytearray, draw: random.Random) -> None:
    start = draw.randrange(len(content))
    end = min(start + draw.randrange(1, 4000), len(content))
    content[start:end] = bytes(end - start)


DAMAGE: list[Callable[[bytearray, random.Random], None]] = [cut, change_bytes, overwrite, clear]


@pytest.fixture(scope="module")
def brief() -> bytes:
    """Return a real result, as short as it gets."""
    case = load_case("vsv").replace({"run.duration": "2 ms", "run.output_interval": "1 ms"})
    dataset: xr.Dataset = simulate(case)
    assert np.isfinite(dataset["e_x"].values).all()
    return netcdf_content(dataset)


@pytest.mark.parametrize("count", [FEW, pytest.param(MANY, marks=pytest.mark.long(minutes=0.8))])
def test_damaged_results_are_read_or_refused(count: int, brief: bytes, tmp_path: Path) -> None:
    whole, damaged = tmp_path / "whole.nc", tmp_path / "damaged.nc"
    whole.write_bytes(brief)
    draw = random.Random(count)
    outcomes: dict[str, int] = {}
    reader = subprocess.Popen(
        [sys.executable, "-c", READER, str(whole)],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    assert reader.stdin is not None
    assert reader.stdout is not None
    for number in range(count):
        content = bytearray(brief)
        draw.choice(DAMAGE)(content, draw)
        damaged.write_bytes(content)
        print(damaged, file=reader.stdin, flush=True)
        said = reader.stdout.readline()
        assert said, f"the reader crashed at file {number}"
        outcomes[json.loads(said)] = outcomes.get(json.loads(said), 0) + 1
    _, stderr = reader.communicate()
    assert reader.returncode == 0
    assert stderr == ""
    # Damage to the checksum's own words, or to what pads the file behind its end, leaves the numbers whole.
    assert set(outcomes) == {"read", "refused"}, outcomes
    assert outcomes["refused"] > 0.9 * count, outcomes
