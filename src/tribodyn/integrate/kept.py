"""Rows and pictures of an integration, as its solution keeps them."""

from __future__ import annotations

import numpy as np

from tribodyn.core.arrays import FloatArray
from tribodyn.core.problem import Floats, Problem
from tribodyn.integrate.following import take_places


class Kept:
    """Room for all rows and pictures of a run, which takes memory as it is filled.

    Parameters
    ----------
    problem
        Which numbers of a row it keeps, and the type of its pictures.
    n_rows, n_pictures
        Numbers of output times and of times of pictures.

    Attributes
    ----------
    rows
        Shape (n_rows, n_kept).
    pictures
        Shape (n_pictures,) followed by the problem's ``field_shape``.
    numbers
        How many of each have been taken.
    """

    def __init__(self, problem: Problem, n_rows: int, n_pictures: int) -> None:
        self._places = problem.kept
        self.rows: FloatArray = np.empty((n_rows, problem.n_kept))
        self.pictures: Floats = np.empty((n_pictures, *problem.field_shape), dtype=problem.picture_type)
        self.numbers = (0, 0)

    def add_rows(self, rows: FloatArray) -> None:
        """Take over rows in the order of time, shape (n, n_observed)."""
        first, n_pictures = self.numbers
        take_places(rows, self._places, self.rows[first : first + len(rows)])
        self.numbers = first + len(rows), n_pictures

    def add_pictures(self, pictures: FloatArray) -> None:
        """Take over pictures in the order of time, shape (n,) followed by ``field_shape``."""
        n_rows, first = self.numbers
        self.pictures[first : first + len(pictures)] = pictures
        self.numbers = n_rows, first + len(pictures)
