"""A result as a film and as moving solids."""

import json
import os
import struct
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr
from PIL import Image

import tribodyn as td
from tribodyn.core.errors import InputError
from tribodyn.mechanism.assembly.skeleton import rotated


@pytest.fixture(scope="module")
def result() -> xr.Dataset:
    return td.simulate(td.load_case("four-bar").replace({"run.cycles": 0.1}))


def read(path: Path) -> tuple[dict[str, Any], list[np.ndarray]]:
    """Return the scene of a file of glTF and its arrays."""
    content = path.read_bytes()
    magic, version, length = struct.unpack_from("<4sII", content)
    assert (magic, version, length) == (b"glTF", 2, len(content))
    n, kind = struct.unpack_from("<I4s", content, 12)
    assert (n % 4, kind) == (0, b"JSON")
    scene = json.loads(content[20 : 20 + n])
    data = content[28 + n :]
    arrays = []
    for accessor in scene["accessors"]:
        view = scene["bufferViews"][accessor["bufferView"]]
        dtype = {5126: "<f4", 5125: "<u4"}[accessor["componentType"]]
        part = data[view["byteOffset"] : view["byteOffset"] + view["byteLength"]]
        arrays.append(np.frombuffer(part, dtype).reshape(accessor["count"], -1))
    return scene, arrays


def test_solids_are_closed_and_move_as_the_bodies_do(result: xr.Dataset, tmp_path: Path) -> None:
    scene, arrays = read(result.tribodyn.animate(tmp_path / "run.glb", seconds=2))
    assert [node["name"] for node in scene["nodes"]] == [*result["body"].values, "mechanism"]
    animation = scene["animations"][0]
    for channel in animation["channels"]:
        sampler = animation["samplers"][channel["sampler"]]
        times, values = arrays[sampler["input"]][:, 0], arrays[sampler["output"]]
        assert (times[0], times[-1], times.size) == (0.0, 2.0, 40)
        name = {"translation": "position", "rotation": "orientation"}[channel["target"]["path"]]
        first, last = result[name].values[[0, -1], channel["target"]["node"]]
        if name == "orientation":
            assert np.all(np.sum(values[1:] * values[:-1], axis=1) > 0.0)
            ends = np.roll(values[[0, -1]], 1, axis=1)
            np.testing.assert_allclose(
                rotated(ends, np.eye(3)[:2]), rotated(np.array([first, last]), np.eye(3)[:2]), atol=1e-6
            )
        else:
            np.testing.assert_allclose(values[[0, -1]], [first, last], atol=1e-6)
    for mesh in scene["meshes"]:
        attributes = mesh["primitives"][0]["attributes"]
        corners = arrays[attributes["POSITION"]].reshape(-1, 3, 3).astype(float)
        # A closed surface whose facets look outwards: Σ area normal = 0, and its volume is above zero.
        areas = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        np.testing.assert_allclose(areas.sum(axis=0), 0.0, atol=1e-6 * np.abs(areas).sum())
        assert np.einsum("ij,ij->", corners[:, 0], areas) > 0.0
        np.testing.assert_allclose(np.linalg.norm(arrays[attributes["NORMAL"]], axis=1), 1.0, rtol=1e-5)


@pytest.fixture
def _few_frames(monkeypatch: pytest.MonkeyPatch) -> None:
    """Draw two frames a second."""
    monkeypatch.setattr("tribodyn.report.figures._PER_SECOND", 2)


@pytest.mark.usefixtures("_few_frames")
def test_a_film_shows_the_motion(result: xr.Dataset, tmp_path: Path) -> None:
    with Image.open(result.tribodyn.animate(tmp_path / "run.gif", seconds=1)) as film:
        assert film.n_frames == 2
        first = np.asarray(film.convert("RGB"), dtype=float)
        film.seek(1)
        assert np.abs(np.asarray(film.convert("RGB"), dtype=float) - first).max() > 100.0


@pytest.mark.usefixtures("_few_frames")
def test_ffmpeg_gets_the_frames_of_a_film(result, tmp_path, monkeypatch):
    program = tmp_path / "ffmpeg"
    program.write_text('#!/bin/sh\nfor last; do :; done\ncat > "$last"\n')
    program.chmod(0o755)
    monkeypatch.setenv("PATH", f"{tmp_path}{os.pathsep}{os.environ['PATH']}")
    path = result.tribodyn.animate(tmp_path / "run.mp4", seconds=1)
    frame = 760 * 420 * 4
    assert path.stat().st_size == 2 * frame


def test_what_cannot_be_shown_is_refused(result, tmp_path, monkeypatch):
    monkeypatch.setenv("PATH", str(tmp_path))
    for name, seconds, words in (
        ("run.mp4", 2, "ffmpeg, which is not found"),
        ("run.avi", 2, r"allowed endings: \.gif, \.mp4, \.glb"),
        ("run.gif", 0, "allowed: 1 to 120 seconds"),
    ):
        with pytest.raises(InputError, match=words):
            result.tribodyn.animate(tmp_path / name, seconds=seconds)
    with pytest.raises(InputError, match="no motion to show"):
        result.isel(time=[0]).tribodyn.animate(tmp_path / "run.gif")
    with pytest.raises(InputError, match='kind "vsv" has no animation'):
        xr.Dataset(attrs={"kind": "vsv"}).tribodyn.animate(tmp_path / "run.gif")
    assert not list(tmp_path.iterdir())
