import random

import numpy as np
import pytest

from tribodyn.core.errors import InputError
from tribodyn.core.problem import Statistics
from tribodyn.mechanisms.bushing import Carried
from tribodyn.simulation import checkpoint
from tribodyn.simulation.campaign import Campaign, columns

CASE = 'case = "vsv"\n'
SHAPE = (4, 6)
OF_CYCLE = ("wear_force_mean",)
COLUMNS = columns(OF_CYCLE)


@pytest.fixture
def worn():
    chance = np.random.default_rng(5)
    return Campaign(
        cycles=10**12 - 1,
        depth=chance.random(SHAPE),
        carried=Carried(chance.random(8), chance.random(SHAPE)),
        load=chance.random(SHAPE),
        gain=0.1,
        life=np.inf,
        history={name: chance.random(3) for name in COLUMNS},
        stage_cycles=chance.random(2),
        stage_depth=chance.random((2, 4, 6)),
        statistics=vars(Statistics(steps=7, wall_time=1.0 / 3.0)),
    )


def test_what_is_written_reads_back_to_the_bit(worn, tmp_path):
    path = tmp_path / "checkpoint.npz"
    checkpoint.write(path, worn, CASE)
    found, told = checkpoint.read(path, CASE, SHAPE, 8, OF_CYCLE)
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


def test_another_case_is_refused_and_kept(worn, tmp_path):
    path = tmp_path / "checkpoint.npz"
    checkpoint.write(path, worn, CASE)
    with pytest.raises(InputError, match="another case; choose another directory, or remove the file"):
        checkpoint.read(path, CASE + "# changed\n", SHAPE, 8, OF_CYCLE)
    assert path.exists()


@pytest.mark.parametrize("kept", [0, 1, 100, -1], ids=["empty", "one byte", "a part", "all but one"])
def test_a_torn_file_is_refused(kept, worn, tmp_path):
    path = tmp_path / "checkpoint.npz"
    checkpoint.write(path, worn, CASE)
    path.write_bytes(path.read_bytes()[:kept])
    with pytest.raises(InputError, match="cannot be read"):
        checkpoint.read(path, CASE, SHAPE, 8, OF_CYCLE)


def parts(found):
    """Return the bytes of all that a campaign continues from."""
    arrays = [found.depth, found.load, found.stage_cycles, found.stage_depth, *found.history.values()]
    arrays += [found.carried.state, found.carried.entry_velocity]
    return found.cycles, found.gain, found.life, found.statistics, [array.tobytes() for array in arrays]


def attempt(path):
    try:
        return checkpoint.read(path, CASE, SHAPE, 8, OF_CYCLE)[0]
    except InputError as error:
        return error


@pytest.mark.parametrize("damage", ["cut", "byte", "noise"])
def test_a_damaged_file_is_refused_or_unharmed(damage, worn, tmp_path):
    path = tmp_path / "checkpoint.npz"
    checkpoint.write(path, worn, CASE)
    content, chance = path.read_bytes(), random.Random(damage)
    refused = 0
    for _ in range(300):
        changed = bytearray(content[: chance.randrange(len(content))] if damage == "cut" else content)
        for _ in range({"cut": 0, "byte": 1, "noise": 300}[damage]):
            changed[chance.randrange(len(content))] ^= chance.randrange(1, 256)
        path.write_bytes(changed)
        found = attempt(path)
        if isinstance(found, InputError):
            refused += 1
            assert "a wear campaign cannot continue from" in str(found)
        else:
            assert parts(found) == parts(worn)  # the byte stood for nothing, such as a date
    assert refused > 200 if damage == "byte" else refused == 300


@pytest.mark.parametrize("name", ["depth", "load", "entry_velocity", "state"])
@pytest.mark.parametrize("wrong", [np.zeros((5, 6)), np.zeros((4, 6), np.int8), np.array("text")])
def test_arrays_of_another_shape_or_kind_never_reach_compiled_code(name, wrong, worn, tmp_path):
    path = tmp_path / "checkpoint.npz"
    checkpoint.write(path, worn, CASE)
    with np.load(path, allow_pickle=False) as archive:
        arrays = dict(archive)
    np.savez(path, **{**arrays, name: wrong})
    with pytest.raises(InputError, match="cannot be read"):
        checkpoint.read(path, CASE, SHAPE, 8, OF_CYCLE)


def test_pickled_objects_are_not_loaded(tmp_path):
    path = tmp_path / "checkpoint.npz"
    np.savez(path, facts=np.array([{"format": 2}], dtype=object))
    with pytest.raises(InputError, match="cannot be read"):
        checkpoint.read(path, CASE, SHAPE, 8, OF_CYCLE)


def test_other_versions_are_told(worn, tmp_path, monkeypatch):
    path = tmp_path / "checkpoint.npz"
    versions = checkpoint.provenance()
    monkeypatch.setattr(checkpoint, "provenance", lambda: versions | {"scipy_version": "0.1"})
    checkpoint.write(path, worn, CASE)
    monkeypatch.undo()
    _, told = checkpoint.read(path, CASE, SHAPE, 8, OF_CYCLE)
    assert told == ["The campaign was begun with scipy 0.1: its later cycles were computed with others."]


def test_another_format_is_refused(worn, tmp_path, monkeypatch):
    path = tmp_path / "checkpoint.npz"
    monkeypatch.setattr(checkpoint, "FORMAT", checkpoint.FORMAT - 1)
    checkpoint.write(path, worn, CASE)
    monkeypatch.undo()
    with pytest.raises(InputError, match="another version of tribodyn"):
        checkpoint.read(path, CASE, SHAPE, 8, OF_CYCLE)
