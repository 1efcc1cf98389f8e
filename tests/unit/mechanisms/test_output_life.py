"""Growth of errors by wear, and lives by them."""

import numpy as np
import pytest

from tribodyn.mechanisms.output_numbers import lives, shaft_displacements

ANGLE = np.linspace(-np.pi, np.pi, 97)[:-1]
NORMAL = np.tile(np.column_stack([np.cos(ANGLE), np.sin(ANGLE), 0.0 * ANGLE]), (2, 1))
POSITION = 0.01 * NORMAL + np.repeat([[0.0, 0.0, -0.02], [0.0, 0.0, 0.02]], ANGLE.size, axis=0)
PRESSED = np.maximum(NORMAL[:, 1], 0.0)[None] ** 2


def test_a_shaft_follows_a_bore_that_is_displaced_and_tilted() -> None:
    moved = np.array([0.0, 3e-6, 0.0, 1e-5, 0.0, 0.0])
    depth = NORMAL @ moved[:3] + np.cross(POSITION, NORMAL) @ moved[3:]
    depth = np.where(PRESSED[0] > 0.0, depth, 0.0)
    assert shaft_displacements(POSITION, NORMAL, PRESSED, depth)[0] == pytest.approx(moved, abs=1e-15)


def test_a_shaft_moves_by_no_more_than_the_largest_depth() -> None:
    # Two lines of contact side by side, one of them worn: the shaft would roll far to the side.
    narrow = np.where(np.abs(ANGLE) < 0.1, 1.0, 0.0)
    depth = np.where(ANGLE > 0.0, 1e-6, 0.0)
    weight, worn = np.tile(narrow, 2)[None], np.tile(depth, 2)
    moved = shaft_displacements(POSITION, NORMAL, weight, worn)[0]
    assert np.linalg.norm(moved[:3]) == pytest.approx(1e-6)


def test_no_pressure_is_no_displacement() -> None:
    assert not shaft_displacements(POSITION, NORMAL, 0.0 * PRESSED, PRESSED[0]).any()


def test_lives_are_those_of_the_instant_that_reaches_the_limit_first() -> None:
    error = np.array([[1.0, -2.0, 0.5], [2.0, 1.0, 0.5]])
    growth = np.array([[0.5, -0.1, np.nan], [0.1, -0.1, 0.1]])
    # (4 − 1) / 0.5 = 6 before (4 − 2) / 0.1; (4 − 2) / 0.1 before (4 + 1) / 0.1; no limit.
    assert lives(error, growth, np.array([4.0, 4.0, np.nan])) == pytest.approx(
        [6.0, 20.0, np.nan], nan_ok=True
    )
    assert lives(5.0 + error, growth, np.array([4.0] * 3))[0] == 0.0
