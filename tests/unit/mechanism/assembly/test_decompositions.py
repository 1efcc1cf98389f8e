"""Large matrices of a mechanism: factors find what singular values would, at a cost linear in bodies."""

import numpy as np
import pytest
from tests.unit.mechanism.drawings import chain, joint, mechanism, rod, with_springs

from tribodyn.mechanism.assembly.decompositions import DEPENDENT, LARGE, factors, row_space, with_unit_rows
from tribodyn.mechanism.assembly.parts_by_number import Model
from tribodyn.mechanism.assembly.records import mechanism_data

N_BODIES = 20


def graph(held: int, *, redundant: int = 0, ring: bool = False, seed: int = 1) -> np.ndarray:
    """Return rows of a chain or ring of bodies, tied to their neighbours by ``held`` rows each.

    As many as ``redundant`` of each body are combinations of its others.
    """
    rng, parts = np.random.default_rng(seed), []
    for body in range(N_BODIES):
        rows = np.zeros((held, N_BODIES, 6))
        rows[:, body] = np.eye(6)[:held] + 0.2 * rng.normal(size=(held, 6))
        if body > 0 or ring:
            rows[:, body - 1] = 0.2 * rng.normal(size=(held, 6))
        own = rows.reshape(held, -1)
        parts.append(np.vstack([own, rng.normal(size=(redundant, held)) @ own]))
    return with_unit_rows(np.vstack(parts))


def dense_one(shape: tuple[int, int], least: float) -> np.ndarray:
    """Return a matrix whose singular values fall from 1 to 0.01, and the last one is ``least``."""
    rng, rank = np.random.default_rng(1), min(shape)
    left, right = (np.linalg.qr(rng.normal(size=(n, rank)))[0] for n in shape)
    values = np.append(np.geomspace(1.0, 1e-2, rank - 1), least)
    return left * values @ right.T


@pytest.mark.parametrize("held", [4, 5, 6])
@pytest.mark.parametrize("redundant", [0, 2])
@pytest.mark.parametrize("ring", [False, True])
def test_factors_find_what_singular_values_do(held: int, redundant: int, *, ring: bool) -> None:
    given = graph(held, redundant=redundant, ring=ring)
    values = np.linalg.svd(given, compute_uv=False)
    rank = int(np.sum(values > DEPENDENT * values[0]))
    assert rank == held * N_BODIES
    found = factors(given)
    if found is None:
        # Motions that run around a ring without ground are found from one body of it, inaccurately.
        assert ring
        assert held < 6
        return
    assert found.rank == rank
    least, largest = found.bounds
    assert 0.3 * values[rank - 1] < least <= values[rank - 1] * (1.0 + 1e-9)
    assert values[0] <= largest
    assert values[rank - 1] * (1.0 - 1e-9) <= found.softest() < 3.0 * values[rank - 1]
    right = np.random.default_rng(2).normal(size=len(given))
    np.testing.assert_allclose(found.solve(right), np.linalg.pinv(given, rcond=1e-9) @ right, atol=1e-9)
    for columns, zero in ((found.null, given @ found.null), (found.dependent.T, found.dependent @ given)):
        np.testing.assert_allclose(columns.T @ columns, np.eye(columns.shape[1]), atol=1e-11)
        np.testing.assert_allclose(zero, 0.0, atol=1e-11)
    assert found.null.shape[1] == given.shape[1] - rank
    assert len(found.dependent) == len(given) - rank


@pytest.mark.parametrize("least", [1e-3, 0.0, 1e-16, 1e-9, 0.5 * DEPENDENT])
@pytest.mark.parametrize("shape", [(LARGE, LARGE + 40), (LARGE + 40, LARGE)])
def test_a_doubtful_rank_is_left_to_singular_values(shape: tuple[int, int], least: float) -> None:
    given = dense_one(shape, least)
    found = factors(given)
    values = np.linalg.svd(given, compute_uv=False)
    if least == 1e-3:
        assert found is not None
    if found is not None:
        assert found.rank == np.sum(values > DEPENDENT * values[0])


@pytest.mark.parametrize("held", [5, 6])
def test_motions_that_some_rows_hold_and_others_leave(held: int) -> None:
    given = graph(held)
    others = given[::2]
    space = row_space(given, held * N_BODIES)
    found = space.left_by(others, len(others))
    assert found.shape[1] == len(given) - len(others)
    np.testing.assert_allclose(found.T @ found, np.eye(found.shape[1]), atol=1e-11)
    np.testing.assert_allclose(others @ found, 0.0, atol=1e-11)
    np.testing.assert_allclose(space.free.T @ found, 0.0, atol=1e-11)
    motion = np.random.default_rng(4).normal(size=given.shape[1])
    np.testing.assert_allclose(
        space.part_of(motion) + space.free @ (space.free.T @ motion), motion, atol=1e-11
    )


def star(n: int) -> Model:
    """Return a ring that turns about the ground, with n bodies hinged to it."""
    ways = [np.array([np.cos(a), np.sin(a), 0.0]) for a in 2.0 * np.pi * np.arange(n) / n]
    vanes = {f"vane {k}": rod(0.5 * way, way) for k, way in enumerate(ways)}
    ring = {"ring": rod((-0.5, 0.0, 0.0), (0.5, 0.0, 0.0))}
    hinges = {
        f"hinge {k}": joint("spherical", ("ring", f"vane {k}"), 0.5 * way) for k, way in enumerate(ways)
    }
    main = {"main": joint("revolute", ("ground", "ring"), (0.0, 0.0, 0.0))}
    return mechanism(ring | vanes, main | hinges)


def softened(model: Model) -> Model:
    """Return a mechanism whose joints are springs, so that nothing but bodies is eliminated."""
    return with_springs(model, 1.0, 1.0, 1.0)


@pytest.mark.parametrize("make", [chain, star])
@pytest.mark.parametrize("change", [lambda d: d, softened], ids=["ideal", "springs"])
def test_operations_grow_linearly(make: object, change: object) -> None:
    for which in ("mass", "newton"):
        counts = [
            [len(operations) for operations in getattr(mechanism_data(change(make(n))), which)[:3]]
            for n in (16, 32, 64)
        ]
        first, second = np.diff(counts, axis=0)
        assert np.all(second == 2 * first), (which, counts)
