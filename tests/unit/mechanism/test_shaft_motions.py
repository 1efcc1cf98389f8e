"""Motions of the shafts of many couplings at once: the same bits as coupling by coupling."""

import numpy as np
import pytest

from tribodyn.kernels import dense
from tribodyn.mechanism.assembly import shaft_motions
from tribodyn.mechanism.assembly.shaft_motions import ShaftMotions, forces, of_bodies, products, ways

N, M, K = 7, 9, 12


@pytest.fixture
def chance() -> np.random.Generator:
    return np.random.default_rng(7)


@pytest.fixture
def ends(chance: np.random.Generator) -> np.ndarray:
    """Sockets and shafts, some of them the ground."""
    return chance.integers(0, N + 1, (2, K))


def test_products_are_those_of_dense(chance: np.random.Generator) -> None:
    first, second = chance.normal(size=(K, 5, 6)), chance.normal(size=(K, 6, 4))
    expected = [dense.product(a, b) for a, b in zip(first, second, strict=True)]
    assert np.array_equal(products(first, second), expected)


def test_forces_add_up_coupling_by_coupling(chance: np.random.Generator, ends: np.ndarray) -> None:
    pushes, expected = chance.normal(size=(K, 12)), np.zeros((N + 1, 6))
    for k, (socket, shaft) in enumerate(ends.T):
        expected[socket] += pushes[k, :6]
        expected[shaft] += pushes[k, 6:]
    assert np.array_equal(forces(pushes, ends, N), expected[:N].ravel())


@pytest.mark.parametrize("room", [1, 60, 2**16])
@pytest.mark.parametrize("share", [0.2, 1.0])
def test_stiffness_adds_up_coupling_by_coupling(
    chance: np.random.Generator, ends: np.ndarray, monkeypatch: pytest.MonkeyPatch, room: int, share: float
) -> None:
    monkeypatch.setattr(shaft_motions, "_ROOM", room)
    motions = np.where(np.repeat(chance.random((N, M)) < share, 6, axis=0), chance.normal(size=(6 * N, M)), 0)
    arms, slopes, roots = chance.normal(size=(K, 6, 12)), *chance.normal(size=(2, K, 6, 6))
    whole = ways(arms, of_bodies(motions, ends))
    expected = np.zeros((2, M, M))
    for way, slope, root in zip(whole, slopes, roots, strict=True):
        lifted = dense.product(root, way)
        expected[0] += dense.product(dense.product(way.T, slope), way)
        expected[1] += dense.product(lifted.T, lifted)
    assert np.array_equal(ShaftMotions(motions, ends).stiffness(arms, slopes, roots), expected)


def test_nothing_moves(ends: np.ndarray) -> None:
    stiffness, even = ShaftMotions(np.zeros((6 * N, 0)), ends).stiffness(
        np.ones((K, 6, 12)), *np.ones((2, K, 6, 6))
    )
    assert stiffness.shape == even.shape == (0, 0)
