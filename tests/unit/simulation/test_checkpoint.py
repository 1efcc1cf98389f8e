from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest

from tribodyn.core.errors import InputError
from tribodyn.core.problem import Statistics
from tribodyn.mechanisms.vsv import Carried
from tribodyn.simulation import checkpoint
from tribodyn.simulation.campaign import Worn
from tribodyn.simulation.history import COLUMNS

CASE = 'case = "vsv"\n'


@pytest.fixture
def worn():
    random = np.random.default_rng(5)
    return Worn(
        cycles=10**12 - 1,
        depth=random.random((4, 6)),
        carried=Carried(random.random(8), random.random((4, 6))),
        load=random.random((4, 6)),
        gain=0.1,
        life=np.inf,
        history={name: random.random(3) for name in COLUMNS},
        stage_cycles=random.random(2),
        stage_depth=random.random((2, 4, 6)),
        statistics=vars(Statistics(steps=7, wall_time=1.0 / 3.0)),
    )


def test_what_is_written_reads_back_to_the_bit(worn, tmp_path):
    path = tmp_path / "checkpoint.npz"
    checkpoint.write(path, worn, CASE)
    found, told = checkpoint.read(path, CASE)
    assert told == []
    assert (found.cycles, found.gain, found.life) == (worn.cycles, worn.gain, worn.life)
    assert found.statistics == worn.statistics
    pairs = [
        (getattr(found, name), getattr(worn, name))
        for name in ("depth", "load", "stage_cycles", "stage_depth")
    ]
    pairs += [(found.history[name], worn.history[name]) for name in COLUMNS]
    pairs += [(found.carried.state, worn.carried.state)]
    pairs += [(found.carried.entry_velocity, worn.carried.entry_velocity)]
    assert all(one.tobytes() == other.tobytes() and one.shape == other.shape for one, other in pairs)
    assert [file.name for file in tmp_path.iterdir()] == ["checkpoint.npz"]


def test_no_file_is_a_beginning(tmp_path):
    assert checkpoint.read(tmp_path / "checkpoint.npz", CASE) is None


def test_another_case_is_refused_and_kept(worn, tmp_path):
    path = tmp_path / "checkpoint.npz"
    checkpoint.write(path, worn, CASE)
    with pytest.raises(InputError, match="another case; choose another directory, or remove the file"):
        checkpoint.read(path, CASE + "# changed\n")
    assert path.exists()


@pytest.mark.parametrize("kept", [0, 1, 100, -1], ids=["empty", "one byte", "a part", "all but one"])
def test_a_torn_file_is_refused(kept, worn, tmp_path):
    path = tmp_path / "checkpoint.npz"
    checkpoint.write(path, worn, CASE)
    path.write_bytes(path.read_bytes()[:kept])
    with pytest.raises(InputError, match="cannot be read"):
        checkpoint.read(path, CASE)


def test_pickled_objects_are_not_loaded(tmp_path):
    path = tmp_path / "checkpoint.npz"
    np.savez(path, facts=np.array([{"format": 1}], dtype=object))
    with pytest.raises(InputError, match="cannot be read"):
        checkpoint.read(path, CASE)


def test_other_versions_are_told(worn, tmp_path, monkeypatch):
    path = tmp_path / "checkpoint.npz"
    versions = checkpoint.provenance()
    monkeypatch.setattr(checkpoint, "provenance", lambda: versions | {"numba_version": "0.1"})
    checkpoint.write(path, worn, CASE)
    monkeypatch.undo()
    _, told = checkpoint.read(path, CASE)
    assert told == ["The campaign was begun with numba 0.1: its later cycles were computed with others."]


def test_another_format_is_refused(worn, tmp_path, monkeypatch):
    path = tmp_path / "checkpoint.npz"
    monkeypatch.setattr(checkpoint, "FORMAT", 2)
    checkpoint.write(path, worn, CASE)
    monkeypatch.undo()
    with pytest.raises(InputError, match="another version of tribodyn"):
        checkpoint.read(path, CASE)


def test_the_file_says_what_it_is(worn, tmp_path):
    path = tmp_path / "checkpoint.npz"
    checkpoint.write(path, replace(worn, life=12.5), CASE)
    with np.load(path, allow_pickle=False) as archive:
        facts = json.loads(str(archive["facts"]))
        assert float(archive["life"]) == 12.5
    assert facts["case"] == CASE
