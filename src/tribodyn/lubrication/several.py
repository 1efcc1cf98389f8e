"""Films of several joints as the arrays that ``kernels/film/several.py`` takes them from."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Final

import numpy as np

from tribodyn.core.arrays import FloatArray
from tribodyn.core.errors import InputError
from tribodyn.kernels.film.data import FilmData, FilmMemory
from tribodyn.lubrication.film import Film, FilmGrid, new_memory

_NO_FILM: Final = Film(1.0, 1.0, 1.0, 1.0, grid=FilmGrid(8, 4))
"""Gives the arrays of no film their shapes."""


def stacked_data(films: Sequence[Film], wear: Sequence[FloatArray | None]) -> FilmData:
    """Return the data of films, every array with an axis over the films before the others.

    Parameters
    ----------
    films
        Films on one grid, none with ``jfo``; there may be none.
    wear
        Wear depth of each at its nodes [m], shape ``Film.field_shape``; None without wear.

    Raises
    ------
    InputError
        If their grids differ.
    """
    if any(film.grid != films[0].grid for film in films):
        raise InputError("all films of a mechanism have one grid; give the same to each", key="film.grid")
    parts = [film.data(depth) for film, depth in zip(films, wear, strict=True)]
    data: FilmData = _stacked(parts) if parts else _none(_NO_FILM.data())
    return data


def stacked_memory(films: FilmData) -> FilmMemory:
    """Return the caches of the films of :func:`stacked_data`."""
    n_films, n = films.columns.shape
    one = new_memory(n, films.z_face.shape[1] - 1, conserves_mass=False)
    memory: FilmMemory = _stacked([one] * n_films) if n_films else _none(one)
    return memory


def _stacked(parts: Sequence[Any]) -> Any:
    """Return named tuples as one whose arrays have one axis more."""
    first = parts[0]
    if isinstance(first, tuple):
        return type(first)(*map(_stacked, zip(*parts, strict=True)))
    return np.stack(parts)


def _none(one: Any) -> Any:
    """Return the arrays of no film, with the shapes of ``one``."""
    if isinstance(one, tuple):
        return type(one)(*map(_none, one))
    return np.stack([one])[:0].copy()
